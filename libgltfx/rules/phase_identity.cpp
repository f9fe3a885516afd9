// SPDX-License-Identifier: Apache-2.0
// Files of other versions or formats than glTF 2.0 get one finding that names the format, instead
// of many consequences.
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/asset.hpp"
#include "model/memory_budget.hpp"
#include "rules/phases.hpp"

namespace gltfx::validate {
namespace {

std::string asset_version(const json::Document& document, json::NodeId& place) {
  const json::NodeId asset = document.find(document.root(), "asset");
  place = document.find(asset, "version");
  if (place == json::kNoNode || !document.is_string(place)) return {};
  return document.string(place);
}

bool check_version_1(const Context& context, Collector& collector) {
  const bool old_glb = context.container.glb_version == 1U;
  if (!old_glb && !model::is_gltf_1(context.document)) return false;
  json::NodeId place = json::kNoNode;
  asset_version(context.document, place);
  Finding finding(Code::GLTF_VERSION_1);
  finding.message = "The asset is glTF 1.0; only glTF 2.0 is supported.";
  finding.span =
      place != json::kNoNode ? context.document.span(place) : first_character(context.document, 0);
  collector.report_file(Phase::schema, std::move(finding));
  return true;
}

// The version that the asset states, if its text is a draft.
const schema::VersionText* draft_of(const Context& context) {
  const schema::Version stated = schema::stated_version(context.document);
  for (const schema::VersionText& text : context.schemas.versions()) {
    if (text.version == stated && text.status == schema::Status::draft) return &text;
  }
  return nullptr;
}

void name_draft(const Context& context) {
  json::NodeId place = json::kNoNode;
  const schema::VersionText* draft = draft_of(context);
  if (draft == nullptr) return;
  asset_version(context.document, place);
  const Path root;
  const Path asset(root, "asset");
  const Path version(asset, "version");
  Finding finding(Code::GLTF_VERSION_2_1_DRAFT);
  finding.message = fmt::format(
      "The asset is checked by the draft of glTF {}, revision {}, which can still change.",
      version_text(draft->version), draft->revision);
  finding.span = context.document.span(place);
  context.schema_sink.report(version, std::move(finding));
}

bool check_amount(const Context& context, Collector& collector) {
  const std::uint64_t count = model::root_objects(context.document);
  const std::uint64_t most = model::most_root_objects(context.document.text().size());
  if (count <= most) return true;
  Finding finding(Code::TOO_MANY_OBJECTS);
  finding.message = fmt::format(
      "The root arrays have {} elements, but at most {} are allowed in {} bytes of JSON; the rest "
      "is not checked.",
      count, most, context.document.text().size());
  finding.span = first_character(context.document, 0);
  collector.report_file(Phase::schema, std::move(finding));
  return false;
}

}  // namespace

bool check_identity(const Context& context, Collector& collector) {
  if (context.deviations.no_additional_rules) return true;
  if (!context.document.is_object(context.document.root())) return true;
  if (check_version_1(context, collector)) return false;
  if (!check_amount(context, collector)) return false;
  name_draft(context);
  return true;
}

}  // namespace gltfx::validate
