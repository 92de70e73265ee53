// SPDX-License-Identifier: MIT
// The main job as a program: any polygon mesh in, a textured model out, with pictures and a report.
#include <Atlas/IO/checkerboard.h>
#include <Atlas/IO/draw_atlas.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/render_model.h>
#include <Atlas/IO/start_polygons_at_fans.h>
#include <Atlas/IO/write_gltf.h>
#include <Atlas/IO/write_html_report.h>
#include <Atlas/IO/write_obj.h>
#include <Atlas/IO/write_ply.h>
#include <Atlas/IO/write_png.h>
#include <Atlas/IO/write_report.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/generate_atlas.h>

#include <CGAL/assertions.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

enum Exit_code {
  success = 0,
  not_valid = 1,
  wrong_usage = 2,
  io_failure = 3,
  internal_failure = 4,
  interrupted = 130
};

struct Options
{
  std::string mesh, output, report, picture;
  Atlas::Index texture_size = Atlas::default_texture_size;
  double gutter = Atlas::default_gutter;
  unsigned threads = 0;
  bool bakes_colors = false, is_quiet = false, shows_progress = false;
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
                  "their order stay as they are.");
  app.add_option("MESH", options.mesh, "The mesh: .obj, .off, .ply, .stl, .gltf or .glb")->required();
  app.add_option(
      "-o,--output", options.output,
      "The textured model to write, an .obj file. Beside it, with the same stem, appear the material (.mtl), "
      "a checkerboard texture (_checkerboard.png), the page with its charts in colours (_page.png), the "
      "model from several sides (_view.png) and the report (.json). Default: <stem of MESH>_atlas.obj in "
      "the current directory");
  app.add_option("--texture-size", options.texture_size, "Side of the square page in texels")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app.add_option("--gutter", options.gutter,
                 "Least distance between two charts in texels; half of it to the border of the page")
      ->check(CLI::Range(0.0, 16384.0))
      ->capture_default_str();
  app.add_option("--report", options.report,
                 "Where to write the report as JSON, instead of beside the model");
  app.add_option("--threads", options.threads,
                 "Number of threads; 0 takes all cores. The result does not depend on it")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--picture", options.picture,
                 "Also write one PNG picture with the page and the model side by side");
  app.add_flag("--bake-colors", options.bakes_colors,
               "Texture the model with the colours of its vertices (_color.png) instead of the checkerboard");
  app.add_flag("--quiet", options.is_quiet, "Print nothing but errors");
  app.add_flag("--progress", options.shows_progress, "Show progress even if stderr is no terminal");
  app.footer("Exit code: 0 for a valid atlas; 1 if the atlas is not valid or the mesh has no area; 2 for a "
             "wrong command line; 3 for "
             "a file that\ncannot be read or written; 130 if interrupted. Files appear whole or not at all.");
}

/// Sets defaults that depend on other options, and refuses what cannot be.
void complete(Options& options)
{
  if (options.output.empty())
    options.output = fs::path(options.mesh).stem().string() + "_atlas.obj";
  const std::string extension = fs::path(options.output).extension().string();
  const bool is_device = fs::exists(options.output) && !fs::is_regular_file(options.output);
  if (extension != ".obj" && extension != ".glb" && extension != ".ply" && !is_device)
    throw CLI::ValidationError("--output",
                               "the name of the model must end in .obj, .glb or .ply: " + options.output);
  if (!(options.gutter * 2 < options.texture_size)) // not a number fails too
    throw CLI::ValidationError("--gutter", "no room for charts between gutters of " +
                                               CLI::detail::to_string(options.gutter) + " texels");
}

std::atomic<bool> is_interrupted{false};

/// One line on stderr that is written over, or a line per stage where it is no terminal.
class Progress_printer
{
public:
  explicit Progress_printer(const Options& options)
      : is_terminal_(isatty(STDERR_FILENO) != 0),
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
    return !is_interrupted;
  }

  void finish() const
  {
    if (is_shown_ && is_terminal_)
      std::fprintf(stderr, "\r%24s\r", "");
  }

