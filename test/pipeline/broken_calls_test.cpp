// SPDX-License-Identifier: MIT
// Whatever a caller passes or a policy returns is an exception that names it, or a report; never undefined
// behaviour.
#include <Atlas/core/errors.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include "test_meshes.h"
#include <cmath>
#include <limits>
#include <string>

namespace Atlas::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The argument that a call with such parameters is refused for; empty if it is not.
template <typename NamedParameters>
std::string refused_argument(const NamedParameters& np, const Surface& surface = surface_of(cube()))
{
  std::vector<Point_2> uv;
  try {
    (void)generate_atlas(surface, uv, np);
  } catch (const Invalid_argument& error) {
    EXPECT_TRUE(uv.empty());
    EXPECT_EQ(std::string(error.what()).find(error.argument()), 0u) << error.what();
    return error.argument();
  }
  return "";
}

TEST(BrokenCalls, NumbersOutOfRangeAreRefusedByName)
{
  using namespace parameters;
  EXPECT_EQ(refused_argument(texture_size(-5)), "texture_size");
  EXPECT_EQ(refused_argument(texture_size(0)), "texture_size");
  EXPECT_EQ(refused_argument(texture_size(1e9)), "texture_size");
  EXPECT_EQ(refused_argument(texture_size(10.5)), "texture_size");
  EXPECT_EQ(refused_argument(gutter(1e9)), "gutter");
  EXPECT_EQ(refused_argument(gutter(-1)), "gutter");
  EXPECT_EQ(refused_argument(gutter(nan)), "gutter");
  EXPECT_EQ(refused_argument(max_charts(-3)), "max_charts");
  EXPECT_EQ(refused_argument(min_chart_texels(-1.0)), "min_chart_texels");
  EXPECT_EQ(refused_argument(min_chart_texels(nan)), "min_chart_texels");
  EXPECT_EQ(refused_argument(min_coverage(1)), "min_coverage");
  EXPECT_EQ(refused_argument(min_coverage(nan)), "min_coverage");
  EXPECT_EQ(refused_argument(seam_exchange_rate(-1)), "seam_exchange_rate");
  EXPECT_EQ(refused_argument(min_texels_per_chart(-1)), "min_texels_per_chart");
  EXPECT_EQ(refused_argument(hard_angle(181)), "hard_angle");
  EXPECT_EQ(refused_argument(hard_angle(-1)), "hard_angle");
  EXPECT_EQ(refused_argument(hard_angle(nan)), "hard_angle");
  EXPECT_EQ(refused_argument(number_of_threads(-1)), "number_of_threads");
  EXPECT_EQ(refused_argument(texture_size(64).gutter(2).max_charts(3).number_of_threads(1)), "");
}

TEST(BrokenCalls, OptionsOutOfRangeAreRefusedByName)
{
  Page_options page;
  page.density = -1;
  EXPECT_EQ(refused_argument(parameters::page_options(page)), "density");
  page = {};
  page.pages = 0;
  EXPECT_EQ(refused_argument(parameters::page_options(page)), "pages");
  page = {};
  page.weights = {-1};
  EXPECT_EQ(refused_argument(parameters::page_options(page)), "weights");
  Merge_options merge;
  merge.max_distortion = 0.5;
  EXPECT_NE(refused_argument(parameters::merge_options(merge)), "");
  merge = {};
  merge.min_solidity = nan;
  EXPECT_NE(refused_argument(parameters::merge_options(merge)), "");
}

TEST(BrokenCalls, WishesThatAnotherSegmentationDoesNotHearAreRefused)
{
  const auto charts = parameters::segmentation(Patch_segmentation());
  EXPECT_EQ(refused_argument(charts.max_charts(2)), "max_charts");
  EXPECT_EQ(refused_argument(charts.min_chart_texels(100)), "min_chart_texels");
  EXPECT_EQ(refused_argument(charts.merge_options(Merge_options())), "merge_options");
  EXPECT_EQ(refused_argument(charts), "");
}

TEST(BrokenCalls, ArraysThatDoNotFitTogetherAreRefusedByName)
{
  const auto np = parameters::texture_size(64);
  const Surface whole = surface_of(cube());
  const auto with = [&](auto change) {
    Surface surface = whole;
    change(surface);
    return refused_argument(np, surface);
  };
  EXPECT_EQ(refused_argument(np, whole), "");
  EXPECT_EQ(with([](Surface& s) { s.triangles[0][0] = 1000; }), "surface.triangles");
  EXPECT_EQ(with([](Surface& s) { s.opposite.pop_back(); }), "surface.opposite");
  EXPECT_EQ(with([](Surface& s) { s.opposite[0] = s.opposite[1]; }), "surface.opposite");
  EXPECT_EQ(with([](Surface& s) { s.opposite[0] = 12345; }), "surface.opposite");
  EXPECT_EQ(with([](Surface& s) { s.face.clear(); }), "surface.face");
  EXPECT_EQ(with([](Surface& s) { s.face[0] = 99; }), "surface.face");
  EXPECT_EQ(with([](Surface& s) { s.corner[5] = no_index; }), "surface.corner");
  EXPECT_EQ(with([](Surface& s) { s.constraint.resize(1); }), "surface.constraint");
  EXPECT_EQ(with([](Surface& s) { s.seam_cost.assign(s.opposite.size(), 0); }), "surface.seam_cost");
  EXPECT_EQ(with([](Surface& s) { s.patch.resize(1); }), "surface.patch");
  EXPECT_EQ(with([](Surface& s) { s.density_weight.assign(s.triangles.size(), -1); }),
            "surface.density_weight");
  EXPECT_EQ(with([](Surface& s) { s.density_weight.assign(s.triangles.size(), infinity); }),
            "surface.density_weight");
}

