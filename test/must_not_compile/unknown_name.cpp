// SPDX-License-Identifier: MIT
// Must not compile: the function would ignore the name, and the compiler has to say so in one line.
#include <Atlas/generate_atlas.h>

int main()
{
  std::vector<Atlas::Point_2> uv;
  (void)Atlas::generate_atlas(Atlas::Surface(), uv, CGAL::parameters::verbose(true));
}
