// SPDX-License-Identifier: MIT
// The recipes of the cookbook, each a function. Run without arguments, they work on a cube.
#include <Atlas/generate_atlas.h>
#include <Atlas/pack_charts.h>
#include <Atlas/parameterization/ARAP_parameterizer.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <thread>
#include <vector>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;
using Uv_map = Mesh::Property_map<Mesh::Halfedge_index, Atlas::Point_2>;

namespace {

Mesh cube()
{
  Mesh mesh;
  CGAL::make_hexahedron(Atlas::Point_3(0, 0, 0), Atlas::Point_3(1, 0, 0), Atlas::Point_3(1, 1, 0),
                        Atlas::Point_3(0, 1, 0), Atlas::Point_3(0, 1, 1), Atlas::Point_3(0, 0, 1),
                        Atlas::Point_3(1, 0, 1), Atlas::Point_3(1, 1, 1), mesh);
  return mesh;
}

//! [map]
Uv_map uv_map(Mesh& mesh)
{
  return mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
}
//! [map]

bool make_an_atlas(const Mesh& mesh, Uv_map uv)
{
  //! [atlas]
  const Atlas::Atlas_report report = Atlas::generate_atlas(mesh, uv);
  //! [atlas]
  return report.is_valid();
}

bool use_only_my_seams(Mesh& mesh, Uv_map uv)
{
  auto cuts = mesh.add_property_map<Mesh::Edge_index, bool>("e:cut", true).first;
  //! [seams]
  const Atlas::Atlas_report report = Atlas::generate_atlas(
      mesh, uv, Atlas::parameters::segmentation(Atlas::Patch_segmentation()).edge_is_constrained_map(cuts));
  //! [seams]
  return report.is_valid() && report.charts.size() == mesh.number_of_faces();
}

bool keep_seams_away(Mesh& mesh, Uv_map uv)
{
  //! [dear]
  // 1 is usual: at these vertices a seam costs eight times as much.
  auto cost = mesh.add_property_map<Mesh::Vertex_index, double>("v:seam_cost", 1).first;
  for (const Mesh::Vertex_index v : mesh.vertices())
    if (mesh.point(v).z() == 1)
      cost[v] = 8;
  const Atlas::Atlas_report report = Atlas::generate_atlas(mesh, uv, Atlas::parameters::seam_cost_map(cost));
  //! [dear]
  return report.is_valid();
}

bool cut_at_sharp_edges(Mesh& mesh, Uv_map uv)
{
  auto material = mesh.add_property_map<Mesh::Face_index, int>("f:material", 0).first;
  //! [hard]
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::hard_angle(30).face_patch_map(material));
  //! [hard]
  return report.is_valid() && report.charts.size() == 6;
}

bool bound_the_stretch(const Mesh& mesh, Uv_map uv)
{
  //! [stretch]
  Atlas::Merge_options bounds = Atlas::merge_options(Atlas::Atlas_mode::standard);
  bounds.max_stretch = 1.25;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::merge_options(bounds));
  for (const Atlas::Chart_report& chart : report.charts)
    if (!chart.is_within_bound)
      std::cout << message(chart.reason) << '\n';
  //! [stretch]
  return report.is_valid() && report.charts_beyond_bound == 0;
}

bool keep_apart_in_mip_maps(const Mesh& mesh, Uv_map uv)
{
  //! [mip]
  Atlas::Page_options page;
  page.width = page.height = 2048;
  page.mip_levels = 4;
  page.block = 4;
  const Atlas::Atlas_report report = Atlas::generate_atlas(mesh, uv, Atlas::parameters::page_options(page));
  //! [mip]
  return report.is_valid();
}

bool have_a_fixed_density(Mesh& mesh, Uv_map uv)
{
  //! [density]
  Atlas::Page_options page;
  page.density = 150; // texels per unit of the model
  auto page_of_face = mesh.add_property_map<Mesh::Face_index, int>("f:page", 0).first;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::page_options(page).face_page_map(page_of_face));
  //! [density]
  return report.is_valid() && std::abs(report.density / 150 - 1) < 1e-6;
}

bool store_equal_parts_once(const Mesh& mesh, Uv_map uv)
{
  //! [stack]
  Atlas::Page_options page;
  page.stacking = Atlas::Chart_stacking::copies_and_mirrored;
  const Atlas::Atlas_report report = Atlas::generate_atlas(mesh, uv, Atlas::parameters::page_options(page));
  //! [stack]
  return report.is_valid();
}