private:
  bool is_terminal_, is_shown_;
  Atlas::Stage stage_{};
  int percent_ = -1;
};

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

/// The name of a file beside the model.
fs::path beside(const fs::path& output, const std::string& suffix)
{
  return output.parent_path() / (output.stem().string() + suffix);
}

Atlas::Image side_by_side(const Atlas::Image& left, const Atlas::Image& right)
{
  Atlas::Image image(left.width + right.width, std::max(left.height, right.height));
  paste(left, image, 0, 0);
  paste(right, image, left.width, 0);
  return image;
}

/// Files that appear together, and their names.
class Outputs
{
public:
  void add(const fs::path& path, const std::string& bytes)
  {
    files_.add(path, bytes);
    names_.push_back(path.string());
  }

  /// Gives the files their names, which are returned.
  const std::vector<std::string>& commit()
  {
    files_.commit();
    return names_;
  }

private:
  Atlas::internal::Output_files files_;
  std::vector<std::string> names_;
};

/// The texture of the model: a checkerboard, or its colours, which are then no longer needed at the vertices.
Atlas::Image make_texture(const Options& options, Atlas::Polygon_soup& model)
{
  const std::size_t side = std::min<std::size_t>(options.texture_size, 4096);
  if (!options.bakes_colors)
    return Atlas::checkerboard(side, std::max<std::size_t>(side / 16, 2));
  Atlas::Image texture = Atlas::bake_vertex_colors(model, side);
  model.colors.clear();
  return texture;
}

/// The model in the format that its extension names, with its texture.
void add_model(Outputs& outputs, const Options& options, const Atlas::Polygon_soup& model,
               const Atlas::Image& texture)
{
  const fs::path output = options.output;
  const fs::path library = beside(output, ".mtl");
  const fs::path picture = beside(output, options.bakes_colors ? "_color.png" : "_checkerboard.png");
  const std::string png = Atlas::png_bytes(texture);
  if (output.extension() == ".glb") {
    outputs.add(output, Atlas::glb_bytes(model, png));
    return;
  }
  if (output.extension() == ".ply") {
    outputs.add(output, Atlas::ply_bytes(model, picture.filename().string()));
  } else {
    outputs.add(output, Atlas::obj_text(model, library.filename().string()));
    outputs.add(library, Atlas::mtl_text(model, picture.filename().string()));
  }
  outputs.add(picture, png);
}

void add_pictures(Outputs& outputs, const Options& options, const Atlas::Polygon_soup& model,
                  const Atlas::Image& texture, const Atlas::Atlas_report& report)
{
  const fs::path output = options.output;
  const std::vector<double> stretch =
      Atlas::face_stretch(Atlas::measure_distortion(model), model.number_of_faces());
  Atlas::Report_pictures pictures;
  pictures.page = Atlas::draw_atlas(model, report.face_chart, 1024, report.certificate.culprits);
  pictures.stretch = Atlas::draw_stretch(model, stretch);
  pictures.view = Atlas::render_model(model, texture);
  outputs.add(beside(output, "_page.png"), Atlas::png_bytes(pictures.page));
  outputs.add(beside(output, "_stretch.png"), Atlas::png_bytes(Atlas::with_stretch_scale(pictures.stretch)));
  outputs.add(beside(output, "_view.png"), Atlas::png_bytes(pictures.view));
  outputs.add(beside(output, ".html"),
              Atlas::html_report(model, report, pictures, fs::path(options.mesh).filename().string()));
  if (!options.picture.empty()) {
    const Atlas::Image page =
        Atlas::draw_atlas(model, report.face_chart, pictures.view.height, report.certificate.culprits);
    outputs.add(options.picture, Atlas::png_bytes(side_by_side(page, pictures.view)));
  }
}

