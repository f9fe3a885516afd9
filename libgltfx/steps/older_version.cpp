// SPDX-License-Identifier: Apache-2.0
// Makes an asset of a later version one of glTF 2.0. The schemas tell which members are new.
#include "steps/older_version.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "report/wording.hpp"
#include "schema/version.hpp"
#include "steps/json_edits.hpp"
#include "steps/moved_members.hpp"

namespace gltfx::steps {
namespace {

/// A member that glTF 2.0 does not have.
struct LaterMember {
  json::NodeId object;
  json::NodeId value;
  std::string_view name;
};

class OlderVersionStep {
 public:
  explicit OlderVersionStep(const StepInput& input)
      : data_(input),
        document_(data_.document),
        changes_(data_),
        editor_(changes_.editor),
        dropped_(document_.node_count(), false) {}

  Result<StepOutcome> run() {
    data_.input.unread.clear();  // most changes need no bytes; an accessor that does says so
    find_members();
    if (auto trouble = find_obstacle()) return *trouble;
    for (const MovedIndex& moved : kMovedIndices) move(moved);
    drop_members();
    OlderVersion asset{data_, changes_, outcome_.row, false};
    name_own_attributes(asset);
    store_integers_as_floats(asset);
    add_still_targets(asset);
    split_matrices(asset);
    if (!keeps_chunks_) restate_version(document_, editor_);
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.version = true;
    outcome_.freedom.new_objects = asset.other_objects;
    outcome_.row.what = fmt::format("glTF {}", schema::version_text(schema::kVersion2));
    return std::move(outcome_);
  }

 private:
  void find_members() {
    for (json::NodeId id = 0; id < document_.node_count(); ++id) {
      if (!document_.is_object(id) || data_.graph.type(id) == schema::kNone) continue;
      for (const auto member : document_.members(id)) {
        const std::string_view name = document_.key(member.key_id);
        const schema::Property* property =
            data_.graph.set().find_property(data_.graph.type(id), name);
        if (property == nullptr || property->since <= schema::kVersion2) continue;
        if (name == "chunk" && needs_chunk(id)) {
          keeps_chunks_ = true;
          continue;
        }
        members_.push_back({id, member.value, name});
        std::fill(dropped_.begin() + member.value, dropped_.begin() + document_.next(member.value),
                  true);
      }
    }
  }

  std::optional<Error> find_obstacle() const {
    for (const LaterMember& member : members_) {
      const std::string pointer = printable(data_.pointer(member.value));
      if (member.name == "externalAsset") {
        return Error{pointer + " shows another asset, which --flatten copies"};
      }
      if (member.name == "chunk" && !has_data_without_chunk(member.object)) {
        return Error{pointer + " is not the number of a BIN chunk"};
      }
    }
    for (const graph::Use& use : data_.graph.uses()) {
      if (!dropped_[use.target] || dropped_[use.at.node]) continue;
      return Error{fmt::format("{} refers to {}, which glTF {} does not have",
                               printable(data_.graph.tree().pointer(use.at)),
                               printable(data_.pointer(use.target)),
                               schema::version_text(schema::kVersion2))};
    }
    return std::nullopt;
  }

  std::optional<container::Chunk> chunk_of(json::NodeId buffer) const {
    return model::chunk_of(data_.input.asset.container(), document_, buffer,
                           data_.graph.tree().position(buffer), schema::stated_version(document_));
  }

  // The container step stores the bytes of a chunk that is not the one of buffer 0.
  bool needs_chunk(json::NodeId buffer) const {
    const auto chunk = chunk_of(buffer);
    const auto& bin = data_.input.asset.container().bin;
    const bool is_implied =
        chunk && bin && chunk->offset == bin->offset && data_.graph.tree().position(buffer) == 0;
    return chunk && !is_implied;
  }

  bool has_data_without_chunk(json::NodeId buffer) const {
    return document_.holds(buffer, "uri") || chunk_of(buffer);
  }

