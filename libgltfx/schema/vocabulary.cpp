// SPDX-License-Identifier: Apache-2.0
#include "schema/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace gltfx::schema {
namespace {

using K = Keyword;
using F = Form;

// A file's own words come first: the schema keywords are the tail of this table.
constexpr std::array kFile{
    Word{"$schema", F::dialect, K::schema, true},
    Word{"$id", F::file_id, K::id, true},
    Word{"$defs", F::schema_map, K::defs},
    Word{"title", F::text, K::title, true},
    Word{"description", F::text, K::description, true},
    Word{"$ref", F::reference, K::ref},
    Word{"$comment", F::text, K::comment},
    Word{"default", F::any, K::default_value},
    Word{"deprecated", F::flag, K::deprecated},
    Word{"examples", F::list, K::examples},
    Word{"type", F::type, K::type},
    Word{"enum", F::literals, K::enumeration},
    Word{"const", F::literal, K::constant},
    Word{"minimum", F::number, K::minimum},
    Word{"maximum", F::number, K::maximum},
    Word{"exclusiveMinimum", F::number, K::exclusive_minimum},
    Word{"exclusiveMaximum", F::number, K::exclusive_maximum},
    Word{"multipleOf", F::positive, K::multiple_of},
    Word{"minLength", F::count, K::min_length},
    Word{"maxLength", F::count, K::max_length},
    Word{"pattern", F::pattern, K::pattern},
    Word{"format", F::text, K::format},
    Word{"properties", F::schema_map, K::properties},
    Word{"required", F::names, K::required},
    Word{"additionalProperties", F::schema, K::additional_properties},
    Word{"patternProperties", F::pattern_map, K::pattern_properties},
    Word{"propertyNames", F::schema, K::property_names},
    Word{"minProperties", F::count, K::min_properties},
    Word{"maxProperties", F::count, K::max_properties},
    Word{"dependentRequired", F::names_map, K::dependent_required},
    Word{"items", F::schema, K::items},
    Word{"minItems", F::count, K::min_items},
    Word{"maxItems", F::count, K::max_items},
    Word{"uniqueItems", F::flag, K::unique_items},
    Word{"allOf", F::schemas, K::all_of},
    Word{"anyOf", F::schemas, K::any_of},
    Word{"oneOf", F::schemas, K::one_of},
    Word{"not", F::schema, K::not_},
    Word{"if", F::schema, K::if_},
    Word{"then", F::schema, K::then_},
    Word{"else", F::schema, K::else_},
    Word{"x-gltfx", F::annotation, K::x_gltfx},
};

// Inside a file: without $schema, $id, $defs, and nothing is required.
constexpr auto kSchema = [] {
  std::array<Word, kFile.size() - 3> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = kFile[i + 3];
    words[i].required = false;
  }
  return words;
}();

constexpr std::array kWord{
    Word{"ref", F::target},
    Word{"refHas", F::member_path},
    Word{"refHolds", F::schema},
    Word{"refName", F::name_target},
    Word{"unitLength", F::severity},
    Word{"shouldMatch", F::pattern},
    Word{"mayRefer", F::target},
    Word{"mayPoint", F::flag},
    Word{"essential", F::flag},
    Word{"byPosition", F::nonempty_text},
    Word{"slot", F::slot},
    Word{"parameter", F::nonempty_text},
    Word{"mutable", F::mutable_type},
    Word{"animatedMinimum", F::number},
    Word{"enumNames", F::enum_names},
    Word{"aliases", F::names},
    Word{"addedLate", F::flag},
    Word{"unit", F::nonempty_text},
    Word{"deprecated", F::nonempty_text},
    Word{"draft", F::nonempty_text},
    Word{"since", F::version},
    Word{"openSince", F::version},
    Word{"without", F::names},
    Word{"should", F::advice},
    Word{"versions", F::versions},
    Word{"hint", F::nonempty_text},
    Word{"zeroHint", F::nonempty_text},
};

constexpr std::array kVersion{
    Word{"version", F::version, K::none, true},
    Word{"status", F::status, K::none, true},
    Word{"revision", F::revision},
    Word{"explained", F::names},
};
constexpr std::array kAdvice{
    Word{"since", F::version},
    Word{"value", F::schema, K::none, true},
    Word{"because", F::nonempty_text, K::none, true},
};

constexpr std::array kExtension{
    Word{"extension", F::extension_name, K::none, true},
    Word{"on", F::attachment_points, K::none, true},
    Word{"status", F::status, K::none, true},
    Word{"spec", F::url},
    Word{"revision", F::revision},
    Word{"excludes", F::relations},
    Word{"requires", F::companions},
    Word{"overriddenBy", F::relations},
    Word{"strength", F::nonempty_text},
    Word{"standalone", F::flag},
    Word{"undrawn", F::flag},
    Word{"mustBeRequired", F::requirement},
    Word{"fallback", F::nonempty_text},
    Word{"fallbackExtensions", F::names},
    Word{"optionalWithFallback", F::flag},
    Word{"imageMimeTypes", F::media_types},
    Word{"vertexAttributes", F::semantics},
    Word{"morphAttributes", F::semantics},
    Word{"instanceAttributes", F::semantics},
    Word{"khronosValidator", F::flag},
    Word{"successor", F::extension_name},
    Word{"generations", F::generations},
    Word{"upgrade", F::upgrade},
    Word{"enumAdditions", F::enum_additions},
    Word{"tests", F::any},
    Word{"hint", F::nonempty_text},
};

