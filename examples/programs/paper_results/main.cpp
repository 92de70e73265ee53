// SPDX-License-Identifier: MIT
// Makes the tables and those figures of the LSCM paper that need whole atlases or flattened charts; the steps
// of the segmentation, figures 4 to 6, are drawn by segmentation_steps.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/build_surface.h>

#include "paper_results.h"
#include "stand_up.h"
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <set>
#include <stdexcept>
#include <utility>

Named_mesh read_mesh(const std::string& argument)
{
  const std::size_t equals = argument.find('='), at = argument.rfind('@');
  const std::string up = at == std::string::npos ? "y" : argument.substr(at + 1);
  if (!std::set<std::string>{"x", "y", "z", "-x", "-y", "-z"}.contains(up))
    throw std::invalid_argument(argument + ": behind @ stands x, y, z, -x, -y or -z");
  const std::filesystem::path file =
      argument.substr(equals == std::string::npos ? 0 : equals + 1).substr(0, at - (equals + 1));
  Named_mesh mesh{equals == std::string::npos ? file.stem().string() : argument.substr(0, equals),
                  Atlas::read_polygon_soup(file),
                  {},
                  {30, 15}};
  mesh.soup.points = stand_up(std::move(mesh.soup.points), up);
  mesh.surface = Atlas::build_surface(mesh.soup.points, mesh.soup.first, mesh.soup.vertices);
  return mesh;
}

namespace {

/// Reads all meshes, to be seen from one direction.
std::vector<Named_mesh> read_meshes(const std::vector<std::string>& arguments,
                                    const Atlas::View_direction& view)
{
  std::vector<Named_mesh> meshes;
  for (const std::string& argument : arguments) {
    meshes.push_back(read_mesh(argument));
    meshes.back().view = view;
  }
  return meshes;
}

} // namespace

int main(int argc, char** argv)
try {
  CLI::App app(
      "Tables and figures of Levy, Petitjean, Ray, Maillot: Least squares conformal maps for automatic "
      "texture atlas generation, 2002");
  Paper_options options;
  std::vector<std::string> meshes;
  std::vector<double> ball;
  Atlas::View_direction view{30, 15};
  app.add_option("-o,--output", options.folder, "The folder for pictures and tables")->required();
  app.add_option("--size", options.size, "Side of the pictures in pixels")->capture_default_str();
  app.add_option("--threads", options.threads, "Number of threads; 0: all cores")->capture_default_str();
  app.require_subcommand(1);
  const auto subcommand = [&](const char* name, const char* what, bool has_ball) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->add_option(
           "MESH", meshes,
           "Mesh files, each as FILE or NAME=FILE; behind them @AXIS if another axis than y points up")
        ->required();
    sub->add_option("--azimuth", view.azimuth, "Where the camera stands, degrees");
    sub->add_option("--elevation", view.elevation, "How high it stands, degrees");
    if (has_ball)
      sub->add_option("--ball", ball, "x y z radius, after turning up: the part to be one chart")
          ->expected(4);
    return sub;
  };
  const auto* table_1 =
      subcommand("table_1", "Table 1: stretch of one chart before and after optimisation", true);
  const auto* table_2 = subcommand("table_2", "Table 2 and figures 7 to 10, for each mesh", false);
  const auto* large_chart = subcommand("figure_1", "Figure 1: iso-parameter curves of one large chart", true);
  const auto* resolutions = app.add_subcommand("figure_3", "Figure 3: curves at several resolutions");
  CLI11_PARSE(app, argc, argv);

  std::filesystem::create_directories(options.folder);
  const std::vector<Named_mesh> named = read_meshes(meshes, view);
  if (*table_1)
    write_table_1(named.at(0), ball, options);
  if (*table_2)
    write_table_2(named, options);
  if (*large_chart)
    draw_large_chart(named.at(0), ball, options);
  if (*resolutions)
    draw_resolutions(options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
