// SPDX-License-Identifier: MIT
// The main job as a program: any polygon mesh in, a textured model out, with pictures and a report.
#include <Atlas/image/IO_error.h>
#include <Atlas/image/pages.h>
#include <Atlas/soup/orient_faces.h>
#include <Atlas/soup/start_polygons_at_fans.h>

#include <CGAL/assertions.h>

#include "texture_atlas.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <new>
#include <set>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

enum Exit_code {
  success = 0,
  not_valid = 1,
  wrong_usage = 2,
  io_failure = 3,
  internal_failure = 4,
  out_of_time = 124, // as of the command `timeout`
  interrupted = 130
};

/// A message may come from a library and have several lines; scripts rely on one.
void print_error(std::string message)
{
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "texture_atlas: %s\n", message.c_str());
}

void declare_options(CLI::App& app, Options& options)
{
  app.description("Makes a texture atlas of a polygon mesh: cuts it into charts, flattens them by least "
                  "squares conformal maps,\n"
                  "packs them into the unit square and proves the result free of flips and overlaps. "
                  "Vertices, faces and\n"
                  "their order stay as they are. Several meshes share one atlas and its density.");
  app.add_option("MESH", options.meshes, "The mesh, or several: .obj, .off, .ply, .stl, .gltf or .glb")
      ->required();
  app.add_option(
      "-o,--output", options.output,
      "The textured model to write, an .obj file. Beside it, with the same stem, appear the material (.mtl), "
      "a checkerboard texture (_checkerboard.png), the page with its charts in colours (_page.png), the "
      "model from several sides (_view.png) and the report (.json). Default: <stem of MESH>_atlas.obj in "
      "the current directory. Of several meshes each gets a model whose name adds its own stem, `out.obj` "
      "becomes `out_<stem of MESH>.obj`, and they share all other files; default: atlas.obj");
  app.add_option(
         "--mode", options.mode,
         "What matters most: `standard` has few charts with low distortion, `few-seams` fewer and larger "
         "charts with more of it, `conformal` least squares conformal maps as they are")
      ->check(CLI::IsMember({"standard", "few-seams", "conformal"}))
      ->capture_default_str();
  CLI::Option* max_distortion =
      app.add_option("--max-distortion", options.max_distortion,
                     "Charts merge while their mean symmetric Dirichlet energy (1 is isometric), in the mode "
                     "`conformal` the ratio of densities, stays below this. Default: that of the mode")
          ->check(CLI::Range(1.0, 1e6));
  app.add_option(
         "--measure", options.measure,
         "What --max-distortion is about instead; 1 is best. `area-ratio` is the largest over the "
         "smallest density in a chart, with `-quantiles` but for the extreme 1 % of the area at either "
         "end; charts that do not keep these are split")
      ->check(CLI::IsMember({"symmetric-dirichlet", "l2-stretch", "linf-stretch", "area-ratio",
                             "area-ratio-quantiles", "quasi-conformal"}))
      ->needs(max_distortion);
  app.add_option(
      "--max-charts", options.max_charts,
      "Merge on until there are at most so many charts, as far as they stay discs. Default: no limit");
  app.add_option("--min-chart-texels", options.min_chart_texels,
                 "Merge charts of fewer texels, about, with a neighbour. Default: no limit")
      ->check(CLI::Range(0.0, 1e10));
  app.add_option("--hard-angle", options.hard_angle,
                 "Cut at edges where normals turn by more than so many degrees. Default: none")
      ->check(CLI::Range(0.0, 180.0));
  app.add_flag("--separate-materials", options.separates_materials,
               "Let no chart have faces of two materials");
  app.add_flag(
      "--keep-uv", options.keeps_uv,
      "Keep the shapes of the charts that the file has, and split only those that are not one-to-one; "
      "faces without coordinates are flattened. Does not go with options that tell what charts are like");
  app.add_flag("--orient", options.turns_faces,
               "Turn faces around first, so that neighbours agree which side is outside, as most of them do. "
               "Charts never run over an edge where they disagree");
  add_packing_options(app, options);
  app.add_option("--report", options.report,
                 "Where to write the report as JSON, instead of beside the model");
  app.add_option("--threads", options.threads,
                 "Number of threads; 0 takes all cores. The result does not depend on it")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--time-limit", options.time_limit,
                 "Give up after so many seconds, and write nothing. Default: no limit")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--picture", options.picture,
                 "Also write one PNG picture with the page and the model side by side");
  app.add_option(
         "--bake", options.bakes,
         "What to bake into the page: `colors` of the vertices (_color.png) or the old `texture` "
         "(_texture.png) instead of the checkerboard; `normals` in the space of the model "
         "(_normal.png) and ambient `occlusion` (_occlusion.png) beside it. May be given several times")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Bake>{{"colors", Bake::colors},
                                                                      {"texture", Bake::texture},
                                                                      {"normals", Bake::normals},
                                                                      {"occlusion", Bake::occlusion}})
                      .description("colors|texture|normals|occlusion"))
      ->allow_extra_args(false);
  app.add_flag("--quiet", options.is_quiet, "Print nothing but errors");
  app.add_flag("--progress", options.shows_progress, "Show progress even if stderr is no terminal");
  app.footer("Exit code: 0 for a valid atlas; 1 if the atlas is not valid or the mesh has no area; 2 for a "
             "wrong command line; 3 for "
             "a file that\ncannot be read or written; 124 if the time limit is over; 130 if interrupted. "
             "Files appear whole or not at all.");
}

