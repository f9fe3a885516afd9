// SPDX-License-Identifier: Apache-2.0
#include "model/instancing.hpp"

#include <algorithm>

#include "base/checked.hpp"
#include "model/elements.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::string_view kExtension = "EXT_mesh_gpu_instancing";
constexpr std::size_t kBlock = 1024;

template <std::size_t N>
std::array<double, N> wide(const std::array<float, N>& from) {
  std::array<double, N> to{};
  std::transform(from.begin(), from.end(), to.begin(),
                 [](float each) { return static_cast<double>(each); });
  return to;
}

class InstanceReader {
 public:
  InstanceReader(const Asset& asset, const Views& views, const ResourceData& resources,
                 json::NodeId attributes)
      : asset_(asset), views_(views), resources_(resources), attributes_(attributes) {}

  // Nothing: attributes are missing or malformed.
  std::optional<std::uint64_t> count() {
    const bool opened = open("TRANSLATION", 3, translations_) && open("ROTATION", 4, rotations_) &&
                        open("SCALE", 3, scales_);
    // Without any of the three, all copies have the same place.
    return opened ? std::optional(count_.value_or(1)) : std::nullopt;
  }

  Instancing read(MemoryBudget& budget) {
    Instancing result;
    const auto copies = count();
    result.too_large = copies && !budget.take(checked_mul(*copies, sizeof(Affine)));
    result.readable = copies && !result.too_large;
    if (!result.readable) return result;
    result.transforms.reserve(static_cast<std::size_t>(*copies));
    for (std::uint64_t first = 0; first < *copies; first += kBlock) {
      const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, *copies - first));
      add(first, size, result.transforms);
    }
    return result;
  }

 private:
  // False when the attribute is present but unusable, or of another length than the previous ones.
  bool open(std::string_view name, unsigned components, std::optional<ElementBlocks>& to) {
    if (asset_.document().find(attributes_, name) == json::kNoNode) return true;
    const auto accessor = asset_.index(attributes_, name, RootArray::accessors);
    if (!accessor) return false;
    auto data = AccessorData::open(asset_, views_, resources_, views_.accessors[*accessor],
                                   Malformed::unusable);
    if (!data || data->components() != components) return false;
    if (count_.value_or(data->count()) != data->count()) return false;
    count_ = data->count();
    to.emplace(*std::move(data));
    return true;
  }

  void add(std::uint64_t first, std::size_t count, std::vector<Affine>& transforms) {
    Vectors<3> translations(count, {0, 0, 0});
    Vectors<4> rotations(count, {0, 0, 0, 1});
    Vectors<3> scales(count, {1, 1, 1});
    if (translations_) translations_->read(first, translations);
    if (rotations_) rotations_->read(first, rotations);
    if (scales_) scales_->read(first, scales);
    for (std::size_t i = 0; i < count; ++i) {
      transforms.push_back(
          Affine::from_parts(wide(translations[i]), wide(rotations[i]), wide(scales[i])));
    }
  }

  const Asset& asset_;
  const Views& views_;
  const ResourceData& resources_;
  json::NodeId attributes_;
  std::optional<std::uint64_t> count_;
  std::optional<ElementBlocks> translations_, rotations_, scales_;
};

json::NodeId instancing_of(const Asset& asset, const Node& node) {
  if (node.extensions == json::kNoNode) return json::kNoNode;
  return object_member(asset.document(), node.extensions, kExtension);
}

}  // namespace

json::NodeId instance_attributes(const Asset& asset, const Node& node) {
  return object_member(asset.document(), instancing_of(asset, node), "attributes");
}

std::optional<Instancing> read_instancing(const Asset& asset, const Views& views,
                                          const ResourceData& resources, const Node& node,
                                          MemoryBudget& budget) {
  const json::NodeId object = instancing_of(asset, node);
  if (object == json::kNoNode) return std::nullopt;
  const json::NodeId attributes = object_member(asset.document(), object, "attributes");
  return InstanceReader(asset, views, resources, attributes).read(budget);
}

std::optional<std::uint64_t> count_copies(const Asset& asset, const Views& views,
                                          const ResourceData& resources, const Node& node) {
  const json::NodeId object = instancing_of(asset, node);
  if (object == json::kNoNode) return 1;
  const json::NodeId attributes = object_member(asset.document(), object, "attributes");
  return InstanceReader(asset, views, resources, attributes).count();
}

std::optional<Vector3> place_of_copy(const Asset& asset, const Views& views,
                                     const ResourceData& resources, const Node& node) {
  const json::NodeId object = instancing_of(asset, node);
  if (object == json::kNoNode) return std::nullopt;
  const json::NodeId attributes = object_member(asset.document(), object, "attributes");
  const auto accessor = asset.index(attributes, "TRANSLATION", RootArray::accessors);
  if (!accessor) return std::nullopt;
  const auto data =
      AccessorData::open(asset, views, resources, views.accessors[*accessor], Malformed::unusable);
  if (!data || data->components() != 3) return std::nullopt;
  const std::vector<float> place = element_at(*data, data->count() / 2);
  if (place.size() != 3) return std::nullopt;
  return wide(std::array<float, 3>{place[0], place[1], place[2]});
}

}  // namespace gltfx::model
