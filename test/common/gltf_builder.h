// SPDX-License-Identifier: MIT
// glTF files for tests.
#ifndef ATLAS_TEST_GLTF_BUILDER_H
#define ATLAS_TEST_GLTF_BUILDER_H

#include <Atlas/image/internal/base64.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace Atlas::test {

/// A glTF file in the making.
struct Builder
{
  using Json = nlohmann::json;
  Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  std::string data;

  template <typename Number>
  std::size_t add(const std::vector<Number>& values, std::size_t width, int component, const char* type)
  {
    data.resize((data.size() + 3) / 4 * 4, '\0');
    const std::size_t size = values.size() * sizeof(Number);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", size}});
    data.append(reinterpret_cast<const char*>(values.data()), size);
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"count", values.size() / width},
                                 {"type", type}});
    return json["accessors"].size() - 1;
  }

  std::string text()
  {
    json["buffers"] = {{{"byteLength", data.size()},
                        {"uri", "data:application/octet-stream;base64," + internal::base64(data)}}};
    return json.dump();
  }
};

} // namespace Atlas::test

#endif
