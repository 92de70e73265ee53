// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_ANY_POLICIES_H
#define ATLAS_CORE_ANY_POLICIES_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/library.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// The name of a type as a programmer writes it.
std::string name_of_type(const std::type_info& type);

/// What an `Any_...` holds: a policy behind an interface, shared by copies, as policies do not change.
template <typename Interface>
class Any_policy
{
public:
  /// The type of the policy inside, in words.
  std::string type_name() const { return name_of_type(*type_); }

protected:
  Any_policy(std::shared_ptr<const Interface> policy, const std::type_info& type)
      : policy_(std::move(policy)), type_(&type)
  {}
  const Interface& policy() const { return *policy_; }

private:
  std::shared_ptr<const Interface> policy_;
  const std::type_info* type_;
};

/// A policy that is taken in by an `Any`.
template <typename Policy, typename Any>
inline constexpr bool is_other = !std::is_base_of_v<Any, std::remove_cvref_t<Policy>>;

struct Segmentation_interface
{
  virtual ~Segmentation_interface() = default;
  virtual Segmentation segment(const Surface&, const Execution&) const = 0;
  virtual std::optional<Distortion_bound> bound() const = 0;
};

struct Parameterizer_interface
{
  virtual ~Parameterizer_interface() = default;
  virtual Chart_status parameterize(Chart&, const Execution&, Flattening_record&) const = 0;
};

struct Optimizer_interface
{
  virtual ~Optimizer_interface() = default;
  virtual Chart_status optimize(Chart&, const Execution&) const = 0;
};

struct Validator_interface
{
  virtual ~Validator_interface() = default;
  virtual Chart_verdict validate(const Chart&, const Execution&) const = 0;
};

struct Splitter_interface
{
  virtual ~Splitter_interface() = default;
  virtual std::vector<Index> split(const Chart&, const Chart_verdict&) const = 0;
};

struct Packer_interface
{
  virtual ~Packer_interface() = default;
  virtual Packing pack(std::span<const Chart>, const Page_options&, const Execution&) const = 0;
};

} // namespace internal

/// \defgroup any_policies Policies of any type
/// \brief Values that hold any model of a concept, and model it themselves.
///
/// The pipeline works on these, so that it is compiled once. What the policy inside returns is checked here:
/// sizes, numbers of charts, finite coordinates and places. What cannot be is a `Policy_error` that names the
/// policy. Copies share the policy.

/// \ingroup any_policies
/// \brief Holds any model of `ChartSegmentation`.
class Any_segmentation : public internal::Any_policy<internal::Segmentation_interface>
{
public:
  /// Holds a policy of any type that models the concept.
  template <ChartSegmentation Policy>
  requires internal::is_other<Policy, Any_segmentation> Any_segmentation(Policy policy)
      : Any_policy(std::make_shared<Model<Policy>>(std::move(policy)), typeid(Policy))
  {}

  /// \throws Policy_error unless each triangle has a chart in [0, number of charts) and each halfedge a cut
  /// or none
  Segmentation segment(const Surface& surface, const Execution& execution) const;
  /// The bound of a `BoundedSegmentation`; nothing for others.
  std::optional<Distortion_bound> bound() const;

private:
  template <typename Policy>
  struct Model final : internal::Segmentation_interface
  {
    explicit Model(Policy p) : policy(std::move(p)) {}
    Segmentation segment(const Surface& surface, const Execution& execution) const override
    {
      return policy.segment(surface, execution);
    }
    std::optional<Distortion_bound> bound() const override
    {
      if constexpr (BoundedSegmentation<Policy>)
        return policy.bound();
      else
        return std::nullopt;
    }
    Policy policy;
  };
};

/// \ingroup any_policies
/// \brief Holds any model of `ChartParameterizer`.
class Any_parameterizer : public internal::Any_policy<internal::Parameterizer_interface>
{
public:
  /// Holds a policy of any type that models the concept.
  template <ChartParameterizer Policy>
  requires internal::is_other<Policy, Any_parameterizer> Any_parameterizer(Policy policy)
      : Any_policy(std::make_shared<Model<Policy>>(std::move(policy)), typeid(Policy))
  {}

