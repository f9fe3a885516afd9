// SPDX-License-Identifier: Apache-2.0
// Nodes in place of the instances of a mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/name_list.hpp"
#include "graph/extensions.hpp"
#include "model/elements.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {
namespace {

using target::Repair;

// JSON takes ten times the bytes of an instance, and nodes may share them.
constexpr std::uint64_t kMostInstances = std::uint64_t{1} << 18U;

/// One attribute of instances: a member of a node.
struct InstanceMember {
  std::string_view attribute, member;
  unsigned components;
};
constexpr std::array<InstanceMember, 3> kMembers{
    {{"TRANSLATION", "translation", 3}, {"ROTATION", "rotation", 4}, {"SCALE", "scale", 3}}};

class InstanceStep {
 public:
  InstanceStep(const StepInput& input, std::string_view extension)
      : data_(input), extension_(extension), editor_(data_.document), additions_(data_.document) {}

  Result<StepOutcome> run() {
    find_pointers();
    for (const model::Node& node : data_.views.nodes) {
      if (node.object == json::kNoNode) continue;
      const json::NodeId object = data_.document.find(node.extensions, extension_);
      if (object == json::kNoNode) continue;
      if (std::string why = convert(node, object); !why.empty()) {
        outcome_.row.refused.push_back({data_.pointer(node.object), std::move(why)});
      }
    }
    if (outcome_.row.refused.empty()) {
      for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
        change::NameList names(data_.document, member);
        names.remove(extension_);
        names.apply(editor_);
      }
    }
    outcome_.change.edits = editor_.take();
    outcome_.change.additions = std::move(additions_);
    outcome_.freedom.new_objects = true;
    if (nodes_ == 0) return std::move(outcome_);
    outcome_.row.what = fmt::format("{} of {}", report::counted(instances_, "instance"),
                                    report::counted(nodes_, "node"));
    return std::move(outcome_);
  }

 private:
  using Values = std::optional<model::AccessorData>;

  // Nodes that pointers refer to, directly or into them, and those with animated weights.
  void find_pointers() {
    const graph::Tree& tree = data_.graph.tree();
    const json::NodeId list = data_.document.find(data_.document.root(), "nodes");
    for (const graph::Use& use : data_.graph.uses()) {
      if (use.kind != graph::UseKind::pointer) continue;
      const json::NodeId element = tree.root_element(use.target);
      const bool inside = element != json::kNoNode && element != use.target;
      if (inside && tree.parent(element) == list) moved_.insert(element);
    }
    for (const model::Animation& animation : data_.views.animations) {
      for (const model::AnimationChannel& channel : animation.channels) {
        if (channel.path != model::AnimationPath::weights || !channel.node) continue;
        moved_.insert(data_.views.nodes[*channel.node].object);
      }
    }
  }

  // Why a node is not converted; empty: it is.
  std::string convert(const model::Node& node, json::NodeId object) {
    std::array<Values, kMembers.size()> values;
    std::uint64_t count = 1;
    if (std::string why = find_obstacle(node, object); !why.empty()) return why;
    if (std::string why = open(object, values, count); !why.empty()) return why;
    if (instances_ + count > kMostInstances) {
      return fmt::format("the asset has more than {} instances", kMostInstances);
    }
    std::string children;
    std::vector<std::string> texts;
    for (std::uint64_t i = 0; i < count; ++i) {
      std::string text = fmt::format(R"({{"mesh":{})", *node.mesh);
      if (node.weights != json::kNoNode) {
        text += fmt::format(R"(,"weights":{})", data_.document.raw(node.weights));
      }
      for (std::size_t k = 0; k < kMembers.size(); ++k) {
        if (!values[k]) continue;
        const std::string array = text_of(model::element_at(*values[k], i), kMembers[k]);
        if (array.empty()) return "an instance has values that are not numbers";
        text += fmt::format(R"(,"{}":{})", kMembers[k].member, array);
      }
      texts.push_back(text + "}");
    }
    for (std::string& text : texts) {
      const std::uint64_t index = additions_.add_element("nodes", std::move(text));
      children += fmt::format("{}{}", children.empty() ? "" : ",", index);
    }
    declare(node, object, children);
    ++nodes_;
    instances_ += count;
    return {};
  }

