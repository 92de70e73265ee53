// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_AVX2_H
#define ATLAS_CORE_INTERNAL_AVX2_H

#if defined(__GNUC__) && defined(__x86_64__)
#define ATLAS_HAS_AVX2_KERNELS
#include <immintrin.h>

namespace Atlas::internal {

/// Programs compiled for any x86-64 would else use half of the width that every processor since 2013 has, and
/// no fused multiplications.
inline bool has_avx2()
{
  static const bool result = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return result;
}

} // namespace Atlas::internal

#endif

#endif
