// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLB_H
#define ATLAS_IO_INTERNAL_GLB_H

#include <Atlas/image/internal/Binary_scanner.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace Atlas::internal {

inline bool is_glb(std::string_view bytes)
{
  return bytes.starts_with("glTF");
}

/// Four bytes as a number; 0 behind the end.
inline std::size_t glb_number(std::string_view bytes, std::size_t at)
{
  return at + 4 <= bytes.size()
             ? Binary_scanner(bytes, {}, std::endian::little, at).get<std::uint32_t>("a number")
             : 0;
}

/// How long a binary glTF file says that it is.
inline std::size_t glb_size(std::string_view bytes)
{
  return glb_number(bytes, 8);
}

/// The contents of the chunk of a binary glTF file that starts at a place, as far as the file goes.
inline std::string_view glb_chunk(std::string_view bytes, std::size_t at)
{
  if (bytes.size() < 8 || at > bytes.size() - 8)
    return {};
  return bytes.substr(at + 8, glb_number(bytes, at));
}

/// The JSON of a glTF file, which is the file, or the first chunk of a binary one.
inline std::string_view gltf_json(std::string_view bytes)
{
  return is_glb(bytes) ? glb_chunk(bytes, 12) : bytes;
}

/// The bytes beside the JSON of a binary glTF file; empty for others.
inline std::string_view gltf_data(std::string_view bytes)
{
  return is_glb(bytes) ? glb_chunk(bytes, 20 + gltf_json(bytes).size()) : std::string_view();
}

/// A binary glTF file of its JSON and its one buffer.
inline std::string glb_of(std::string json, std::string data)
{
  const auto append_number = [](std::string& text, std::size_t number) {
    for (int shift = 0; shift < 32; shift += 8)
      text += static_cast<char>(static_cast<unsigned char>(number >> shift & 255));
  };
  json.resize((json.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  std::string result = "glTF";
  for (const std::size_t number : {std::size_t(2), 28 + json.size() + data.size(), json.size()})
    append_number(result, number);
  result += "JSON" + json;
  append_number(result, data.size());
  return result + std::string("BIN\0", 4) + data;
}

} // namespace Atlas::internal

#endif
