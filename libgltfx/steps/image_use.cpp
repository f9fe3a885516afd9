// SPDX-License-Identifier: Apache-2.0
#include "steps/image_use.hpp"

#include <numeric>
#include <set>
#include <string_view>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/texture.hpp"

namespace gltfx::steps {
namespace {

using model::RootArray;
using schema::SlotUse;

/// Finds references to images and textures that are not texture slots of a schema.
class OtherUserFinder {
 public:
  OtherUserFinder(const model::Asset& asset, const graph::Graph& graph)
      : asset_(asset), document_(asset.document()), graph_(graph) {}

  OtherUsers find() {
    for (const SlotUse& use : graph_.checked().slots) {
      if (use.slot != nullptr) known_.insert(document_.find(use.texture_info, "index"));
    }
    for (const json::NodeId texture : asset_.elements(RootArray::textures)) note_sources(texture);
    find_in(RootArray::images, found_.of_images);
    find_in(RootArray::textures, found_.of_textures);
    for (const json::NodeId object : graph_.unknown_extensions()) guess(object);
    return std::move(found_);
  }

 private:
  void note_sources(json::NodeId texture) {
    if (texture == json::kNoNode) return;
    known_.insert(document_.find(texture, "source"));
    const json::NodeId extensions = model::object_member(document_, texture, "extensions");
    if (extensions == json::kNoNode) return;
    for (const auto member : document_.members(extensions)) {
      known_.insert(document_.find(member.value, "source"));
    }
  }

  void find_in(RootArray array, std::map<std::uint32_t, std::string>& found) {
    const auto& elements = asset_.elements(array);
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
      if (elements[i] == json::kNoNode) continue;
      for (const graph::Use& use : graph_.users(elements[i])) {
        if (use.kind != graph::UseKind::index || known_.contains(use.at.node)) continue;
        found.try_emplace(i, graph_.tree().pointer(use.at));
        break;
      }
    }
  }

  void guess(json::NodeId object) {
    for (json::NodeId id = object; id < document_.next(object); ++id) {
      if (document_.kind(id) != json::Kind::key) continue;
      const std::string name = lower_case(document_.key(document_.node(id).next));
      const bool image = name == "source" || name.find("image") != name.npos;
      const bool texture = name == "index" || name.find("texture") != name.npos;
      if (!image && !texture) continue;
      auto& found = image ? found_.of_images : found_.of_textures;
      const RootArray array = image ? RootArray::images : RootArray::textures;
      const auto note = [&](double number) {
        const auto index = asset_.index(number, array);
        if (index) found.try_emplace(*index, graph_.tree().pointer(id + 1));
      };
      if (document_.is_number(id + 1)) note(document_.number(id + 1).value);
      if (document_.kind(id + 1) != json::Kind::number_array) continue;
      for (json::NumberCursor at(document_, id + 1); at.valid(); at.advance()) {
        note(at.number().value);
      }
    }
  }

  const model::Asset& asset_;
  const json::Document& document_;
  const graph::Graph& graph_;
  std::unordered_set<json::NodeId> known_;  ///< index values of slots and sources
  OtherUsers found_;
};

/// Properties of all slots that use the images of one group.
struct Tally {
  std::set<ImageClass> kinds;
  bool alpha_alone = false;  ///< a slot reads nothing but alpha
  std::set<float> cutoffs;
  bool blends = false;
  std::string other;  ///< a pointer to another user
};

codec::Wrap wrap_of(model::Wrap wrap) {
  if (wrap == model::Wrap::repeat) return codec::Wrap::repeat;
  return wrap == model::Wrap::clamp_to_edge ? codec::Wrap::clamp : codec::Wrap::mirror;
}

// If slots differ, repeat has priority, then mirror.
codec::Wrap stronger(codec::Wrap one, codec::Wrap other) {
  if (one == codec::Wrap::repeat || other == codec::Wrap::repeat) return codec::Wrap::repeat;
  return one == codec::Wrap::mirror ? one : other;
}

class UseReader {
 public:
  UseReader(const model::Asset& asset, const graph::Graph& graph,
            const std::vector<std::size_t>& groups, std::size_t count)
      : asset_(asset),
        document_(asset.document()),
        graph_(graph),
        groups_(groups),
        uses_(count),
        tallies_(count) {
    for (const json::NodeId texture : asset.elements(RootArray::textures)) {
      textures_.push_back(texture == json::kNoNode ? model::Texture()
                                                   : model::read_texture(asset, texture));
    }
  }

