// SPDX-License-Identifier: MIT
// What the writers write, as the library assimp reads it: every corner has its position, its texture
// coordinates and the picture of its page.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/build_surface.h>

#include "baked_soups.h"
#include "temporary_folder.h"
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace Atlas {
namespace {

/// Position, texture coordinates, picture.
using Corner = std::tuple<std::array<double, 3>, std::array<double, 2>, std::string>;
/// The corners of each face in their order, from the least one; the faces sorted.
using Faces = std::vector<std::vector<Corner>>;

Faces sorted(Faces faces)
{
  for (auto& face : faces)
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Bumpy quads, all of them apart on the page, and a pentagon. All numbers are floats, and so are their sums
/// with numbers of tiles.
Polygon_soup quads_and_a_pentagon(double far = 0)
{
  const test::Soup grid = test::grid(
      4, 4,
      [&](double x, double y) {
        return Point_3(4 * x + far, 4 * y, 0.25 * static_cast<double>(static_cast<int>(16 * x * y) % 3));
      },
      false, false, true);
  Polygon_soup soup = test::faces_side_by_side(grid);
  const auto n = static_cast<Index>(soup.points.size());
  const double x[] = {0, 1, 1.5, 1, 0}, y[] = {0, 0, 0.75, 1.5, 1.25};
  for (Index i = 0; i < 5; ++i) {
    soup.points.emplace_back(x[i] + far, y[i], 3);
    soup.vertices.push_back(n + i);
    soup.uv.emplace_back(x[i] / 32, y[i] / 32);
  }
  soup.close_face();
  return soup;
}

/// The same on three pages, the last of them in the second row of tiles.
Polygon_soup pages()
{
  Polygon_soup soup = quads_and_a_pentagon();
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    soup.face_page.push_back(std::array<Index, 3>{0, 1, 12}[f % 3]);
  return soup;
}

/// The coordinates of `pages()` in tiles 1001, 1002 and 1013.
std::vector<Point_2> coordinates_in_tiles(const Polygon_soup& soup)
{
  std::vector<Point_2> uv = soup.uv;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      uv[c] = uv[c] + std::array{Vector_2(0, 0), Vector_2(1, 0), Vector_2(2, 1)}[f % 3];
  return uv;
}

Corner corner_of(const Polygon_soup& soup, const std::vector<Point_2>& uv, std::size_t c,
                 const std::string& picture)
{
  const Point_3& p = soup.points[soup.vertices[c]];
  return {{p.x(), p.y(), p.z()}, {uv[c].x(), uv[c].y()}, picture};
}

/// \param picture  of a face
template <typename Picture>
Faces faces_of(const Polygon_soup& soup, const std::vector<Point_2>& uv, const Picture& picture)
{
  Faces faces(soup.number_of_faces());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      faces[f].push_back(corner_of(soup, uv, c, picture(f)));
  return sorted(faces);
}

/// The triangles of the soup; their picture is `*` and the number of the page, which stands for a texture
/// inside the file.
Faces triangles_of(const Polygon_soup& soup, const std::vector<Index>& pages_in_file)
{
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  Faces faces(surface.number_of_triangles());
  for (Index h = 0; h < surface.corner.size(); ++h) {
    const auto page = std::find(pages_in_file.begin(), pages_in_file.end(), soup.page(surface.face[h / 3]));
    faces[h / 3].push_back(
        corner_of(soup, soup.uv, surface.corner[h], "*" + std::to_string(page - pages_in_file.begin())));
  }
  return sorted(faces);
}

std::string picture_of(const aiScene& scene, const aiMesh& mesh)
{
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiString name;
  for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR})
    if (material.GetTexture(type, 0, &name) == aiReturn_SUCCESS)
      return name.C_Str();
  return {};
}

void append_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, Faces& faces)
{
  const aiMatrix4x4 place = parent * node.mTransformation;
  for (const unsigned m : std::span(node.mMeshes, node.mNumMeshes)) {
    const aiMesh& mesh = *scene.mMeshes[m];
    ASSERT_TRUE(mesh.HasTextureCoords(0));
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      faces.emplace_back();
      for (const unsigned v : std::span(face.mIndices, face.mNumIndices)) {
        const aiVector3D p = place * mesh.mVertices[v], &uv = mesh.mTextureCoords[0][v];
        faces.back().push_back({{p.x, p.y, p.z}, {uv.x, uv.y}, picture_of(scene, mesh)});
      }
    }
  }
  for (const aiNode* child : std::span(node.mChildren, node.mNumChildren))
    append_node(scene, *child, place, faces);
}

