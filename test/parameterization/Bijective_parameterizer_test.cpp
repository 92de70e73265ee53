// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>

#include <CGAL/Polygon_2_algorithms.h>

#include "test_meshes.h"
#include <set>

namespace {

using namespace Atlas;

static_assert(ChartParameterizer<Bijective_parameterizer<>>);
static_assert(ChartParameterizer<Schnyder_parameterizer>);
static_assert(UVOptimizer<Symmetric_dirichlet_optimizer>);

/// The same verdict without the code under test: all triangles counterclockwise, and no two border edges meet
/// but at their common ends.
bool is_one_to_one(const Chart& chart)
{
  for (const auto& [a, b, c] : chart.triangles)
    if (CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]) != CGAL::LEFT_TURN)
      return false;
  std::vector<std::pair<Index, Index>> border;
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index g = next_halfedge(h);
      border.emplace_back(chart.triangles[h / 3][h % 3], chart.triangles[g / 3][g % 3]);
    }
  for (std::size_t i = 0; i < border.size(); ++i)
    for (std::size_t j = i + 1; j < border.size(); ++j) {
      const auto [a, b] = border[i];
      const auto [c, d] = border[j];
      const Kernel::Segment_2 s(chart.uv[a], chart.uv[b]), t(chart.uv[c], chart.uv[d]);
      if (a == d || b == c) {
        const Index p = a == d ? b : a, q = a == d ? c : d;
        if (p != q && (s.has_on(chart.uv[q]) || t.has_on(chart.uv[p])))
          return false;
      } else if (CGAL::do_intersect(s, t))
        return false;
    }
  return true;
}

/// Mean symmetric Dirichlet energy over 4, from singular values by lengths and areas.
double mean_energy(const Chart& chart)
{
  double sum = 0, total = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const Vector_3 p = chart.points[b] - chart.points[a], q = chart.points[c] - chart.points[a];
    const Vector_2 s = chart.uv[b] - chart.uv[a], t = chart.uv[c] - chart.uv[a];
    const double space = std::sqrt(CGAL::cross_product(p, q).squared_length()),
                 plane = s.x() * t.y() - s.y() * t.x();
    // |J|^2 = trace of G^-1 H with the first fundamental forms G in space and H in the plane
    const double squares = ((q * q) * (s * s) - 2 * (p * q) * (s * t) + (p * p) * (t * t)) / (space * space);
    sum += space * squares * (1 + space * space / (plane * plane));
    total += space;
  }
  return sum / total / 4;
}

Chart height_field(Index n, double noise, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-noise / n, noise / n);
  return test::chart_of(test::grid(n, n, [&](double x, double y) { return Point_3(x, y, height(random)); }));
}

/// A ramp that winds around an axis: flat in the plane it covers itself.
Chart spiral(double turns, Index length = 60, Index width = 3)
{
  return test::chart_of(test::grid(length, width, [=](double x, double y) {
    const double angle = 2 * M_PI * turns * x, r = 1 + y;
    return Point_3(r * std::cos(angle), r * std::sin(angle), 0.1 * angle);
  }));
}

/// A closed tube of quads, open only by one missing triangle at its end.
Chart tube(Index rings)
{
  test::Soup soup = test::grid(
      6, rings,
      [=](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), y * rings); },
      true);
  soup.points.emplace_back(0, 0, -1);
  for (Index i = 0; i < 6; ++i)
    soup.polygons.push_back({(i + 1) % 6, i, static_cast<Index>(soup.points.size() - 1)});
  return test::chart_of(soup);
}

TEST(Symmetric_dirichlet_optimizer, reaches_the_isometry_where_there_is_one)
{
  Chart chart = test::chart_of(
      test::grid(24, 6, [](double x, double y) { return Point_3(std::cos(4 * x), std::sin(4 * x), y); }));
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  Distortion_options options;
  options.tolerance = 1e-12;
  Distortion_record record;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), record), Chart_status::valid);
  EXPECT_GT(record.before, 1.2);
  EXPECT_NEAR(mean_energy(chart), 1, 1e-9);
  EXPECT_LT(record.iterations, 30u);
}

