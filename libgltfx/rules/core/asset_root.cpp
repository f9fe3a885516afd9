// SPDX-License-Identifier: Apache-2.0
// The glTF version of an asset, and the minimum version that a reader must support.
#include <optional>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using schema::Version;

void check_min_version(const Context& context, json::NodeId asset, const Path& path,
                       const Version& version) {
  const auto least =
      schema::parse_version(model::string_member(context.document, asset, "minVersion"));
  if (!least || !(version < *least)) return;
  report_member(context.schema_sink, context, path, asset, "minVersion",
                Code::ASSET_MIN_VERSION_GREATER_THAN_VERSION,
                fmt::format("minVersion {}.{} is greater than version {}.{}.", least->major,
                            least->minor, version.major, version.minor));
}

void check_minor(const Context& context, json::NodeId asset, const Path& path,
                 const Version& version) {
  const Version known = context.deviations.minor_versions_are_unknown
                            ? schema::kVersion2
                            : context.schemas.newest_version();
  if (version <= known) return;
  report_member(context.schema_sink, context, path, asset, "version",
                Code::UNKNOWN_ASSET_MINOR_VERSION,
                fmt::format("The asset has the unknown version {}; it is checked as glTF {}.",
                            version_text(version), version_text(known)));
}

// glTF 1.0 and drafts are reported by the identity phase, which is an addition.
void check_known(const Context& context, json::NodeId asset, const Path& path,
                 const Version& version) {
  if (version.major == schema::kVersion2.major) return check_minor(context, asset, path, version);
  report_member(
      context.schema_sink, context, path, asset, "version", Code::UNKNOWN_ASSET_MAJOR_VERSION,
      fmt::format("The asset is glTF {}; only version 2 is supported.", version_text(version)));
}

void check_asset(const Context& context, json::NodeId asset, const Path& path) {
  const auto version =
      schema::parse_version(model::string_member(context.document, asset, "version"));
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
