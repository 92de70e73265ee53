// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_PLY_ROWS_H
#define ATLAS_IO_INTERNAL_PLY_ROWS_H

#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/internal/row_ends.h>
#include <Atlas/image/internal/Binary_scanner.h>
#include <Atlas/image/internal/Text_scanner.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Atlas::internal {

enum class Ply_type { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct Ply_property
{
  std::string name;
  Ply_type type{};
  std::optional<Ply_type> count_type; ///< of a list
};

struct Ply_element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Ply_property> properties;

  /// The place of the first property with one of the names, or -1.
  int find(std::initializer_list<std::string_view> names) const
  {
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (std::find(names.begin(), names.end(), lower_case(properties[i].name)) != names.end())
        return static_cast<int>(i);
    return -1;
  }
};

/// The type that a word in the header names, if it does.
inline std::optional<Ply_type> ply_type(std::string_view word)
{
  static constexpr std::pair<std::string_view, Ply_type> types[] = {
      {"char", Ply_type::int8},      {"int8", Ply_type::int8},       {"uchar", Ply_type::uint8},
      {"uint8", Ply_type::uint8},    {"short", Ply_type::int16},     {"int16", Ply_type::int16},
      {"ushort", Ply_type::uint16},  {"uint16", Ply_type::uint16},   {"int", Ply_type::int32},
      {"int32", Ply_type::int32},    {"uint", Ply_type::uint32},     {"uint32", Ply_type::uint32},
      {"long", Ply_type::int64},     {"int64", Ply_type::int64},     {"ulong", Ply_type::uint64},
      {"uint64", Ply_type::uint64},  {"float", Ply_type::float32},   {"float32", Ply_type::float32},
      {"double", Ply_type::float64}, {"float64", Ply_type::float64}, {"longlong", Ply_type::int64}};
  for (const auto& [name, value] : types)
    if (name == word)
      return value;
  return std::nullopt;
}

/// The rows of a text or binary PLY file as numbers.
class Ply_rows
{
public:
  Ply_rows(std::string_view bytes, std::string file_name, Text_scanner& text,
           std::optional<std::endian> order, Row_ends ends)
      : text_(text), is_text_(!order), has_free_rows_(ends == Row_ends::anywhere),
        binary_(bytes, std::move(file_name), order.value_or(std::endian::little),
                bytes.size() - text.rest().size())
  {}

  /// Starts row `i` of the element; fails if there is none.
  void start_row(const Ply_element& element, std::size_t i)
  {
    if (is_text_ && !has_free_rows_ && !text_.next_filled_line())
      text_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(element.count) +
                 " rows of '" + element.name + "'");
  }

  double value(Ply_type type, const std::string& what)
  {
    if (is_text_) {
      if (has_free_rows_ && text_.at_end())
        text_.next_filled_line();
      return text_.number(what.c_str());
    }
    switch (type) {
    case Ply_type::int8:
      return binary_.get<std::int8_t>(what.c_str());
    case Ply_type::uint8:
      return binary_.get<std::uint8_t>(what.c_str());
    case Ply_type::int16:
      return binary_.get<std::int16_t>(what.c_str());
    case Ply_type::uint16:
      return binary_.get<std::uint16_t>(what.c_str());
    case Ply_type::int32:
      return binary_.get<std::int32_t>(what.c_str());
    case Ply_type::uint32:
      return binary_.get<std::uint32_t>(what.c_str());
    case Ply_type::int64:
      return static_cast<double>(binary_.get<std::int64_t>(what.c_str()));
    case Ply_type::uint64:
      return static_cast<double>(binary_.get<std::uint64_t>(what.c_str()));
    case Ply_type::float32:
      return static_cast<double>(binary_.get<float>(what.c_str()));
    case Ply_type::float64:
      return binary_.get<double>(what.c_str());
    }
    return 0;
  }

  /// The values of a property, one if it is not a list.
  void values(const Ply_property& property, std::vector<double>& result)
  {
    result.clear();
    double n = 1;
    if (property.count_type) {
      n = value(*property.count_type, property.name);
      if (!(n >= 0) || n != std::floor(n))
        fail("the length of list '" + property.name + "' is not a count");
      if (!is_text_ && n > static_cast<double>(binary_.bytes_left()))
        fail("list '" + property.name + "' is longer than the file");
    }
    for (double i = 0; i < n; ++i)
      result.push_back(value(property.type, property.name));
  }

  /// Rows that may end anywhere are taken for what they are only if nothing is left over.
  void check_end()
  {
    if (is_text_ && has_free_rows_ && (!text_.at_end() || text_.next_filled_line()))
      text_.fail("more values than the header tells of");
  }

  [[noreturn]] void fail(const std::string& message) const
  {
    if (is_text_)
      text_.fail(message);
    binary_.fail(message);
  }

private:
  Text_scanner& text_;
  bool is_text_, has_free_rows_;
  Binary_scanner binary_;
};

/// The places of red, green, blue and alpha in the rows of an element; the last may be -1.
struct Ply_colors
{
  std::array<int, 4> at{-1, -1, -1, -1};
  double range = 1; ///< the value of full colour; that of floats is 1 or 255, which only the values tell
  bool is_complete() const { return at[0] >= 0 && at[1] >= 0 && at[2] >= 0; }
};

inline Ply_colors ply_colors(const Ply_element& element)
{
  Ply_colors result;
  result.at = {element.find({"red", "r", "diffuse_red"}), element.find({"green", "g", "diffuse_green"}),
               element.find({"blue", "b", "diffuse_blue"}), element.find({"alpha", "a", "diffuse_alpha"})};
  if (!result.is_complete())
    return result;
  const Ply_type t = element.properties[static_cast<std::size_t>(result.at[0])].type;
  result.range = t == Ply_type::float32 || t == Ply_type::float64 ? 1 : t == Ply_type::uint16 ? 65535 : 255;
  return result;
}

} // namespace Atlas::internal

#endif
