// SPDX-License-Identifier: MIT
// The meshes of the tests as meshes of CGAL.
#ifndef ATLAS_TEST_CGAL_MESHES_H
#define ATLAS_TEST_CGAL_MESHES_H

#include <Atlas/core/Kernel.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <vector>

namespace Atlas::test {

using Surface_mesh = CGAL::Surface_mesh<Point_3>;

inline Surface_mesh surface_mesh_of(const Soup& soup)
{
  Surface_mesh mesh;
  std::vector<Surface_mesh::Vertex_index> v;
  for (const Point_3& p : soup.points)
    v.push_back(mesh.add_vertex(p));
  for (const auto& polygon : soup.polygons) {
    std::vector<Surface_mesh::Vertex_index> corners;
    for (const Index i : polygon)
      corners.push_back(v[i]);
    EXPECT_NE(mesh.add_face(corners), Surface_mesh::null_face());
  }
  return mesh;
}

/// As a model of `FaceListGraph`, whose header of `graph_traits` is to be included.
template <typename Mesh>
Mesh mesh_of(const Soup& soup)
{
  Mesh mesh;
  CGAL::copy_face_graph(surface_mesh_of(soup), mesh);
  return mesh;
}

} // namespace Atlas::test

#endif