/// Refuses options that have no meaning with, or without, the coordinates of the file.
void check_use_of_uv(const CLI::App& app, const Options& options)
{
  const auto refuse = [&](const char* option, const char* named, const std::string& why) {
    if (app.count(option) > 0)
      throw CLI::ValidationError(named, why);
  };
  if (!options.keeps_uv) {
    for (const char* name : {"--group", "--lock"})
      refuse(name, name, "charts have places only where those of the file are kept: add --keep-uv");
    return;
  }
  for (const char* name : {"--mode", "--max-distortion", "--measure", "--max-charts", "--min-chart-texels",
                           "--hard-angle", "--separate-materials"})
    refuse(name, "--keep-uv",
           std::string("the charts of the file stay as they are, so ") + name +
               " has no meaning: leave out one of the two");
}

/// Sets defaults that depend on other options, and refuses what cannot be.
void complete_all(const CLI::App& app, Options& options)
{
  if (options.output.empty())
    options.output = options.meshes.size() > 1
                         ? "atlas.obj"
                         : fs::path(options.meshes.front()).stem().string() + "_atlas.obj";
  const std::string extension = fs::path(options.output).extension().string();
  const bool is_device = fs::exists(options.output) && !fs::is_regular_file(options.output);
  if (is_device && options.meshes.size() > 1)
    throw CLI::ValidationError("--output", "several models cannot go to one place: " + options.output);
  if (extension != ".obj" && extension != ".glb" && extension != ".ply" && !is_device)
    throw CLI::ValidationError("--output",
                               "the name of the model must end in .obj, .glb or .ply: " + options.output);
  complete(options);
  check_use_of_uv(app, options);
}

std::atomic<bool> is_interrupted{false};

class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// How long to go on: until a signal comes, or the time is over.
class Patience
{
public:
  explicit Patience(double limit) : limit_(limit) {}

  bool is_over() const { return is_interrupted || is_late(); }

  /// Tells why the work ended; returns the exit code.
  Exit_code say() const
  {
    if (is_interrupted)
      print_error("interrupted; nothing has been written");
    else
      print_error("not finished within the time limit; nothing has been written");
    return is_interrupted ? interrupted : out_of_time;
  }

private:
  bool is_late() const { return limit_ > 0 && watch_.seconds() > limit_; }

  double limit_;
  Stopwatch watch_;
};

/// One line on stderr that is written over, or a line per stage where it is no terminal.
class Progress_printer
{
public:
  Progress_printer(const Options& options, const Patience& patience)
      : patience_(patience), is_terminal_(isatty(STDERR_FILENO) != 0),
        is_shown_((is_terminal_ || options.shows_progress) && !options.is_quiet)
  {}

  bool operator()(Atlas::Stage stage, double fraction)
  {
    const int percent = static_cast<int>(100 * fraction);
    if (is_shown_ && is_terminal_ && (stage != stage_ || percent != percent_))
      std::fprintf(stderr, "\r%-16s %3d %%", Atlas::name(stage), percent);
    else if (is_shown_ && !is_terminal_ && (percent_ < 0 || stage != stage_))
      std::fprintf(stderr, "%s\n", Atlas::name(stage));
    stage_ = stage;
    percent_ = percent;
    return !patience_.is_over();
  }

  void finish() const
  {
    if (is_shown_ && is_terminal_)
      std::fprintf(stderr, "\r%24s\r", "");
  }

private:
  const Patience& patience_;
  bool is_terminal_, is_shown_;
  Atlas::Stage stage_{};
  int percent_ = -1;
};

