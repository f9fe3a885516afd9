// SPDX-License-Identifier: Apache-2.0
// The version of glTF an asset is written in, and the least one a reader must know.
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "model/fields.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMinimal = R"({"asset": {"version": "2.0"}})";

constexpr RuleDescription kRules[] = {
    {"ASSET_MIN_VERSION_GREATER_THAN_VERSION", Severity::error,
     "The asset asks for a newer glTF than the one it is written in",
     "A reader that looks at minVersion refuses an asset that it could read.",
     "Lower minVersion, or leave it out.", R"({"asset": {"version": "2.0", "minVersion": "2.5"}})",
     R"({"asset": {"version": "2.0", "minVersion": "2.0"}})", Fix::none, true},
    {"UNKNOWN_ASSET_MAJOR_VERSION", Severity::error,
     "The asset is written in another glTF than version 2",
     "Major versions are different formats: nothing of the asset can be relied on.",
     "Export the asset as glTF 2.0.", R"({"asset": {"version": "3.0"}})", kMinimal, Fix::none,
     true},
    {"UNKNOWN_ASSET_MINOR_VERSION", Severity::warning,
     "The asset names a minor version of glTF that does not exist",
     "Readers treat the asset as glTF 2.0; what a newer version brings is ignored.",
     "Write version 2.0.", R"({"asset": {"version": "2.7"}})", kMinimal, Fix::none, true},
};

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
                "ASSET_MIN_VERSION_GREATER_THAN_VERSION",
                fmt::format("minVersion {}.{} is above version {}.{}.", least->major, least->minor,
                            version.major, version.minor));
}

// glTF 1.0 and the draft of 2.1 are named by the identity phase, but not in the khronos profile.
void check_known(const Context& context, json::NodeId asset, const Path& path,
                 const Version& version) {
  if (version.major != 2) {
    report_member(context.schema_sink, context, path, asset, "version",
                  "UNKNOWN_ASSET_MAJOR_VERSION",
                  fmt::format("The asset is glTF {}.{}; only version 2 is known.", version.major,
                              version.minor));
  } else if (version.minor > (context.khronos() ? 0U : 1U)) {
    report_member(
        context.schema_sink, context, path, asset, "version", "UNKNOWN_ASSET_MINOR_VERSION",
        fmt::format("There is no glTF 2.{}; the asset is checked as 2.0.", version.minor));
  }
}

void check_asset(const Context& context, json::NodeId asset, const Path& path) {
  const auto version = parse_version(model::string_member(context.document, asset, "version"));
  if (!version) return;
  check_min_version(context, asset, path, *version);
  check_known(context, asset, path, *version);
}

constexpr ObjectRuleEntry kObjectRules[] = {{"asset", check_asset}};

}  // namespace

const Family& asset_root_family() {
  static const Family family{"asset_root", kRules, kObjectRules, {}};
  return family;
}

}  // namespace gltfx::validate
