// SPDX-License-Identifier: MIT
// counted_call NAME: one call of generate_atlas() on a surface that is made here, on one thread, for valgrind
// to count its instructions. Without arguments it prints the names.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace Atlas;

#ifdef __GNUC__
/// What tells whether the two static objects have been made with which CGAL checks, at the start of a
/// program, that intervals are rounded outwards.
extern "C" {
extern char is_rounding_checked __asm__("_ZGVN4CGAL11Interval_ntILb0EE6testerE") __attribute__((weak));
extern char is_protected_rounding_checked __asm__("_ZGVN4CGAL11Interval_ntILb1EE6testerE")
    __attribute__((weak));
}

/// Valgrind rounds to the nearest whatever is set, so that the check would end the program. Before all other
/// static objects: it is taken for done.
struct No_check_of_rounding
{
  No_check_of_rounding()
  {
    for (char* is_done : {&is_rounding_checked, &is_protected_rounding_checked})
      if (is_done)
        *is_done = 1;
  }
};
[[maybe_unused]] const No_check_of_rounding no_check __attribute__((init_priority(101)));
#endif

struct Soup
{
  std::vector<Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
};

void add_box(Soup& soup, const Point_3& corner, const std::array<double, 3>& size)
{
  const std::size_t first = soup.points.size();
  for (int k = 0; k < 8; ++k)
    soup.points.emplace_back(corner.x() + (k % 2) * size[0], corner.y() + (k / 2 % 2) * size[1],
                             corner.z() + (k / 4) * size[2]);
  for (const std::array<std::size_t, 4>& f : {std::array<std::size_t, 4>{0, 2, 3, 1},
                                              {4, 5, 7, 6},
                                              {0, 1, 5, 4},
                                              {2, 6, 7, 3},
                                              {0, 4, 6, 2},
                                              {1, 3, 7, 5}})
    soup.faces.push_back({first + f[0], first + f[1], first + f[2], first + f[3]});
}

/// What every call costs.
Soup box()
{
  Soup soup;
  add_box(soup, Point_3(0, 0, 0), {3, 2, 1});
  return soup;
}

/// Nets, and a page of many of them.
Soup boxes()
{
  Soup soup;
  std::mt19937 random(3);
  const auto side = [&] { return 0.2 + static_cast<double>(random()) / 4294967296.; };
  for (int i = 0; i < 5; ++i) {
    const std::array size{side(), side(), side()};
    add_box(soup, Point_3(2 * (i % 4), 2 * (i / 4), 0), size);
  }
  return soup;
}

/// A closed surface around the origin, of twice as many meridians as parallels; `radius(x, y, z)` tells how
/// far it is in a direction.
template <typename Radius>
Soup round_body(std::size_t parallels, Radius radius)
{
  const std::size_t meridians = 2 * parallels;
  Soup soup;
  const auto add = [&](double x, double y, double z) {
    const double r = radius(x, y, z);
    soup.points.emplace_back(r * x, r * y, r * z);
  };
  add(0, 0, 1);
  for (std::size_t i = 1; i < parallels; ++i)
    for (std::size_t j = 0; j < meridians; ++j) {
      const double a = std::numbers::pi * double(i) / double(parallels),
                   b = 2 * std::numbers::pi * double(j) / double(meridians);
      add(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  add(0, 0, -1);
  const auto vertex = [&](std::size_t i, std::size_t j) {
    return i == 0 ? 0 : i == parallels ? soup.points.size() - 1 : 1 + (i - 1) * meridians + j % meridians;
  };
  for (std::size_t i = 0; i < parallels; ++i)
    for (std::size_t j = 0; j < meridians; ++j) {
      if (i + 1 < parallels)
        soup.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      if (i > 0)
        soup.faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return soup;
}

/// A body with limbs: merging on trial.
Soup body()
{
  const std::array<std::array<double, 3>, 3> limbs{{{1, 0, 0}, {-0.3, 0.9, 0.3}, {-0.4, -0.5, 0.77}}};
  return round_body(20, [&](double x, double y, double z) {
    double r = 1;
    for (const auto& [a, b, c] : limbs)
      r += 1.2 * std::exp(-8 * ((x - a) * (x - a) + (y - b) * (y - b) + (z - c) * (z - c)));
    return r;
  });
}

/// A height field over n x n points.
Soup height_field(std::size_t n)
{
  Soup soup;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const double x = double(i) / double(n), y = double(j) / double(n);
      soup.points.emplace_back(x, y,
                               0.06 * std::sin(7 * x + 2 * y) * std::cos(9 * y) + 0.02 * std::sin(23 * x));
    }
  for (std::size_t j = 0; j + 1 < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const std::size_t a = j * n + i;
      soup.faces.push_back({a, a + 1, a + n + 1});
      soup.faces.push_back({a, a + n + 1, a + n});
    }
  return soup;
}

/// A chart of many triangles: flattening.
Soup hills()
{
  return height_field(80);
}

/// A chart of some hundred triangles, as there are many in scenes.
Soup patch()
{
  return height_field(24);
}

const std::map<std::string, Soup (*)()> meshes{
    {"body", body}, {"box", box}, {"boxes", boxes}, {"hills", hills}, {"patch", patch}};

} // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    for (const auto& mesh : meshes)
      std::puts(mesh.first.c_str());
    return 0;
  }
  const auto mesh = meshes.find(argv[1]);
  if (mesh == meshes.end())
    return 2;
  Soup soup = mesh->second();
  std::vector<Point_2> uv;
  const Atlas_report report =
      generate_atlas(build_surface(std::move(soup.points), soup.faces), uv, parameters::number_of_threads(1));
  std::printf("%s: %zu faces, %zu charts, %s\n", argv[1], report.faces, report.charts.size(),
              message(report.status));
  return report.is_valid() ? 0 : 1;
}