void print_table(const Options& options, const Atlas::Polygon_soup& model, const Atlas::Atlas_report& report)
{
  const Atlas::Distortion& d = report.distortion;
  const Atlas::Atlas_certificate& c = report.certificate;
  std::printf("mesh          %s: %zu vertices, %zu faces\n", options.title().c_str(), model.points.size(),
              report.faces);
  std::printf("charts        %zu on %zu page%s of %u x %u texels", report.charts.size(), report.pages,
              report.pages == 1 ? "" : "s", report.page_width, report.page_height);
  if (report.stacked_charts > 0)
    std::printf(", %zu of them on copies of theirs", report.stacked_charts);
  std::printf(
      "\ndistortion    stretch L2 %.3f, Linf %.2f; angles %.3f (1 is conformal); areas %.3f (1 is equal)\n",
      d.l2_stretch, d.linf_stretch, d.quasi_conformal_mean, d.area_mean);
  std::printf("packing       %.1f %% of the page covered, %.4g texels per unit",
              100 * report.packing_efficiency, report.density);
  if (report.charts.size() > 1)
    std::printf(", charts %.2f texels apart", c.chart_distance);
  std::printf(
      "\nverdict       %s: %zu flipped, %zu flat, %zu overlapping, %zu of %zu faces without a shape\n",
      report.is_valid() ? "valid" : "NOT VALID", c.flipped, c.degenerate,
      c.overlaps_in_charts + c.overlaps_between_charts, report.rejected.size(), report.faces);
}

void print_times(const Atlas::Atlas_report& report, double reading, double writing)
{
  std::printf("time          reading %.2f s", reading);
  for (const Atlas::Stage stage : Atlas::all_stages)
    std::printf(", %s %.2f s", Atlas::name(stage), report.seconds[static_cast<std::size_t>(stage)]);
  std::printf(", pictures and writing %.2f s\n", writing);
}

/// Tells of faces that take no part; the report has all of them.
void print_rejected(const Options& options, const Atlas::Joined_soups& models,
                    const Atlas::Atlas_report& report)
{
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(report.rejected.size(), shown); ++i) {
    const std::size_t face = report.rejected[i].face;
    std::size_t mesh = models.number_of_parts() - 1;
    while (models.first_face(mesh) > face)
      --mesh;
    std::fprintf(stderr, "texture_atlas: %s%sface %zu (counting from 0) takes no part: %s\n",
                 models.number_of_parts() > 1 ? options.meshes[mesh].c_str() : "",
                 models.number_of_parts() > 1 ? ": " : "", face - models.first_face(mesh),
                 message(report.rejected[i].reason));
  }
  if (report.rejected.size() > shown)
    std::fprintf(stderr, "texture_atlas: and %zu more faces; the report lists them\n",
                 report.rejected.size() - shown);
}

/// How many faces of locked materials are not where they were.
std::size_t moved_locked_faces(const Options& options, const Atlas::Polygon_soup& model)
{
  constexpr double tolerance = 1e-5;
  const std::vector<Material_rule> rules = rules_of(options.materials, model);
  const std::vector<Atlas::Point_2> uv = Atlas::udim_uv(model);
  std::size_t count = 0;
  for (std::size_t f = 0; f < model.face_material.size(); ++f) {
    bool is_moved = false;
    for (std::size_t c = model.first[f]; c < model.first[f + 1]; ++c)
      is_moved = is_moved || !(std::abs(uv[c].x() - model.old_uv[c].x()) <= tolerance &&
                               std::abs(uv[c].y() - model.old_uv[c].y()) <= tolerance);
    const Atlas::Index material = model.face_material[f];
    count += is_moved && material != Atlas::no_index && rules[material].is_locked;
  }
  return count;
}

/// Tells of wishes that could not be fulfilled.
void print_unfulfilled(const Options& options, const Atlas::Polygon_soup& model,
                       const Atlas::Atlas_report& report)
{
  if (!options.materials.locked.empty())
    if (const std::size_t moved = moved_locked_faces(options, model))
      std::fprintf(stderr,
                   "texture_atlas: %zu faces of locked materials have no usable place in the file (no "
                   "coordinates, face down, or folded) and got another\n",
                   moved);
  constexpr double tolerance = 1e-6;
  if (report.density < options.page.density * (1 - tolerance))
    std::fprintf(
        stderr,
        "texture_atlas: a chart at %g texels per unit is larger than a page; all charts have %g instead\n",
        options.page.density, report.density);
  if (options.max_charts > 0 && report.charts.size() > options.max_charts)
    std::fprintf(stderr, "texture_atlas: fewer than %zu charts would not be discs without overlap\n",
                 report.charts.size());
}

