// SPDX-License-Identifier: MIT
// The command line.
#include <Atlas/IO/internal/extension.h>

#include "bakes.h"
#include "texture_atlas.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace {

namespace fs = std::filesystem;

/// What is bounded besides the mean, and what the bounds allow.
void add_stretch_options(CLI::App& app, Options& options)
{
  CLI::Option* max_stretch =
      app.add_option(
             "--max-stretch", options.max_stretch,
             "Besides, no length in a chart is stretched or shrunk by more than this factor, the chart "
             "scaled to its area in space. Charts that exceed this or --max-distortion are cut until "
             "they do not, or the report tells why. Default: 1.5 in the mode standard, 2.5 in the others")
          ->check(CLI::Range(1.0, 1e6));
  app.add_option("--max-stretch-share", options.max_stretch_share,
                 "The share of each chart's area that has to keep --max-stretch; 1: every triangle. "
                 "Default: 0.99")
      ->check(CLI::Range(1e-6, 1.0))
      ->needs(max_stretch);
  app.add_flag(
      "--straighten", options.is_straightened,
      "Make rectangles of regular grids of quadrilaterals (a tube, a road, a rope), rows and columns "
      "on straight lines, where the bounds on distortion allow it");
}

/// What charts are to be like.
void add_chart_options(CLI::App& app, Options& options)
{
  app.add_option(
         "--mode", options.mode,
         "What matters most: `standard` has few charts with low distortion, `few-seams` fewer and larger "
         "charts with more of it, `conformal` least squares conformal maps as they are, `paper` is Levy et "
         "al. "
         "2002 to the letter")
      ->check(CLI::IsMember({"standard", "few-seams", "conformal", "paper"}))
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
  app.add_option("--symmetry", options.symmetry,
                 "Cut left and right alike: where the mesh is its own mirror image but for 0.5 % of its "
                 "diagonal, at the best plane there is (`auto`) or at one across an axis, so are its charts")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Atlas::Symmetry>{{"off", Atlas::Symmetry::off},
                                                                         {"auto", Atlas::Symmetry::automatic},
                                                                         {"x", Atlas::Symmetry::x},
                                                                         {"y", Atlas::Symmetry::y},
                                                                         {"z", Atlas::Symmetry::z}})
              .description("off|auto|x|y|z"));
  app.add_flag("--separate-materials", options.separates_materials,
               "Let no chart have faces of two materials");
  app.add_option(
      "--seams", options.seams,
      "A file of edges that must be seams: lines `l a b c ...` as in OBJ files, or `a b c ...`, are "
      "chains of vertices of the mesh, counting from 1; in a file with vertices of its own (`v x y "
      "z`) of those, which must be at the places of the mesh's");
}

void add_pinned_option(CLI::App& app, Options& options)
{
  app.add_option("--pinned", options.pinned,
                 "A file of lines `vertex u v`: vertices of the mesh, counting from 1, that get these "
                 "coordinates in [0, 1]. Their charts follow, and the others are packed around them. What "
                 "cannot be kept is told");
}

void add_aspect_option(CLI::App& app, Options& options)
{
  app.add_flag("--free-aspect", options.page.has_free_aspect,
               "Let the sides of the page have another ratio, with about as many texels: that at which the "
               "charts cover most of it. Takes 17 packings. The report tells the sides");
}

/// What charts do for fuller pages.
void add_coverage_options(CLI::App& app, Options& options)
{
  app.add_option("--min-coverage", options.min_coverage,
                 "Cut charts until they cover this share of the pages, with as little seam as is found. The "
                 "report tells if no cut helps any longer. Takes some 5 to 30 packings")
      ->check(CLI::Range(0.0, 0.99));
  app.add_option(
         "--seam-exchange-rate", options.seam_exchange_rate,
         "Cut charts where that gives so many per cent more texels per unit for each per cent of added "
         "seam, both relative; 0: never. Default: in the mode `standard` 0.5, on pages less than 75 % full, "
         "with seams at most 6 % longer, or 35 % where that fills a page to 65 %; "
         "else never; never with --max-charts, --min-chart-texels, --symmetry, --segmentation, --density "
         "or --keep-uv")
      ->check(CLI::Range(0.0, 1e6));
  app.add_option("--min-texels-per-chart", options.min_texels_per_chart,
                 "Enlarge charts of fewer texels until they have so many. Default: no limit")
      ->check(CLI::Range(0.0, 1e6));
}

