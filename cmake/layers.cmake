# SPDX-License-Identifier: MIT
# The rooms of include/Atlas in their one order: a header may include headers of its own room and of those before it.
# `front` stands for the headers that lie in include/Atlas itself, the front doors.
set(ATLAS_LAYERS core planar measure validation segmentation parameterization packing pipeline front soup image IO bake
                 report)
# The rooms that need nothing but CGAL's LGPL part, Boost and Eigen (and TBB, if it is there).
set(ATLAS_CORE_LAYERS core planar measure validation segmentation parameterization packing pipeline front)
