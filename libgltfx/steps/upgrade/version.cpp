// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/version.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "change/name_list.hpp"
#include "json/edit.hpp"
#include "model/asset.hpp"
#include "model/fields.hpp"
#include "model/views.hpp"
#include "schema/version.hpp"
#include "steps/json_edits.hpp"
#include "steps/moved_members.hpp"
#include "steps/upgrade/version_shapes.hpp"

namespace gltfx::upgrade {
namespace {

class VersionPlan {
 public:
  VersionPlan(const json::Document& document, const schema::Set& set, const UpgradeOptions& options)
      : document_(document), set_(set), options_(options), editor_(document) {}

  Plan run() {
    plan_.change.additions = change::Additions(document_);
    if (!set_version()) return std::move(plan_);
    for (const steps::MovedIndex& moved : steps::kMovedIndices) move(moved);
    drop_targets();
    move_shapes();
    keep_scenes();
    keep_promoted();
    plan_.change.edits = editor_.take();
    return std::move(plan_);
  }

 private:
  UpgradeAction& add(std::string pointer, std::string_view from, UpgradeOutcome outcome) {
    UpgradeAction& action = plan_.actions.emplace_back();
    action.pointer = std::move(pointer);
    action.from = from;
    action.outcome = outcome;
    action.done = outcome == UpgradeOutcome::safe || outcome == UpgradeOutcome::unsafe;
    return action;
  }
  void keep(std::string pointer, std::string_view from, std::string why) {
    add(std::move(pointer), from, UpgradeOutcome::no_successor).notes.push_back(std::move(why));
  }

  // False: the asset has no version that can be raised.
  bool set_version() {
    const json::NodeId asset = model::object_member(document_, document_.root(), "asset");
    const json::NodeId value = document_.find(asset, "version");
    const auto version = schema::parse_version(model::string_member(document_, asset, "version"));
    if (!version || version->major != schema::kVersion2.major) {
      add("/asset/version", "glTF", UpgradeOutcome::impossible)
          .notes.emplace_back("the version is not one of glTF 2");
      return false;
    }
    if (*version >= *schema::parse_version(kGltfVersion)) return true;
    const std::string from = "glTF " + schema::version_text(*version);
    add("/asset/version", from, UpgradeOutcome::safe).to = fmt::format("glTF {}", kGltfVersion);
    editor_.replace_scalar(value, fmt::format(R"("{}")", kGltfVersion));
    return true;
  }

  void move(const steps::MovedIndex& moved) {
    const json::NodeId root = document_.root();
    const json::NodeId object = model::object_member(document_, root, moved.object);
    const json::NodeId extras = model::object_member(document_, object, "extras");
    const json::NodeId value = document_.find(extras, moved.name);
    if (value == json::kNoNode) return;
    std::string pointer = fmt::format("/{}/extras/{}", moved.object, moved.name);
    const std::string from = fmt::format("extras.{}", moved.name);
    if (document_.find(object, moved.name) != json::kNoNode) {
      return keep(std::move(pointer), from, fmt::format("{} has it already", moved.object));
    }
    const auto index = model::unsigned_member(document_, extras, moved.name);
    const json::NodeId list = document_.find(root, moved.array);
    const bool is_list = list != json::kNoNode && document_.is_array(list);
    if (!index || !is_list || *index >= document_.array_size(list)) {
      return keep(std::move(pointer), from, fmt::format("it is not an index of {}", moved.array));
    }
    add(std::move(pointer), from, UpgradeOutcome::safe).to =
        fmt::format("{}.{}", moved.object, moved.name);
    editor_.append_member(object, moved.name, document_.raw(value));
    if (document_.object_size(extras) == 1) {
      editor_.remove(object, extras - 1);
    } else {
      editor_.remove(extras, value - 1);
    }
  }

  // A target on a view that has neither indices nor vertex attributes, by all that is known of it.
  void drop_targets() {
    const model::Asset asset(document_);
    const model::Views views(asset);
    for (std::uint32_t i = 0; i < views.buffer_views.size(); ++i) {
      const json::NodeId view = views.buffer_views[i].node;
      const auto& use = views.usage.view(i);
      if (view == json::kNoNode || document_.find(view, "target") == json::kNoNode) continue;
      if (!use.used() || use.has(model::ViewUse::indices) || use.has(model::ViewUse::vertices)) {
        continue;
      }
      add(fmt::format("/bufferViews/{}/target", i), "target", UpgradeOutcome::safe).removed = true;
      steps::remove_member(document_, editor_, view, "target");
    }
  }

  void move_shapes() {
    auto shapes = shapes_of_extension(document_, set_);
    if (!shapes) return;
    const std::string pointer = fmt::format("/extensions/{}", steps::kShapesExtension);
    if (!*shapes) return keep(pointer, steps::kShapesExtension, shapes->error().message);
    if (!options_.unsafe) {
      add(pointer, steps::kShapesExtension, UpgradeOutcome::on_request)
          .notes.push_back(fmt::format(
              "{} becomes shapes with --unsafe: programs that read the extension lose them",
              steps::kShapesExtension));
      return;
    }
    add(pointer, steps::kShapesExtension, UpgradeOutcome::unsafe).to = "shapes";
    const json::NodeId list = document_.find(document_.root(), "shapes");
    if (list == json::kNoNode) {
      editor_.append_member(document_.root(), "shapes",
                            fmt::format("[{}]", fmt::join(**shapes, ",")));
    } else {
      for (const std::string& shape : **shapes) editor_.append_element(list, shape);
    }
    steps::remove_extension(document_, editor_, document_.root(), steps::kShapesExtension);
    for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
      change::NameList names(document_, member);
      names.remove(steps::kShapesExtension);
      names.apply(editor_);
    }
  }

  void keep_scenes() {
    const json::NodeId list = document_.find(document_.root(), "scenes");
    if (list == json::kNoNode || !document_.is_array(list)) return;
    if (document_.array_size(list) < 2) return;
    keep("/scenes", "scenes",
         "glTF 2.1 deprecates more than one scene: one file per scene has the same, and an asset "
         "can refer to these files as externalAssets");
  }

  void keep_promoted() {
    const change::NameList used(document_, "extensionsUsed");
    for (const std::string_view name : steps::kPromoted) {
      const std::vector<std::string> places = used.places(name);
      if (places.empty()) continue;
      keep(places.front(), name,
           "glTF 2.1 is to include it, but the draft has no members for it; the extension stays");
    }
  }

  const json::Document& document_;
  const schema::Set& set_;
  const UpgradeOptions& options_;
  json::Editor editor_;
  Plan plan_;
};

}  // namespace

Plan plan_version(const json::Document& document, const schema::Set& set,
                  const UpgradeOptions& options) {
  return VersionPlan(document, set, options).run();
}

}  // namespace gltfx::upgrade