/// Where seams run.
void add_seam_options(CLI::App& app, Options& options)
{
  app.add_flag("--seams-only", options.has_only_given_seams,
               "Let charts be what --seams, --hard-angle and --separate-materials make, whatever their "
               "distortion; only what is no disc, or covers itself in the plane, is cut further");
  app.add_option(
         "--hide-seams", options.hiding,
         "Let seams run where they are hardly seen, even if they get a little longer. `openness`: where "
         "little light gets to; `view:X,Y,Z`: out of sight of a viewer in that direction; `dome:AXIS`: "
         "of viewers in the half-space there, such as `dome:z` above the ground, an axis being `x`, "
         "`-x`, `y` ... or X,Y,Z; `colors`: where the colours of the vertices are dark; else a file "
         "with a number per vertex, 0 where seams are hidden to 1 where they are seen")
      ->check([](const std::string& text) {
        return is_hiding(text) ? std::string()
                               : "'" + text + "' has no axis: x, -x, y ... or X,Y,Z, not all 0";
      })
      ->type_name("openness|view:AXIS|dome:AXIS|colors|FILE");
}

/// What is done with the coordinates and faces of the file.
void add_input_options(CLI::App& app, Options& options)
{
  app.add_flag(
      "--keep-uv", options.keeps_uv,
      "Keep the shapes of the charts that the file has, and split only those that are not one-to-one; "
      "faces without coordinates are flattened. Does not go with options that tell what charts are like");
  app.add_flag(
         "--defragment", options.merges_uv,
         "Merge the charts that the file has where the union can be flattened within --max-distortion and "
         "--max-stretch; all others keep their shapes. With --bake texture the texture moves along")
      ->excludes("--keep-uv");
  app.add_option(
         "--only", options.only,
         "MATERIAL: unwrap its faces anew, and pack them around the charts of all others, which stay where "
         "they are in the file. May be given several times")
      ->allow_extra_args(false);
  app.add_flag("--orient", options.turns_faces,
               "Turn faces around first, so that neighbours agree which side is outside, as most of them do. "
               "Charts never run over an edge where they disagree");
  app.add_option(
         "--weld", options.weld,
         "Take vertices for one that are nearer to each other than this share of the longest side of "
         "the model's bounding box, as 1e-5: triangles of scanners and of STL files often hardly miss "
         "each other. The model is written with the vertices that it has. Default: only equal ones")
      ->check(CLI::Range(1e-12, 0.1));
}

void add_output_options(CLI::App& app, Options& options)
{
  app.add_option(
         "--uv-set", options.uv_set,
         "Of a glTF file written as .glb: the number of the new set of coordinates, 1 for a lightmap. Sets "
         "from there on move up by one, and textures with them")
      ->check(CLI::Range(0, 7))
      ->capture_default_str();
}

void add_run_options(CLI::App& app, Options& options)
{
  app.add_option("--report", options.report,
                 "Where to write the report as JSON, instead of beside the model");
  app.add_option("--threads", options.threads,
                 "Number of threads; 0 takes all cores. The result does not depend on it")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--time-limit", options.time_limit,
                 "Give up after so many seconds, and write nothing. Default: no limit")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option(
         "--memory-limit", options.memory_limit,
         "Refuse, before the work, what will take more than so many gigabytes, about; and end the work "
         "when its data take more. Pictures are not in the estimate. Default: no limit")
      ->check(CLI::Range(0.0, 1e6));
}

/// Refuses options that tell how charts merge where they do not.
void check_use_of_merging(const CLI::App& app, const Options& options)
{
  if (options.mode != "paper" && options.stages.segmentation.empty())
    return;
  const std::string named =
      options.stages.segmentation.empty() ? "--mode paper" : "--segmentation " + options.stages.segmentation;
  for (const char* name : {"--max-distortion", "--max-charts", "--min-chart-texels", "--symmetry"})
    if (app.count(name) > 0)
      throw CLI::ValidationError(name, "has no meaning with " + named + ", whose charts are not merged");
}

/// Refuses options that have no meaning where vertices are pinned.
void check_use_of_pinned(const CLI::App& app, const Options& options)
{
  if (options.pinned.empty())
    return;
  if (options.meshes.size() > 1)
    throw CLI::ValidationError("--pinned", "speaks of the vertices of one mesh, but there are several");
  for (const char* name :
       {"--keep-uv", "--defragment", "--only", "--weight", "--stack", "--free-aspect", "--min-coverage"})
    if (app.count(name) > 0)
      throw CLI::ValidationError("--pinned", std::string("does not go with ") + name);
}

