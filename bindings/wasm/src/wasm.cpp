// SPDX-License-Identifier: MIT
// What ../package/index.js calls: the C interface with numbers and addresses alone, options as JSON, and
// files in memory.
#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/atlas.h>
#include <Atlas/core/errors.h>
#include <Atlas/soup/Polygon_soup.h>

#include "options.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <emscripten.h>
#include <exception>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

using namespace Atlas;
using Json = nlohmann::json;

// Tells the module how far a stage is; 0 cancels.
EM_JS(int, tell_progress, (int stage, double fraction),
      { return Module.atlasProgress ? Module.atlasProgress(stage, fraction) : 1; });

/// A scene, and for each mesh of it the model whose attributes a written file keeps.
struct Wasm_scene
{
  atlas_scene* scene = atlas_create();
  std::vector<Polygon_soup> models;
  std::vector<std::string> paths; ///< their files
  std::string error, bytes;

  ~Wasm_scene() { atlas_destroy(scene); }
};

namespace {

int fail(Wasm_scene& scene, int status)
{
  scene.error = atlas_error(scene.scene);
  return status;
}

template <typename Body>
int guarded(Wasm_scene& scene, Body body)
{
  scene.error.clear();
  try {
    return body();
  } catch (const std::bad_alloc&) {
    scene.error = "not enough memory";
    return ATLAS_OUT_OF_MEMORY;
  } catch (const Invalid_argument& e) {
    scene.error = e.what();
    return ATLAS_INVALID_ARGUMENT;
  } catch (const std::exception& e) {
    scene.error = e.what();
    return ATLAS_FAILED;
  }
}

int progress(void*, int stage, double fraction)
{
  return tell_progress(stage, fraction);
}

/// Calls `work` with options read from JSON.
template <typename Work>
int run(Wasm_scene& scene, const char* json, Work work)
{
  return guarded(scene, [&] {
    const Json wishes = Json::parse(json);
    atlas_options options;
    ATLAS_OPTIONS_INIT(&options);
    options.threads = 1;
    options.progress = progress;
    wasm::Option_reader reader(options);
    for (const auto& [name, value] : wishes.items())
      reader.read(name, value);
    return fail(scene, work(scene.scene, &options));
  });
}

/// Adds a model of a file, whose attributes a written file keeps.
int add_model(Wasm_scene& scene, Polygon_soup model)
{
  std::vector<unsigned> sizes;
  for (std::size_t f = 0; f < model.number_of_faces(); ++f)
    sizes.push_back(unsigned(model.first[f + 1] - model.first[f]));
  std::vector<double> positions;
  for (const Point_3& p : model.points)
    positions.insert(positions.end(), {p.x(), p.y(), p.z()});
  std::vector<float> uvs;
  for (const Point_2& p : model.uv)
    uvs.insert(uvs.end(), {float(p.x()), float(p.y())});
  const auto data = [](const auto& list) { return list.empty() ? nullptr : list.data(); };
  atlas_mesh mesh;
  ATLAS_MESH_INIT(&mesh);
  mesh.positions = positions.data();
  mesh.position_type = ATLAS_DOUBLE;
  mesh.number_of_vertices = model.points.size();
  mesh.indices = model.vertices.data();
  mesh.face_sizes = sizes.data();
  mesh.number_of_faces = model.number_of_faces();
  mesh.corner_uvs = data(uvs);
  mesh.face_pages = data(model.face_page);
  mesh.face_materials = data(model.face_material);
  const int status = atlas_add_mesh(scene.scene, &mesh);
  if (status == ATLAS_OK)
    scene.models.push_back(std::move(model));
  return fail(scene, status);
}

/// The model with the coordinates that the atlas has for it.
Polygon_soup textured(Wasm_scene& scene, std::size_t mesh)
{
  internal::require(mesh < scene.models.size(), "the mesh", "was not read from a file");
  atlas_result result;
  ATLAS_RESULT_INIT(&result);
  if (atlas_get_result(scene.scene, mesh, &result) != ATLAS_OK)
    throw Invalid_argument("the scene", "has no coordinates yet");
  Polygon_soup model = scene.models[mesh];
  model.old_uv = std::exchange(model.uv, {});
  for (std::size_t c = 0; c < result.number_of_corners; ++c)
    model.uv.emplace_back(result.corner_uvs[2 * c], result.corner_uvs[2 * c + 1]);
  model.face_page.assign(result.face_pages, result.face_pages + result.number_of_faces);
  return model;
}

bool is_gltf(const std::filesystem::path& path)
{
  const std::string extension = internal::lower_case_extension(path);
  return extension == ".glb" || extension == ".gltf";
}

} // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* wasm_version()
{
  return atlas_version();
}