TEST(Symmetric_dirichlet_optimizer, reports_the_energy_and_ends_at_a_stationary_point)
{
  Chart chart = height_field(12, 0.8, 3);
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  Distortion_options options;
  options.tolerance = 1e-13;
  options.max_iterations = 200;
  Distortion_record record;
  const Symmetric_dirichlet_optimizer optimizer(options);
  ASSERT_EQ(optimizer.optimize(chart, Execution(), record), Chart_status::valid);
  EXPECT_NEAR(record.after, mean_energy(chart), 1e-9);
  // Scale to the best size, then no vertex can lower the energy to first order.
  const double least = mean_energy(chart);
  double best = least;
  for (double s = 0.99; s < 1.01; s += 1e-4) {
    Chart scaled = chart;
    for (Point_2& p : scaled.uv)
      p = Point_2(s * p.x(), s * p.y());
    if (mean_energy(scaled) < best) {
      best = mean_energy(scaled);
      chart.uv = scaled.uv;
    }
  }
  for (const Index v : {0, 7, 80, 120, 168})
    for (const Vector_2& d : {Vector_2(1e-5, 0), Vector_2(0, 1e-5), Vector_2(-1e-5, 1e-5)}) {
      Chart moved = chart;
      moved.uv[v] = moved.uv[v] + d;
      EXPECT_GT(mean_energy(moved), best - 1e-9);
    }
}

/// What of a sphere is below the given height; the more, the stronger conformal maps vary in scale.
Chart bowl(double height)
{
  return test::chart_of(test::grid(40, 80, [=](double x, double y) {
    const double polar = y * std::acos(-height), around = 2 * M_PI * x;
    const double r = std::sin(polar + 1e-3), angle = 0.98 * around;
    return Point_3(r * std::cos(angle), r * std::sin(angle), -std::cos(polar));
  }));
}

std::vector<internal::Complex> coordinates(const Chart& chart)
{
  std::vector<internal::Complex> u;
  for (const Point_2& p : chart.uv)
    u.emplace_back(p.x(), p.y());
  return u;
}

TEST(Chart_hierarchy, thins_out_discs_without_flips)
{
  Chart chart = height_field(60, 0.5, 1);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution()), Chart_status::valid);
  const std::vector<internal::Complex> u = coordinates(chart);
  const internal::Chart_geometry geometry(chart);
  internal::Chart_hierarchy hierarchy(geometry, u);
  hierarchy.coarsen(100);
  ASSERT_GE(hierarchy.levels().size(), 3u);
  EXPECT_LE(hierarchy.levels().back().vertices.size(), 300u);
  for (std::size_t level = 0; level < hierarchy.levels().size(); ++level) {
    const Chart coarse = hierarchy.chart(level);
    EXPECT_TRUE(topology(coarse).is_disc());
    std::vector<internal::Complex> part;
    for (const Index v : hierarchy.levels()[level].vertices) {
      part.push_back(u[v]);
      EXPECT_TRUE(hierarchy.has(level, v));
    }
    EXPECT_TRUE(internal::Injectivity_checker(coarse).is_one_to_one(part));
  }
}

TEST(Chart_hierarchy, brings_affine_maps_back_to_the_finest_mesh)
{
  Chart chart = test::chart_of(test::grid(50, 50, [](double x, double y) {
    return Point_3(x + 0.05 * std::sin(7 * y), y + 0.05 * std::cos(9 * x), 0);
  }));
  std::vector<internal::Complex> u, mapped;
  for (const Point_3& p : chart.points) {
    u.emplace_back(p.x(), p.y());
    mapped.emplace_back(3 * p.x() + p.y(), 0.2 * p.y());
  }
  const internal::Chart_geometry geometry(chart);
  internal::Chart_hierarchy hierarchy(geometry, u);
  hierarchy.coarsen(100);
  const std::size_t top = hierarchy.levels().size() - 1;
  ASSERT_GE(top, 2u);
  std::vector<internal::Complex> back(u.size(), -1), inside = back;
  for (const Index v : hierarchy.levels()[top].vertices)
    back[v] = inside[v] = mapped[v];
  for (std::size_t level = top; level-- > 0;) {
    ASSERT_TRUE(hierarchy.refine(level, back, false));
    ASSERT_TRUE(hierarchy.refine(level, inside, true));
  }
  for (std::size_t v = 0; v < u.size(); ++v)
    EXPECT_NEAR(std::abs(back[v] - mapped[v]), 0, 1e-12);
  // Inside: valid too, and nothing sticks out of the coarse mesh.
  internal::Injectivity_checker checker(chart);
  EXPECT_TRUE(checker.is_one_to_one(inside));
  std::vector<Index> loop = checker.borders().front();
  std::erase_if(loop, [&](Index v) { return !hierarchy.has(top, v); });
  std::vector<Point_2> polygon;
  for (const Index v : loop)
    polygon.push_back(internal::to_point(inside[v]));
  for (const internal::Complex& z : inside)
    EXPECT_NE(CGAL::bounded_side_2(polygon.begin(), polygon.end(), internal::to_point(z), Kernel()),
              CGAL::ON_UNBOUNDED_SIDE);
}

