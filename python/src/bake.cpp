// SPDX-License-Identifier: MIT
// The texels of a page.
#include "bake.h"

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/heights.h>
#include <Atlas/bake/internal/nearest_texels.h>
#include <Atlas/core/Packing.h>
#ifdef ATLAS_PYTHON_OCCLUSION
#include <Atlas/bake/bake_ambient_occlusion.h>
#endif

#include "arrays.h"
#include <cstring>
#include <functional>
#include <memory>
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

/// The old textures.
/// \param face_texture  per face: which one; `no_index`: none
Source_textures source_textures(const std::vector<Array<std::uint8_t>>& images,
                                const Array<Index>& face_texture)
{
  Source_textures source;
  for (const auto& image : images)
    source.textures.emplace_back().image = image_of(image, "texture");
  source.face_texture = values<Index>(face_texture, "face_texture");
  for (const Index t : source.face_texture)
    internal::require(t == no_index || t < images.size(), "face_texture",
                      "names a texture that does not exist");
  return source;
}

Bake_shader color_of(Bake_normal normal)
{
  return [normal = std::move(normal)](const Bake_sample& sample) { return color_of_normal(normal(sample)); };
}

/// \brief What a page shows of a mesh, or of another mesh at the same places.
class Page_baker
{
public:
  /// \param detail  the other mesh; null: the mesh itself. Meshes and textures must outlive the baker
  Page_baker(const Polygon_soup& soup, const Polygon_soup* detail, [[maybe_unused]] double cage,
             Source_textures source)
      : soup_(soup), shown_(detail ? *detail : soup), source_(std::move(source))
  {
    if (!detail)
      return;
#ifdef ATLAS_PYTHON_OCCLUSION
    place_ = place_on(soup, *detail, cage);
#else
    throw Invalid_argument("source", "needs a build with a part of CGAL that is under the GPL");
#endif
  }

  Image bake(const std::string& what, Image_size size, Index page, std::size_t samples,
             const Execution& execution) const
  {
    if (what == "texture" && !place_) // with alpha
      return transfer_texture(soup_, size, source_, page, execution);
    return bake_texture(soup_, size, shader(what, size, samples), page, execution);
  }

  /// How far the other mesh is along the normals.
  std::vector<float> heights(Image_size size, Index page, const Execution& execution) const
  {
    internal::require(place_ != nullptr, "source", "is needed: displacement is measured to another mesh");
    return internal::heights_of_page(soup_, shown_, place_, size, page, execution);
  }

private:
  using Place = std::function<Bake_sample(const Bake_sample&)>;

  Bake_shader shader(const std::string& what, Image_size size, std::size_t samples) const
  {
    if (what == "tangent-normals")
      return color_of(in_tangent_space(soup_, at_place(shading_normal(shown_))));
    return at_place(shader_of_shown(what, size, samples));
  }

  Bake_shader shader_of_shown(const std::string& what, Image_size size,
                              [[maybe_unused]] std::size_t samples) const
  {
    if (what == "colors")
      return vertex_color_shader(shown_);
    if (what == "normals")
      return color_of(shading_normal(shown_));
    if (what == "texture")
      return texture_shader(shown_, size, source_);
#ifdef ATLAS_PYTHON_OCCLUSION
    if (what == "occlusion")
      return occlusion_shader(shown_, {.samples = samples});
#endif
    throw Invalid_argument("what", "is '" + what + "', which this build does not know");
  }

  template <typename Function>
  Function at_place(Function function) const
  {
    if (!place_)
      return function;
    return [place = place_, function](const Bake_sample& sample) { return function(place(sample)); };
  }

  const Polygon_soup &soup_, &shown_;
  Source_textures source_;
  Place place_; ///< on the other mesh; empty: there is none
};

/// \param detail  the mesh that is shown; null: the soup itself. The textures are its
py::array bake(Polygon_soup& soup, const std::string& what, std::size_t width, std::size_t height, Index page,
               unsigned threads, std::size_t samples, const std::vector<Array<std::uint8_t>>& images,
               const Array<Index>& face_texture, const Polygon_soup* detail, double cage)
{
  const Image_size size = size_of(width, height);
  Source_textures source;
  if (what == "texture")
    source = source_textures(images, face_texture);
  Image image;
  if (what == "displacement") {
    const auto heights = std::make_shared<std::vector<float>>();
    {
      const py::gil_scoped_release unlocked;
      *heights = Page_baker(soup, detail, cage, {}).heights(size, page, Execution(threads));
    }
    return view(*heights, heights, static_cast<py::ssize_t>(width), true);
  }
  {
    const py::gil_scoped_release unlocked;
    if (what == "tangent-normals")
      add_normals(soup);
    const Page_baker baker(soup, detail, cage, std::move(source));
    image = baker.bake(what, size, page, samples, Execution(threads));
  }
  return image_array(std::move(image));
}

/// The pages whose seams have been closed, and what the two sides of seams differed in before and after.
py::tuple close_seams(Polygon_soup& soup, const std::vector<Array<std::uint8_t>>& pages, bool are_tangent,
                      unsigned threads)
{
  std::vector<Image> images;
  for (const auto& page : pages)
    images.push_back(image_of(page, "images"));
  const Texel_meaning meaning = are_tangent ? Texel_meaning::tangent_normals : Texel_meaning::colors;
  Seam_difference before, after;
  {
    const py::gil_scoped_release unlocked;
    if (are_tangent)
      add_normals(soup);
    before = seam_difference(soup, images, meaning);
    after = make_seamless(soup, images, meaning, Execution(threads));
  }
  py::list result;
  for (Image& image : images)
    result.append(image_array(std::move(image)));
  return py::make_tuple(result, after.seams, before.largest, after.largest);
}

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
#ifdef ATLAS_PYTHON_OCCLUSION
  m.attr("has_occlusion") = true;
#else
  m.attr("has_occlusion") = false;
#endif
  m.def("bake", &bake);
  m.def("make_seamless", &close_seams);
  m.def("sample_page", &sample_page);
  m.def("nearest", &nearest);
}

} // namespace Atlas::python
