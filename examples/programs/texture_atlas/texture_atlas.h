// SPDX-License-Identifier: MIT
// What the parts of the program share.
#ifndef TEXTURE_ATLAS_H
#define TEXTURE_ATLAS_H

#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/soup/Joined_soups.h>
#include <Atlas/soup/Polygon_soup.h>

#include "packing_options.h"
#include "policies.h"
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// What the texture of the model shows, or a further picture beside it.
enum class Bake { colors, texture, normals, occlusion, tangent_normals, displacement };

struct Options : Packing_options
{
  std::vector<std::string> meshes; ///< files to read
  std::string output, report, picture;
  std::string mode = "standard", measure;
  Atlas::Symmetry symmetry = Atlas::Symmetry::off;
  Stage_choice stages;
  std::string seams;             ///< a file of them
  std::string pinned;            ///< a file of vertices with their coordinates
  std::vector<std::string> only; ///< the materials that are unwrapped; empty: all
  std::string hiding;            ///< from whom seams are hidden
  double max_distortion = 0, hard_angle = 0, min_chart_texels = 0; ///< 0: not given
  double max_stretch = 0, max_stretch_share = 0;                   ///< 0: not given
  double min_coverage = 0, min_texels_per_chart = 0;               ///< 0: not given
  std::optional<double> seam_exchange_rate;
  std::size_t max_charts = 0;
  unsigned threads = 0;
  std::vector<Bake> bakes;
  bool keeps_uv = false, merges_uv = false, has_only_given_seams = false, separates_materials = false,
       is_straightened = false, turns_faces = false, is_seamless = false, has_pictures = false,
       is_quiet = false, shows_progress = false;
  double time_limit = 0;   ///< seconds; 0: none
  double memory_limit = 0; ///< gigabytes; 0: none
  int uv_set = 0;          ///< the number of the new coordinates in a glTF document
  double weld = 0;    ///< vertices nearer than this share of the model's size are one; 0: only equal ones
  std::string detail; ///< the mesh that bakes are made from; empty: the meshes themselves
  double cage = 0.02; ///< how far it is looked for along normals, as a share of its diagonal
  bool tells_times = true; ///< in the report
  /// Called once all files are written, with their names.
  std::function<void(const Atlas::Atlas_report&, const std::vector<std::string>&)> when_written;
  std::function<void(const std::vector<std::string>&)>
      before_writing; ///< may throw, so that nothing is written

  bool has(Bake bake) const;
  /// The meshes, for messages: their files as they were given.
  std::string name() const;
  /// The same without folders.
  std::string title() const;
  /// The file of each mesh's model. One mesh has the name of the output; of several, each adds its own.
  std::vector<std::string> models() const;
  /// Whether a glTF document comes in and goes out.
  bool keeps_document() const;
};

enum Exit_code {
  success = 0,
  not_valid = 1,
  wrong_usage = 2,
  io_failure = 3,
  internal_failure = 4,
  not_full = 5,
  out_of_time = 124, // as of the command `timeout`
  interrupted = 130
};

/// Set by a signal: what is being done is to end soon.
extern std::atomic<bool> is_interrupted;

/// Prints one line on stderr: a message may come from a library and have several, but scripts rely on one.
void print_error(std::string message);

/// Does some work, and tells of what it throws. Returns the exit code.
int exit_code_of(const Options& options, const std::function<int()>& work);

/// Makes an atlas of the meshes and writes it. Returns the exit code. \throw Atlas::IO_error
int run(Options& options);

/// Declares the options of the command line.
void declare_options(CLI::App& app, Options& options);

/// Sets defaults that depend on other options, and refuses what cannot be. \throw CLI::ValidationError
void complete_all(const CLI::App& app, Options& options);

/// What has been read.
struct Input
{
  Atlas::Joined_soups models;
  Atlas::Surface surface;        ///< of all of them
  Atlas::Source_textures source; ///< of what is baked, if they are to be
  Atlas::Polygon_soup detail; ///< what is baked, if it is another mesh; its coordinates are in `old_uv` too
};

/// Reads all meshes. \throw Atlas::IO_error if one cannot be read, or lacks what has been asked for
Input read_meshes(const Options& options);

/// Makes seams of the edges in a file. \throw Atlas::IO_error if it cannot be read, or names what is no edge
void constrain_seams(const std::string& file, const Atlas::Polygon_soup& model, Atlas::Surface& surface);

/// Gives the vertices in a file of lines `vertex u v` their coordinates. \return per corner whether it has
/// some of these \throw Atlas::IO_error if the file cannot be read, or names what is no vertex
std::vector<bool> pin_vertices(const std::string& file, Atlas::Polygon_soup& model);

/// Whether the text tells from whom seams are hidden: a keyword, with an axis where it needs one, or a file.
bool is_hiding(const std::string& text);

/// Makes seams cheap where they are not seen. \throw Atlas::IO_error if a file of visibility cannot be read
/// or does not fit, or there are no colours to read it from
void hide_seams(const Options& options, const Atlas::Polygon_soup& model, Atlas::Surface& surface);

/// Has the system refuse what exceeds the limit of memory, if there is one.
void limit_memory(const Options& options);

/// \throw Atlas::IO_error if the work will take more memory, about, than the limit allows
void check_memory(const Options& options, const Atlas::Surface& surface);

/// Makes the atlas. `uv` gets the coordinates per corner of the model.
Atlas::Atlas_report make_atlas(const Options& options, const Atlas::Polygon_soup& model,
                               Atlas::Surface& surface, std::vector<Atlas::Point_2>& uv,
                               const std::function<bool(Atlas::Stage, double)>& progress);

/// Per face of the model, whether it is of a material that is unwrapped. \throw CLI::ValidationError if there
/// is no such material
std::vector<bool> faces_to_unwrap(const Options& options, const Atlas::Polygon_soup& model);

/// Finds out whether the outputs can be written, before the work. \throw Atlas::IO_error
void check_outputs(const Options& options);

/// Whether charts that share their place show different colours of what is to be baked.
bool is_stacked_wrongly(const Options& options, const Input& input, const Atlas::Atlas_report& report);

/// What has been written.
struct Written
{
  std::vector<std::string> names;
  std::vector<std::string> seams; ///< what there is to say of seams of textures, a line each
};

/// Writes everything or nothing; nothing once cancelled.
Written write_outputs(const Options& options, Input& input, const Atlas::Atlas_report& report,
                      const Atlas::Execution& execution);

void print_table(const Options& options, const Atlas::Polygon_soup& model, const Atlas::Atlas_report& report);

/// \param reading, writing  seconds
void print_times(const Atlas::Atlas_report& report, double reading, double writing);

/// Tells of faces that take no part; the report has all of them.
void print_rejected(const Options& options, const Atlas::Joined_soups& models,
                    const Atlas::Atlas_report& report);

/// Tells of wishes that could not be fulfilled.
void print_unfulfilled(const Options& options, const Atlas::Polygon_soup& model,
                       const Atlas::Atlas_report& report);

/// Tells of charts that exceed the bound on distortion, and why.
void print_beyond_bound(const Atlas::Atlas_report& report);

/// Tells why there may be so many charts.
void print_disagreement(const Options& options, const Atlas::Polygon_soup& model,
                        const Atlas::Atlas_report& report);

/// Tells of edges that would hang together if vertices near each other were one.
void print_unwelded(const Options& options, const Atlas::Polygon_soup& model, const Atlas::Surface& surface,
                    const Atlas::Atlas_report& report);

#endif
