// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_HORIZON_RECTANGLE_PACKER_IMPL_H
#define ATLAS_PACKING_INTERNAL_HORIZON_RECTANGLE_PACKER_IMPL_H

#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/horizon/horizon_layout.h>
#include <Atlas/packing/internal/pages/page_task.h>

namespace Atlas {

ATLAS_INLINE std::optional<Page_layout> Rectangle_packer::lay_out(const Page_task& task,
                                                                  const Execution& execution) const
{
  const internal::Outlines outlines = internal::outlines_of(task);
  return internal::page_layout(
      internal::horizon_layout(outlines, task, internal::Horizon_source::rectangle, execution));
}

ATLAS_INLINE Packing Rectangle_packer::pack(std::span<const Chart> charts, const Page_options& page,
                                            const Execution& execution) const
{
  return Page_packer(*this).pack(charts, page, execution);
}

ATLAS_INLINE std::optional<Page_layout> Row_packer::lay_out(const Page_task& task,
                                                            const Execution& execution) const
{
  const internal::Outlines outlines = internal::outlines_of(task);
  return internal::page_layout(
      internal::horizon_layout(outlines, task, internal::Horizon_source::rows, execution));
}

ATLAS_INLINE Packing Row_packer::pack(std::span<const Chart> charts, const Page_options& page,
                                      const Execution& execution) const
{
  return Page_packer(*this).pack(charts, page, execution);
}

} // namespace Atlas

#endif
