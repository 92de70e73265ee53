// SPDX-License-Identifier: MIT
// A limit of memory.
#include <Atlas/core/errors.h>

#include "texture_atlas.h"
#include <cstdio>
#include <sys/resource.h>

namespace {

constexpr double gigabyte = 1e9;

/// What the program takes at most, about, in bytes: measured on smooth, rough and branched surfaces of 0.1 to
/// 4 million triangles; doc/large_meshes.md has the figures.
double estimated_memory(const Atlas::Surface& surface)
{
  constexpr double program = 0.1 * gigabyte, per_triangle = 1000;
  return program + per_triangle * static_cast<double>(surface.number_of_triangles());
}

std::string shown(double gigabytes)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", gigabytes);
  return text;
}

} // namespace

void limit_memory(const Options& options)
{
  if (!(options.memory_limit > 0))
    return;
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = static_cast<rlim_t>(options.memory_limit * gigabyte);
  if (limit.rlim_max == RLIM_INFINITY || limit.rlim_cur < limit.rlim_max)
    setrlimit(RLIMIT_DATA, &limit);
}

void check_memory(const Options& options, const Atlas::Surface& surface)
{
  const double estimate = estimated_memory(surface) / gigabyte;
  if (options.memory_limit > 0 && estimate > options.memory_limit)
    throw Atlas::IO_error(options.name() + ": " + std::to_string(surface.number_of_triangles()) +
                          " triangles take about " + shown(estimate) + " GB, more than --memory-limit " +
                          shown(options.memory_limit) + " allows");
}
