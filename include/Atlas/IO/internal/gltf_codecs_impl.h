// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_CODECS_IMPL_H
#define ATLAS_IO_INTERNAL_GLTF_CODECS_IMPL_H

#include <Atlas/IO/internal/gltf_codecs.h>
#include <Atlas/core/internal/library.h>

#include <cstdint>
#include <cstring>
#include <tiny_gltf.h>

#ifdef ATLAS_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef ATLAS_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif

namespace Atlas::internal {

#ifdef ATLAS_HAS_MESHOPTIMIZER
inline constexpr bool has_meshoptimizer = true;
#else
inline constexpr bool has_meshoptimizer = false;
#endif
#ifdef ATLAS_HAS_DRACO
inline constexpr bool has_draco = true;
#else
inline constexpr bool has_draco = false;
#endif

ATLAS_INLINE const std::vector<Gltf_codec>& gltf_codecs()
{
  static const std::vector<Gltf_codec> codecs{
      {"KHR_draco_mesh_compression", "libdraco", has_draco},
      {"EXT_meshopt_compression", "libmeshoptimizer", has_meshoptimizer},
      {"KHR_meshopt_compression", "libmeshoptimizer", has_meshoptimizer}};
  return codecs;
}

#ifdef ATLAS_HAS_MESHOPTIMIZER

/// What the decoder demands of rows and filters, and a bound on what so many bytes can hold: a block of 256
/// equal bytes takes four.
inline bool is_possible_meshopt(std::size_t bytes, const Meshopt_view& view)
{
  if (view.stride == 0 || view.stride > 256 || view.count > (64 * bytes + 4096) / view.stride)
    return false;
  if (view.mode == "ATTRIBUTES")
    return view.stride % 4 == 0 && (view.filter != "OCTAHEDRAL" || view.stride == 4 || view.stride == 8) &&
           (view.filter != "QUATERNION" || view.stride == 8);
  return (view.stride == 2 || view.stride == 4) && view.filter == "NONE" &&
         (view.mode != "TRIANGLES" || view.count % 3 == 0);
}

ATLAS_INLINE std::optional<std::string> decode_meshopt(std::string_view bytes, const Meshopt_view& view)
{
  if (!is_possible_meshopt(bytes.size(), view))
    return std::nullopt;
  std::string result(view.count * view.stride, '\0');
  void* const rows = result.data();
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  int error = -1;
  if (view.mode == "ATTRIBUTES")
    error = meshopt_decodeVertexBuffer(rows, view.count, view.stride, data, bytes.size());
  else if (view.mode == "TRIANGLES")
    error = meshopt_decodeIndexBuffer(rows, view.count, view.stride, data, bytes.size());
  else if (view.mode == "INDICES")
    error = meshopt_decodeIndexSequence(rows, view.count, view.stride, data, bytes.size());
  if (error != 0)
    return std::nullopt;
  if (view.filter == "OCTAHEDRAL")
    meshopt_decodeFilterOct(rows, view.count, view.stride);
  else if (view.filter == "QUATERNION")
    meshopt_decodeFilterQuat(rows, view.count, view.stride);
  else if (view.filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(rows, view.count, view.stride);
  else if (view.filter != "NONE")
    return std::nullopt;
  return result;
}

#else

ATLAS_INLINE std::optional<std::string> decode_meshopt(std::string_view, const Meshopt_view&)
{
  return std::nullopt;
}

#endif
#ifdef ATLAS_HAS_DRACO

/// All rows of an attribute as numbers of one type.
template <typename Number>
bool append_draco_rows(const draco::PointAttribute& attribute, std::size_t points, std::size_t width,
                       std::string& rows)
{
  std::vector<Number> row(width);
  rows.reserve(points * width * sizeof(Number));
  for (std::uint32_t p = 0; p < points; ++p) {
    if (!attribute.ConvertValue<Number>(attribute.mapped_index(draco::PointIndex(p)),
                                        static_cast<std::int8_t>(width), row.data()))
      return false;
    rows.append(reinterpret_cast<const char*>(row.data()), width * sizeof(Number));
  }
  return true;
}

inline bool append_draco_rows(const draco::PointAttribute& attribute, std::size_t points,
                              const Draco_attribute& wanted, std::string& rows)
{
  switch (wanted.component_type) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return append_draco_rows<std::int8_t>(attribute, points, wanted.width, rows);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return append_draco_rows<std::uint8_t>(attribute, points, wanted.width, rows);
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return append_draco_rows<std::int16_t>(attribute, points, wanted.width, rows);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return append_draco_rows<std::uint16_t>(attribute, points, wanted.width, rows);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return append_draco_rows<std::uint32_t>(attribute, points, wanted.width, rows);
  case TINYGLTF_COMPONENT_TYPE_FLOAT:
    return append_draco_rows<float>(attribute, points, wanted.width, rows);
  }
  return false;
}

ATLAS_INLINE std::optional<Draco_mesh> decode_draco(std::string_view bytes,
                                                    const std::vector<Draco_attribute>& attributes)
{
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok() || !decoded.value())
    return std::nullopt;
  const draco::Mesh& mesh = *decoded.value();
  Draco_mesh result;
  result.points = mesh.num_points();
  result.indices.reserve(12 * std::size_t(mesh.num_faces()));
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(f))) {
      const std::uint32_t index = point.value();
      char raw[sizeof index];
      std::memcpy(raw, &index, sizeof index);
      result.indices.append(raw, sizeof raw);
    }
  for (const Draco_attribute& wanted : attributes) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (!attribute || static_cast<std::size_t>(attribute->num_components()) != wanted.width ||
        !append_draco_rows(*attribute, result.points, wanted, result.attributes.emplace_back()))
      return std::nullopt;
  }
  return result;
}

#else

ATLAS_INLINE std::optional<Draco_mesh> decode_draco(std::string_view, const std::vector<Draco_attribute>&)
{
  return std::nullopt;
}

#endif

} // namespace Atlas::internal

#endif
