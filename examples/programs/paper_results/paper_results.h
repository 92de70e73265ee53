// SPDX-License-Identifier: MIT
#ifndef ATLAS_EXAMPLE_PAPER_RESULTS_H
#define ATLAS_EXAMPLE_PAPER_RESULTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/image/render_model.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/soup/Polygon_soup.h>

#include <filesystem>
#include <string>
#include <vector>

/// What all parts of the program are told.
struct Paper_options
{
  std::filesystem::path folder; ///< where pictures and tables go
  std::size_t size = 720;       ///< side of a picture in pixels
  unsigned threads = 0;
};

/// A mesh with the name under which the paper, or the caller, knows it.
struct Named_mesh
{
  std::string name;
  Atlas::Polygon_soup soup;
  Atlas::Surface surface;
  Atlas::View_direction view;
};

/// Reads FILE or NAME=FILE, behind which @AXIS names the axis of the file that points up.
Named_mesh read_mesh(const std::string& argument);

/// A part of a surface as one chart that is a disc, cut open where it must be.
///
/// \param ball  centre and radius: of the triangles in it, those that hang together with the nearest to its
/// centre; empty: the whole surface, which is connected
Atlas::Chart chart_of_part(const Atlas::Surface& surface, const std::vector<double>& ball);

/// Figure 1: a chart, its iso-parameter curves on the model and in the plane, and its cuts.
void draw_large_chart(const Named_mesh& mesh, const std::vector<double>& ball, const Paper_options& options);

/// Figure 3: iso-parameter curves of one surface on a coarse, a fine and two graded meshes. Writes how far
/// the maps differ as `figure_3.html`.
void draw_resolutions(const Paper_options& options);

/// Table 1: the stretch of one chart before and after its optimisation, as `table_1.html`.
void write_table_1(const Named_mesh& mesh, const std::vector<double>& ball, const Paper_options& options);

/// \brief Table 2, as `table_2.html`: each mesh by the paper's pipeline, by the same without the rule on
/// areas, and by the default mode, beside the numbers that the paper prints for meshes of the names dinosaur,
/// skull, bunny and horse.
///
/// Draws each mesh in the paper's mode: figure 7, the page on its horizon; figure 8, model and page; figure
/// 9, histograms (`figure_9_NAME.html`); figure 10, the model with a pattern.
void write_table_2(const std::vector<Named_mesh>& meshes, const Paper_options& options);

/// Figures 7 to 10 of a mesh with coordinates.
///
/// \param uv  per corner
void draw_results(const Named_mesh& mesh, const std::vector<Atlas::Point_2>& uv,
                  const Atlas::Atlas_report& report, const Paper_options& options);

#endif
