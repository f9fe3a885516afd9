// SPDX-License-Identifier: Apache-2.0
// The glTF version of an asset, and the minimum version that a reader must support.
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

struct Version {
  std::uint32_t major = 0;
  std::uint32_t minor = 0;
  bool operator<(const Version& other) const {
    return major != other.major ? major < other.major : minor < other.minor;
  }
};

std::optional<std::uint32_t> parse_part(std::string_view digits) {
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
    return std::nullopt;
  }
  std::uint32_t number = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return result.ec == std::errc() ? number : UINT32_MAX;
}

std::optional<Version> parse_version(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const auto major = parse_part(text.substr(0, dot));
  const auto minor = parse_part(text.substr(dot + 1));
  if (!major || !minor) return std::nullopt;
  return Version{*major, *minor};
}

void check_min_version(const Context& context, json::NodeId asset, const Path& path,
                       const Version& version) {
  const auto least = parse_version(model::string_member(context.document, asset, "minVersion"));
  if (!least || !(version < *least)) return;
  report_member(context.schema_sink, context, path, asset, "minVersion",
                Code::ASSET_MIN_VERSION_GREATER_THAN_VERSION,
                fmt::format("minVersion {}.{} is greater than version {}.{}.", least->major,
                            least->minor, version.major, version.minor));
}

// glTF 1.0 and the draft of 2.1 are reported by the identity phase, which is an addition.
void check_known(const Context& context, json::NodeId asset, const Path& path,
                 const Version& version) {
  if (version.major != 2) {
    report_member(context.schema_sink, context, path, asset, "version",
                  Code::UNKNOWN_ASSET_MAJOR_VERSION,
                  fmt::format("The asset is glTF {}.{}; only version 2 is supported.",
                              version.major, version.minor));
  } else if (version.minor > (context.deviations.minor_versions_are_unknown ? 0U : 1U)) {
    report_member(context.schema_sink, context, path, asset, "version",
                  Code::UNKNOWN_ASSET_MINOR_VERSION,
                  fmt::format("The asset has the unknown version 2.{}; it is checked as glTF 2.0.",
                              version.minor));
  }
}

void check_asset(const Context& context, json::NodeId asset, const Path& path) {
  const auto version = parse_version(model::string_member(context.document, asset, "version"));
  if (!version) return;
  check_min_version(context, asset, path, *version);
  check_known(context, asset, path, *version);
}

}  // namespace

const RuleGroup& asset_root_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {{"asset", check_asset}};
  static constexpr RuleGroup group{.object_rules = kObjectRules};
  return group;
}

}  // namespace gltfx::validate
