// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_CODECS_H
#define ATLAS_IO_INTERNAL_GLTF_CODECS_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace Atlas::internal {

/// The library that decodes what a glTF extension compresses, for messages; and whether it is built in.
struct Gltf_codec
{
  const char* extension;
  const char* library;
  bool is_built_in;
};
const std::vector<Gltf_codec>& gltf_codecs();

/// What the extension EXT_meshopt_compression says of a buffer view.
struct Meshopt_view
{
  std::size_t count = 0, stride = 0; ///< rows, and bytes of a row
  std::string mode, filter = "NONE";
};

/// The rows of a buffer view; none if the bytes are broken or the decoder does not know them.
std::optional<std::string> decode_meshopt(std::string_view bytes, const Meshopt_view& view);

/// An attribute of a mesh compressed by Draco, and how its accessor wants it.
struct Draco_attribute
{
  unsigned id;        ///< in the compressed mesh
  int component_type; ///< of glTF
  std::size_t width;  ///< components
};

struct Draco_mesh
{
  std::size_t points = 0;
  std::string indices;                 ///< three a triangle, 32 bits each
  std::vector<std::string> attributes; ///< in the order asked for: rows of components, without gaps
};

/// None if the bytes are broken, or an attribute is not there or of another width.
std::optional<Draco_mesh> decode_draco(std::string_view bytes,
                                       const std::vector<Draco_attribute>& attributes);

} // namespace Atlas::internal

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/IO/internal/gltf_codecs_impl.h>
#endif

#endif