EMSCRIPTEN_KEEPALIVE const char* wasm_stage_name(int stage)
{
  return atlas_stage_name(stage);
}

EMSCRIPTEN_KEEPALIVE Wasm_scene* wasm_create()
{
  return new Wasm_scene;
}

EMSCRIPTEN_KEEPALIVE void wasm_destroy(Wasm_scene* scene)
{
  delete scene;
}

EMSCRIPTEN_KEEPALIVE const char* wasm_error(const Wasm_scene* scene)
{
  return scene->error.c_str();
}

/// \param arrays addresses of positions, indices, face sizes, coordinates of vertices, those of corners,
/// pages, materials, seams, forbidden seams, visibilities, selected faces and pinned corners; 0: none \param
/// sizes position type, stride, and the numbers of vertices, faces and the seams
EMSCRIPTEN_KEEPALIVE int wasm_add_mesh(Wasm_scene* scene, void* const* arrays, const unsigned* sizes)
{
  atlas_mesh mesh;
  ATLAS_MESH_INIT(&mesh);
  mesh.positions = arrays[0];
  mesh.indices = static_cast<unsigned*>(arrays[1]);
  mesh.face_sizes = static_cast<unsigned*>(arrays[2]);
  mesh.vertex_uvs = static_cast<float*>(arrays[3]);
  mesh.corner_uvs = static_cast<float*>(arrays[4]);
  mesh.face_pages = static_cast<unsigned*>(arrays[5]);
  mesh.face_materials = static_cast<unsigned*>(arrays[6]);
  mesh.seams = static_cast<unsigned*>(arrays[7]);
  mesh.forbidden_seams = static_cast<unsigned*>(arrays[8]);
  mesh.visibility = static_cast<double*>(arrays[9]);
  mesh.selected = static_cast<unsigned char*>(arrays[10]);
  mesh.pinned = static_cast<unsigned char*>(arrays[11]);
  mesh.position_type = int(sizes[0]);
  mesh.position_stride = sizes[1];
  mesh.number_of_vertices = sizes[2];
  mesh.number_of_faces = sizes[3];
  mesh.number_of_seams = sizes[4];
  mesh.number_of_forbidden_seams = sizes[5];
  return fail(*scene, atlas_add_mesh(scene->scene, &mesh));
}

/// Adds the model of a file of the module's file system.
EMSCRIPTEN_KEEPALIVE int wasm_read(Wasm_scene* scene, const char* path)
{
  return guarded(*scene, [&] {
    const int status = add_model(*scene, read_polygon_soup(path));
    if (status == ATLAS_OK)
      scene->paths.push_back(path);
    return status;
  });
}

EMSCRIPTEN_KEEPALIVE int wasm_generate(Wasm_scene* scene, const char* options)
{
  return run(*scene, options, atlas_generate);
}

EMSCRIPTEN_KEEPALIVE int wasm_pack(Wasm_scene* scene, const char* options)
{
  return run(*scene, options, atlas_pack);
}

EMSCRIPTEN_KEEPALIVE int wasm_verify(Wasm_scene* scene, const char* options)
{
  return run(*scene, options, atlas_verify);
}

EMSCRIPTEN_KEEPALIVE const char* wasm_report(const Wasm_scene* scene)
{
  return atlas_report(scene->scene);
}