  void take(const SlotUse& use) {
    const auto index = asset_.index(use.texture_info, "index", RootArray::textures);
    if (!index || use.slot == nullptr) return;
    const model::Texture& texture = textures_[*index];
    for (const std::uint32_t image : texture.images) {
      const std::size_t group = groups_[image];
      add(use, uses_[group], tallies_[group]);
      uses_[group].wrap_u = stronger(uses_[group].wrap_u, wrap_of(texture.sampler.wrap_s));
      uses_[group].wrap_v = stronger(uses_[group].wrap_v, wrap_of(texture.sampler.wrap_t));
    }
  }

  void take(const OtherUsers& others) {
    for (const auto& [image, pointer] : others.of_images) note_other(image, pointer);
    for (const auto& [texture, pointer] : others.of_textures) {
      for (const std::uint32_t image : textures_[texture].images) note_other(image, pointer);
    }
  }

  std::vector<ImageUse> finish() {
    for (std::size_t i = 0; i < uses_.size(); ++i) judge(uses_[i], tallies_[i]);
    return std::move(uses_);
  }

 private:
  void note_other(std::uint32_t image, const std::string& pointer) {
    std::string& other = tallies_[groups_[image]].other;
    if (other.empty()) other = pointer;
  }

  void add(const SlotUse& use, ImageUse& to, Tally& tally) {
    const std::string& channels = use.slot->channels;
    const bool has_colors = channels.find_first_of("rgb") != channels.npos;
    if (has_colors) tally.kinds.insert(kind_of(use));
    if (channels.find('a') == channels.npos) return;
    if (!has_colors) tally.alpha_alone = true;
    if (!schema::has_coverage(graph_.set(), use)) {
      to.alpha = true;
      return;
    }
    const json::NodeId material = graph_.tree().root_element(use.texture_info);
    const std::string mode = model::string_member(document_, material, "alphaMode");
    if (mode != "MASK" && mode != "BLEND") return;
    to.alpha = to.coverage = true;
    if (mode == "BLEND") {
      tally.blends = true;
      return;
    }
    constexpr double kDefaultCutoff = 0.5;
    tally.cutoffs.insert(static_cast<float>(
        model::number_member(document_, material, "alphaCutoff").value_or(kDefaultCutoff)));
  }

  static ImageClass kind_of(const SlotUse& use) {
    if (use.slot->srgb) return ImageClass::color;
    const std::string_view pointer = use.pointer;
    const bool normal = model::is_normal_map(pointer.substr(pointer.rfind('/') + 1));
    return normal ? ImageClass::normal : ImageClass::data;
  }

  static void judge(ImageUse& use, const Tally& tally) {
    if (!tally.blends && tally.cutoffs.size() == 1) {
      const float cutoff = *tally.cutoffs.begin();
      use.alpha_cutoff = cutoff > 0 && cutoff <= 1 ? cutoff : 0;
    }
    if (!tally.other.empty()) {
      use.doubt = fmt::format("{} uses it, but no schema describes how", printable(tally.other));
    } else if (tally.kinds.size() > 1) {
      use.doubt = tally.kinds.contains(ImageClass::color) ? "it is used as color and as data"
                                                          : "it is used as normals and as data";
    } else if (!tally.kinds.empty()) {
      use.kind = *tally.kinds.begin();
    } else if (tally.alpha_alone) {
      use.kind = ImageClass::data;
    } else {
      use.doubt = "no texture slot uses it";
    }
  }

  const model::Asset& asset_;
  const json::Document& document_;
  const graph::Graph& graph_;
  const std::vector<std::size_t>& groups_;
  std::vector<ImageUse> uses_;  ///< by group
  std::vector<Tally> tallies_;  ///< by group
  std::vector<model::Texture> textures_;
};

}  // namespace

OtherUsers other_users(const model::Asset& asset, const graph::Graph& graph) {
  return OtherUserFinder(asset, graph).find();
}

std::vector<ImageUse> image_uses(const model::Asset& asset, const graph::Graph& graph,
                                 const OtherUsers& others, const std::vector<std::size_t>& groups,
                                 std::size_t count) {
  UseReader reader(asset, graph, groups, count);
  for (const SlotUse& use : graph.checked().slots) reader.take(use);
  reader.take(others);
  return reader.finish();
}

std::vector<ImageUse> image_uses(const model::Asset& asset, const graph::Graph& graph) {
  std::vector<std::size_t> groups(asset.count(model::RootArray::images));
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  return image_uses(asset, graph, other_users(asset, graph), groups, groups.size());
}

}  // namespace gltfx::steps