TEST(BrokenCalls, MapsOfAMeshAreCheckedToo)
{
  CGAL::Surface_mesh<Point_3> mesh;
  const auto a = mesh.add_vertex(Point_3(0, 0, 0)), b = mesh.add_vertex(Point_3(1, 0, 0)),
             c = mesh.add_vertex(Point_3(0, 1, 0)), d = mesh.add_vertex(Point_3(0, 0, 1));
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
  auto uv = mesh.add_property_map<CGAL::SM_Halfedge_index, Point_2>("h:uv").first;
  const auto cost = mesh.add_property_map<CGAL::SM_Edge_index, double>("e:cost", -1.0).first;
  const auto weight = mesh.add_property_map<CGAL::SM_Face_index, double>("f:weight", 0.0).first;
  EXPECT_THROW((void)generate_atlas(mesh, uv, parameters::seam_cost_map(cost)), Invalid_argument);
  EXPECT_THROW((void)generate_atlas(mesh, uv, parameters::face_weight_map(weight)), Invalid_argument);
  const auto index = mesh.add_property_map<CGAL::SM_Vertex_index, std::size_t>("v:i", 1000).first;
  EXPECT_ANY_THROW(
      (void)generate_atlas(mesh, uv, CGAL::parameters::vertex_index_map(index))); // or CGAL sees it first
  EXPECT_THROW((void)verify_atlas(mesh, uv, parameters::texture_size(-1)), Invalid_argument);
  EXPECT_THROW((void)verify_atlas(mesh, uv, parameters::gutter(-1)), Invalid_argument);
}

// Policies that break their contracts.

struct No_charts
{
  Segmentation segment(const Surface&, const Execution&) const { return {}; }
};
struct Chart_out_of_range
{
  Segmentation segment(const Surface& s, const Execution&) const
  {
    return {std::vector<Index>(s.number_of_triangles(), 3), std::vector<std::uint8_t>(s.opposite.size()), 3};
  }
};
struct Cuts_of_another_size
{
  Segmentation segment(const Surface& s, const Execution&) const
  {
    return {std::vector<Index>(s.number_of_triangles(), 0), std::vector<std::uint8_t>(1), 1};
  }
};
struct No_coordinates
{
  Chart_status parameterize(Chart&, const Execution&) const { return Chart_status::valid; }
};
struct Loses_triangles
{
  Chart_status parameterize(Chart& chart, const Execution&) const
  {
    chart.triangles.pop_back();
    chart.uv.resize(chart.points.size(), Point_2(0, 0));
    return Chart_status::valid;
  }
};
struct Loses_coordinates
{
  Chart_status optimize(Chart& chart, const Execution&) const
  {
    chart.uv.pop_back();
    return Chart_status::valid;
  }
};
struct Blames_nobody_there
{
  Chart_verdict validate(const Chart&, const Execution&) const
  {
    return {Chart_status::overlapping, {no_index}};
  }
};
struct Refuses_all
{
  Chart_verdict validate(const Chart&, const Execution&) const { return {Chart_status::overlapping, {}}; }
};
struct Splits_nothing
{
  std::vector<Index> split(const Chart&, const Chart_verdict&) const { return {}; }
};
struct Part_out_of_range
{
  std::vector<Index> split(const Chart& chart, const Chart_verdict&) const
  {
    return std::vector<Index>(chart.number_of_triangles(), no_index);
  }
};
struct Packs_nothing
{
  Packing pack(std::span<const Chart>, const Page_options&, const Execution&) const
  {
    return {{}, 1, 1, 0, {}};
  }
};
struct Packs_nowhere
{
  Packing pack(std::span<const Chart> charts, const Page_options&, const Execution&) const
  {
    return {std::vector<Placement>(charts.size(), Placement{nan, 0, 0, 0, 0, false}), 1, 1, 0, {}};
  }
};
struct Packs_on_a_page_that_is_none
{
  Packing pack(std::span<const Chart> charts, const Page_options&, const Execution&) const
  {
    return {std::vector<Placement>(charts.size(), Placement{1, 0, 0, 0, 7, false}), 1, 1, 0, {}};
  }
};