/// Writes everything or nothing. Returns the names of what has been written.
std::vector<std::string> write_outputs(const Options& options, Atlas::Polygon_soup& model,
                                       const Atlas::Atlas_report& report, const Atlas::Json& json)
{
  Outputs outputs;
  const fs::path output = options.output;
  const bool is_device = fs::exists(output) && !fs::is_regular_file(output); // then nothing lies beside it
  if (is_device) {
    outputs.add(output, Atlas::obj_text(model, ""));
  } else {
    const Atlas::Image texture = make_texture(options, model);
    add_model(outputs, options, model, texture);
    add_pictures(outputs, options, model, texture, report);
  }
  if (!is_device || !options.report.empty())
    outputs.add(options.report.empty() ? beside(output, ".json") : fs::path(options.report),
                Atlas::json_text(json));
  return outputs.commit();
}

void print_table(const Options& options, const Atlas::Polygon_soup& model, const Atlas::Atlas_report& report)
{
  const Atlas::Distortion& d = report.distortion;
  const Atlas::Atlas_certificate& c = report.certificate;
  std::printf("mesh          %s: %zu vertices, %zu faces\n",
              fs::path(options.mesh).filename().string().c_str(), model.points.size(), report.faces);
  std::printf("charts        %zu on %zu page%s of %u x %u texels\n", report.charts.size(), report.pages,
              report.pages == 1 ? "" : "s", report.page_width, report.page_height);
  std::printf(
      "distortion    stretch L2 %.3f, Linf %.2f; angles %.3f (1 is conformal); areas %.3f (1 is equal)\n",
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
void print_rejected(const Atlas::Atlas_report& report)
{
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(report.rejected.size(), shown); ++i)
    std::fprintf(stderr, "texture_atlas: face %u (counting from 0) takes no part: %s\n",
                 report.rejected[i].face, message(report.rejected[i].reason));
  if (report.rejected.size() > shown)
    std::fprintf(stderr, "texture_atlas: and %zu more faces; the report lists them\n",
                 report.rejected.size() - shown);
}

int run(const Options& options)
{
  const Stopwatch reading;
  Atlas::Polygon_soup model = Atlas::read_polygon_soup(options.mesh);
  const Atlas::Surface surface = Atlas::build_surface(model.points, model.first, model.vertices);
  if (options.bakes_colors && model.colors.empty())
    throw Atlas::IO_error(options.mesh + ": the vertices have no colours to bake");
  const double seconds_reading = reading.seconds();

  Progress_printer progress(options);
  std::vector<Atlas::Point_2> uv;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(surface, uv,
                            Atlas::parameters::texture_size(options.texture_size)
                                .gutter(options.gutter)
                                .number_of_threads(options.threads)
                                .progress(std::ref(progress)));
  progress.finish();
  if (report.status == Atlas::Atlas_status::cancelled) {
    print_error("interrupted; nothing has been written");
    return interrupted;
  }
  if (report.status == Atlas::Atlas_status::no_surface) {
    print_error(options.mesh + ": " + message(report.status));
    return not_valid;
  }

  const Stopwatch writing;
  model.uv = std::move(uv);
  start_polygons_at_fans(surface, model);
  Atlas::Json json = {{"mesh", options.mesh}, {"vertices", model.points.size()}};
  json.update(to_json(report));
  const std::vector<std::string> names = write_outputs(options, model, report, json);
  if (!options.is_quiet) {
    print_rejected(report);
    print_table(options, model, report);
    print_times(report, seconds_reading, writing.seconds());
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf("%-13s %s\n", i == 0 ? "written" : "", names[i].c_str());
    if (std::fflush(stdout) != 0)
      throw Atlas::IO_error("cannot write to stdout");
  }
  if (!report.is_valid()) {
    print_error(options.mesh + ": " + message(report.certificate));
    return not_valid;
  }
  return success;
}

} // namespace

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
    complete(options);
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
    print_error(options.mesh + ": not enough memory");
    return io_failure;
  } catch (const std::exception& error) {
    print_error(options.mesh + ": internal error: " + error.what());
    return internal_failure;
  }
}