TEST(Symmetric_dirichlet_optimizer, needs_few_iterations_at_full_size)
{
  const std::pair<Chart, std::size_t> charts[] = {{bowl(0.99), 2}, {spiral(1.2, 150, 16), 8}};
  for (auto [chart, most] : charts) {
    Flattening_record record;
    ASSERT_EQ(Bijective_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(is_one_to_one(chart));
    EXPECT_LE(record.distortion.iterations, most); // without coarser meshes 4 and 11
    Distortion_options options;
    options.tolerance = 1e-8;
    options.max_iterations = 500;
    Chart best = chart;
    ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(best, Execution()), Chart_status::valid);
    EXPECT_LE(mean_energy(chart), 1.002 * mean_energy(best));
  }
}

TEST(Symmetric_dirichlet_optimizer, asks_at_every_step_whether_to_go_on)
{
  const Chart start = height_field(12, 0.8, 3);
  for (const int last : {1, 3, 1000}) {
    Chart chart = start;
    ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
    int asked = 0;
    std::set<double> fractions;
    const Execution execution(1, [&](double fraction) {
      fractions.insert(fraction);
      return ++asked < last;
    });
    ASSERT_TRUE(last == 1 || execution.proceed(0.25));
    Distortion_record record;
    const Chart_status status = Symmetric_dirichlet_optimizer().optimize(chart, execution, record);
    EXPECT_EQ(status, last == 1000 ? Chart_status::valid : Chart_status::cancelled);
    if (last == 1000)
      EXPECT_GE(asked, static_cast<int>(record.iterations));
    else
      EXPECT_EQ(asked, last);
    EXPECT_EQ(fractions, std::set<double>{last == 1 ? 0 : 0.25}); // asking is no news
  }
}

TEST(Symmetric_dirichlet_optimizer, stops_at_its_target_and_its_limit)
{
  Chart chart = height_field(12, 0.8, 3);
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  const Chart start = chart;
  Distortion_record full, limited, early;
  Distortion_options options;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), full), Chart_status::valid);
  options.max_iterations = 2;
  chart = start;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), limited),
            Chart_status::valid);
  EXPECT_EQ(limited.iterations, 2u);
  options = {};
  options.target = 1 + 1.5 * (full.after - 1);
  chart = start;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), early), Chart_status::valid);
  EXPECT_LT(early.iterations, full.iterations);
  EXPECT_LE(early.after, options.target * 1.001);
  EXPECT_GT(early.after, full.after);
}

TEST(Symmetric_dirichlet_optimizer, leaves_flipped_charts_alone)
{
  Chart chart = test::chart_of(test::planar_grid(3, 3));
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back(-p.x(), p.y());
  const std::vector<Point_2> before = chart.uv;
  EXPECT_EQ(Symmetric_dirichlet_optimizer().optimize(chart, Execution()), Chart_status::flipped);
  EXPECT_EQ(chart.uv, before);
}

