// SPDX-License-Identifier: MIT
// Any soup gets an atlas: the points are those of a small grid, so that equal points, flat faces and faces
// upon faces are frequent. The certificate is the judge.
#include <Atlas/generate_atlas.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/validation/certify.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

using namespace Atlas;

void require(bool is_true, const char* what)
{
  if (is_true)
    return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

struct Soup
{
  std::vector<Point_3> points;
  std::vector<std::size_t> first{0};
  std::vector<Index> vertices;
};

/// Most inputs are packed the fast way: the raster packer takes longer than all the rest.
struct Some_packer
{
  int choice; ///< of 64

  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const
  {
    if (choice == 63)
      return Raster_packer().pack(charts, page, execution);
    if (choice >= 48)
      return Rectangle_packer().pack(charts, page, execution);
    return Horizon_packer().pack(charts, page, execution);
  }
};

Atlas_mode mode_of(int choice)
{
  return choice == 3 ? Atlas_mode::conformal : choice == 2 ? Atlas_mode::few_seams : Atlas_mode::standard;
}

/// The first byte tells the unit, the packer and the mode, the second the packer and the number of points;
/// then come a byte per point and, for each face, a byte with the number of its corners and one for each
/// corner.
Soup soup_of(const std::uint8_t* data, std::size_t size)
{
  static constexpr double units[] = {1, 1e-30, 1e30, 0.1};
  Soup soup;
  const double unit = units[data[0] % 4];
  const std::size_t n = 3 + data[1] % 40;
  std::size_t at = 2;
  for (; soup.points.size() < n && at < size; ++at) {
    const int b = data[at];
    const double x = b & 3, y = b >> 2 & 3, z = b >> 4 & 3;
    // A quarter of the values are off the grid.
    const double bend = b >> 6 == 3 ? std::sin(double(soup.points.size())) : 0;
    soup.points.emplace_back(unit * (x + bend), unit * (y - bend), unit * (z + bend * bend));
  }
  while (at < size && soup.first.size() <= 48) {
    const std::size_t corners = data[at] % 4 == 3 ? data[at] / 4 % 9 : 3 + data[at] % 2;
    ++at;
    for (std::size_t i = 0; i < corners && at < size; ++i, ++at)
      soup.vertices.push_back(data[at] % static_cast<Index>(n + 1)); // sometimes one too many
    soup.first.push_back(soup.vertices.size());
  }
  return soup;
}

void check(const Surface& surface, const std::vector<Point_2>& uv, const Atlas_report& report)
{
  require(report.faces == surface.number_of_faces, "faces are counted");
  require(report.rejected.size() == surface.rejected.size(), "rejected faces are listed");
  if (surface.number_of_triangles() == 0)
    require(report.status == Atlas_status::no_surface, "no triangle, no surface");
  if (report.status == Atlas_status::no_surface) {
    require(uv.empty(), "coordinates are left as they are");
    return;
  }
  require(report.is_valid(), "the atlas is valid");
  require(uv.size() == surface.number_of_corners, "coordinates per corner");
  Certificate_options options;
  options.precision = Uv_precision::single_precision;
  const Atlas_certificate certificate = certify(surface, uv, report.face_page, options);
  require(certificate.is_valid(), "the certificate holds for the coordinates");
  for (const Index c : surface.corner)
    require(uv[c].x() == static_cast<double>(static_cast<float>(uv[c].x())), "coordinates are floats");
  for (std::size_t t = 0; t < surface.number_of_triangles(); ++t)
    require(report.face_chart[surface.face[t]] < report.charts.size(),
            "every face with triangles has a chart");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size < 8)
    return 0;
  const Soup soup = soup_of(data, size);
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface, uv,
                                             parameters::texture_size(32)
                                                 .gutter(1)
                                                 .mode(mode_of(data[0] >> 2 & 3))
                                                 .packer(Some_packer{data[0] >> 4 << 2 | data[1] >> 6})
                                                 .number_of_threads(1));
  check(surface, uv, report);
  return 0;
}