constexpr std::array kSlot{
    Word{"channels", F::channels, K::none, true},
    Word{"colorSpace", F::color_space, K::none, true},
    Word{"scaledBy", F::nonempty_text},
    Word{"factors", F::channel_factors},
};
constexpr std::array kRelation{
    Word{"extension", F::extension_name, K::none, true},
    Word{"because", F::nonempty_text, K::none, true},
};
constexpr std::array kCompanion{
    kRelation[0],
    kRelation[1],
    Word{"severity", F::severity},
};
constexpr std::array kAttribute{
    Word{"types", F::element_types, K::none, true},
    Word{"components", F::component_types, K::none, true},
    Word{"required", F::flag},
};
constexpr std::array kGeneration{
    Word{"name", F::nonempty_text, K::none, true},
    Word{"description", F::nonempty_text, K::none, true},
    Word{"with", F::names},
    Word{"without", F::names},
    Word{"slots", F::slot_map},
};

constexpr std::array kUpgrade{
    Word{"to", F::extension_name},     Word{"alternatives", F::names},
    Word{"optIn", F::nonempty_text},   Word{"together", F::flag},
    Word{"convert", F::conversion},    Word{"hiddenBy", F::relations},
    Word{"blockedBy", F::relations},   Word{"steps", F::upgrade_steps},
    Word{"losses", F::upgrade_losses}, Word{"stays", F::upgrade_stays},
};
constexpr std::array kUpgradeStep{
    Word{"step", F::step_kind, K::none, true},
    Word{"from", F::nonempty_text},
    Word{"to", F::nonempty_text, K::none, true},
    Word{"otherwise", F::any},
    Word{"take", F::count},
    Word{"swizzle", F::swizzle},
    Word{"accept", F::accepted_form},
    Word{"generations", F::names},
};
constexpr std::array kUpgradeLoss{
    Word{"vertexAttribute", F::nonempty_text},
    Word{"generations", F::names},
    Word{"because", F::nonempty_text, K::none, true},
};
constexpr std::array kUpgradeStay{
    Word{"generations", F::names},
    Word{"because", F::nonempty_text, K::none, true},
};

constexpr std::array<std::string_view, 7> kTypes{"object",  "array",   "string", "number",
                                                 "integer", "boolean", "null"};
constexpr std::array<std::string_view, 7> kStatus{
    "ratified", "release-candidate", "draft", "legacy", "archived", "registered-vendor", "vendor"};
constexpr std::array<std::string_view, 10> kMutable{"bool",     "int",    "float",    "float2",
                                                    "float3",   "float4", "float2x2", "float3x3",
                                                    "float4x4", "float[]"};
constexpr std::array<std::string_view, 2> kColorSpaces{"linear", "srgb"};
constexpr std::array<std::string_view, 2> kSeverities{"error", "warning"};
constexpr std::array<std::string_view, 3> kStepKinds{"move", "copy", "place"};
constexpr std::array<std::string_view, 4> kConversions{"root-translation", "scattering",
                                                       "specular-glossiness", "xmp"};
constexpr std::array<std::string_view, 1> kAcceptedForms{"index"};
constexpr std::array<std::string_view, 3> kRequirements{"always", "without-fallback",
                                                        "recommended"};
constexpr std::array<std::string_view, 7> kElements{"SCALAR", "VEC2", "VEC3", "VEC4",
                                                    "MAT2",   "MAT3", "MAT4"};
constexpr std::array<std::string_view, 10> kComponents{
    "BYTE",       "BYTE_NORM", "UBYTE",       "UBYTE_NORM", "SHORT",
    "SHORT_NORM", "USHORT",    "USHORT_NORM", "UINT",       "FLOAT"};

}  // namespace

std::span<const Word> words(Context context) {
  switch (context) {
    case Context::file:
      return kFile;
    case Context::schema:
      return kSchema;
    case Context::word:
      return kWord;
    case Context::version:
      return kVersion;
    case Context::advice:
      return kAdvice;
    case Context::extension:
      return kExtension;
    case Context::slot:
      return kSlot;
    case Context::relation:
      return kRelation;
    case Context::companion:
      return kCompanion;
    case Context::attribute:
      return kAttribute;
    case Context::generation:
      return kGeneration;
    case Context::upgrade:
      return kUpgrade;
    case Context::upgrade_step:
      return kUpgradeStep;
    case Context::upgrade_loss:
      return kUpgradeLoss;
    case Context::upgrade_stay:
      return kUpgradeStay;
  }
  return {};
}

std::string_view context_name(Context context) {
  constexpr std::array<std::string_view, 15> kNames{"a schema file",
                                                    "a schema",
                                                    "x-gltfx",
                                                    "a version",
                                                    "advice",
                                                    "x-gltfx of an extension",
                                                    "a slot",
                                                    "a relation to an extension",
                                                    "a companion",
                                                    "an attribute",
                                                    "a generation",
                                                    "an upgrade",
                                                    "a step of an upgrade",
                                                    "a loss of an upgrade",
                                                    "what stays in an upgrade"};
  return kNames[static_cast<std::size_t>(context)];
}

Keyword keyword_of(std::string_view name) {
  const auto word = std::find_if(kFile.begin(), kFile.end(),
                                 [name](const Word& known) { return known.name == name; });
  return word == kFile.end() ? Keyword::none : word->keyword;
}

std::span<const std::string_view> listed_values(Form form) {
  switch (form) {
    case Form::type:
      return kTypes;
    case Form::status:
      return kStatus;
    case Form::mutable_type:
      return kMutable;
    case Form::color_space:
      return kColorSpaces;
    case Form::severity:
      return kSeverities;
    case Form::requirement:
      return kRequirements;
    case Form::element_types:
      return kElements;
    case Form::component_types:
      return kComponents;
    case Form::step_kind:
      return kStepKinds;
    case Form::accepted_form:
      return kAcceptedForms;
    case Form::conversion:
      return kConversions;
    default:
      return {};
  }
}

}  // namespace gltfx::schema
