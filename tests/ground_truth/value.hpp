// SPDX-License-Identifier: Apache-2.0
/// Values of a file of cases: inputs, expected values, results of the shader.
#pragma once

#include <gltfx/vec3.hpp>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx::ground_truth {

/// A JSON value.
struct Value {
  enum class Kind { null, boolean, number, text, list, object };

  Kind kind = Kind::null;
  double number = 0;  ///< of a boolean: 0 or 1
  std::string text;
  std::vector<std::string> keys;  ///< of an object, beside `items`
  std::vector<Value> items;

  Value() = default;
  Value(double n) : kind(Kind::number), number(n) {}
  Value(bool b) : kind(Kind::boolean), number(b ? 1 : 0) {}
  Value(std::string t) : kind(Kind::text), text(std::move(t)) {}
  Value(const Rgb& c) : kind(Kind::list), items{Value(c.x), Value(c.y), Value(c.z)} {}

  const Value* find(std::string_view key) const;
};

/// Reads a JSON text; nothing when it is none.
std::optional<Value> parse_json(const std::string& text);

/// The inputs of a case. Values that are never read stay in unread(): unknown inputs.
class Inputs {
 public:
  explicit Inputs(const Value& object, std::string path = "") : object_(&object), path_(path) {}

  bool has(const std::string& key) const { return object_->find(key) != nullptr; }
  double number(const std::string& key, double otherwise);
  /// A number means three equal ones.
  Rgb color(const std::string& key, const Rgb& otherwise);
  std::vector<double> numbers(const std::string& key, const std::vector<double>& otherwise);
  std::string text(const std::string& key);
  Inputs object(const std::string& key);
  /// For prose that changes nothing.
  void ignore(const std::string& key) { (void)find(key); }
  /// Counts those of `inner` as this one's.
  void absorb(const Inputs& inner);

  std::vector<std::string> unread() const;

 private:
  const Value* find(const std::string& key);

  const Value* object_;
  std::string path_;
  std::set<std::string> read_;
  std::vector<std::string> unread_below_;
};

/// An object with the keys of `expected`, each with what `of_key` makes of it: null for a key that
/// is not known. Keys hold parameters, too.
using OfKey = std::function<Value(const std::string& key, const Value& expected)>;
Value for_each_key(const Value& expected, const OfKey& of_key);

/// The number that a key is, or ends in after `prefix`.
std::optional<double> number_in(const std::string& key, const std::string& prefix = "");
/// The F0 that a key ends in after `prefix`: "1" is 1, "004" is 0.04, "0.04" is itself.
std::optional<double> f0_in(const std::string& key, const std::string& prefix);

/// How far apart two values are.
struct Difference {
  double worst = 0;      ///< largest error over its tolerance
  std::string mismatch;  ///< first thing that is not within; empty: all is well
};
Difference compare(const Value& expected, const Value& actual, const Value& tolerance);

}  // namespace gltfx::ground_truth
