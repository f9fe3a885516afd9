// SPDX-License-Identifier: Apache-2.0
/// Members of objects as values with defaults, overridden by an animation.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "model/node.hpp"

namespace gltfx::model {

/// Values of properties at one moment of an animation, by canonical JSON pointer. An element of an
/// array may have its own pointer.
using AnimatedValues = std::map<std::string, std::vector<float>, std::less<>>;

/// The limits that a value is clamped to: splines overshoot.
struct Limits {
  float least = std::numeric_limits<float>::lowest();
  float most = std::numeric_limits<float>::max();
};
inline constexpr Limits kUnitLimits{0, 1};
inline constexpr Limits kPositiveLimits{0, std::numeric_limits<float>::max()};

/// One object of a document, or none. Absent or malformed members have the given default. The
/// document and the values must outlive it.
class Properties {
 public:
  /// `pointer` is that of the object; only needed with `animated`.
  Properties(const json::Document& document, json::NodeId object,
             const AnimatedValues* animated = nullptr, std::string pointer = {});

  bool exists() const { return object_ != json::kNoNode; }
  const json::Document& document() const { return document_; }
  json::NodeId node() const { return object_; }

  /// The object of a member; without a node when there is none.
  Properties object(std::string_view name) const;
  Properties extension(std::string_view name) const;

  float number(std::string_view name, float absent, const Limits& limits = {}) const;
  bool flag(std::string_view name, bool absent) const;

  /// Fills `values` with as many numbers; does not change them if the member is absent.
  void read(std::string_view name, std::span<float> values, const Limits& limits) const;

  template <std::size_t N>
  std::array<float, N> numbers(std::string_view name, const std::array<float, N>& absent,
                               const Limits& limits = {}) const {
    std::array<float, N> values = absent;
    read(name, values, limits);
    return values;
  }

 private:
  /// The animated values of a member, or null.
  const std::vector<float>* animated(std::string_view name) const;

  const json::Document& document_;
  json::NodeId object_;
  const AnimatedValues* animated_;
  std::string pointer_;
};

/// Whether `values` has the value at `pointer` or a value below it.
bool any_below(const AnimatedValues& values, std::string_view pointer);

}  // namespace gltfx::model