  /// Coordinates that are not finite count as `solver_failed`.
  /// \throws Policy_error if the chart is said to be valid and has not one point for each vertex
  Chart_status parameterize(Chart& chart, const Execution& execution) const;
  /// \copydoc parameterize
  /// \param record  what the policy did, if it is a `RecordingParameterizer`; else as by default
  Chart_status parameterize(Chart& chart, const Execution& execution, Flattening_record& record) const;

private:
  template <typename Policy>
  struct Model final : internal::Parameterizer_interface
  {
    explicit Model(Policy p) : policy(std::move(p)) {}
    Chart_status parameterize(Chart& chart, const Execution& execution,
                              Flattening_record& record) const override
    {
      if constexpr (RecordingParameterizer<Policy>)
        return policy.parameterize(chart, execution, record);
      else
        return policy.parameterize(chart, execution);
    }
    Policy policy;
  };
};

/// \ingroup any_policies
/// \brief Holds any model of `UVOptimizer`.
class Any_optimizer : public internal::Any_policy<internal::Optimizer_interface>
{
public:
  /// Holds a policy of any type that models the concept.
  template <UVOptimizer Policy>
  requires internal::is_other<Policy, Any_optimizer> Any_optimizer(Policy policy)
      : Any_policy(std::make_shared<Model<Policy>>(std::move(policy)), typeid(Policy))
  {}

  /// Coordinates that are not finite count as `solver_failed`.
  /// \throws Policy_error if the chart is said to be valid and has not one point for each vertex
  Chart_status optimize(Chart& chart, const Execution& execution) const;

private:
  template <typename Policy>
  struct Model final : internal::Optimizer_interface
  {
    explicit Model(Policy p) : policy(std::move(p)) {}
    Chart_status optimize(Chart& chart, const Execution& execution) const override
    {
      return policy.optimize(chart, execution);
    }
    Policy policy;
  };
};

/// \ingroup any_policies
/// \brief Holds any model of `ChartValidator`.
class Any_validator : public internal::Any_policy<internal::Validator_interface>
{
public:
  /// Holds a policy of any type that models the concept.
  template <ChartValidator Policy>
  requires internal::is_other<Policy, Any_validator> Any_validator(Policy policy)
      : Any_policy(std::make_shared<Model<Policy>>(std::move(policy)), typeid(Policy))
  {}

  /// \throws Policy_error if a culprit is no triangle of the chart
  Chart_verdict validate(const Chart& chart, const Execution& execution) const;

private:
  template <typename Policy>
  struct Model final : internal::Validator_interface
  {
    explicit Model(Policy p) : policy(std::move(p)) {}
    Chart_verdict validate(const Chart& chart, const Execution& execution) const override
    {
      return policy.validate(chart, execution);
    }
    Policy policy;
  };
};

/// \ingroup any_policies
/// \brief Holds any model of `ChartSplitter`.
class Any_splitter : public internal::Any_policy<internal::Splitter_interface>
{
public:
  /// Holds a policy of any type that models the concept.
  template <ChartSplitter Policy>
  requires internal::is_other<Policy, Any_splitter> Any_splitter(Policy policy)
      : Any_policy(std::make_shared<Model<Policy>>(std::move(policy)), typeid(Policy))
  {}

  /// \throws Policy_error unless each triangle has a part number less than the number of triangles
  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const;

private:
  template <typename Policy>
  struct Model final : internal::Splitter_interface
  {
    explicit Model(Policy p) : policy(std::move(p)) {}
    std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const override
    {
      return policy.split(chart, verdict);
    }
    Policy policy;
  };
};

/// \ingroup any_policies
/// \brief Holds any model of `ChartPacker`.
class Any_packer : public internal::Any_policy<internal::Packer_interface>
{
public:
  /// Holds a policy of any type that models the concept.
  template <ChartPacker Policy>
  requires internal::is_other<Policy, Any_packer> Any_packer(Policy policy)
      : Any_policy(std::make_shared<Model<Policy>>(std::move(policy)), typeid(Policy))
  {}

  /// \throws Policy_error unless there is no page at all, or each chart has a finite place on one of the
  /// pages
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;

private:
  template <typename Policy>
  struct Model final : internal::Packer_interface
  {
    explicit Model(Policy p) : policy(std::move(p)) {}
    Packing pack(std::span<const Chart> charts, const Page_options& page,
                 const Execution& execution) const override
    {
      return policy.pack(charts, page, execution);
    }
    Policy policy;
  };
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/Any_policies_impl.h>
#endif

#endif
