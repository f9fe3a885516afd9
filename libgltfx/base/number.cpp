// SPDX-License-Identifier: Apache-2.0
#include "base/number.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#ifndef __cpp_lib_to_chars
#include <fast_float/fast_float.h>
#endif

namespace gltfx {
namespace {

#ifndef __cpp_lib_to_chars
// Whether a number is outside the range of a double, as std::from_chars() reports it.
bool is_out_of_range(std::string_view text, double read) {
  text = text.substr(0, text.find_first_of("eE"));
  if (read == 0) return text.find_first_of("123456789") != std::string_view::npos;
  return std::isinf(read) && text.find_first_of("0123456789") != std::string_view::npos;
}
#endif

// A number that is not 0 is 0.d1d2d3... * 10^point.
struct Digits {
  std::string text;
  int point = 0;
};

// The fewest digits that read back as `value`. Precondition: finite and above 0.
Digits shortest_digits(double value) {
  const std::string spelt = fmt::format("{}", value);
  const std::size_t e = spelt.find('e');
  Digits digits;
  if (e != std::string::npos) digits.point = std::stoi(spelt.substr(e + 1));
  const std::string mantissa = spelt.substr(0, e);
  const std::size_t dot = std::min(mantissa.find('.'), mantissa.size());
  digits.point += static_cast<int>(dot);
  digits.text = mantissa.substr(0, dot);
  if (dot < mantissa.size()) digits.text += mantissa.substr(dot + 1);
  const std::size_t zeros = digits.text.find_first_not_of('0');
  digits.text.erase(0, zeros);
  digits.point -= static_cast<int>(zeros);
  digits.text.erase(digits.text.find_last_not_of('0') + 1);
  return digits;
}

}  // namespace

std::from_chars_result read_double(const char* first, const char* last, double& value) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(first, last, value);
#else
  double read = 0;
  const auto [end, error] = fast_float::from_chars(first, last, read);
  if (error != std::errc()) return {end, error};
  const std::string_view text(first, static_cast<std::size_t>(end - first));
  if (is_out_of_range(text, read)) return {end, std::errc::result_out_of_range};
  value = read;
  return {end, error};
#endif
}

std::string number_text(double value) {
  if (std::isnan(value)) return "NaN";
  const std::string sign = std::signbit(value) ? "-" : "";
  if (std::isinf(value)) return sign + "Infinity";
  if (value == 0) return sign + "0";
  auto [text, point] = shortest_digits(std::fabs(value));
  const int count = static_cast<int>(text.size());
  if (point > 21 || point < -5) {
    if (count > 1) text.insert(1, 1, '.');
    return fmt::format("{}{}e{:+}", sign, text, point - 1);
  }
  if (point <= 0) return sign + "0." + std::string(static_cast<std::size_t>(-point), '0') + text;
  if (count <= point)
    return sign + text + std::string(static_cast<std::size_t>(point - count), '0');
  text.insert(static_cast<std::size_t>(point), 1, '.');
  return sign + text;
}

}  // namespace gltfx