Faces read_by_assimp(const std::filesystem::path& path, std::vector<std::string>* textures = nullptr)
{
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(path.string(), 0);
  Faces faces;
  if (!scene) {
    ADD_FAILURE() << importer.GetErrorString();
    return faces;
  }
  append_node(*scene, *scene->mRootNode, aiMatrix4x4(), faces);
  if (textures)
    for (const aiTexture* t : std::span(scene->mTextures, scene->mNumTextures))
      textures->emplace_back(reinterpret_cast<const char*>(t->pcData), t->mWidth);
  return sorted(faces);
}

TEST(Assimp, Reads_an_OBJ_file_and_its_picture)
{
  const test::Temporary_folder folder;
  for (const char* name : {"plain", "Möbel für é", "名前"}) {
    const Polygon_soup soup = quads_and_a_pentagon();
    const std::string picture = std::string(name) + ".png";
    const auto path = folder / (std::string(name) + ".obj");
    write_obj(path, soup, picture);
    EXPECT_EQ(read_by_assimp(path), faces_of(soup, soup.uv, [&](std::size_t) { return picture; }));
  }
}

TEST(Assimp, Reads_the_pages_of_an_OBJ_file_as_tiles_and_as_materials)
{
  const test::Temporary_folder folder;
  const Polygon_soup soup = pages();
  const auto path = folder / "pages.obj";
  write_obj(path, soup, "é.png", Page_style::udim);
  EXPECT_EQ(read_by_assimp(path),
            faces_of(soup, coordinates_in_tiles(soup), [](std::size_t) { return "é.<UDIM>.png"; }));
  write_obj(path, soup, "é.png", Page_style::materials);
  EXPECT_EQ(read_by_assimp(path), faces_of(soup, soup.uv, [&](std::size_t f) {
              return std::array{"é.1001.png", "é.1002.png", "é.1013.png"}[f % 3];
            }));
}

TEST(Assimp, Reads_a_PLY_file_with_coordinates_at_vertices)
{
  const test::Temporary_folder folder;
  const auto path = folder / "Möbel.ply";
  const auto no_picture = [](std::size_t) { return ""; };
  const Polygon_soup one = quads_and_a_pentagon(), three = pages();
  write_ply(path, one, "", Ply_texcoord_style::vertex);
  EXPECT_EQ(read_by_assimp(path), faces_of(one, one.uv, no_picture));
  write_ply(path, three, "", Ply_texcoord_style::vertex);
  EXPECT_EQ(read_by_assimp(path), faces_of(three, coordinates_in_tiles(three), no_picture));
}

TEST(Assimp, Reads_a_GLB_file_and_the_pictures_in_it)
{
  const test::Temporary_folder folder;
  for (const double far : {0., 4096.}) {
    const Polygon_soup soup = quads_and_a_pentagon(far);
    const auto path = folder / "Möbel.glb";
    write_glb(path, soup, "the bytes of a picture");
    std::vector<std::string> textures;
    EXPECT_EQ(read_by_assimp(path, &textures), triangles_of(soup, {0}));
    EXPECT_EQ(textures, std::vector<std::string>{"the bytes of a picture"});
  }
}

TEST(Assimp, Reads_a_GLB_file_that_was_rewritten)
{
  const test::Temporary_folder folder;
  write_glb(folder / "old.glb", quads_and_a_pentagon(0.), "a picture");
  Polygon_soup soup = read_polygon_soup(folder / "old.glb");
  for (Point_2& p : soup.uv) // the old ones are a set of their own behind
    p = Point_2(p.x() / 2, p.y() / 2);
  const auto path = folder.write("new.glb", glb_bytes(folder / "old.glb", soup));
  EXPECT_EQ(read_by_assimp(path), triangles_of(soup, {0}));
}

TEST(Assimp, Reads_the_pages_of_a_GLB_file)
{
  const test::Temporary_folder folder;
  const Polygon_soup soup = pages();
  std::vector<std::string> pictures(13);
  pictures[0] = "zero";
  pictures[1] = "one";
  pictures[12] = "twelve";
  write_glb(folder / "pages.glb", soup, pictures);
  std::vector<std::string> textures;
  EXPECT_EQ(read_by_assimp(folder / "pages.glb", &textures), triangles_of(soup, {0, 1, 12}));
  EXPECT_EQ(textures, (std::vector<std::string>{"zero", "one", "twelve"}));
}

} // namespace
} // namespace Atlas
