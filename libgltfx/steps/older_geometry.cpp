// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "json/writer.hpp"
#include "model/accessor_writer.hpp"
#include "model/mesh.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"
#include "steps/older_version.hpp"

namespace gltfx::steps {
namespace {

// Calls `visit(primitive)` for each primitive that is an object.
template <class Visit>
void each_primitive(const StepData& data, const Visit& visit) {
  for (const model::Mesh& mesh : data.views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      if (primitive.node != json::kNoNode) visit(primitive);
    }
  }
}

// Whether a name is an error in any version: it has the beginning of one of the specification.
bool has_known_beginning(std::string_view name) {
  constexpr std::array<std::string_view, 4> kSets{"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"};
  return std::any_of(kSets.begin(), kSets.end(),
                     [&](std::string_view set) { return name.starts_with(set); });
}

/// Gives the keys of objects of attributes another name.
class Renaming {
 public:
  explicit Renaming(OlderVersion& asset) : asset_(asset), document_(asset.data.document) {}

  void run() {
    each_primitive(asset_.data, [this](const model::Primitive& primitive) {
      rename(primitive.attributes_node);
      for (const json::NodeId target : primitive.targets) rename(target);
      const json::NodeId extensions = document_.find(primitive.node, "extensions");
      if (extensions == json::kNoNode || !document_.is_object(extensions)) return;
      for (const auto extension : document_.members(extensions)) {
        rename(document_.find(extension.value, "attributes"));
      }
    });
    if (count_ == 0) return;
    asset_.other_objects = true;
    asset_.row.losses.push_back({fmt::format("the names of {}, which begin with an underscore now",
                                             report::counted(count_, "attribute")),
                                 0,
                                 0,
                                 {}});
  }

 private:
  void rename(json::NodeId attributes) {
    if (attributes == json::kNoNode || !document_.is_object(attributes)) return;
    for (const auto member : document_.members(attributes)) {
      const std::string_view name = document_.key(member.key_id);
      const bool invalid = model::parse_semantic(name).kind == model::SemanticKind::invalid;
      if (!invalid || has_known_beginning(name)) continue;
      const std::string now = fmt::format("_{}", name);
      if (document_.holds(attributes, now)) {
        asset_.refuse(attributes, fmt::format("has {} as well", now));
        continue;
      }
      asset_.changes.editor.rename(member.key, now);
      ++count_;
    }
  }

  OlderVersion& asset_;
  const json::Document& document_;
  std::uint64_t count_ = 0;
};

// The least integer after which floats leave some out.
constexpr std::uint32_t kExact = std::uint32_t{1} << 24U;

// The same values as floats; nothing: one of them is too large.
std::optional<std::string> as_floats(const model::AccessorData& data) {
  std::string bytes;
  bool fits = true;
  data.visit<std::uint32_t>([&](const std::uint32_t* values, std::size_t elements, std::uint64_t) {
    for (std::size_t i = 0; i < elements * data.components(); ++i) {
      fits = fits && values[i] <= kExact;
      model::append_number(bytes, static_cast<float>(values[i]));
    }
  });
  if (!fits) return std::nullopt;
  return bytes;
}

// Why the elements of an accessor do not become floats, half a sentence.
std::optional<std::string> store_as_floats(OlderVersion& asset, std::uint32_t index) {
  const model::Accessor& accessor = asset.data.views.accessors[index];
  if (accessor.format.normalized) return "has normalized 32-bit integers";
  if (!asset.data.views.usage.accessor(index).only()) {
    return "has 32-bit integers that attributes and other objects share";
  }
  std::optional<model::AccessorData> elements;
  if (std::string why = asset.data.open(index, elements); !why.empty()) return why;
  auto floats = as_floats(*elements);
  if (!floats) return fmt::format("has integers above {}, which floats cannot hold", kExact);
  asset.changes.contents.set(index, {*std::move(floats), elements->count(), false});
  set_number(asset.data.document, asset.changes.editor, accessor.node, "componentType", 5126);
  return std::nullopt;
}

bool has_morph_targets(const model::Primitive& primitive) {
  return !primitive.targets.empty() || primitive.targets_are_broken;
}

}  // namespace

void name_own_attributes(OlderVersion& asset) { Renaming(asset).run(); }

void store_integers_as_floats(OlderVersion& asset) {
  std::set<std::uint32_t> accessors;
  each_primitive(asset.data, [&](const model::Primitive& primitive) {
    for (const model::Attribute& attribute : primitive.attributes) {
      if (attribute.semantic.kind == model::SemanticKind::joints || !attribute.accessor) continue;
      const model::Format& format = asset.data.views.accessors[*attribute.accessor].format;
      if (format.component == model::ComponentType::uint32) accessors.insert(*attribute.accessor);
    }
  });
  std::uint64_t stored = 0;
  for (const std::uint32_t index : accessors) {
    if (auto why = store_as_floats(asset, index)) {
      asset.refuse(asset.data.views.accessors[index].node, *std::move(why));
    } else {
      ++stored;
    }
  }
  if (stored == 0) return;
  asset.other_objects = true;
  asset.row.losses.push_back({fmt::format("the 32-bit integers of {}, which are equal floats now",
                                          report::counted(stored, "accessor")),
                              0,
                              0,
                              {}});
}

void add_still_targets(OlderVersion& asset) {
  const StepData& data = asset.data;
  std::map<std::uint64_t, std::uint64_t> zeros;  // accessors, by count
  for (const model::Mesh& mesh : data.views.meshes) {
    std::size_t most = 0;
    for (const model::Primitive& each : mesh.primitives) most = std::max(most, each.targets.size());
    for (const model::Primitive& each : mesh.primitives) {
      if (most == 0 || each.node == json::kNoNode || has_morph_targets(each)) continue;
      const model::Attribute* position = each.find(model::SemanticKind::position);
      const auto count = position && position->accessor
                             ? data.views.accessors[*position->accessor].count
                             : std::nullopt;
      if (!count) {
        asset.refuse(each.node, "has no positions that a morph target could move");
        continue;
      }
      const auto [zero, is_new] = zeros.try_emplace(*count, 0);
      if (is_new) {
        zero->second = asset.changes.additions.add_element(
            "accessors",
            fmt::format(R"({{"componentType":5126,"count":{},"max":[0,0,0],"min":[0,0,0],)"
                        R"("type":"VEC3"}})",
                        *count));
      }
      std::string targets;
      for (std::size_t i = 0; i < most; ++i) {
        targets += fmt::format(R"({}{{"POSITION":{}}})", i == 0 ? "" : ",", zero->second);
      }
      asset.other_objects = true;
      remove_member(data.document, asset.changes.editor, each.node, "targets");
      asset.changes.editor.append_member(each.node, "targets", fmt::format("[{}]", targets));
    }
  }
}

}  // namespace gltfx::steps
