// SPDX-License-Identifier: Apache-2.0
#include "value.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace gltfx::ground_truth {

const Value* Value::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == key) return &items[i];
  }
  return nullptr;
}

const Value* Inputs::find(const std::string& key) {
  read_.insert(key);
  return object_->find(key);
}

double Inputs::number(const std::string& key, double otherwise) {
  const Value* value = find(key);
  if (value == nullptr || value->kind == Value::Kind::null) return otherwise;
  return value->number;
}

Rgb Inputs::color(const std::string& key, const Rgb& otherwise) {
  const Value* value = find(key);
  if (value == nullptr) return otherwise;
  if (value->items.size() < 3) return Rgb(value->number);
  return {value->items[0].number, value->items[1].number, value->items[2].number};
}

std::vector<double> Inputs::numbers(const std::string& key, const std::vector<double>& otherwise) {
  const Value* value = find(key);
  if (value == nullptr || value->kind != Value::Kind::list) return otherwise;
  std::vector<double> numbers;
  for (const Value& item : value->items) numbers.push_back(item.number);
  return numbers;
}

std::string Inputs::text(const std::string& key) {
  const Value* value = find(key);
  return value == nullptr ? "" : value->text;
}

Inputs Inputs::object(const std::string& key) {
  static const Value kNone;
  const Value* value = find(key);
  return Inputs(value == nullptr ? kNone : *value, path_ + key + ".");
}

void Inputs::absorb(const Inputs& inner) {
  for (const std::string& key : inner.unread()) unread_below_.push_back(key);
}

std::vector<std::string> Inputs::unread() const {
  std::vector<std::string> unread = unread_below_;
  for (const std::string& key : object_->keys) {
    if (read_.count(key) == 0) unread.push_back(path_ + key);
  }
  return unread;
}

Value for_each_key(const Value& expected, const OfKey& of_key) {
  Value object;
  object.kind = Value::Kind::object;
  for (std::size_t i = 0; i < expected.keys.size(); ++i) {
    object.keys.push_back(expected.keys[i]);
    object.items.push_back(of_key(expected.keys[i], expected.items[i]));
  }
  return object;
}

std::optional<double> number_in(const std::string& key, const std::string& prefix) {
  if (!key.starts_with(prefix)) return std::nullopt;
  const char* begin = key.c_str() + prefix.size();
  char* end = nullptr;
  const double number = std::strtod(begin, &end);
  if (end == begin || *end != '\0') return std::nullopt;
  return number;
}

std::optional<double> f0_in(const std::string& key, const std::string& prefix) {
  const std::optional<double> number = number_in(key, prefix);
  if (!number || key.find('.') != std::string::npos) return number;
  const std::size_t digits = key.size() - prefix.size();
  return *number / std::pow(10.0, static_cast<double>(digits) - 1);
}

namespace {

double entry(const Value& tolerance, std::string_view key) {
  const Value* value = tolerance.find(key);
  return value == nullptr ? 0 : value->number;
}

void compare_numbers(double expected, double actual, const Value& tolerance,
                     const std::string& path, Difference& difference) {
  const double limit =
      std::max(entry(tolerance, "abs"), entry(tolerance, "rel") * std::fabs(expected));
  const double error = std::fabs(actual - expected);
  if (error == 0) return;
  if (limit > 0) difference.worst = std::max(difference.worst, error / limit);
  if (error <= limit || !difference.mismatch.empty()) return;
  difference.mismatch =
      fmt::format("{} is {:.8g}, expected {:.8g}, tolerance {:.3g}", path, actual, expected, limit);
}

void compare_at(const Value& expected, const Value& actual, const Value& tolerance,
                const std::string& path, Difference& difference);

void compare_items(const Value& expected, const Value& actual, const Value& tolerance,
                   const std::string& path, Difference& difference) {
  if (expected.items.size() != actual.items.size()) {
    difference.mismatch = fmt::format("{} has another number of values", path);
    return;
  }
  for (std::size_t i = 0; i < expected.items.size(); ++i) {
    const std::string name = expected.keys.empty() ? fmt::format("{}", i) : expected.keys[i];
    compare_at(expected.items[i], actual.items[i], tolerance,
               path.empty() ? name : fmt::format("{}.{}", path, name), difference);
  }
}

void compare_at(const Value& expected, const Value& actual, const Value& tolerance,
                const std::string& path, Difference& difference) {
  using Kind = Value::Kind;
  if (actual.kind == Kind::null) {
    difference.mismatch = fmt::format("{} is not known", path);
  } else if (expected.kind == Kind::number && actual.kind == Kind::list) {
    // One number for three equal colours.
    for (const Value& item : actual.items) {
      compare_numbers(expected.number, item.number, tolerance, path, difference);
    }
  } else if (expected.kind != actual.kind) {
    difference.mismatch = fmt::format("{} is of another kind", path);
  } else if (expected.kind == Kind::number) {
    compare_numbers(expected.number, actual.number, tolerance, path, difference);
  } else if (expected.kind == Kind::list || expected.kind == Kind::object) {
    compare_items(expected, actual, tolerance, path, difference);
  } else if (expected.number != actual.number || expected.text != actual.text) {
    difference.mismatch = fmt::format("{} differs: {}", path, actual.text);
  }
}

}  // namespace

Difference compare(const Value& expected, const Value& actual, const Value& tolerance) {
  Difference difference;
  compare_at(expected, actual, tolerance, "", difference);
  return difference;
}

}  // namespace gltfx::ground_truth