bool pack_what_is_there(const Mesh& mesh, Uv_map uv)
{
  //! [repack]
  const Atlas::Packing packing =
      Atlas::pack_charts(mesh, uv, Atlas::parameters::texture_size(2048).gutter(4));
  //! [repack]
  return packing.number_of_pages == 1;
}

bool check_what_is_there(const Mesh& mesh, Uv_map uv)
{
  //! [check]
  const Atlas::Atlas_certificate certificate = Atlas::verify_atlas(mesh, uv);
  if (!certificate.is_valid())
    std::cout << message(certificate) << '\n';
  //! [check]
  return certificate.is_valid();
}

bool straighten_grids(const Mesh& mesh, Uv_map uv)
{
  //! [straight]
  const Atlas::Atlas_report report = Atlas::generate_atlas(mesh, uv, Atlas::parameters::straighten(true));
  //! [straight]
  return report.is_valid();
}

bool cancel(const Mesh& mesh, Uv_map uv)
{
  bool wants_to_stop = true;
  //! [progress]
  const Atlas::Atlas_report report = Atlas::generate_atlas(
      mesh, uv, Atlas::parameters::progress([&](Atlas::Stage stage, double fraction) {
        std::cerr << name(stage) << ' ' << 100 * fraction << " %\n";
        return !wants_to_stop; // false cancels: the status is `cancelled`, and uv is untouched
      }));
  //! [progress]
  return report.status == Atlas::Atlas_status::cancelled;
}

bool call_from_several_threads(std::vector<Mesh>& meshes)
{
  std::vector<char> is_valid(meshes.size());
  //! [threads]
  // Calls share nothing: any number of threads may call at once, each with a mesh of its own.
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    threads.emplace_back([&, i] {
      const auto options = Atlas::parameters::number_of_threads(1);
      is_valid[i] = Atlas::generate_atlas(meshes[i], uv_map(meshes[i]), options).is_valid();
    });
  for (std::thread& thread : threads)
    thread.join();
  //! [threads]
  return std::find(is_valid.begin(), is_valid.end(), 0) == is_valid.end();
}

bool handle_failures(const Mesh& mesh, Uv_map uv)
{
  //! [failures]
  try {
    const Atlas::Atlas_report report =
        Atlas::generate_atlas(mesh, uv, Atlas::parameters::texture_size(0)); // no page is that small
    if (!report.is_valid())                                                  // the data is to blame
      std::cerr << message(report.status) << ": " << message(report.certificate) << '\n';
  } catch (const Atlas::Invalid_argument& error) { // the call is to blame; nothing has been done
    std::cerr << error.what() << '\n';
    return true;
  }
  //! [failures]
  return false;
}

bool use_another_method(const Mesh& mesh, Uv_map uv)
{
  //! [policy]
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::parameterizer(Atlas::ARAP_parameterizer()));
  //! [policy]
  return report.is_valid();
}

int failures = 0;

void tell(const char* recipe, bool is_right)
{
  std::cout << (is_right ? "right  " : "WRONG  ") << recipe << '\n';
  failures += !is_right;
}

} // namespace

int main()
{
  Mesh mesh = cube();
  const Uv_map uv = uv_map(mesh);
  tell("only my seams", use_only_my_seams(mesh, uv));
  tell("seams away from a place", keep_seams_away(mesh, uv));
  tell("sharp edges", cut_at_sharp_edges(mesh, uv));
  tell("bound on stretch", bound_the_stretch(mesh, uv));
  tell("mip-maps", keep_apart_in_mip_maps(mesh, uv));
  tell("density", have_a_fixed_density(mesh, uv));
  tell("equal parts once", store_equal_parts_once(mesh, uv));
  tell("straight grids", straighten_grids(mesh, uv));
  tell("another method", use_another_method(mesh, uv));
  tell("an atlas", make_an_atlas(mesh, uv));
  tell("check", check_what_is_there(mesh, uv));
  tell("repack", pack_what_is_there(mesh, uv));
  tell("cancel", cancel(mesh, uv));
  std::vector<Mesh> meshes(3, cube());
  tell("several threads", call_from_several_threads(meshes));
  tell("failures", handle_failures(mesh, uv));
  return failures;
}