  // The custom before it was a member.
  void move(const MovedIndex& moved) {
    const json::NodeId object = model::object_member(document_, document_.root(), moved.object);
    const json::NodeId value = document_.find(object, moved.name);
    if (value == json::kNoNode) return;
    const json::NodeId extras = document_.find(object, "extras");
    const std::string text(document_.raw(value));
    if (extras == json::kNoNode) {
      editor_.append_member(object, "extras", fmt::format(R"({{"{}":{}}})", moved.name, text));
    } else if (document_.is_object(extras) && !document_.holds(extras, moved.name)) {
      editor_.append_member(extras, moved.name, text);
    } else {
      lose(fmt::format("{}.{}", moved.object, moved.name));
    }
  }

  void lose(std::string what) { outcome_.row.losses.push_back({std::move(what), 0, 0, {}}); }

  static bool is_moved(std::string_view name) {
    return std::any_of(kMovedIndices.begin(), kMovedIndices.end(),
                       [&](const MovedIndex& moved) { return moved.name == name; });
  }

  void drop_members() {
    std::map<std::string_view, std::uint64_t> dropped;
    for (const LaterMember& member : members_) {
      editor_.remove(member.object, member.value - 1);
      if (member.name == "chunk" || is_moved(member.name)) continue;
      const bool is_list = member.object == document_.root() && document_.is_array(member.value);
      dropped[member.name] += is_list ? document_.array_size(member.value) : 1;
    }
    for (const auto& [name, count] : dropped) {
      lose(fmt::format("{} ({})", name, report::counted(count, "object")));
    }
    note_unused();
  }

  // Objects to which only dropped members refer.
  void note_unused() {
    std::vector<json::NodeId> targets;
    for (const graph::Use& use : data_.graph.uses()) {
      if (dropped_[use.at.node] && !dropped_[use.target]) targets.push_back(use.target);
    }
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    for (const json::NodeId target : targets) {
      const auto users = data_.graph.users(target);
      const auto is_kept = [this](const graph::Use& use) { return !dropped_[use.at.node]; };
      if (std::any_of(users.begin(), users.end(), is_kept) || keeps_a_use(target)) continue;
      outcome_.row.left.push_back({data_.pointer(target), "has no use now (--prune removes it)"});
    }
  }

  // A moved index counts as a use.
  bool keeps_a_use(json::NodeId target) const {
    const graph::Tree& tree = data_.graph.tree();
    const auto users = data_.graph.users(target);
    return std::any_of(users.begin(), users.end(), [&](const graph::Use& use) {
      return tree.is_member(use.at.node) && is_moved(tree.name(use.at.node));
    });
  }

  StepData data_;
  const json::Document& document_;
  StepChanges changes_;
  json::Editor& editor_;
  std::vector<LaterMember> members_;
  std::vector<bool> dropped_;  ///< by node: whether it is a member of these, or in one
  bool keeps_chunks_ = false;  ///< the container step restates the version
  StepOutcome outcome_;
};

Result<StepOutcome> to_older_version(const StepInput& input) {
  if (schema::stated_version(input.asset.document()) <= schema::kVersion2) return StepOutcome();
  return OlderVersionStep(input).run();
}

}  // namespace

void restate_version(const json::Document& document, json::Editor& editor) {
  const json::NodeId asset = document.find(document.root(), "asset");
  const std::string text = schema::version_text(schema::kVersion2);
  editor.replace_scalar(document.find(asset, "version"), fmt::format(R"("{}")", text));
  remove_member(document, editor, asset, "minVersion");
}

StepDescription older_version_step();
StepDescription older_version_step() {
  return {"version",
          "makes an asset of glTF 2.1 one of glTF 2.0",
          "the picture, and thumbnails as extras",
          "members of glTF 2.1 without an effect on the picture; types and names of attributes",
          [](const ConvertOptions& options) { return !options.later.gltf.empty(); },
          to_older_version};
}

}  // namespace gltfx::steps
