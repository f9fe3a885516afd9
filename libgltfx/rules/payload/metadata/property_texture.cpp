// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/data_texture.hpp"
#include "rules/payload/metadata/value_scan.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataProperty;
using model::MetadataType;

// Bytes of a value in texels; nothing: it cannot be stored in texels.
std::optional<std::uint64_t> texel_bytes(const MetadataProperty& property) {
  if (property.type == MetadataType::string || property.is_variable()) return std::nullopt;
  if (property.type != MetadataType::boolean) {
    return checked_mul(property.width(), metadata_component_size(property.component));
  }
  return property.width() / 8 + (property.width() % 8 != 0 ? 1 : 0);
}

class PropertyTextureCheck {
 public:
  explicit PropertyTextureCheck(MetadataPhase& phase) : phase_(phase) {}

  void run() {
    for_each_listed(
        phase_, "propertyTextures",
        [&](std::size_t index, json::NodeId, const PropertyUse& use) { check(index, use); });
    read_texels(phase_, std::move(requests_));
    check_primitives();
  }

 private:
  void check(std::size_t index, const PropertyUse& use) {
    const MetadataProperty& property = use.property;
    const DataTexture texture = check_data_texture(phase_, use.value, use.path, false);
    if (!property.is_sound()) return;
    const auto bytes = texel_bytes(property);
    if (!bytes) {
      return report_unstorable(
          phase_, use, "a property texture",
          property.is_variable() ? "its arrays vary in length" : "its type is STRING");
    }
    if (*bytes != texture.channel_count) {
      return report_member(phase_.sink(), phase_.context(), use.path, use.value, "channels",
                           Code::PROPERTY_TEXTURE_CHANNELS_MISMATCH,
                           fmt::format("The number of channels is {}; property {} takes {}.",
                                       texture.channel_count, gltfx::quoted(property.id), *bytes));
    }
    if (!texture.image || texture.channels.empty() || property.type == MetadataType::boolean)
      return;
    const ValueLimits limits = value_limits(phase_, use);
    if (make_value_scan(property, limits, property.width()) == nullptr) return;
    requests_.push_back(
        {*texture.image,
         [this, index, limits, &property, node = use.value, channels = texture.channels](
             const codec::Image& image) { scan(index, property, limits, node, channels, image); },
         use.value, use.path.pointer()});
  }

  void scan(std::size_t index, const MetadataProperty& property, const ValueLimits& limits,
            json::NodeId node, const std::vector<unsigned>& channels, const codec::Image& image) {
    const auto scan = make_value_scan(property, limits, property.width());
    for_each_texel_block(
        image, channels,
        [&](std::span<const std::byte> bytes, std::size_t texels) { scan->add(bytes, texels); });
    with_metadata_path([&](const Path& path) {
      const Path list(path, "propertyTextures");
      const Path texture(list, index);
      const Path properties(texture, "properties");
      report_stored(phase_, Path(properties, property.id), node,
                    describe_values(property, limits, scan->finish(), "texel"));
    });
  }

  // --- texture coordinates of the primitives that use them ---

  void read_sets() {
    const json::Document& document = phase_.document();
    for (const json::NodeId texture : object_list(document, phase_.root, "propertyTextures")) {
      std::vector<std::uint64_t>& sets = sets_.emplace_back();
      const json::NodeId properties = model::object_member(document, texture, "properties");
      if (properties == json::kNoNode) continue;
      for (const auto member : document.members(properties)) {
        const auto set = texcoord_set(document, member.value);
        if (set) sets.push_back(*set);
      }
      std::sort(sets.begin(), sets.end());
      sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    }
  }

  void check_primitives() {
    read_sets();
    for_each_primitive_extension(
        phase_.context(), kMetadataExtension, [&](const ExtensionPlace& place, const Path& path) {
          const auto there = texcoord_sets(phase_.context(), place.host);
          for_each_index(phase_, place.object, path, "propertyTextures", sets_.size(),
                         [&](std::size_t index, json::NodeId list, const Path& at) {
                           check_sets(sets_[index], there, list, at);
                         });
        });
  }

  void check_sets(const std::vector<std::uint64_t>& wanted, const std::vector<std::uint64_t>& there,
                  json::NodeId list, const Path& path) {
    if (!phase_.data.budget.take(wanted.size(), kCostOfName)) return;
    for (const std::uint64_t set : wanted) {
      if (std::binary_search(there.begin(), there.end(), set)) continue;
      return report_missing_texcoord(phase_, set, list, path);
    }
  }

  MetadataPhase& phase_;
  std::vector<TexelRequest> requests_;
  std::vector<std::vector<std::uint64_t>> sets_;  // read by slots, by property texture
};

}  // namespace

void check_property_textures(MetadataPhase& phase) { PropertyTextureCheck(phase).run(); }

}  // namespace gltfx::validate
