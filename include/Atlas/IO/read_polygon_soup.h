// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_READ_POLYGON_SOUP_H
#define ATLAS_IO_READ_POLYGON_SOUP_H

#include <Atlas/soup/Polygon_soup.h>

#include <filesystem>

namespace Atlas {

/// \brief Reads a mesh file; its extension tells the format, in any case.
///
/// | extension | what is read |
/// |---|---|
/// | .obj | polygons with relative indices, comments, continued lines, all line ends; `v` with w or colours,
/// `vt`, `vn`, `usemtl`, `mtllib`, `o` and `g` (one group name a face, the latest); vertices may come after
/// the faces that name them; unknown statements are skipped | | .off, .coff | `OFF`, and with normals,
/// colours or coordinates at the vertices `NOFF`, `COFF`, `STOFF` and their combinations; colours of faces
/// are skipped | | .ply | text or binary of either byte order, with positions, normals, colours, and
/// coordinates at the vertices, at the wedges of faces as MeshLab writes them, or at the halfedges as CGAL
/// does; MeshLab's numbers of textures are pages | | .stl | text or binary; corners at exactly the same
/// position become one vertex | | .gltf, .glb | version 2.0: all triangles of the default scene, transformed
/// by their nodes |
///
/// \throw IO_error with one line that names the file, the line or byte and what is wrong: a statement cannot
/// be understood, there is no face, the format is unknown or, in glTF, compressed
Polygon_soup read_polygon_soup(const std::filesystem::path& path);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/IO/internal/read_polygon_soup_impl.h>
#endif

#endif
