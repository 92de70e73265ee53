// SPDX-License-Identifier: MIT
// CGAL's parameterizers as models of ChartParameterizer, and Atlas's own compared with them.
#include <Atlas/core/concepts.h>
#include <Atlas/parameterization/CGAL_parameterizer_adaptor.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>

#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_conformal_map_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>

#include "test_meshes.h"

namespace {

using namespace Atlas;
namespace SMP = CGAL::Surface_mesh_parameterization;
using Circle = SMP::Circular_border_arc_length_parameterizer_3<CGAL_chart_mesh>;
using CGAL_LSCM = CGAL_parameterizer_adaptor<SMP::LSCM_parameterizer_3<CGAL_chart_mesh>>;
using CGAL_harmonic =
    CGAL_parameterizer_adaptor<SMP::Discrete_conformal_map_parameterizer_3<CGAL_chart_mesh, Circle>>;
using CGAL_mean_value =
    CGAL_parameterizer_adaptor<SMP::Mean_value_coordinates_parameterizer_3<CGAL_chart_mesh, Circle>>;

static_assert(ChartParameterizer<CGAL_LSCM>);

Chart wavy()
{
  return test::chart_of(test::grid(14, 10, [](double x, double y) {
    return Point_3(x, 0.8 * y, 0.1 * std::sin(7 * x) * std::cos(5 * y + 1));
  }));
}

/// Largest difference of edge lengths, over the largest.
double difference(const Chart& a, const Chart& b)
{
  double worst = 0, longest = 0;
  for (const auto& t : a.triangles)
    for (int i = 0; i < 3; ++i) {
      const Index v = t[i], w = t[(i + 1) % 3];
      const double p = std::sqrt((a.uv[v] - a.uv[w]).squared_length()),
                   q = std::sqrt((b.uv[v] - b.uv[w]).squared_length());
      worst = std::max(worst, std::abs(p - q));
      longest = std::max(longest, p);
    }
  return worst / longest;
}

TEST(CGAL_parameterizer_adaptor, harmonic_and_mean_value_maps_agree_with_ours)
{
  Chart theirs = wavy(), ours = wavy();
  ASSERT_EQ(CGAL_harmonic().parameterize(theirs, Execution()), Chart_status::valid);
  ASSERT_EQ(Harmonic_parameterizer().parameterize(ours, Execution()), Chart_status::valid);
  EXPECT_LT(difference(ours, theirs), 1e-4);
  ASSERT_EQ(CGAL_mean_value().parameterize(theirs, Execution()), Chart_status::valid);
  ASSERT_EQ(Mean_value_parameterizer().parameterize(ours, Execution()), Chart_status::valid);
  EXPECT_LT(difference(ours, theirs), 1e-4);
}

TEST(CGAL_parameterizer_adaptor, lscm_agrees_where_both_are_exact_and_ours_has_less_energy_elsewhere)
{
  Chart theirs = test::chart_of(
      test::grid(12, 5, [](double x, double y) { return Point_3(std::cos(3 * x), std::sin(3 * x), y); }));
  Chart ours = theirs;
  ASSERT_EQ(CGAL_LSCM().parameterize(theirs, Execution()), Chart_status::valid);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(ours, Execution()), Chart_status::valid);
  EXPECT_LT(difference(ours, theirs), 1e-4); // CGAL's iterative solver stops early

  theirs = wavy(), ours = wavy();
  LSCM_record record;
  ASSERT_EQ(CGAL_LSCM().parameterize(theirs, Execution()), Chart_status::valid);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(ours, Execution(), record), Chart_status::valid);
  const internal::Chart_geometry geometry(theirs);
  std::vector<internal::Complex> u;
  for (const Point_2& p : theirs.uv)
    u.emplace_back(p.x(), p.y());
  const double energy = internal::Conformal_energy(geometry).value(u) / internal::area_in_plane(theirs, u);
  EXPECT_LT(record.energy, energy);
  EXPECT_LT(energy, 2 * record.energy);
}

TEST(CGAL_parameterizer_adaptor, refuses_what_has_no_border)
{
  Chart sphere = test::chart_of(test::sphere(1));
  EXPECT_EQ(CGAL_LSCM().parameterize(sphere, Execution()), Chart_status::not_a_disc);
}

} // namespace
