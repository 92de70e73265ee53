// SPDX-License-Identifier: MIT
// Least squares conformal map of one disc, without segmentation and packing: half a sphere.
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/validation/Exact_validator.h>

#include <cmath>
#include <iostream>

int main()
{
  // The pole, then rings of vertices down to the equator.
  const Atlas::Index rings = 20, sectors = 60;
  Atlas::Chart chart;
  chart.points.emplace_back(0, 0, 1);
  for (Atlas::Index r = 1; r <= rings; ++r)
    for (Atlas::Index s = 0; s < sectors; ++s) {
      const double theta = CGAL_PI / 2 * r / rings, phi = 2 * CGAL_PI * s / sectors;
      chart.points.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                std::cos(theta));
    }
  const auto at = [&](Atlas::Index r, Atlas::Index s) {
    return r == 0 ? 0 : 1 + (r - 1) * sectors + s % sectors;
  };
  for (Atlas::Index r = 0; r < rings; ++r)
    for (Atlas::Index s = 0; s < sectors; ++s) {
      chart.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      if (r > 0)
        chart.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }

  const Atlas::Execution execution;
  const Atlas::Chart_status status = Atlas::LSCM_parameterizer<>().parameterize(chart, execution);
  const Atlas::Chart_verdict verdict = Atlas::Exact_validator().validate(chart, execution);
  const Atlas::Distortion distortion = Atlas::measure_distortion(chart);

  // The conformal map of a half sphere is the stereographic one: areas grow by a factor of 4 from pole to
  // equator.
  std::cout << "flattening: " << message(status) << "\nverdict: " << message(verdict.status)
            << "\nratio of singular values, mean: " << distortion.quasi_conformal_mean
            << "\nlargest to smallest area: " << distortion.area_max / distortion.area_min << '\n';
  return status == Atlas::Chart_status::valid && distortion.quasi_conformal_mean < 1.1 ? 0 : 1;
}
