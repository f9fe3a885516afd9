// SPDX-License-Identifier: Apache-2.0
/// @file
/// Limits on measures: the budgets of a user.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/measure.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// How a value is compared. `min`, `max`, `equal`: numbers, within a millionth of the larger one
/// unless both are whole; `equal` also flags. `match`, `deny_match`: texts with a pattern.
/// `unique`: no two elements have the same text. `allow`, `deny`: texts, and each text of a set,
/// with a list of words; a word that ends in '*' matches every text with that prefix.
enum class LimitOp : std::uint8_t { min, max, equal, match, deny_match, unique, allow, deny };
/// "min", "deny-match" and so on.
std::string_view limit_op_name(LimitOp op);
/// The one with that name, or nothing.
std::optional<LimitOp> limit_op_from_name(std::string_view name);

/// A limit on a measure. A value beyond it is a finding with the code of the measure.
struct Limit {
  const MeasureDescription* measure = nullptr;  ///< not null; static storage
  MeasureScope on = MeasureScope::asset;        ///< each element of it is compared
  LimitOp op = LimitOp::max;                    ///< one that the type of the measure has
  double number = 0;                            ///< of min, max, equal: in the unit of the measure
  bool flag = true;                             ///< of equal, for a flag
  std::vector<std::string> texts;  ///< of match, deny_match: one pattern; of allow, deny: words
  Severity severity = Severity::error;  ///< of the finding
  MeasureParameters parameters;         ///< how the measure is taken
  std::string from;                     ///< where the limit is stated: "gltfx.toml:8"
  std::string note;                     ///< text that findings add to `from`; may be empty
  /// Member by member.
  bool operator==(const Limit&) const = default;
};

/// Metres along x, y and z; 0: any.
using ProductSize = std::array<double, 3>;

/// The sizes that assets should have: MeasureParameters::product.
struct ProductList {
  std::map<std::string, ProductSize, std::less<>>
      by_path;  ///< by absolute path, without "..": first
  std::map<std::string, ProductSize, std::less<>> by_name;  ///< by the name of the file: second
  ProductSize others{};                                     ///< of all other assets

  /// The size for an asset. Relative paths start from the working folder.
  const ProductSize& find(std::string_view path) const;
};

}  // namespace gltfx
