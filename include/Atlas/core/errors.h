// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_ERRORS_H
#define ATLAS_CORE_ERRORS_H

#include <stdexcept>
#include <string>

namespace Atlas {

/// \brief The caller's fault: an argument that cannot be. Thrown before any work, in every build.
///
/// `what()` is a sentence that begins with the name of the argument.
class Invalid_argument : public std::invalid_argument
{
public:
  /// \param argument  its name, as the caller writes it, such as `texture_size`
  /// \param fault     what is wrong and what it may be, such as "must be at least 1 texel, but is -5"
  Invalid_argument(const std::string& argument, const std::string& fault)
      : std::invalid_argument(argument + " " + fault), argument_(argument)
  {}

  /// The name of the argument.
  const std::string& argument() const { return argument_; }

private:
  std::string argument_;
};

/// \brief A policy broke the contract of its concept: it returned what has the wrong size or cannot be.
///
/// `what()` is a sentence that begins with the policy's role and its type.
class Policy_error : public std::logic_error
{
public:
  /// \param role   what the policy is, such as `packer`
  /// \param type   its type, such as `My_packer`
  /// \param fault  what is wrong, such as "returned 3 placements for 5 charts"
  Policy_error(const std::string& role, const std::string& type, const std::string& fault)
      : std::logic_error("the " + role + " " + type + " " + fault), role_(role), type_(type)
  {}

  /// Which policy it is: "segmentation" and so on.
  const std::string& role() const { return role_; }
  /// The name of its type.
  const std::string& type() const { return type_; }

private:
  std::string role_, type_;
};

/// \brief A file could not be read or written, or the machine has not what is needed for a picture.
///
/// `what()` is one line: the file, the line or byte if there is one, and what is wrong.
class IO_error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

namespace internal {

/// Throws `Invalid_argument` unless the condition holds. For messages that cost nothing to make.
inline void require(bool condition, const char* argument, const char* fault)
{
  if (!condition)
    throw Invalid_argument(argument, fault);
}

} // namespace internal

} // namespace Atlas

#endif
