// SPDX-License-Identifier: MIT
// The module atlas_uv._native: scenes and pages in terms of numpy's arrays. What users call is in
// ../atlas_uv.
#include <Atlas/core/errors.h>
#include <Atlas/image/pages.h>
#include <Atlas/version.h>

#include "../../bindings/Scene.h"
#include "Conversation.h"
#include "arrays.h"
#include "bake.h"
#include "options.h"
#include <chrono>
#include <cmath>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace Atlas::python {

namespace {

using bindings::Mesh_result;
using bindings::Scene;
using bindings::Scene_mesh;
using bindings::Scene_options;

py::object to_python(const Json& json)
{
  switch (json.type()) {
  case Json::value_t::object: {
    py::dict result;
    for (const auto& [key, value] : json.items())
      result[py::str(key)] = to_python(value);
    return result;
  }
  case Json::value_t::array: {
    py::list result(json.size());
    for (std::size_t i = 0; i < json.size(); ++i)
      result[i] = to_python(json[i]);
    return result;
  }
  case Json::value_t::string:
    return py::str(json.get<std::string>());
  case Json::value_t::boolean:
    return py::bool_(json.get<bool>());
  case Json::value_t::number_integer:
    return py::int_(json.get<long long>());
  case Json::value_t::number_unsigned:
    return py::int_(json.get<unsigned long long>());
  case Json::value_t::number_float:
    return py::float_(json.get<double>());
  default:
    return py::none();
  }
}

/// What a listener is told.
struct News
{
  Stage stage;
  double fraction;
};

/// \brief Does work that can be followed and cancelled, without the interpreter's lock.
///
/// The listener hears the beginning of each stage, and then something every 20 ms at most. What it raises,
/// and what handlers of signals raise, ends the work and reaches the caller.
template <typename Work>
void run_patiently(const py::object& listener, Work work)
{
  Conversation<News> talk;
  using Clock = std::chrono::steady_clock;
  Clock::time_point last{};
  Stage stage{};
  const bindings::Progress progress = [&, is_heard = !listener.is_none()](Stage now, double fraction) {
    if (!is_heard || !talk.goes_on())
      return talk.goes_on();
    const Clock::time_point time = Clock::now();
    if (last != Clock::time_point() && now == stage && time - last < std::chrono::milliseconds(20))
      return true;
    last = time;
    stage = now;
    return talk.ask({now, fraction});
  };
  const auto answer = [&](const News& news) {
    const py::gil_scoped_acquire lock;
    const py::object goes_on = listener(py::str(name(news.stage)), news.fraction);
    return goes_on.is_none() || py::cast<bool>(py::bool_(goes_on));
  };
  const auto look = [] {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
    return true;
  };
  const py::gil_scoped_release unlocked;
  talk.hold([&] { work(progress); }, answer, look);
}

const char* word(const Scene& scene, Atlas_status status)
{
  switch (status) {
  case Atlas_status::valid:
    return "valid";
  case Atlas_status::not_valid:
    return "not valid";
  case Atlas_status::no_surface:
    return "no surface";
  case Atlas_status::no_room:
    return "no room";
  case Atlas_status::cancelled:
    return scene.is_out_of_time() ? "out of time" : "cancelled";
  case Atlas_status::vertices_split: // soups have coordinates of corners
    break;
  }
  return "";
}

/// The corners of faces: so many for each, or three for all.
void set_faces(Polygon_soup& soup, const Optional_array<Index>& face_sizes, const Array<Index>& indices)
{
  soup.vertices = values<Index>(indices, "indices");
  if (!face_sizes) {
    internal::require(soup.vertices.size() % 3 == 0, "indices", "must have three corners for each face");
    for (std::size_t c = 3; c <= soup.vertices.size(); c += 3)
      soup.first.push_back(c);
    return;
  }
  for (const Index size : values<Index>(*face_sizes, "face_sizes"))
    soup.first.push_back(soup.first.back() + size);
  internal::require(soup.first.back() == soup.vertices.size(), "face_sizes",
                    "must add up to the number of indices");
}

/// Normals are given for vertices.
void set_normals(Polygon_soup& soup, const Optional_array<double>& normals)
{
  if (!normals)
    return;
  soup.normals = rows<Vector_3, 3>(*normals, "normals");
  internal::require(soup.normals.size() == soup.points.size(), "normals", "must have a row for each vertex");
  soup.corner_normal = soup.vertices;
}

Polygon_soup make_soup(const Array<double>& points, const Optional_array<Index>& face_sizes,
                       const Array<Index>& indices, const Optional_array<double>& uvs,
                       const Optional_array<double>& normals, const Optional_array<float>& colors,
                       const Optional_array<Index>& pages)
{
  Polygon_soup soup;
  soup.points = rows<Point_3, 3>(points, "positions");
  set_faces(soup, face_sizes, indices);
  if (uvs)
    soup.uv = rows<Point_2, 2>(*uvs, "uvs");
  set_normals(soup, normals);
  if (colors)
    soup.colors = rows<std::array<float, 4>, 4>(*colors, "colors");
  if (pages)
    soup.face_page = values<Index>(*pages, "pages");
  return soup;
}

std::vector<std::array<Index, 2>> edges(const Optional_array<Index>& array, const char* argument)
{
  if (!array)
    return {};
  return rows<std::array<Index, 2>, 2>(*array, argument);
}

void add_mesh(Scene& scene, const Array<double>& points, const Optional_array<Index>& face_sizes,
              const Array<Index>& indices, const Optional_array<double>& uvs,
              const Optional_array<double>& normals, const Optional_array<float>& colors,
              const Optional_array<Index>& pages, const Optional_array<Index>& materials,
              const Optional_array<Index>& seams, const Optional_array<Index>& forbidden_seams,
              const Optional_array<double>& visibility, const Optional_array<bool>& selected,
              const Optional_array<bool>& pinned)
{
  Scene_mesh mesh{make_soup(points, face_sizes, indices, uvs, normals, colors, pages),
                  edges(seams, "seams"),
                  edges(forbidden_seams, "forbidden_seams"),
                  {},
                  {},
                  {}};
  if (selected)
    mesh.selected = values<bool>(*selected, "selected");
  if (pinned)
    mesh.pinned = values<bool>(*pinned, "pinned");
  if (visibility)
    mesh.visibility = values<double>(*visibility, "visibility");
  if (materials)
    mesh.soup.face_material = values<Index>(*materials, "materials");
  scene.add(std::move(mesh));
}

const char* generate(Scene& scene, const py::dict& keywords, const py::object& listener)
{
  const Scene_options options = scene_options(keywords);
  Atlas_status status{};
  run_patiently(listener, [&](const auto& progress) { status = scene.generate(options, progress); });
  return word(scene, status);
}

const char* pack(Scene& scene, const py::dict& keywords, const py::object& listener)
{
  const Scene_options options = scene_options(keywords);
  Atlas_status status{};
  run_patiently(listener, [&](const auto& progress) { status = scene.pack(options, progress); });
  return word(scene, status);
}

const char* verify(Scene& scene, const py::dict& keywords, bool is_single)
{
  const Scene_options options = scene_options(keywords);
  const py::gil_scoped_release unlocked;
  return word(scene, scene.verify(options, is_single ? Uv_precision::single_precision
                                                     : Uv_precision::double_precision));
}

/// The arrays of a mesh, without copies.
/// \param is_owned  nobody else will see them: they can be changed
py::dict result(const Scene& scene, std::size_t mesh, bool is_owned)
{
  const auto& owner = scene.results();
  if (mesh >= owner->size())
    throw py::index_error("mesh " + std::to_string(mesh) + " has no coordinates");
  const Mesh_result& r = (*owner)[mesh];
  const auto array = [&](const auto& list, py::ssize_t columns) {
    return view(list, owner, columns, is_owned);
  };
  py::dict arrays;
  arrays["corner_uvs"] = array(r.corner_uvs, 2);
  arrays["vmapping"] = array(r.vmapping, 0);
  arrays["uvs"] = array(r.uvs, 2);
  arrays["indices"] = array(r.indices, 0);
  arrays["triangles"] = array(r.triangles, 3);
  arrays["face_of_triangle"] = array(r.face_of_triangle, 0);
  arrays["face_charts"] = array(r.face_charts, 0);
  arrays["face_pages"] = array(r.face_pages, 0);
  arrays["turned_faces"] = array(r.turned_faces, 0);
  return arrays;
}

/// A picture of a page with its charts in colours.
py::array draw(const Scene& scene, std::size_t longer_side, Index page)
{
  internal::require(!scene.results()->empty(), "the scene", "has no coordinates yet");
  std::vector<Index> charts;
  for (const Mesh_result& r : *scene.results())
    charts.insert(charts.end(), r.face_charts.begin(), r.face_charts.end());
  const Image_size size =
      Image_size(scene.summary().width, scene.summary().height).with_longer_side(longer_side);
  return image_array(draw_atlas(scene.textured(), charts, size, {}, page));
}

py::dict summary(const Scene& scene)
{
  const bindings::Scene_summary& s = scene.summary();
  py::dict result;
  result["charts"] = s.charts;
  result["pages"] = s.pages;
  result["width"] = s.width;
  result["height"] = s.height;
  result["texels_per_unit"] = s.density;
  result["efficiency"] = s.efficiency;
  return result;
}

void define_scene(py::module_& m)
{
  py::class_<Scene, std::shared_ptr<Scene>>(m, "Scene")
      .def(py::init<>())
      .def("add", &add_mesh, py::arg("positions"), py::arg("face_sizes"), py::arg("indices"), py::arg("uvs"),
           py::arg("normals"), py::arg("colors"), py::arg("pages"), py::arg("materials"), py::arg("seams"),
           py::arg("forbidden_seams"), py::arg("visibility"), py::arg("selected"), py::arg("pinned"))
      .def("__len__", &Scene::size)
      .def("generate", &generate, py::arg("options"), py::arg("progress"))
      .def("pack", &pack, py::arg("options"), py::arg("progress"))
      .def("verify", &verify, py::arg("options"), py::arg("is_single"))
      .def("report", [](const Scene& scene) { return to_python(scene.report()); })
      .def("summary", &summary)
      .def("result", &result, py::arg("mesh"), py::arg("is_owned"))
      .def("draw", &draw, py::arg("size"), py::arg("page"))
      .def("textured", &Scene::textured)
      .def("welded", [](const Scene& scene) {
        Polygon_soup soup = scene.textured();
        soup.points = scene.welded_points();
        return soup;
      });
}

} // namespace

} // namespace Atlas::python

PYBIND11_MODULE(_native, m)
{
  using namespace Atlas::python;
  m.attr("__version__") = ATLAS_VERSION;
  py::register_exception<Atlas::IO_error>(m, "IOError", PyExc_RuntimeError);
  py::class_<Atlas::Polygon_soup>(m, "Soup")
      .def(py::init(&make_soup), py::arg("positions"), py::arg("face_sizes"), py::arg("indices"),
           py::arg("uvs"), py::arg("normals"), py::arg("colors"), py::arg("pages"))
      .def("set_old_uv",
           [](Atlas::Polygon_soup& soup, const Array<double>& uvs) {
             soup.old_uv = rows<Atlas::Point_2, 2>(uvs, "source_uvs");
           })
      .def("become_source", [](Atlas::Polygon_soup& soup) {
        if (soup.uv.empty())
          soup.uv.assign(soup.number_of_corners(), Atlas::Point_2(NAN, NAN));
        soup.old_uv = soup.uv;
      });
  define_scene(m);
  define_baking(m);
}
