// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_NUMBERS_H
#define ATLAS_IO_INTERNAL_GLTF_NUMBERS_H

#include <Atlas/core/errors.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief What the accessors of a glTF model hold.
class Gltf_numbers
{
public:
  /// \param model  must outlive the reader of its numbers
  Gltf_numbers(const tinygltf::Model& model, std::string file_name)
      : model_(model), name_(std::move(file_name))
  {}

  [[noreturn]] void fail(const std::string& message) const { throw IO_error(name_ + ": " + message); }

  /// An item of one of the model's lists; fails if it does not exist.
  template <typename Item>
  const Item& item(const std::vector<Item>& items, int i, const char* what) const
  {
    if (i < 0 || static_cast<std::size_t>(i) >= items.size())
      fail(std::string("refers to ") + what + " " + std::to_string(i) + ", which does not exist");
    return items[static_cast<std::size_t>(i)];
  }

  /// The numbers of an accessor, normalised if it says so, sparse substitutions included.
  std::vector<double> of(int accessor_index, std::size_t width) const
  {
    const tinygltf::Accessor& accessor = item(model_.accessors, accessor_index, "accessor");
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
        static_cast<int>(width))
      fail("accessor " + std::to_string(accessor_index) + " has the wrong type");
    std::vector<double> result;
    if (accessor.bufferView >= 0)
      result = view_numbers(accessor.bufferView, accessor.byteOffset, accessor.count, width,
                            accessor.componentType, accessor.normalized, true);
    else if (accessor.count <= total_bytes())
      result.assign(accessor.count * width, 0);
    else
      fail("accessor " + std::to_string(accessor_index) + " is longer than the file");
    if (accessor.sparse.isSparse)
      substitute(accessor, width, result);
    return result;
  }

  /// The bytes of an accessor, row by row without gaps, sparse substitutions included.
  std::string rows(int accessor_index) const
  {
    const tinygltf::Accessor& accessor = item(model_.accessors, accessor_index, "accessor");
    const auto width = static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) *
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    if (accessor.bufferView < 0 && accessor.count > total_bytes())
      fail("accessor " + std::to_string(accessor_index) + " is longer than the file");
    std::string result(accessor.count * width, '\0');
    const auto copy = [&](int view, std::size_t offset, std::size_t count, bool may_have_stride, auto place) {
      const auto [begin, stride] = view_rows(view, offset, count, width, may_have_stride);
      for (std::size_t i = 0; i < count; ++i)
        std::memcpy(&result[place(i) * width], begin + i * stride, width);
    };
    if (accessor.bufferView >= 0)
      copy(accessor.bufferView, accessor.byteOffset, accessor.count, true, [](std::size_t i) { return i; });
    if (accessor.sparse.isSparse) {
      const auto& sparse = accessor.sparse;
      const auto n = static_cast<std::size_t>(std::max(sparse.count, 0));
      const auto where =
          view_numbers(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), n, 1,
                       sparse.indices.componentType, false, false);
      for (const double i : where)
        if (!(i >= 0 && i < static_cast<double>(accessor.count)))
          fail("a sparse accessor replaces what does not exist");
      copy(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), n, false,
           [&](std::size_t i) { return static_cast<std::size_t>(where[i]); });
    }
    return result;
  }

private:
  void substitute(const tinygltf::Accessor& accessor, std::size_t width, std::vector<double>& result) const
  {
    const auto& sparse = accessor.sparse;
    const auto n = static_cast<std::size_t>(std::max(sparse.count, 0));
    const auto where =
        view_numbers(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), n, 1,
                     sparse.indices.componentType, false, false);
    const auto what =
        view_numbers(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), n, width,
                     accessor.componentType, accessor.normalized, false);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(where[i] >= 0 && where[i] < static_cast<double>(result.size() / width)))
        fail("a sparse accessor replaces what does not exist");
      const auto at = static_cast<std::size_t>(where[i]) * width;
      std::copy_n(what.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                  result.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }

  std::size_t total_bytes() const
  {
    std::size_t sum = 0;
    for (const auto& buffer : model_.buffers)
      sum += buffer.data.size();
    return sum;
  }

  /// Where rows of so many bytes start in a view, and how far they are apart; fails if it is too short.
  std::pair<const unsigned char*, std::size_t> view_rows(int view_index, std::size_t offset,
                                                         std::size_t count, std::size_t tight,
                                                         bool may_have_stride) const
  {
    const tinygltf::BufferView& view = item(model_.bufferViews, view_index, "buffer view");
    const tinygltf::Buffer& buffer = item(model_.buffers, view.buffer, "buffer");
    const std::size_t stride = may_have_stride && view.byteStride > 0 ? view.byteStride : tight;
    const std::size_t bytes = buffer.data.size();
    if (view.byteOffset > bytes || view.byteLength > bytes - view.byteOffset || count > bytes ||
        offset > view.byteLength || (count > 0 && (count - 1) * stride + tight > view.byteLength - offset))
      fail("buffer view " + std::to_string(view_index) + " is too short for what is to be read from it");
    return {buffer.data.data() + view.byteOffset + offset, stride};
  }

  std::vector<double> view_numbers(int view_index, std::size_t offset, std::size_t count, std::size_t width,
                                   int type, bool is_normalized, bool may_have_stride) const
  {
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    if (size <= 0)
      fail("unknown component type " + std::to_string(type));
    const auto [begin, stride] =
        view_rows(view_index, offset, count, width * static_cast<std::size_t>(size), may_have_stride);
    std::vector<double> result;
    result.reserve(count * width);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < width; ++k)
        result.push_back(
            component(begin + i * stride + k * static_cast<std::size_t>(size), type, is_normalized));
    return result;
  }

  template <typename Number>
  static Number load(const unsigned char* p)
  {
    Number value;
    std::memcpy(&value, p, sizeof value);
    return value;
  }

  double component(const unsigned char* p, int type, bool is_normalized) const
  {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return is_normalized ? std::max(load<std::int8_t>(p) / 127.0, -1.0) : load<std::int8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return is_normalized ? load<std::uint8_t>(p) / 255.0 : load<std::uint8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return is_normalized ? std::max(load<std::int16_t>(p) / 32767.0, -1.0) : load<std::int16_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return is_normalized ? load<std::uint16_t>(p) / 65535.0 : load<std::uint16_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(p);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return static_cast<double>(load<float>(p));
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return load<double>(p);
    }
    fail("unknown component type " + std::to_string(type));
  }

  const tinygltf::Model& model_;
  std::string name_;
};

} // namespace Atlas::internal

#endif
