// SPDX-License-Identifier: Apache-2.0
// KHR_gaussian_splatting: attributes that must occur together, which depends on their names; this
// file is about that one extension and names it.
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kSplatsExtension = "KHR_gaussian_splatting";
constexpr std::string_view kHarmonics = "KHR_gaussian_splatting:SH_DEGREE_";
constexpr std::string_view kCoefficient = "_COEF_";
constexpr std::size_t kDegrees = 4;

// The existing coefficients of each degree: bit n for coefficient n.
using Coefficients = std::array<std::uint32_t, kDegrees>;

std::optional<unsigned> small_number(std::string_view text) {
  unsigned number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
  return whole && !text.empty() ? std::optional(number) : std::nullopt;
}

void note(std::string_view name, Coefficients& found) {
  if (!name.starts_with(kHarmonics)) return;
  name.remove_prefix(kHarmonics.size());
  const std::size_t middle = name.find(kCoefficient);
  if (middle == std::string_view::npos) return;
  const auto degree = small_number(name.substr(0, middle));
  const auto coefficient = small_number(name.substr(middle + kCoefficient.size()));
  if (degree && *degree < kDegrees && coefficient && *coefficient <= 2 * *degree) {
    found[*degree] |= 1U << *coefficient;
  }
}

// The name of the first coefficient missing below the highest existing degree; empty: none.
std::string missing_coefficient(const Coefficients& found) {
  std::size_t highest = kDegrees;
  while (highest > 0 && found[highest - 1] == 0) --highest;
  for (std::size_t degree = 0; degree < highest; ++degree) {
    for (std::size_t n = 0; n <= 2 * degree; ++n) {
      if ((found[degree] >> n & 1U) == 0) {
        return fmt::format("{}{}{}{}", kHarmonics, degree, kCoefficient, n);
      }
    }
  }
  return {};
}

void check_harmonics(const Context& context, const ExtensionPlace& place, json::NodeId attributes,
                     const Path& path) {
  Coefficients found{};
  for (const auto member : context.document.members(attributes)) {
    note(context.document.key(member.key_id), found);
  }
  // Without the first one, no others are allowed: that is a missing attribute.
  if (found[0] == 0) return;
  const std::string missing = missing_coefficient(found);
  if (missing.empty()) return;
  report_link(context, path, place.object, Code::SPLAT_HARMONICS_INCOMPLETE,
              fmt::format("The primitive has no attribute {}.", missing));
}

void check_primitive(const Context& context, const schema::Extension& extension,
                     const ExtensionPlace& place, const Path& path) {
  const json::Document& document = context.document;
  const std::uint64_t mode = model::unsigned_member(document, place.host, "mode").value_or(4);
  if (mode != 0) {
    report_link(context, path, place.object, Code::SPLAT_INVALID_MODE,
                fmt::format("The mode of the primitive is {}; it must be 0 (POINTS).", mode));
  }
  const json::NodeId attributes = model::object_member(document, place.host, "attributes");
  if (attributes == json::kNoNode) return;
  // An extension of the extension stores the splats in another form.
  if (document.find(place.object, "extensions") != json::kNoNode) return;
  for (const schema::AttributeFormat& wanted : extension.vertex_attributes) {
    if (!wanted.required || document.find(attributes, wanted.semantic) != json::kNoNode) continue;
    report_link(context, path, place.object, Code::SPLAT_ATTRIBUTE_MISSING,
                fmt::format("The primitive has no attribute {}.", wanted.semantic));
  }
  check_harmonics(context, place, attributes, path);
}

void check_splats(const Context& context) {
  if (!has_objects_of(context, kSplatsExtension)) return;
  const schema::ExtensionId id = context.schemas.find_extension(kSplatsExtension);
  if (id == schema::kNone) return;
  for_each_primitive_extension(
      context, kSplatsExtension, [&](const ExtensionPlace& place, const Path& path) {
        check_primitive(context, context.schemas.extensions()[id], place, path);
      });
}

}  // namespace

const RuleGroup& gaussian_splatting_rules() {
  static constexpr LinkRule kLinkRules[] = {check_splats};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
