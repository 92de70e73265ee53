// SPDX-License-Identifier: MIT
// Numbers to text and back, where the standard library cannot do it.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

#ifndef __cpp_lib_to_chars
namespace {

bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

const char* after_digits(const char* p, const char* last)
{
  return std::find_if_not(p, last, is_digit);
}

/// Where the decimal number ends that starts here; `first` if there is none. No blanks, no plus sign, no
/// hexadecimal.
const char* end_of_number(const char* first, const char* last)
{
  const char* const digits = first != last && *first == '-' ? first + 1 : first;
  const char* p = after_digits(digits, last);
  bool has_digits = p != digits;
  if (p != last && *p == '.') {
    const char* const end = after_digits(p + 1, last);
    has_digits = has_digits || end != p + 1;
    p = end;
  }
  if (!has_digits)
    return first;
  if (p != last && (*p == 'e' || *p == 'E')) {
    const char* exponent = p + 1;
    if (exponent != last && (*exponent == '-' || *exponent == '+'))
      ++exponent;
    const char* const end = after_digits(exponent, last);
    if (end != exponent)
      p = end;
  }
  return p;
}

/// The end of `inf`, `infinity` or `nan`, in any case; `first` if none of them is here.
const char* end_of_word(const char* first, const char* last)
{
  const char* const letters = first != last && *first == '-' ? first + 1 : first;
  for (const char* word : {"infinity", "inf", "nan"}) {
    const std::size_t n = std::strlen(word);
    if (static_cast<std::size_t>(last - letters) >= n &&
        std::equal(word, word + n, letters, [](char a, char b) { return a == (b | 0x20); }))
      return letters + n;
  }
  return first;
}

/// A number of at most 15 digits and a small exponent is one rounding away from two numbers that are exact.
/// The general way of this C library is ten times slower. \return whether it is such a number
bool read_short(const char* first, const char* last, double& value)
{
  static constexpr double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const bool is_negative = *first == '-';
  std::int64_t digits = 0;
  int number = 0, exponent = 0;
  bool is_behind_point = false;
  const char* p = first + is_negative;
  for (; p != last && (is_digit(*p) || *p == '.'); ++p) {
    if (*p == '.') {
      is_behind_point = true;
      continue;
    }
    digits = 10 * digits + (*p - '0');
    exponent -= is_behind_point;
    if (digits != 0 && ++number > 15)
      return false;
  }
  if (p != last) {
    int written = 0;
    p += p[1] == '+' ? 2 : 1;
    if (std::from_chars(p, last, written).ec != std::errc() || std::abs(written) > 1000)
      return false;
    exponent += written;
  }
  if (std::abs(exponent) > 22)
    return false;
  const double size = exponent < 0 ? double(digits) / powers[-exponent] : double(digits) * powers[exponent];
  value = is_negative ? -size : size;
  return true;
}

/// With so few digits every decimal number comes back from the type as it was; with `most`, every number of
/// the type does.
template <typename Number, typename Parse>
std::to_chars_result shortest(char* first, char* last, Number value, int few, int most, Parse parse)
{
  char text[40];
  int n = 0;
  for (int digits = few; digits <= most; ++digits) {
    n = std::snprintf(text, sizeof text, "%.*g", digits, double(value));
    if (parse(text) == value)
      break;
  }
  if (last - first < n)
    return {last, std::errc::value_too_large};
  return {std::copy(text, text + n, first), std::errc()};
}

} // namespace

namespace std {

from_chars_result from_chars(const char* first, const char* last, double& value)
{
  const char* end = end_of_number(first, last);
  if (end != first && read_short(first, end, value))
    return {end, errc()};
  if (end == first)
    end = end_of_word(first, last);
  if (end == first)
    return {first, errc::invalid_argument};
  const string text(first, end);
  const double number = strtod(text.c_str(), nullptr);
  const bool is_word = text.find_first_of("nN") != string::npos;
  const bool has_value = text.find_first_of("123456789") < text.find_first_of("eE");
  if (!is_word && (isinf(number) || (number == 0 && has_value)))
    return {end, errc::result_out_of_range};
  value = number;
  return {end, errc()};
}

to_chars_result to_chars(char* first, char* last, float value)
{
  return shortest(first, last, value, std::numeric_limits<float>::digits10, 9,
                  [](const char* text) { return strtof(text, nullptr); });
}

to_chars_result to_chars(char* first, char* last, double value)
{
  return shortest(first, last, value, std::numeric_limits<double>::digits10, 17,
                  [](const char* text) { return strtod(text, nullptr); });
}

} // namespace std
#endif
