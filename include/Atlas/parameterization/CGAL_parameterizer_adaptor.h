// SPDX-License-Identifier: MIT
// This header alone includes GPL parts of CGAL (Surface_mesh, Surface_mesh_parameterization): programs that
// include it are bound by the GPL or need a commercial licence of CGAL. Nothing else in Atlas includes it.
#ifndef ATLAS_PARAMETERIZATION_CGAL_PARAMETERIZER_ADAPTOR_H
#define ATLAS_PARAMETERIZATION_CGAL_PARAMETERIZER_ADAPTOR_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/helpers.h>

#include <utility>
#include <vector>

namespace Atlas {

/// The mesh on which CGAL's parameterizers work inside `CGAL_parameterizer_adaptor`.
using CGAL_chart_mesh = CGAL::Surface_mesh<Point_3>;

/// \brief Makes a parameterizer of CGAL's package Surface_mesh_parameterization a model of
/// `ChartParameterizer`, for instance
/// `CGAL_parameterizer_adaptor<CGAL::Surface_mesh_parameterization::ARAP_parameterizer_3<CGAL_chart_mesh>>`.
///
/// The result is scaled to the area of the chart. CGAL's precondition: the chart is a disc.
template <typename Parameterizer>
class CGAL_parameterizer_adaptor
{
public:
  /// Takes any parameterizer of CGAL.
  explicit CGAL_parameterizer_adaptor(Parameterizer parameterizer = Parameterizer())
      : parameterizer_(std::move(parameterizer))
  {}

  /// \return `not_a_disc` for a chart that is not an oriented manifold with a border; `solver_failed` for any
  /// other error of CGAL
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    if (execution.is_cancelled())
      return Chart_status::cancelled;
    CGAL_chart_mesh mesh;
    for (const Point_3& p : chart.points)
      mesh.add_vertex(p);
    using Vertex = CGAL_chart_mesh::Vertex_index;
    for (const auto& [a, b, c] : chart.triangles)
      if (mesh.add_face(Vertex(a), Vertex(b), Vertex(c)) == CGAL_chart_mesh::null_face())
        return Chart_status::not_a_disc;
    CGAL_chart_mesh::Halfedge_index border;
    for (const auto h : mesh.halfedges())
      if (mesh.is_border(h)) {
        border = h;
        break;
      }
    if (border == CGAL_chart_mesh::null_halfedge())
      return Chart_status::not_a_disc;
    auto uv = mesh.add_property_map<Vertex, Point_2>("v:uv", Point_2(0, 0)).first;
    Parameterizer parameterizer = parameterizer_;
    if (CGAL::Surface_mesh_parameterization::parameterize(mesh, parameterizer, border, uv) !=
        CGAL::Surface_mesh_parameterization::OK)
      return Chart_status::solver_failed;

    const internal::Chart_geometry geometry(chart);
    std::vector<internal::Complex> u;
    for (const Vertex v : mesh.vertices()) {
      u.emplace_back(uv[v].x(), uv[v].y());
      if (!CGAL::is_finite(uv[v].x()) || !CGAL::is_finite(uv[v].y()))
        return Chart_status::solver_failed;
    }
    internal::store_coordinates(geometry, u, internal::density_correction(geometry, u), chart);
    return Chart_status::valid;
  }

private:
  Parameterizer parameterizer_;
};

} // namespace Atlas

#endif
