// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_unknown_modes.hpp"

#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prove/leaf_reader.hpp"
#include "prove/soup_lists.hpp"

namespace gltfx::prove {
namespace {

/// A value of a primitive: an attribute, its indices or its mode.
struct PartOfPrimitive {
  Hash128 hash;
  std::string pointer;
  bool position = false;
};

class UnknownMode {
 public:
  /// Nothing: it has a mode of glTF.
  static std::optional<UnknownMode> read(const SurfacePiece& piece) {
    const Side& side = piece.content->side();
    const model::Primitive primitive = model::read_primitive(side.asset(), piece.primitive);
    const json::NodeId mode = side.document().find(piece.primitive, "mode");
    if (primitive.mode || mode == json::kNoNode || primitive.targets_are_broken) {
      return std::nullopt;
    }
    UnknownMode reader(*piece.content);
    reader.parts_["mode"] = {hash_json(side.document(), mode), side.pointer(mode), false};
    reader.add(side.document().find(piece.primitive, "indices"), "indices", false);
    reader.add(primitive.attributes, "");
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
      reader.add(model::read_attributes(side.asset(), primitive.targets[i]),
                 fmt::format(" of target {}", i));
    }
    return reader;
  }

  /// By name.
  const std::map<std::string, PartOfPrimitive>& parts() const { return parts_; }
  bool readable() const { return readable_; }

 private:
  explicit UnknownMode(const Content& content) : content_(content) {}

  void add(const std::vector<model::Attribute>& attributes, const std::string& target) {
    for (const model::Attribute& each : attributes) {
      add(each.value, printable(std::string(each.name).substr(0, 80)) + target,
          each.semantic.kind == model::SemanticKind::position);
    }
  }

  void add(json::NodeId value, const std::string& name, bool position) {
    if (value == json::kNoNode) return;
    const Side& side = content_.side();
    const Link* link = side.link(value);
    bool readable = false;
    if (link != nullptr && link->target != json::kNoNode) {
      parts_[name] = {content_.elements(side.index(link->target), readable), side.pointer(value),
                      position};
    }
    readable_ = readable_ && readable;
  }

  const Content& content_;
  std::map<std::string, PartOfPrimitive> parts_;
  bool readable_ = true;
};

bool same_materials(const Comparison& all, const SurfacePiece& ours, const SurfacePiece& theirs) {
  const auto item = [](const SurfacePiece& piece) {
    return piece.material ? ItemId{piece.content->list("/materials"), *piece.material} : ItemId{};
  };
  return all.match.same(item(ours), item(theirs));
}

Change change_of_part(const SurfacePair& pair, const std::string& name, const PartOfPrimitive* ours,
                      const PartOfPrimitive* theirs) {
  const bool both = ours != nullptr && theirs != nullptr;
  const bool of_elements = name == "mode" || name == "indices";
  const std::string_view kind = !both            ? "geometry.attribute"
                                : of_elements    ? "geometry.elements"
                                : ours->position ? "geometry.position"
                                                 : "geometry.custom";
  const std::string_view what = both              ? "has other values"
                                : ours != nullptr ? "was removed"
                                                  : "was added";
  Change change = change_of(pair, kind, fmt::format("{} {}", name, what));
  change.old_pointer.reset();
  change.new_pointer.reset();
  if (ours != nullptr) change.old_pointer = ours->pointer;
  if (theirs != nullptr) change.new_pointer = theirs->pointer;
  return change;
}

}  // namespace

bool compare_unknown_modes(const Comparison& all, const SurfacePair& pair,
                           std::vector<Change>& changes) {
  if (pair.ours.size() != pair.theirs.size()) return false;
  std::vector<Change> found;
  for (std::size_t i = 0; i < pair.ours.size(); ++i) {
    const auto here = UnknownMode::read(pair.ours[i]);
    const auto there = UnknownMode::read(pair.theirs[i]);
    if (!here || !there || !same_materials(all, pair.ours[i], pair.theirs[i])) return false;
    if (!here->readable() && !there->readable()) return false;
    if (here->readable() != there->readable()) {
      found.push_back(change_of(
          pair, "geometry.elements",
          fmt::format("can be read in the {} asset only", here->readable() ? "old" : "new")));
      continue;
    }
    for (const auto& [name, part] : here->parts()) {
      const auto other = there->parts().find(name);
      if (other == there->parts().end()) {
        found.push_back(change_of_part(pair, name, &part, nullptr));
      } else if (part.hash != other->second.hash) {
        found.push_back(change_of_part(pair, name, &part, &other->second));
      }
    }
    for (const auto& [name, part] : there->parts()) {
      if (!here->parts().contains(name)) {
        found.push_back(change_of_part(pair, name, nullptr, &part));
      }
    }
  }
  std::move(found.begin(), found.end(), std::back_inserter(changes));
  return true;
}

}  // namespace gltfx::prove
