// SPDX-License-Identifier: Apache-2.0
// Files that are not quite glTF 2.0 are named for what they are, once, instead of drowning the
// reader in consequences.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "validate/phases.hpp"

namespace gltfx::validate {
namespace {

std::string asset_version(const json::Document& document, json::NodeId& place) {
  const json::NodeId asset = document.find(document.root(), "asset");
  place = document.find(asset, "version");
  if (place == json::kNoNode || !document.is_string(place)) return {};
  return document.string(place);
}

// glTF 1.0 kept its objects in dictionaries and always had shaders; `asset` was optional.
bool looks_like_version_1(const json::Document& document) {
  static constexpr std::array<std::string_view, 3> kOld{"techniques", "programs", "shaders"};
  static constexpr std::array<std::string_view, 3> kArrays{"accessors", "buffers", "meshes"};
  const auto is_object = [&](std::string_view name) {
    const json::NodeId value = document.find(document.root(), name);
    return value != json::kNoNode && document.is_object(value);
  };
  return std::any_of(kOld.begin(), kOld.end(), is_object) &&
         std::any_of(kArrays.begin(), kArrays.end(), is_object);
}

// Exporters of that time wrote a number as often as a string.
bool is_version_1(const json::Document& document, json::NodeId place, const std::string& version) {
  if (place == json::kNoNode) return looks_like_version_1(document);
  if (!document.is_number(place)) return version == "1.0" || version == "1.1";
  const double number = document.number(place).value;
  return number >= 1 && number < 2;
}

bool check_version_1(const Context& context, Collector& collector) {
  json::NodeId place = json::kNoNode;
  const std::string version = asset_version(context.document, place);
  const bool old_glb = context.container.glb_version == 1U;
  if (!old_glb && !is_version_1(context.document, place, version)) return false;
  Finding finding;
  finding.code = "GLTF_VERSION_1";
  finding.message = "This is a glTF 1.0 asset; only glTF 2.0 can be checked.";
  finding.span =
      place != json::kNoNode ? context.document.span(place) : first_character(context.document, 0);
  collector.report_file(Phase::schema, std::move(finding));
  return true;
}

void name_draft(const Context& context) {
  json::NodeId place = json::kNoNode;
  if (asset_version(context.document, place) != "2.1") return;
  const Path root;
  const Path asset(root, "asset");
  const Path version(asset, "version");
  Finding finding;
  finding.code = "GLTF_VERSION_2_1_DRAFT";
  finding.message = "The asset says it is glTF 2.1, a draft; it is checked by the rules of 2.0.";
  finding.span = context.document.span(place);
  context.schema_sink.report(version, std::move(finding));
}

// VRM avatars are glTF files with rules of their own behind one extension.
void name_vrm(const Context& context) {
  const json::NodeId extensions = context.document.find(context.document.root(), "extensions");
  const Path root;
  const Path at_extensions(root, "extensions");
  for (const std::string_view name : {std::string_view("VRM"), std::string_view("VRMC_vrm")}) {
    const json::NodeId object = context.document.find(extensions, name);
    if (object == json::kNoNode) continue;
    Finding finding;
    finding.code = "VRM_ASSET";
    finding.message = fmt::format(
        "This is a VRM {} avatar; it is checked as glTF, without the "
        "rules of VRM.",
        name == "VRM" ? "0.x" : "1.0");
    finding.span = first_character(context.document, object);
    context.schema_sink.report(Path(at_extensions, name), std::move(finding));
  }
}

}  // namespace

bool check_identity(const Context& context, Collector& collector) {
  if (context.khronos() || !context.document.is_object(context.document.root())) return true;
  if (check_version_1(context, collector)) return false;
  name_draft(context);
  name_vrm(context);
  return true;
}

}  // namespace gltfx::validate
