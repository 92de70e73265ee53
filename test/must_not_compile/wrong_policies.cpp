// SPDX-License-Identifier: MIT
// Must not compile: each policy is of the wrong kind, and the compiler has to say so with the concept's name.
#include <Atlas/generate_atlas.h>

struct Not_a_policy
{};

template <typename NamedParameters>
void run(const NamedParameters& np)
{
  std::vector<Atlas::Point_2> uv;
  (void)Atlas::generate_atlas(Atlas::Surface(), uv, np);
}

int main()
{
  run(Atlas::parameters::segmentation(Not_a_policy()));
  run(Atlas::parameters::parameterizer(Not_a_policy()));
  run(Atlas::parameters::optimizer(Not_a_policy()));
  run(Atlas::parameters::validator(Not_a_policy()));
  run(Atlas::parameters::splitter(Not_a_policy()));
  run(Atlas::parameters::packer(Not_a_policy()));
}
