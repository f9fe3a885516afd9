// SPDX-License-Identifier: Apache-2.0
#include "schema/meant.hpp"

#include <algorithm>
#include <vector>

#include "json/parse.hpp"

namespace gltfx::schema {
namespace {

constexpr std::size_t kLongestNumber = 40;

bool is_number(std::string_view text) {
  if (text.empty() || text.size() > kLongestNumber) return false;
  const json::Parsed parsed = json::parse(share_text(std::string(text)));
  const json::Document& document = parsed.document;
  return parsed.errors.empty() && !document.empty() && document.is_number(document.root());
}

bool is_integer(std::string_view literal) {
  return json::parse(share_text(std::string(literal))).document.number(0).is_integer();
}

// The comma of "1,500" may be a decimal one or group thousands.
bool may_group_thousands(std::string_view whole, std::string_view fraction) {
  return fraction.size() == 3 && whole.size() <= 3 && whole.front() != '0';
}

bool are_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

std::string meant_by_text(const Shape& shape, const std::string& text) {
  const bool real = (shape.types & kNumber) != 0;
  if (real || (shape.types & kInteger) != 0) {
    std::string number = spelt_number(text);
    if (!number.empty() && (real || is_integer(number))) return number;
  }
  const bool flag = (shape.types & kBoolean) != 0 && (text == "true" || text == "false");
  return flag ? text : std::string();
}

bool accepts(const Set& set, const Shape& shape, std::string_view text) {
  const auto equal = [&](const Literal& literal) {
    return literal.kind == Literal::Kind::string && literal.string == text;
  };
  const bool listed =
      shape.literals.empty() || std::any_of(shape.literals.begin(), shape.literals.end(), equal);
  return listed && (shape.pattern == kNone || set.matches(shape.pattern, text));
}

// The number 2 for a version means "2.0".
std::string meant_text(const Set& set, const Shape& shape, const std::string& number) {
  for (const std::string& text : {number, number + ".0"}) {
    if (accepts(set, shape, text)) return '"' + text + '"';
    if (!are_digits(number)) break;
  }
  return {};
}

}  // namespace

std::string spelt_number(std::string_view text) {
  std::string number(text.substr(0, kLongestNumber + 1));
  const std::size_t comma = number.find(',');
  if (comma != number.npos) {
    const std::string_view sign = number.starts_with('-') ? "-" : "";
    const std::string whole = number.substr(sign.size(), comma - sign.size());
    const std::string fraction = number.substr(comma + 1);
    if (!are_digits(whole) || !are_digits(fraction) || may_group_thousands(whole, fraction)) {
      return {};
    }
    number[comma] = '.';
  }
  return is_number(number) ? number : std::string();
}

std::string with_decimal_points(const json::Document& document, json::NodeId numbers,
                                const Shape& shape) {
  constexpr std::uint64_t kMostNumbers = 64;
  if (document.kind(numbers) != json::Kind::number_array) return {};
  if (shape.max_items > kMostNumbers || document.array_size(numbers) > 2 * shape.max_items) {
    return {};
  }
  const std::uint32_t begin = document.span(numbers).begin;
  std::string text(document.raw(numbers));
  std::uint64_t count = 0;
  bool fraction = false;  // whether the previous number is one
  Span before;
  std::vector<std::uint32_t> commas;
  for (json::NumberCursor at(document, numbers); at.valid(); at.advance()) {
    const Span span = at.number().span;
    const std::string_view literal = span.in(document.text());
    const bool joined = !before.empty() && span.begin == before.end + 1;
    if (joined && (fraction || !are_digits(literal))) return {};
    if (!are_digits(literal.substr(literal.starts_with('-') ? 1 : 0))) return {};
    if (joined) {
      commas.push_back(before.end - begin);
    } else {
      ++count;
    }
    fraction = joined;
    before = span;
  }
  if (commas.empty() || count < shape.min_items || count > shape.max_items) return {};
  for (const std::uint32_t comma : commas) text[comma] = '.';
  return text;
}

std::string meant_value(const Set& set, const Values& values, const Shape& shape, Value value) {
  const json::Kind kind = values.kind(value);
  if (kind == json::Kind::string) {
    return meant_by_text(shape, values.document.string(value.node));
  }
  if (kind != json::Kind::number) return {};
  const double number = values.number(value).value;
  const std::string raw(values.raw(value));
  if (raw.size() > kLongestNumber) return {};
  if (shape.types == kBoolean) {
    return number == 0 ? "false" : number == 1 ? "true" : "";
  }
  const bool index = shape.type != kNone && values.has_type(value, kInteger) &&
                     set.find_property(shape.type, "index") != nullptr;
  if (index) return "{ \"index\": " + raw + " }";
  return shape.types == kString ? meant_text(set, shape, raw) : std::string();
}

}  // namespace gltfx::schema
