// SPDX-License-Identifier: MIT
// Nests polygons on a strip by the page engine of `Raster_packer`, and prints how much of the strip they
// cover.
//
// Usage: nesting_benchmark [--seconds S] [--threads N] FILE.json... A file has the `strip_height` and the
// `items`: of each the `demand`, the `allowed_orientations` in degrees, and the `shape`, a polygon as a list
// of points in `data`. The strip is as long as it has to be. Items keep no distance.
//
// Items that may be turned by all multiples of 90 degrees are; of items that may only be turned upside down,
// every second copy is, and more or less of them in later rounds. So each layout is an allowed one, but not
// every allowed one is looked for.
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/pages/page_task.h>
#include <Atlas/packing/internal/raster/raster_layout.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace Atlas;
using Polygon = std::vector<std::complex<double>>;

/// One copy of an item, counterclockwise about its centre of gravity.
struct Item
{
  Polygon border;
  double area = 0;
  Chart_rotation rotation = Chart_rotation::none;
  bool may_turn_over = false; ///< by 180 degrees, and no other way
};

struct Instance
{
  std::string name;
  double height = 0, area = 0;
  std::vector<Item> items;
};

double cross(std::complex<double> a, std::complex<double> b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

/// Moves the centre of gravity to the origin, and makes the border counterclockwise.
void normalize(Item& item)
{
  Polygon& p = item.border;
  if (p.size() > 1 && p.front() == p.back())
    p.pop_back();
  double twice_area = 0;
  std::complex<double> moment;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::complex<double> a = p[i] - p[0], b = p[(i + 1) % p.size()] - p[0];
    twice_area += cross(a, b);
    moment += cross(a, b) / 3 * (a + b);
  }
  const std::complex<double> centre = p[0] + moment / twice_area;
  for (std::complex<double>& z : p)
    z -= centre;
  if (twice_area < 0)
    std::reverse(p.begin(), p.end());
  item.area = std::abs(twice_area) / 2;
}

Instance read_instance(const std::string& file)
{
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream);
  Instance instance{std::filesystem::path(file).stem().string(), json.at("strip_height"), 0, {}};
  for (const auto& entry : json.at("items")) {
    Item item;
    for (const auto& point : entry.at("shape").at("data"))
      item.border.emplace_back(point.at(0), point.at(1));
    normalize(item);
    const std::vector<double> turns = entry.at("allowed_orientations");
    item.rotation = turns.size() >= 4 ? Chart_rotation::quarter_turns : Chart_rotation::none;
    item.may_turn_over = turns.size() == 2;
    for (int i = 0; i < entry.at("demand"); ++i) {
      instance.items.push_back(item);
      instance.area += item.area;
    }
  }
  return instance;
}

Page_piece piece_of(const Item& item, bool is_turned_over, double unit)
{
  Page_piece piece;
  const std::size_t n = item.border.size();
  for (Index i = 0; i < n; ++i) {
    piece.points.push_back((is_turned_over ? -unit : unit) * item.border[i]);
    piece.segments.push_back({i, static_cast<Index>((i + 1) % n)});
    piece.radius = std::max(piece.radius, std::abs(piece.points.back()));
  }
  piece.number_of_border_segments = n;
  piece.orientation = 1;
  piece.area = unit * unit * item.area;
  piece.rotation = item.rotation;
  return piece;
}

/// \brief Looks for the shortest strip, until time is up.
class Strip_search
{
public:
  Strip_search(const Instance& instance, double seconds, unsigned threads)
      : instance_(instance), start_(std::chrono::steady_clock::now()), seconds_(seconds),
        execution_(threads, [this](double) { return elapsed() < seconds_; })
  {
    double radius = 0;
    for (const Item& item : instance.items)
      for (const std::complex<double>& z : item.border)
        radius = std::max(radius, std::abs(z));
    unit_ = 0.5 / radius;
  }

  /// The share of the strip that is covered, and in how many rounds.
  double operator()(int& rounds)
  {
    double wanted = 0.7, step = 0.04;
    for (rounds = 0; elapsed() < seconds_; ++rounds) {
      const double reached = attempt(wanted, rounds);
      if (reached >= wanted)
        best_ = std::max(best_, reached);
      else if (best_ > 0)
        step = std::max(least_step, 0.6 * step);
      wanted = best_ > 0 ? best_ * (1 + step) : reached;
    }
    return best_;
  }

private:
  static constexpr double least_step = 0.002;
  static constexpr Index side = 2048; ///< texels across the strip

  double elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  /// Nests all items on a strip that they cover by `wanted`. Gives that share, or the smaller one of a strip
  /// of the same proportions that has room for them.
  double attempt(double wanted, int round)
  {
    Page_task task;
    task.height = side;
    task.width = static_cast<Index>(side * instance_.area / (instance_.height * instance_.height * wanted));
    task.margin = 1e-3;
    task.most_scale = side / (instance_.height * unit_);
    std::mt19937 random(static_cast<unsigned>(round));
    for (std::size_t i = 0; i < instance_.items.size(); ++i) {
      const Item& item = instance_.items[i];
      const bool is_turned_over = round == 0 ? i % 2 == 1 : random() % 2 == 1;
      task.pieces.push_back(piece_of(item, item.may_turn_over && is_turned_over, unit_));
    }
    internal::Search_budget budget;
    budget.rounds = 24;
    const auto layout = internal::Raster_engine{budget}.lay_out(task, execution_);
    if (!layout || !is_proved(task, *layout))
      return 0.9 * wanted;
    const double scale = layout->scale / task.most_scale, share = wanted * scale * scale;
    return scale < 1 ? std::min(share, 0.999 * wanted) : share;
  }

  /// Whether no two items overlap, and none sticks out.
  static bool is_proved(const Page_task& task, const Page_layout& layout)
  {
    return keeps_margin(internal::outlines_of(task), internal::layout_of(layout), 0, internal::Obstacles(),
                        task.width, task.height);
  }

  const Instance& instance_;
  std::chrono::steady_clock::time_point start_;
  double seconds_, unit_ = 1, best_ = 0;
  Execution execution_;
};

} // namespace

int main(int argc, char** argv)
try {
  double seconds = 60;
  unsigned threads = 0;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--seconds" && i + 1 < argc)
      seconds = std::strtod(argv[++i], nullptr);
    else if (argument == "--threads" && i + 1 < argc)
      threads = static_cast<unsigned>(std::strtoul(argv[++i], nullptr, 10));
    else
      files.push_back(argument);
  }
  if (files.empty()) {
    std::fprintf(stderr, "usage: nesting_benchmark [--seconds S] [--threads N] FILE.json...\n");
    return 2;
  }
  std::printf("%-16s items  density  rounds\n", "instance");
  for (const std::string& file : files) {
    const Instance instance = read_instance(file);
    int rounds = 0;
    const double density = Strip_search(instance, seconds, threads)(rounds);
    std::printf("%-16s %5zu  %7.4f  %6d\n", instance.name.c_str(), instance.items.size(), density, rounds);
    std::fflush(stdout);
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "nesting_benchmark: %s\n", e.what());
  return 2;
}