template <typename NamedParameters>
void expect_blamed(const NamedParameters& np, const std::string& role, const std::string& type)
{
  std::vector<Point_2> uv;
  try {
    (void)generate_atlas(surface_of(cube()), uv, np);
    ADD_FAILURE() << "nobody is blamed for " << type;
  } catch (const Policy_error& error) {
    EXPECT_EQ(error.role(), role);
    EXPECT_NE(error.type().find(type), std::string::npos) << error.type();
    EXPECT_NE(std::string(error.what()).find(type), std::string::npos) << error.what();
  }
}

TEST(BrokenCalls, PoliciesThatBreakTheirContractAreNamed)
{
  using namespace parameters;
  expect_blamed(segmentation(No_charts()), "segmentation", "No_charts");
  expect_blamed(segmentation(Chart_out_of_range()), "segmentation", "Chart_out_of_range");
  expect_blamed(segmentation(Cuts_of_another_size()), "segmentation", "Cuts_of_another_size");
  expect_blamed(parameterizer(No_coordinates()), "parameterizer", "No_coordinates");
  expect_blamed(parameterizer(Loses_triangles()), "parameterizer", "Loses_triangles");
  expect_blamed(optimizer(Loses_coordinates()), "optimizer", "Loses_coordinates");
  expect_blamed(validator(Blames_nobody_there()), "validator", "Blames_nobody_there");
  expect_blamed(validator(Refuses_all()).splitter(Splits_nothing()), "splitter", "Splits_nothing");
  expect_blamed(validator(Refuses_all()).splitter(Part_out_of_range()), "splitter", "Part_out_of_range");
  expect_blamed(packer(Packs_nothing()), "packer", "Packs_nothing");
  expect_blamed(packer(Packs_nowhere()), "packer", "Packs_nowhere");
  expect_blamed(packer(Packs_on_a_page_that_is_none()), "packer", "Packs_on_a_page_that_is_none");
}

// What policies may say, if rarely, is a report.

struct Never_solves
{
  Chart_status parameterize(Chart&, const Execution&) const { return Chart_status::solver_failed; }
};
struct Not_a_number
{
  Chart_status parameterize(Chart& chart, const Execution&) const
  {
    chart.uv.assign(chart.points.size(), Point_2(nan, 0));
    return Chart_status::valid;
  }
};
struct Cancels_itself
{
  Chart_status parameterize(Chart&, const Execution&) const { return Chart_status::cancelled; }
};

TEST(BrokenCalls, ParameterizersThatFailLeaveFacesAloneWithADrawing)
{
  const Surface surface = surface_of(sphere(2));
  const auto run = [&](const auto& parameterizer) {
    std::vector<Point_2> uv;
    const Atlas_report report = generate_atlas(surface, uv, parameters::parameterizer(parameterizer));
    EXPECT_TRUE(report.is_valid()) << message(report.certificate);
    EXPECT_EQ(report.charts.size(), surface.number_of_faces);
    for (const Chart_report& chart : report.charts)
      EXPECT_EQ(chart.flattening.start, Flattening_start::schnyder);
  };
  run(Never_solves());
  run(Not_a_number());
  run(Cancels_itself());
}

TEST(BrokenCalls, AValidatorThatRefusesAllEndsAtSingleFaces)
{
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface_of(cube()), uv, parameters::validator(Refuses_all()));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.charts.size(), 6u);
  EXPECT_EQ(report.charts[0].status, Chart_status::overlapping);
}

struct Has_no_room
{
  Packing pack(std::span<const Chart> charts, const Page_options&, const Execution&) const
  {
    return {std::vector<Placement>(charts.size()), 0, 0, 0, {}};
  }
};

TEST(BrokenCalls, NoRoomIsAStatusAndLeavesCoordinatesAlone)
{
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface_of(cube()), uv, parameters::packer(Has_no_room()));
  EXPECT_EQ(report.status, Atlas_status::no_room);
  EXPECT_FALSE(report.is_valid());
  EXPECT_TRUE(uv.empty());
}

TEST(BrokenCalls, ChartsHaveOneNumberingEverywhere)
{
  const Surface surface = surface_of(torus(30, 20));
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface, uv);
  ASSERT_TRUE(report.is_valid());
  ASSERT_GT(report.charts.size(), 1u);
  EXPECT_EQ(report.face_chart, report.certificate.face_chart);
  std::vector<std::size_t> triangles(report.charts.size(), 0);
  for (const Index c : report.segmentation.chart)
    ++triangles.at(c);
  for (std::size_t c = 0; c < triangles.size(); ++c)
    EXPECT_EQ(triangles[c], report.charts[c].triangles);
  EXPECT_EQ(report.segmentation.number_of_charts, report.charts.size());
}

} // namespace
} // namespace Atlas::test
