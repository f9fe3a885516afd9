// SPDX-License-Identifier: Apache-2.0
// A center that all positions are relative to (CESIUM_RTC) becomes the translation of new nodes
// above the roots of the scenes. Applications that use the extension, those of 3D Tiles, add the
// center after the rotation from Y up, as in glTF, to Z up: so (x, y, z) becomes (x, z, -y).
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "json/writer.hpp"
#include "model/node.hpp"
#include "steps/upgrade/conversion.hpp"

namespace gltfx::upgrade {
namespace {

constexpr double kMostRounding = 0.001;  // metres

/// One scene with roots, and the node above them.
struct Scene {
  json::NodeId object = json::kNoNode;
  json::NodeId roots = json::kNoNode;
  std::uint64_t parent = 0;
};

class RootTranslation : public Conversion {
 public:
  Problem reason_to_go(const ConversionContext& context) override {
    if (find(context)) return std::nullopt;
    if (translation_ == "[0,0,0]") return "no effect: center is 0";
    const double rounding = largest_rounding();
    context.action.notes.push_back(
        fmt::format("readers that add it in single precision round positions by up to {} m",
                    number_text(rounding)));
    if (rounding > kMostRounding) context.action.outcome = UpgradeOutcome::unsafe;
    return fmt::format(
        "its center, with Z up, becomes the translation of {} above the scenes",
        parents_.size() == 1 ? "a new node" : fmt::format("{} new nodes", parents_.size()));
  }

  Problem prepare(const ConversionContext& context) override { return find(context); }

  void apply(const ConversionContext& context) override {
    if (translation_ == "[0,0,0]") return;
    const json::Document& document = context.run.document;
    const json::NodeId nodes = document.find(document.root(), "nodes");
    for (const json::NodeId roots : parents_) {
      context.run.editor.append_element(nodes, fmt::format(R"({{"translation":{},"children":{}}})",
                                                           translation_, document.raw(roots)));
    }
    for (const Scene& scene : scenes_) {
      context.run.editor.replace(scene.object, scene.roots, fmt::format("[{}]", scene.parent));
    }
  }

 private:
  // Sets the members, or returns why it cannot be done.
  Problem find(const ConversionContext& context) {
    scenes_.clear();
    parents_.clear();
    center_.clear();
    const json::Document& document = context.run.document;
    const json::NodeId center = context.member("center");
    if (center != json::kNoNode && document.kind(center) == json::Kind::number_array) {
      for (json::NumberCursor at(document, center); at.valid(); at.advance()) {
        center_.push_back(at.number().value);
      }
    }
    if (center_.size() != 3 || !std::isfinite(center_[0] + center_[1] + center_[2])) {
      return "its center is invalid; see 'gltfx validate'";
    }
    translation_ = fmt::format("[{},{},{}]", number_text(center_[0]), number_text(center_[2]),
                               number_text(center_[1] == 0 ? 0 : -center_[1]));
    return find_scenes(context);
  }

  // Scenes with the same list of roots share the new node. A root in two different lists would have
  // two parents.
  Problem find_scenes(const ConversionContext& context) {
    const model::Asset& asset = context.run.asset;
    const json::Document& document = context.run.document;
    std::unordered_map<std::string_view, std::uint64_t> by_roots;
    std::unordered_map<std::uint32_t, std::uint64_t> by_root;
    for (const json::NodeId object : asset.elements(model::RootArray::scenes)) {
      const json::NodeId roots = document.find(object, "nodes");
      if (roots == json::kNoNode) continue;
      if (document.kind(roots) != json::Kind::number_array) return kInvalidRoots;
      const std::uint64_t next = asset.count(model::RootArray::nodes) + parents_.size();
      const auto known = by_roots.emplace(document.raw(roots), next);
      const std::uint64_t parent = known.first->second;
      if (known.second) parents_.push_back(roots);
      scenes_.push_back({object, roots, parent});
      Problem problem;
      model::for_each_index(asset, roots, model::RootArray::nodes,
                            [&](std::uint64_t, std::optional<std::uint32_t> root, Span) {
                              if (!root) problem = kInvalidRoots;
                              if (problem) return;
                              const auto owner = by_root.emplace(*root, parent).first;
                              if (owner->second != parent) problem = kSharedRoots;
                            });
      if (problem) return problem;
    }
    return scenes_.empty() ? Problem("no scene has a node") : std::nullopt;
  }

  // Half the distance between adjacent single-precision numbers at the largest coordinate.
  double largest_rounding() const {
    double largest = 0;
    for (const double one : center_) largest = std::max(largest, std::abs(one));
    if (largest > std::numeric_limits<float>::max()) return largest;
    const auto single = static_cast<float>(largest);
    return (std::nextafter(single, std::numeric_limits<float>::infinity()) - single) / 2.0;
  }

  static constexpr const char* kInvalidRoots =
      "the nodes of a scene are invalid; see 'gltfx validate'";
  static constexpr const char* kSharedRoots = "scenes share some of their root nodes";

  std::vector<double> center_;
  std::string translation_;
  std::vector<Scene> scenes_;
  std::vector<json::NodeId> parents_;  ///< lists of roots below the new nodes
};

}  // namespace

std::unique_ptr<Conversion> make_root_translation() { return std::make_unique<RootTranslation>(); }

}  // namespace gltfx::upgrade