/// \param numbers charts, pages, width, height, texels per unit, efficiency
EMSCRIPTEN_KEEPALIVE int wasm_summary(Wasm_scene* scene, double* numbers)
{
  atlas_summary s;
  ATLAS_SUMMARY_INIT(&s);
  const int status = atlas_get_summary(scene->scene, &s);
  const double values[] = {double(s.number_of_charts), double(s.number_of_pages), double(s.width),
                           double(s.height),           s.texels_per_unit,         s.efficiency};
  std::copy(std::begin(values), std::end(values), numbers);
  return fail(*scene, status);
}

/// \param numbers of faces, corners, new vertices and triangles; the addresses of corner_uvs, face_charts,
/// face_pages, vmapping, uvs, indices, triangles, face_of_triangle
EMSCRIPTEN_KEEPALIVE int wasm_result(Wasm_scene* scene, unsigned mesh, std::uintptr_t* numbers)
{
  atlas_result r;
  ATLAS_RESULT_INIT(&r);
  const int status = atlas_get_result(scene->scene, mesh, &r);
  const auto address = [](const void* p) { return reinterpret_cast<std::uintptr_t>(p); };
  const std::uintptr_t values[] = {r.number_of_faces,     r.number_of_corners,   r.number_of_vertices,
                                   r.number_of_triangles, address(r.corner_uvs), address(r.face_charts),
                                   address(r.face_pages), address(r.vmapping),   address(r.uvs),
                                   address(r.indices),    address(r.triangles),  address(r.face_of_triangle)};
  std::copy(std::begin(values), std::end(values), numbers);
  return fail(*scene, status);
}

/// A model that was read, as its file has it. \param numbers of vertices, corners and faces; the addresses of
/// the positions, three doubles per vertex, of the vertices of the corners, and of where the corners of each
/// face start
EMSCRIPTEN_KEEPALIVE int wasm_model(Wasm_scene* scene, unsigned mesh, std::uintptr_t* numbers)
{
  return guarded(*scene, [&] {
    internal::require(mesh < scene->models.size(), "the mesh", "was not read from a file");
    const Polygon_soup& model = scene->models[mesh];
    std::vector<double> positions;
    for (const Point_3& p : model.points)
      positions.insert(positions.end(), {p.x(), p.y(), p.z()});
    scene->bytes.assign(reinterpret_cast<const char*>(positions.data()), positions.size() * sizeof(double));
    const auto address = [](const void* p) { return reinterpret_cast<std::uintptr_t>(p); };
    const std::uintptr_t values[] = {
        model.points.size(),          model.number_of_corners(),      model.number_of_faces(),
        address(scene->bytes.data()), address(model.vertices.data()), address(model.first.data())};
    std::copy(std::begin(values), std::end(values), numbers);
    return ATLAS_OK;
  });
}

/// A model that was read, as a file with the coordinates of the atlas. \param format obj, ply or glb \param
/// numbers the size, and the address of the bytes
EMSCRIPTEN_KEEPALIVE int wasm_write(Wasm_scene* scene, unsigned mesh, const char* format,
                                    std::uintptr_t* numbers)
{
  return guarded(*scene, [&] {
    const Polygon_soup model = textured(*scene, mesh);
    const std::string name = format;
    if (name == "obj")
      scene->bytes = obj_text(model, "");
    else if (name == "ply")
      scene->bytes = ply_bytes(model, "");
    else if (name == "glb" && is_gltf(scene->paths[mesh]) && model.number_of_pages() == 1)
      scene->bytes = glb_bytes(scene->paths[mesh], model);
    else if (name == "glb")
      scene->bytes = glb_bytes(model, std::vector<std::string>());
    else
      throw Invalid_argument("format", "is " + name + "; known are obj, ply, glb");
    numbers[0] = scene->bytes.size();
    numbers[1] = reinterpret_cast<std::uintptr_t>(scene->bytes.data());
    return ATLAS_OK;
  });
}

} // extern "C"