TEST(Schnyder_parameterizer, draws_every_disc_one_to_one)
{
  test::Soup sphere = test::sphere(3);
  sphere.polygons.pop_back();
  std::vector<Chart> charts{test::chart_of(test::planar_grid(1, 1)), test::chart_of(test::planar_grid(7, 9)),
                            test::chart_of(test::planar_grid(200, 1)), tube(150), test::chart_of(sphere)};
  Chart triangle = charts.front();
  triangle.triangles.pop_back();
  const Index unused = 6 - triangle.triangles[0][0] - triangle.triangles[0][1] - triangle.triangles[0][2];
  triangle.points.erase(triangle.points.begin() + unused);
  for (Index& v : triangle.triangles[0])
    v -= v > unused;
  charts.push_back(triangle);
  for (Chart& chart : charts) {
    ASSERT_EQ(Schnyder_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
    EXPECT_TRUE(is_one_to_one(chart));
  }
  Chart closed = test::chart_of(test::sphere(1)), torus = test::chart_of(test::torus(5, 4));
  EXPECT_EQ(Schnyder_parameterizer().parameterize(closed, Execution()), Chart_status::not_a_disc);
  EXPECT_EQ(Schnyder_parameterizer().parameterize(torus, Execution()), Chart_status::not_a_disc);
}

TEST(Bijective_parameterizer, keeps_what_is_one_to_one)
{
  Chart chart = test::chart_of(
      test::grid(8, 8, [](double x, double y) { return Point_3(x, y, 0.2 * std::sin(5 * x + y)); }));
  Chart lscm = chart;
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
  Flattening_record record;
  ASSERT_EQ(Bijective_parameterizer<>(Finish::as_it_is).parameterize(chart, Execution(), record),
            Chart_status::valid);
  EXPECT_EQ(chart.uv, lscm.uv);
  EXPECT_FALSE(record.is_optimized);
  ASSERT_EQ(Bijective_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
  EXPECT_EQ(record.start, Flattening_start::first_choice);
  EXPECT_TRUE(record.is_optimized);
  EXPECT_LT(mean_energy(chart), mean_energy(lscm));
}

TEST(Bijective_parameterizer, repairs_overlaps)
{
  for (const double turns : {1.3, 2.5}) {
    Chart chart = spiral(turns), lscm = chart;
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
    ASSERT_FALSE(is_one_to_one(lscm));
    Flattening_record record;
    EXPECT_EQ(Bijective_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(record.was_overlapping);
    EXPECT_TRUE(is_one_to_one(chart));
    EXPECT_LT(mean_energy(chart), 3);
  }
}

TEST(Bijective_parameterizer, repairs_flips)
{
  std::size_t flips = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Chart chart = height_field(16, 2, seed);
    Flattening_record record;
    EXPECT_EQ(Bijective_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
    flips += record.flips;
    EXPECT_TRUE(is_one_to_one(chart));
    if (record.flips > 0) {
      EXPECT_EQ(record.start, Flattening_start::tutte);
    }
  }
  EXPECT_GT(flips, 0u);
}

/// Mean over the area of the ratio of the singular values and its inverse, over 2.
double mean_shear(const Chart& chart)
{
  double sum = 0, total = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const Vector_3 p = chart.points[b] - chart.points[a], q = chart.points[c] - chart.points[a];
    const Vector_2 s = chart.uv[b] - chart.uv[a], t = chart.uv[c] - chart.uv[a];
    const double space = std::sqrt(CGAL::cross_product(p, q).squared_length()),
                 plane = s.x() * t.y() - s.y() * t.x();
    sum += ((q * q) * (s * s) - 2 * (p * q) * (s * t) + (p * p) * (t * t)) / (2 * plane);
    total += space;
  }
  return sum / total;
}

TEST(Bijective_parameterizer, repairs_flips_conformally_if_asked_to)
{
  std::size_t flips = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Chart chart = height_field(16, 2, seed), isometric = chart;
    Flattening_record record;
    ASSERT_EQ(Bijective_parameterizer<>(Finish::as_it_is).parameterize(chart, Execution(), record),
              Chart_status::valid);
    ASSERT_EQ(Bijective_parameterizer<>().parameterize(isometric, Execution()), Chart_status::valid);
    flips += record.flips;
    EXPECT_TRUE(is_one_to_one(chart));
    if (record.is_optimized) {
      EXPECT_LT(mean_shear(chart) - 1, 0.95 * (mean_shear(isometric) - 1));
    }
  }
  EXPECT_GT(flips, 0u);
}

TEST(Bijective_parameterizer, needs_no_more_than_connectivity)
{
  for (const Index rings : {20, 150}) {
    Chart chart = tube(rings);
    Flattening_record record;
    EXPECT_EQ(Bijective_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(is_one_to_one(chart));
  }
  Chart folded = test::chart_of(test::planar_grid(5, 5)); // needles: columns of vertices in one place
  for (Point_3& p : folded.points)
    p = Point_3(std::floor(p.x() * 2), p.y(), 0);
  EXPECT_EQ(Bijective_parameterizer<>().parameterize(folded, Execution()), Chart_status::valid);
  EXPECT_TRUE(is_one_to_one(folded));
}

TEST(Bijective_parameterizer, says_why_it_refuses)
{
  Chart sphere = test::chart_of(test::sphere(1)), torus = test::chart_of(test::torus(5, 4));
  EXPECT_EQ(Bijective_parameterizer<>().parameterize(sphere, Execution()), Chart_status::not_a_disc);
  EXPECT_EQ(Bijective_parameterizer<>().parameterize(torus, Execution()), Chart_status::not_a_disc);
  Chart chart = test::chart_of(test::planar_grid(4, 4));
  const Execution execution;
  execution.cancel();
  EXPECT_EQ(Bijective_parameterizer<>().parameterize(chart, execution), Chart_status::cancelled);
}

/// The kinds of charts on which flattenings break, by number.
Chart stress_chart(unsigned number)
{
  std::mt19937 random(number);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const Index n = 6 + number % 13;
  const double size = uniform(0.5, 4);
  switch (number % 8) {
  case 0: // rugged terrain
    return height_field(n, size, number);
  case 1: // saddles, up to very steep ones
    return test::chart_of(test::grid(
        n, n, [=](double x, double y) { return Point_3(x, y, 3 * size * (x - 0.5) * (y - 0.5)); }));
  case 2:
    return spiral(size);
  case 3: // a frilled ring
    return test::chart_of(test::grid(12 * n, 3, [=](double x, double y) {
      const double a = 6.1 * x;
      return Point_3((1 + y) * std::cos(a), (1 + y) * std::sin(a), size * y * std::sin(9 * a));
    }));
  case 4: { // columns of needles, of aspect 1e-9 and below
    const double width = std::pow(10, -9 - std::floor(3 * size));
    return test::chart_of(test::grid(2 * n, n, [=](double x, double y) {
      const int column = static_cast<int>(std::lround(2 * n * x));
      return Point_3((column / 2 + column % 2 * width) / n, y, 0.1 * std::sin(5 * y));
    }));
  }
  case 5: { // a vertex of valence 10,000, or less
    test::Soup soup;
    const Index valence = number % 16 == 5 ? 10000 : 50 * n;
    soup.points.emplace_back(0, 0, uniform(-1, 1));
    for (Index i = 0; i < valence; ++i) {
      const double a = 2 * M_PI * i / valence;
      soup.points.emplace_back(std::cos(a), std::sin(a), uniform(0, size / valence));
    }
    for (Index i = 0; i < valence; ++i)
      soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % valence});
    return test::chart_of(soup);
  }
  case 6: // deep tubes
    return tube(n + 5 * (number % 20));
  default: { // caps, of height 0 to 1e-6, on flat ground
    test::Soup soup = test::planar_grid(n, n);
    const double height = number % 3 == 0 ? 0 : std::pow(10, -3 * size);
    const std::size_t count = soup.polygons.size();
    for (std::size_t i = 0; i < count; i += 3) {
      const std::vector<Index> t = soup.polygons[i];
      const Index v = static_cast<Index>(soup.points.size());
      soup.points.push_back(CGAL::barycenter(soup.points[t[0]], 0.5, soup.points[t[1]], 0.5 - height,
                                             soup.points[t[2]], height));
      soup.polygons[i] = {t[0], t[1], v};
      soup.polygons.insert(soup.polygons.end(), {{t[1], t[2], v}, {t[2], t[0], v}});
    }
    return test::chart_of(soup);
  }
  }
}

TEST(Bijective_parameterizer, flattens_two_hundred_hard_charts_one_to_one)
{
  std::array<int, 3> starts{};
  for (unsigned number = 0; number < 200; ++number) {
    Chart chart = stress_chart(number);
    Flattening_record record;
    ASSERT_TRUE(topology(chart).is_disc()) << number;
    EXPECT_EQ(Bijective_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid)
        << number;
    if (chart.number_of_triangles() < 5000) { // the test looks at all pairs of border edges
      EXPECT_TRUE(is_one_to_one(chart)) << number;
    }
    ++starts[static_cast<int>(record.start)];
  }
  for (const int count : starts) // all ways are needed
    EXPECT_GT(count, 0);
}

} // namespace
