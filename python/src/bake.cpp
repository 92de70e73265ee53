// SPDX-License-Identifier: MIT
// The texels of a page.
#include "bake.h"

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/nearest_texels.h>
#include <Atlas/core/Packing.h>
#ifdef ATLAS_PYTHON_OCCLUSION
#include <Atlas/bake/bake_ambient_occlusion.h>
#endif

#include "arrays.h"
#include <cstring>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace Atlas::python {

namespace {

Image_size size_of(std::size_t width, std::size_t height)
{
  if (width < 1 || height < 1 || width > max_page_side || height > max_page_side)
    throw Invalid_argument("size", "must be from 1 to " + std::to_string(max_page_side));
  return {width, height};
}

py::array bake_colors(const Polygon_soup& soup, std::size_t width, std::size_t height, Index page)
{
  const Image_size size = size_of(width, height);
  Image image;
  {
    const py::gil_scoped_release unlocked;
    image = bake_vertex_colors(soup, size, page);
  }
  return image_array(std::move(image));
}

py::array bake_normal_map(const Polygon_soup& soup, std::size_t width, std::size_t height, Index page,
                          unsigned threads)
{
  const Image_size size = size_of(width, height);
  Image image;
  {
    const py::gil_scoped_release unlocked;
    image = bake_normals(soup, size, page, Execution(threads));
  }
  return image_array(std::move(image));
}

/// \param images        the old textures
/// \param face_texture  per face: which one; `no_index`: none
py::array bake_old_texture(const Polygon_soup& soup, std::size_t width, std::size_t height, Index page,
                           unsigned threads, const std::vector<Array<std::uint8_t>>& images,
                           const Array<Index>& face_texture)
{
  const Image_size size = size_of(width, height);
  Source_textures source;
  for (const auto& image : images)
    source.textures.emplace_back().image = image_of(image, "texture");
  source.face_texture = values<Index>(face_texture, "face_texture");
  for (const Index t : source.face_texture)
    internal::require(t == no_index || t < images.size(), "face_texture",
                      "names a texture that does not exist");
  Image image;
  {
    const py::gil_scoped_release unlocked;
    image = transfer_texture(soup, size, source, page, Execution(threads));
  }
  return image_array(std::move(image));
}

#ifdef ATLAS_PYTHON_OCCLUSION
py::array bake_occlusion(const Polygon_soup& soup, std::size_t width, std::size_t height, Index page,
                         unsigned threads, std::size_t samples)
{
  const Image_size size = size_of(width, height);
  Image image;
  {
    const py::gil_scoped_release unlocked;
    image = bake_ambient_occlusion(soup, size, {.samples = samples}, page, Execution(threads));
  }
  return image_array(std::move(image));
}
#endif

/// What each texel shows: its face or -1, the corners of its triangle, and barycentric weights.
py::tuple sample_page(const Polygon_soup& soup, std::size_t width, std::size_t height, Index page)
{
  const Image_size size = size_of(width, height);
  const auto w = static_cast<py::ssize_t>(width), h = static_cast<py::ssize_t>(height);
  py::array_t<std::int32_t> faces({h, w});
  py::array_t<Index> corners({h, w, py::ssize_t(3)});
  py::array_t<float> weights({h, w, py::ssize_t(3)});
  std::int32_t* face = faces.mutable_data();
  Index* corner = corners.mutable_data();
  float* weight = weights.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    std::fill_n(face, width * height, -1);
    std::fill_n(corner, 3 * width * height, 0);
    std::fill_n(weight, 3 * width * height, 0.f);
    const auto note = [&](const Bake_sample& sample) {
      face[sample.texel] = static_cast<std::int32_t>(sample.face);
      for (std::size_t k = 0; k < 3; ++k) {
        corner[3 * sample.texel + k] = sample.corners[k];
        weight[3 * sample.texel + k] = static_cast<float>(sample.weights[k]);
      }
      return Color();
    };
    (void)bake_texture(soup, size, note, page);
  }
  return py::make_tuple(faces, corners, weights);
}

/// For each texel the nearest one that is covered, as a number from the first on; those there are if there
/// are none.
py::array nearest(const py::array_t<bool, py::array::c_style | py::array::forcecast>& covered)
{
  if (covered.ndim() != 2 || covered.size() == 0)
    throw Invalid_argument("covered", "must be height x width Booleans");
  const auto height = static_cast<std::size_t>(covered.shape(0)),
             width = static_cast<std::size_t>(covered.shape(1));
  const std::vector<bool> is_covered(covered.data(), covered.data() + covered.size());
  const auto result =
      std::make_shared<std::vector<Index>>(internal::nearest_texels(is_covered, width, height));
  for (std::size_t i = 0; i < result->size(); ++i)
    if ((*result)[i] == no_index)
      (*result)[i] = static_cast<Index>(i);
  return view(*result, result, 0, true);
}

} // namespace

void define_baking(py::module_& m)
{
  m.def("bake_colors", &bake_colors);
  m.def("bake_normals", &bake_normal_map);
  m.def("bake_texture", &bake_old_texture);
#ifdef ATLAS_PYTHON_OCCLUSION
  m.def("bake_occlusion", &bake_occlusion);
#endif
  m.def("sample_page", &sample_page);
  m.def("nearest", &nearest);
}

} // namespace Atlas::python