/// Refuses options that have no meaning with, or without, the coordinates of the file.
void check_use_of_uv(const CLI::App& app, const Options& options)
{
  const auto refuse = [&](const char* option, const char* named, const std::string& why) {
    if (app.count(option) > 0)
      throw CLI::ValidationError(named, why);
  };
  if (!options.only.empty())
    for (const char* name : {"--keep-uv", "--defragment", "--group", "--lock", "--weight", "--stack",
                             "--free-aspect", "--min-coverage"})
      refuse(name, "--only", std::string("does not go with ") + name);
  if (options.merges_uv)
    for (const char* name : {"--straighten", "--symmetry", "--segmentation", "--parameterizer", "--solver",
                             "--pins", "--optimizer", "--validator", "--max-area-ratio"})
      refuse(name, "--defragment", std::string("charts come from those of the file: leave out ") + name);
  if (options.has_only_given_seams)
    for (const char* name : {"--max-distortion", "--measure", "--max-stretch", "--max-charts",
                             "--min-chart-texels", "--symmetry", "--straighten", "--segmentation",
                             "--keep-uv", "--defragment", "--min-coverage", "--seam-exchange-rate"})
      refuse(name, "--seams-only", std::string("the seams are given: leave out ") + name);
  if (options.merges_uv && options.mode == "paper")
    throw CLI::ValidationError("--defragment", "charts do not merge in --mode paper");
  if (!options.keeps_uv) {
    for (const char* name : {"--group", "--lock"})
      refuse(name, name, "charts have places only where those of the file are kept: add --keep-uv");
    return;
  }
  for (const char* name :
       {"--mode", "--max-distortion", "--measure", "--max-stretch", "--max-charts", "--min-chart-texels",
        "--hard-angle", "--straighten", "--symmetry", "--separate-materials", "--seams", "--hide-seams",
        "--segmentation", "--parameterizer", "--solver", "--pins", "--optimizer", "--validator",
        "--max-area-ratio"})
    refuse(name, "--keep-uv",
           std::string("the charts of the file stay as they are, so ") + name +
               " has no meaning: leave out one of the two");
}

} // namespace

void declare_options(CLI::App& app, Options& options)
{
  app.description("Makes a texture atlas of a polygon mesh: cuts it into charts, flattens them by least "
                  "squares conformal maps,\n"
                  "packs them into the unit square and proves the result free of flips and overlaps. "
                  "Vertices, faces and\n"
                  "their order stay as they are. Several meshes share one atlas and its density.");
  app.add_option("MESH", options.meshes, "The mesh, or several: .obj, .off, .ply, .stl, .gltf or .glb");
  app.add_option(
      "-o,--output", options.output,
      "The textured model to write, an .obj file. Beside it, with the same stem, appear the material (.mtl), "
      "a checkerboard texture (_checkerboard.png) and the report (.json). Default: <stem of "
      "MESH>_atlas.obj in the current directory. Of several meshes each gets a model whose name adds its "
      "own stem, `out.obj` becomes `out_<stem of MESH>.obj`, and they share all other files; default: "
      "atlas.obj");
  add_chart_options(app, options);
  add_seam_options(app, options);
  add_stretch_options(app, options);
  add_stage_options(app, options.stages);
  add_input_options(app, options);
  add_pinned_option(app, options);
  add_packing_options(app, options);
  add_aspect_option(app, options);
  add_coverage_options(app, options);
  add_run_options(app, options);
  add_picture_options(app, options);
  add_output_options(app, options);
  app.add_flag("--quiet", options.is_quiet, "Print nothing but errors");
  app.add_flag("--progress", options.shows_progress, "Show progress even if stderr is no terminal");
  app.footer("Exit code: 0 for a valid atlas; 1 if the atlas is not valid or the mesh has no area; 2 for a "
             "wrong command line; 3 for "
             "a file that\ncannot be read or written, or too little memory; 4 for an internal error; 5 for a "
             "valid atlas that does not keep --min-coverage; "
             "124 if the time limit is over; 130 if interrupted. "
             "Files appear whole or not at all.");
}

void complete_all(const CLI::App& app, Options& options)
{
  if (options.meshes.empty())
    throw CLI::RequiredError("MESH");
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
  if (app.count("--uv-set") > 0 && !options.keeps_document())
    throw CLI::ValidationError("--uv-set", "is for one glTF file that is written as .glb");
  complete(options);
  check_use_of_uv(app, options);
  check_use_of_merging(app, options);
  check_use_of_pinned(app, options);
  check(options.stages);
  if (options.page.has_free_aspect && app.count("--lock") > 0)
    throw CLI::ValidationError("--free-aspect", "locked charts have their places on a square page");
  if (options.min_coverage > 0 && options.page.density > 0)
    throw CLI::ValidationError("--min-coverage",
                               "does not go with --density, whose last page is as it comes");
  if (options.has(Bake::displacement) && options.detail.empty())
    throw CLI::ValidationError("--bake", "displacement is measured to another mesh: add --bake-from");
  if (!options.seams.empty() && options.meshes.size() > 1)
    throw CLI::ValidationError("--seams", "speaks of the vertices of one mesh, but there are several");
}

bool Options::has(Bake bake) const
{
  return std::find(bakes.begin(), bakes.end(), bake) != bakes.end();
}

bool Options::keeps_document() const
{
  const std::string extension = Atlas::internal::lower_case_extension(meshes.front());
  return meshes.size() == 1 && (extension == ".glb" || extension == ".gltf") &&
         fs::path(output).extension() == ".glb";
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
