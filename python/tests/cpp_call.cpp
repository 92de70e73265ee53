// SPDX-License-Identifier: MIT
// The C++ call that overhead.py compares with: `cpp_call MESH RUNS` prints the least seconds of
// `build_surface()` and `generate_atlas()`, on one thread. MESH has two 64-bit counts, positions as doubles,
// and indices of triangles.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

int main(int argc, char** argv)
{
  if (argc != 3)
    return 2;
  std::ifstream file(argv[1], std::ios::binary);
  const auto read = [&](auto& list) {
    file.read(reinterpret_cast<char*>(list.data()),
              static_cast<std::streamsize>(list.size() * sizeof list[0]));
  };
  std::vector<std::uint64_t> counts(2);
  read(counts);
  std::vector<double> positions(3 * counts[0]);
  std::vector<Atlas::Index> indices(3 * counts[1]);
  read(positions);
  read(indices);
  if (!file)
    return 2;
  std::vector<Atlas::Point_3> points;
  for (std::size_t i = 0; i < positions.size(); i += 3)
    points.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i <= indices.size(); i += 3)
    first.push_back(i);

  double least = 1e9;
  for (int run = std::atoi(argv[2]); run > 0; --run) {
    const auto begin = std::chrono::steady_clock::now();
    const Atlas::Surface surface = Atlas::build_surface(points, first, indices);
    std::vector<Atlas::Point_2> uv;
    const Atlas::Atlas_report report =
        Atlas::generate_atlas(surface, uv, Atlas::parameters::number_of_threads(1));
    if (!report.is_valid())
      return 1;
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::printf("%.9f\n", least);
  return 0;
}