  std::string find_obstacle(const model::Node& node, json::NodeId object) const {
    if (!node.mesh) return "it has no mesh";
    if (node.skin) return "it has a skin";
    if (moved_.contains(node.object)) return "an animation or a pointer refers to its members";
    const bool alone = data_.document.object_size(node.extensions) == 1;
    if (!alone) return "it has other extensions, which may be about its instances";
    const json::NodeId attributes = data_.document.find(object, "attributes");
    if (attributes == json::kNoNode || !data_.document.is_object(attributes)) {
      return "its instances cannot be read";
    }
    for (const auto member : data_.document.members(attributes)) {
      const std::string_view name = data_.document.key(member.key_id);
      const bool known = std::any_of(kMembers.begin(), kMembers.end(),
                                     [&](const auto& one) { return one.attribute == name; });
      if (!known) return fmt::format("{} of its instances would be lost", gltfx::quoted(name));
    }
    if (node.children == json::kNoNode) return {};
    const bool list = data_.document.kind(node.children) == json::Kind::number_array ||
                      data_.document.is_array(node.children);
    return list ? std::string() : "its children cannot be read";
  }

  std::string open(json::NodeId object, std::array<Values, kMembers.size()>& values,
                   std::uint64_t& count) const {
    const json::NodeId attributes = data_.document.find(object, "attributes");
    bool first = true;
    for (std::size_t k = 0; k < kMembers.size(); ++k) {
      if (data_.document.find(attributes, kMembers[k].attribute) == json::kNoNode) continue;
      const auto accessor =
          data_.asset.index(attributes, kMembers[k].attribute, model::RootArray::accessors);
      if (accessor) {
        values[k] =
            model::AccessorData::open(data_.asset, data_.views, data_.resources,
                                      data_.views.accessors[*accessor], model::Malformed::unusable);
      }
      if (!values[k] || values[k]->components() != kMembers[k].components) {
        return "its instances cannot be read";
      }
      // Their number would have no limit.
      if (values[k]->implied()) return "its instances are not stored";
      if (!first && values[k]->count() != count) return "its attributes differ in their count";
      count = values[k]->count();
      first = false;
    }
    return {};
  }

  // A JSON array; empty: a value is not finite.
  static std::string text_of(std::vector<float> values, const InstanceMember& member) {
    if (!std::all_of(values.begin(), values.end(), [](float each) { return std::isfinite(each); }))
      return {};
    if (member.components == 4) make_unit(values);
    std::string text = "[";
    for (const float value : values) text += fmt::format("{}{}", text.size() > 1 ? "," : "", value);
    return text + "]";
  }

  // Integers give lengths that are only about 1.
  static void make_unit(std::vector<float>& values) {
    constexpr double kRounding = 1e-6;
    double square = 0;
    for (const float value : values) square += std::pow(static_cast<double>(value), 2);
    if (!(square > 0) || std::abs(square - 1) < kRounding) return;
    for (float& value : values) {
      value = static_cast<float>(static_cast<double>(value) / std::sqrt(square));
    }
  }

  void declare(const model::Node& node, json::NodeId object, const std::string& children) {
    const json::Document& document = data_.document;
    if (document.find(object, "extras") != json::kNoNode) {
      outcome_.row.losses.push_back(
          {fmt::format("the extras of the instances of {}", data_.pointer(node.object)), 0, 0, {}});
    }
    remove_extension(document, editor_, node.object, extension_);
    remove_member(document, editor_, node.object, "mesh");
    remove_member(document, editor_, node.object, "weights");
    if (node.children == json::kNoNode) {
      return editor_.append_member(node.object, "children", fmt::format("[{}]", children));
    }
    std::string old(document.raw(node.children));
    old.resize(old.find_last_not_of(" \t\r\n]") + 1);
    const bool was_empty = old.ends_with('[');
    editor_.replace(node.object, node.children,
                    fmt::format("{}{}{}]", old, was_empty ? "" : ",", children));
  }

  const StepData data_;
  const std::string_view extension_;
  json::Editor editor_;
  change::Additions additions_;
  std::set<json::NodeId> moved_;  ///< nodes
  StepOutcome outcome_;
  std::uint64_t nodes_ = 0, instances_ = 0;
};

Result<StepOutcome> write_instances(const StepInput& input) {
  const auto& extensions = input.repairs.features(Repair::instance_nodes);
  if (extensions.empty()) return StepOutcome{};
  return InstanceStep(input, extensions.begin()->first).run();
}

}  // namespace

StepDescription instances_step();
StepDescription instances_step() {
  return {"instances",
          "writes instances of meshes as nodes for a target",
          "the transforms of all instances, and indices of nodes",
          "nothing",
          [](const ConvertOptions&) { return false; },
          write_instances,
          {Repair::instance_nodes}};
}

}  // namespace gltfx::steps