/// Tells why there may be so many charts.
void print_disagreement(const Options& options, const Atlas::Polygon_soup& model,
                        const Atlas::Atlas_report& report)
{
  constexpr std::size_t many_charts = 20;
  if (options.turns_faces || report.charts.size() < many_charts)
    return;
  if (const std::size_t edges = Atlas::disagreeing_edges(model))
    std::fprintf(
        stderr,
        "texture_atlas: at %zu edges two faces disagree which side is outside, and no chart runs over "
        "these; --orient turns faces\n",
        edges);
}

int run(const Options& options)
{
  const Patience patience(options.time_limit);
  const Stopwatch reading;
  Input input = read_meshes(options);
  Atlas::Polygon_soup& model = input.models.whole();
  const double seconds_reading = reading.seconds();

  Progress_printer progress(options, patience);
  std::vector<Atlas::Point_2> uv;
  const Atlas::Atlas_report report = make_atlas(options, model, input.surface, uv, std::ref(progress));
  progress.finish();
  if (report.status == Atlas::Atlas_status::cancelled)
    return patience.say();
  if (report.status == Atlas::Atlas_status::no_surface) {
    print_error(options.name() + ": " + message(report.status));
    return not_valid;
  }

  const Stopwatch writing;
  const Atlas::Execution execution(options.threads, [&](double) { return !patience.is_over(); });
  model.old_uv = std::exchange(model.uv, std::move(uv));
  model.face_page = report.face_page;
  start_polygons_at_fans(input.surface, model);
  const std::vector<std::string> names = write_outputs(options, input, report, execution);
  if (execution.is_cancelled())
    return patience.say();
  if (!options.is_quiet) {
    print_rejected(options, input.models, report);
    print_unfulfilled(options, model, report);
    print_disagreement(options, model, report);
    print_table(options, model, report);
    print_times(report, seconds_reading, writing.seconds());
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf("%-13s %s\n", i == 0 ? "written" : "", names[i].c_str());
    if (std::fflush(stdout) != 0)
      throw Atlas::IO_error("cannot write to stdout");
  }
  if (!report.is_valid()) {
    print_error(options.name() + ": " + message(report.certificate));
    return not_valid;
  }
  return success;
}

} // namespace

bool Options::has(Bake bake) const
{
  return std::find(bakes.begin(), bakes.end(), bake) != bakes.end();
}

std::string Options::name() const
{
  std::string result;
  for (const std::string& file : meshes)
    result += (result.empty() ? "" : ", ") + file;
  return result;
}

std::string Options::title() const
{
  std::string result;
  for (const std::string& file : meshes)
    result += (result.empty() ? "" : ", ") + fs::path(file).filename().string();
  return result;
}

std::vector<std::string> Options::models() const
{
  if (meshes.size() == 1)
    return {output};
  const fs::path path = output;
  std::vector<std::string> result;
  std::set<std::string> taken;
  for (const std::string& file : meshes) {
    const std::string stem = path.stem().string() + '_' + fs::path(file).stem().string();
    std::string name = stem;
    for (int number = 2; !taken.insert(name).second; ++number)
      name = stem + '_' + std::to_string(number);
    result.push_back((path.parent_path() / (name + path.extension().string())).string());
  }
  return result;
}

int main(int argc, char** argv)
{
  std::signal(SIGXFSZ, SIG_IGN); // a limit of the file size is then an error like a full disk
  std::signal(SIGPIPE, SIG_IGN);
  const auto interrupt = [](int) { is_interrupted = true; };
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});

  Options options;
  CLI::App app("", "texture_atlas");
  declare_options(app, options);
  try {
    app.parse(argc, argv);
    complete_all(app, options);
    return run(options);
  } catch (const CLI::CallForHelp&) {
    std::fputs((app.help() + '\n').c_str(), stdout);
    return std::fflush(stdout) == 0 ? success : io_failure;
  } catch (const CLI::Error& error) {
    print_error(std::string(error.what()) + " (see --help)");
    return wrong_usage;
  } catch (const Atlas::IO_error& error) {
    print_error(error.what());
    return io_failure;
  } catch (const fs::filesystem_error& error) {
    print_error(error.what());
    return io_failure;
  } catch (const std::bad_alloc&) {
    print_error(options.name() + ": not enough memory");
    return io_failure;
  } catch (const std::exception& error) {
    print_error(options.name() + ": internal error: " + error.what());
    return internal_failure;
  }
}
