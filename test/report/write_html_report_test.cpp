// SPDX-License-Identifier: MIT
#include <Atlas/image/internal/base64.h>
#include <Atlas/image/pages.h>
#include <Atlas/report/internal/Report_model.h>
#include <Atlas/report/write_report.h>
#include <Atlas/soup/internal/face_distortion.h>

#include "temporary_folder.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <string>
#include <vector>

using namespace Atlas;

namespace {

/// Two unit squares: the first is mapped by a similarity, the second is stretched twofold along u.
Polygon_soup two_squares()
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.vertices = {0, 1, 2, 3, 0, 1, 2, 3, 0, 0, 0};
  soup.first = {0, 4, 8, 11};
  soup.uv = {{0, 0},   {.1, 0},  {.1, .1}, {0, .1}, {.5, .5}, {.7, .5},
             {.7, .6}, {.5, .6}, {0, 0},   {0, 0},  {0, 0}};
  return soup;
}

} // namespace

TEST(Face_distortion, known_answers)
{
  const Soup_distortion d = measure_distortion(two_squares());
  ASSERT_EQ(d.face, (std::vector<Index>{0, 0, 1, 1}));
  const double scale = std::sqrt(0.03 / 2); // area on the page over area in space
  EXPECT_NEAR(d.largest[0], scale * 10, 1e-12);
  EXPECT_NEAR(d.smallest[0], scale * 10, 1e-12);
  EXPECT_NEAR(d.largest[2], scale * 10, 1e-12);
  EXPECT_NEAR(d.smallest[2], scale * 5, 1e-12);
  EXPECT_NEAR(std::accumulate(d.weight.begin(), d.weight.end(), 0.), 1, 1e-12);
  const std::vector<double> stretch = face_stretch(d, 3);
  EXPECT_NEAR(stretch[0], scale * 10, 1e-12);
  EXPECT_NEAR(stretch[1], 1 / (scale * 5), 1e-12);
  EXPECT_TRUE(std::isnan(stretch[2]));
}

TEST(Face_distortion, histograms_are_shares_of_area)
{
  const Soup_distortion d = measure_distortion(two_squares());
  const Histogram angles = angle_histogram(d), areas = area_histogram(d);
  EXPECT_NEAR(angles.share[0], 0.5, 1e-12);
  const auto bin = static_cast<std::size_t>(2 * std::atan(2.) * 180 / CGAL_PI - 90); // of width 1
  EXPECT_NEAR(angles.share[bin], 0.5, 1e-12);
  EXPECT_NEAR(std::accumulate(areas.share.begin(), areas.share.end(), 0.), 1, 1e-12);
}

TEST(Base64, known_answers)
{
  for (const auto& [text, code] : std::vector<std::pair<std::string, std::string>>{{"", ""},
                                                                                   {"f", "Zg=="},
                                                                                   {"fo", "Zm8="},
                                                                                   {"foo", "Zm9v"},
                                                                                   {"foob", "Zm9vYg=="},
                                                                                   {"fooba", "Zm9vYmE="},
                                                                                   {"foobar", "Zm9vYmFy"}})
    EXPECT_EQ(internal::base64(text), code);
}

TEST(Report_model, edges_of_one_triangle_are_seams)
{
  const internal::Report_model model(two_squares(), {0, 1, no_index});
  EXPECT_EQ(model.positions.size(), 3u * 8);
  EXPECT_EQ(model.charts, (std::vector<float>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(model.indices.size(), 3u * 4); // the face of one vertex is no triangle
  EXPECT_EQ(model.seams.size(), 2u * 8);   // the sides of both squares, not their diagonals
  for (std::size_t i = 0; i < model.seams.size(); i += 2)
    EXPECT_EQ(model.charts[model.seams[i]], model.charts[model.seams[i + 1]]);
  EXPECT_NEAR(model.density, 0.03 / 4, 1e-6); // in the unit ball each square has an area of 2
}

TEST(Report_model, worst_spots_come_first)
{
  const Polygon_soup soup = two_squares();
  Atlas_report report;
  report.charts.resize(2);
  const internal::Report_model model(soup, {0, 1, no_index});
  const std::vector<internal::Worst_spot> spots = internal::worst_spots(model, soup, report, 5);
  ASSERT_EQ(spots.size(), 2u);
  EXPECT_EQ(spots[0].chart, 1u); // stretched twofold
  EXPECT_EQ(spots[1].chart, 0u);
  EXPECT_NEAR(spots[0].normal[2], 1, 1e-6);
  EXPECT_GT(spots[0].radius, 0.5);
  EXPECT_EQ(internal::worst_spots(model, soup, report, 1).size(), 1u);
}

TEST(Write_html_report, is_complete_and_needs_nothing_else)
{
  const Polygon_soup soup = two_squares();
  Atlas_report report;
  report.faces = 3;
  report.rejected = {{2, Rejection::too_few_corners}};
  report.charts.resize(2);
  report.face_chart = {0, 1, no_index};
  const Image picture(8, 8);
  const std::string html = html_report(soup, report, {picture, picture, picture}, "a <b> & \"c\"");
  EXPECT_NE(html.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
  EXPECT_NE(html.find("fewer than three distinct corners"), std::string::npos);
  EXPECT_EQ(html.find('@'), html.find("@media"));  // every placeholder has been replaced
  EXPECT_EQ(html.find("http"), std::string::npos); // nothing is loaded
  EXPECT_EQ(html.find("<b>"), std::string::npos);
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(count("<section>"), count("</section>"));
  EXPECT_EQ(count("<div"), count("</div>"));
  EXPECT_EQ(count("data:image/png;base64,"), 3u);
  EXPECT_EQ(count("<tr class=\"chart\""), 2u);
  EXPECT_LT(html.find("data-chart=\"1\""), html.find("data-chart=\"0\"")); // the worst one first
}

TEST(Draw_stretch, hot_and_cool)
{
  const Polygon_soup soup = two_squares();
  const Image image = draw_stretch(soup, {1, 5, NAN}, 200);
  EXPECT_EQ(image.at(10, 190), color_of_stretch(1));
  EXPECT_EQ(image.at(120, 90), color_of_stretch(2));
  EXPECT_GT(color_of_stretch(2)[0], color_of_stretch(1)[0]);
  EXPECT_GT(with_stretch_scale(image).height, image.height);
}
