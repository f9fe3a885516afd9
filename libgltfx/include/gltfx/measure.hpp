// SPDX-License-Identifier: Apache-2.0
/// @file
/// Measures: what is counted in an asset, and the values of one asset. The pages in schema/measures
/// define them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gltfx {

/// The kind of element that has a value.
enum class MeasureScope : std::uint8_t {
  asset,
  scene,
  node,
  mesh,
  primitive,
  material,  ///< also those primitives that have none, as one element
  image,
  skin,
  animation,
};
inline constexpr std::size_t kMeasureScopeCount = 9;  ///< how many there are
/// "asset", "scene" and so on.
std::string_view measure_scope_name(MeasureScope scope);
/// The scope with that name, or nothing.
std::optional<MeasureScope> measure_scope_from_name(std::string_view name);

/// The type of a value.
enum class MeasureType : std::uint8_t { number, flag, text, set };
/// "number", "flag", "text", "set".
std::string_view measure_type_name(MeasureType type);

/// How the values of elements make the value of the asset. `all`: whether all are true.
enum class MeasureTotal : std::uint8_t { none, sum, max, min, all };
/// "none", "sum", "max", "min", "all".
std::string_view measure_total_name(MeasureTotal total);

/// What has to be read: the JSON text and headers of files, bytes of buffers, or pixels of images.
enum class MeasureNeeds : std::uint8_t { json, bytes, pixels };
/// "json", "bytes", "pixels".
std::string_view measure_needs_name(MeasureNeeds needs);

/// One measure. All text has static storage duration.
struct MeasureDescription {
  std::string_view name;        ///< "open-edges"
  std::string_view code;        ///< of a finding about a limit on it: "BUDGET_OPEN_EDGES"
  std::string_view unit;        ///< "B", "m", "s", "px", "%", or what is counted; may be empty
  std::string_view summary;     ///< one sentence, no full stop
  std::string_view definition;  ///< one paragraph
  std::string_view help;        ///< how to meet a limit, one paragraph
  std::string_view example;     ///< an asset, as example_bytes() reads it
  std::string_view values;      ///< its values, JSON: {"mesh": {"0": {"open-edges": 4}}}
  std::uint16_t on = 0;         ///< one bit for each MeasureScope
  MeasureScope first = MeasureScope::asset;  ///< the scope that makes the value of the asset
  MeasureType type = MeasureType::number;    ///< of its values
  MeasureTotal total = MeasureTotal::none;   ///< how the value of the asset is made
  MeasureNeeds needs = MeasureNeeds::json;   ///< what it reads

  /// Whether elements of that scope have values.
  bool is_on(MeasureScope scope) const { return (on >> static_cast<unsigned>(scope) & 1U) != 0; }
  /// Whether the asset has a value: its own, a total, or that of its default scene.
  bool is_of_asset() const {
    return first <= MeasureScope::scene || is_on(MeasureScope::asset) ||
           total != MeasureTotal::none;
  }
};

/// All measures, sorted by name. Two may have one name on different scopes, such as the channels of
/// an image and of an animation. Static storage.
std::span<const MeasureDescription> measures();

/// The first measure with that name, or null.
const MeasureDescription* find_measure(std::string_view name);
/// The one on that scope, or of the asset for MeasureScope::asset; null: there is none.
const MeasureDescription* find_measure(MeasureScope scope, std::string_view name);

/// No value. `reason`: position in Measurements::reasons.
struct NotMeasured {
  std::uint32_t reason = 0;  ///< 0: it does not apply
  /// Member by member.
  bool operator==(const NotMeasured&) const = default;
};

/// A value, by MeasureType: a number in the unit of the measure, a flag, a text, a sorted set of
/// texts.
using MeasureValue = std::variant<NotMeasured, double, bool, std::string, std::vector<std::string>>;

/// Why there is no value.
struct MeasureReason {
  std::string text;    ///< one sentence
  bool fault = false;  ///< the measure applies, but could not be taken
};

/// The values of a measure for all elements of a scope.
struct MeasureColumn {
  const MeasureDescription* measure = nullptr;  ///< static storage
  std::vector<MeasureValue> values;             ///< by element
};

/// A primitive.
struct MeasuredPrimitive {
  std::uint32_t mesh = 0;   ///< index in `meshes`
  std::uint32_t index = 0;  ///< in `primitives`
};

/// The values of an asset. Owns its text; independent of the asset.
struct Measurements {
  /// By scope, sorted by name. The asset has one element; its columns include totals of elements
  /// and the values of the default scene.
  std::array<std::vector<MeasureColumn>, kMeasureScopeCount> columns;
  std::vector<MeasuredPrimitive> primitives;  ///< elements of MeasureScope::primitive
  /// Whether the last element of MeasureScope::material stands for the primitives without one.
  bool has_plain_primitives = false;
  std::vector<MeasureReason> reasons;  ///< the first one: the measure does not apply

  /// The values of a measure, or null: it was not requested.
  const MeasureColumn* find(MeasureScope scope, std::string_view name) const;
};

/// Parameters of measures that have some.
struct MeasureParameters {
  double weld = 0;              ///< metres: vertices that are no farther apart are one
  double hard_angle = 90;       ///< degrees between two normals: hard-edges
  std::uint32_t gutter_at = 0;  ///< pixels of the texture; 0: its size: uv-gutter
  std::string density_slot;     ///< "normalTexture"; empty: the base color: texel-density
  /// Metres along x, y and z that the asset should have; 0: any: product-deviation.
  std::array<double, 3> product{};
  /// Member by member.
  bool operator==(const MeasureParameters&) const = default;
};

}  // namespace gltfx
