// SPDX-License-Identifier: MIT
// Arrays of numpy to vectors and back.
#ifndef ATLAS_PYTHON_ARRAYS_H
#define ATLAS_PYTHON_ARRAYS_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/Image.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

namespace Atlas::python {

namespace py = pybind11;

template <typename Value>
using Array = py::array_t<Value, py::array::c_style | py::array::forcecast>;
template <typename Value>
using Optional_array = std::optional<Array<Value>>;

/// Refuses an array that is not N x `columns`, or for 0 columns not one-dimensional.
inline void require_shape(const py::array& array, py::ssize_t columns, const char* argument)
{
  const bool is_good = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
  if (!is_good)
    throw Invalid_argument(argument, columns == 0 ? "must be one-dimensional"
                                                  : "must be Nx" + std::to_string(columns) + " numbers");
}

/// The rows of an N x `columns` array, as what two or three numbers make.
template <typename Row, std::size_t columns, typename Value>
std::vector<Row> rows(const Array<Value>& array, const char* argument)
{
  require_shape(array, columns, argument);
  std::vector<Row> result;
  result.reserve(static_cast<std::size_t>(array.shape(0)));
  const Value* x = array.data();
  for (py::ssize_t i = 0; i < array.shape(0); ++i, x += columns)
    result.push_back([&]<std::size_t... k>(std::index_sequence<k...>) {
      return Row{x[k]...};
    }(std::make_index_sequence<columns>()));
  return result;
}

template <typename Value>
std::vector<Value> values(const Array<Value>& array, const char* argument)
{
  require_shape(array, 0, argument);
  return std::vector<Value>(array.data(), array.data() + array.size());
}

/// A view of a vector that keeps its owner alive. No copy.
template <typename Value, typename Owner>
py::array view(const std::vector<Value>& list, const std::shared_ptr<Owner>& owner, py::ssize_t columns,
               bool is_writable)
{
  const auto size = static_cast<py::ssize_t>(list.size());
  std::vector<py::ssize_t> shape{size};
  if (columns > 0)
    shape = {size / columns, columns};
  const py::capsule base(new std::shared_ptr<Owner>(owner),
                         [](void* p) { delete static_cast<std::shared_ptr<Owner>*>(p); });
  py::array_t<Value> result(shape, list.data(), base);
  if (!is_writable)
    result.attr("setflags")(py::arg("write") = false);
  return result;
}

/// A picture as height x width x 3 bytes, the first row on top; x 4 if it has alpha. No copy without alpha.
inline py::array image_array(Image image)
{
  const auto owner = std::make_shared<Image>(std::move(image));
  static_assert(sizeof(Color) == 3);
  const auto height = static_cast<py::ssize_t>(owner->height), width = static_cast<py::ssize_t>(owner->width);
  const py::capsule base(new std::shared_ptr<Image>(owner),
                         [](void* p) { delete static_cast<std::shared_ptr<Image>*>(p); });
  const py::array_t<std::uint8_t> colors({height, width, py::ssize_t(3)},
                                         reinterpret_cast<const std::uint8_t*>(owner->pixels.data()), base);
  if (owner->alpha.empty())
    return colors;
  py::array_t<std::uint8_t> result({height, width, py::ssize_t(4)});
  std::uint8_t* to = result.mutable_data();
  for (std::size_t i = 0; i < owner->pixels.size(); ++i, to += 4) {
    std::copy(owner->pixels[i].begin(), owner->pixels[i].end(), to);
    to[3] = owner->alpha[i];
  }
  return result;
}

/// A picture of 3 or 4 bytes for each pixel; the fourth is alpha.
inline Image image_of(const Array<std::uint8_t>& array, const char* argument)
{
  if (array.ndim() != 3 || (array.shape(2) != 3 && array.shape(2) != 4) || array.size() == 0)
    throw Invalid_argument(argument, "must be height x width x 3 or 4 bytes");
  Image image(static_cast<std::size_t>(array.shape(1)), static_cast<std::size_t>(array.shape(0)));
  const std::uint8_t* from = array.data();
  for (Color& pixel : image.pixels) {
    std::copy_n(from, 3, pixel.begin());
    if (array.shape(2) == 4)
      image.alpha.push_back(from[3]);
    from += array.shape(2);
  }
  return image;
}

} // namespace Atlas::python

#endif
