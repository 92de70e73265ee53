// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_STAGE_H
#define ATLAS_CORE_STAGE_H

namespace Atlas {

/// The stages of the pipeline, in the order in which they run.
enum class Stage { segmentation, parameterization, packing, verification };

/// All stages, for loops over them.
inline constexpr Stage all_stages[] = {Stage::segmentation, Stage::parameterization, Stage::packing,
                                       Stage::verification};

/// The name of a stage.
inline const char* name(Stage stage)
{
  switch (stage) {
  case Stage::segmentation:
    return "segmentation";
  case Stage::parameterization:
    return "parameterization";
  case Stage::packing:
    return "packing";
  case Stage::verification:
    return "verification";
  }
  return "unknown";
}

} // namespace Atlas

#endif
