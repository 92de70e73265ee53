// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_BOUNDS_H
#define ATLAS_IO_INTERNAL_GLTF_BOUNDS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>
#include <utility>

namespace Atlas::internal {

/// The least and the largest of numbers of one type, component by component, as `min` and `max` of an
/// accessor.
template <typename Number>
void set_bounds_of(nlohmann::ordered_json& accessor, const std::string& rows, std::size_t components)
{
  nlohmann::ordered_json least, largest;
  for (std::size_t k = 0; k < components; ++k) {
    Number low{}, high{};
    for (std::size_t at = k * sizeof(Number); at + sizeof(Number) <= rows.size();
         at += components * sizeof(Number)) {
      Number value;
      std::memcpy(&value, &rows[at], sizeof value);
      const bool is_first = at == k * sizeof(Number);
      low = is_first ? value : std::min(low, value);
      high = is_first ? value : std::max(high, value);
    }
    least.push_back(low);
    largest.push_back(high);
  }
  accessor["min"] = std::move(least);
  accessor["max"] = std::move(largest);
}

/// Gives an accessor that tells the bounds of its numbers those that they have now: compression has changed
/// them a little.
inline void renew_bounds(nlohmann::ordered_json& accessor, const std::string& rows, std::size_t components)
{
  if (!accessor.contains("min") && !accessor.contains("max"))
    return;
  switch (accessor.at("componentType").get<int>()) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return set_bounds_of<std::int8_t>(accessor, rows, components);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return set_bounds_of<std::uint8_t>(accessor, rows, components);
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return set_bounds_of<std::int16_t>(accessor, rows, components);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return set_bounds_of<std::uint16_t>(accessor, rows, components);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return set_bounds_of<std::uint32_t>(accessor, rows, components);
  case TINYGLTF_COMPONENT_TYPE_FLOAT:
    return set_bounds_of<float>(accessor, rows, components);
  }
}

} // namespace Atlas::internal

#endif
