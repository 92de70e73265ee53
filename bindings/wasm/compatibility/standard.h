// SPDX-License-Identifier: MIT
// Included before everything else: what emscripten's standard library lacks of C++20, and what Eigen takes
// clang for.
#ifndef ATLAS_WASM_STANDARD_H
#define ATLAS_WASM_STANDARD_H
#ifdef __cplusplus

#include <Eigen/src/Core/util/Macros.h>

#include <bit>
#include <charconv>
#include <cstddef>
#include <memory>
#include <type_traits>

// clang says that it is GCC. Eigen then works around faults of GCC's with assembler for x86.
#undef EIGEN_COMP_GNUC
#define EIGEN_COMP_GNUC 0
#undef EIGEN_GNUC_AT_LEAST
#define EIGEN_GNUC_AT_LEAST(major, minor) 0

namespace std {

#ifndef __cpp_lib_bit_cast
template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept
{
  return __builtin_bit_cast(To, from);
}
#endif

#ifndef __cpp_lib_smart_ptr_for_overwrite
template <typename Array>
unique_ptr<Array> make_unique_for_overwrite(size_t n)
{
  return unique_ptr<Array>(new remove_extent_t<Array>[n]);
}
#endif

#ifndef __cpp_lib_to_chars
from_chars_result from_chars(const char* first, const char* last, double& value);
to_chars_result to_chars(char* first, char* last, float value);
to_chars_result to_chars(char* first, char* last, double value);
#endif

} // namespace std

#endif
#endif
