// SPDX-License-Identifier: Apache-2.0
/// The filled texture slots of an asset with all values that determine whether their images are
/// suitable, and where their texels are on a surface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "model/resource_data.hpp"
#include "rules/context.hpp"
#include "rules/core/animated.hpp"

namespace gltfx::validate {

/// The set of texture coordinates and its transform (KHR_texture_transform, or another extension of
/// the texture info with such members).
struct UvMapping {
  double texcoord = 0;
  double rotation = 0;  ///< radians
  std::array<double, 2> offset{0, 0}, scale{1, 1};

  /// The first difference, by its name in the text; empty: none.
  std::string_view difference(const UvMapping& other) const;
};

UvMapping read_uv_mapping(const json::Document& document, json::NodeId texture_info);

/// A set of the channels R, G, B, A.
class ChannelSet {
 public:
  constexpr ChannelSet() = default;
  /// The channels named in a text such as "gb".
  explicit ChannelSet(std::string_view names);
  constexpr bool has(char name) const { return (bits_ & bit(name)) != 0; }
  constexpr void remove(char name) { bits_ &= static_cast<std::uint8_t>(~bit(name)); }
  constexpr bool empty() const { return bits_ == 0; }
  /// Number of channels among R, G and B.
  int colors() const { return has('r') + has('g') + has('b'); }
  constexpr bool overlaps(ChannelSet other) const { return (bits_ & other.bits_) != 0; }
  /// "R", "G and B" and so on.
  std::string text() const;

 private:
  static constexpr std::uint8_t bit(char name) {
    return name == 'r' ? 1 : name == 'g' ? 2 : name == 'b' ? 4 : 8;
  }
  std::uint8_t bits_ = 0;
};

/// One filled slot. Contains numbers, and nodes and texts that live as long as the Context.
struct TextureSlot {
  const schema::SlotUse* use = nullptr;
  json::NodeId material = json::kNoNode;  ///< the material it belongs to, or kNoNode
  std::uint32_t material_index = 0;       ///< index of `material`, if there is one
  std::string_view property;              ///< "baseColorTexture"
  std::uint32_t texture = 0;              ///< index
  std::optional<std::uint32_t> sampler;   ///< index
  std::vector<std::uint32_t> images;      ///< images of the texture, its own source first
  /// Channels that are read. Without alpha if it is only coverage and alphaMode ignores it.
  ChannelSet channels;
  /// Channels that no factor of 0 hides.
  ChannelSet effective;
  /// The factor that hides all channels, or empty: "clearcoatFactor".
  std::string_view hidden_by;
  bool coverage = false;  ///< alpha, if present, is coverage by the material's alphaMode
  bool srgb = false;      ///< whether R, G and B are sRGB
  bool normal_map = false;
};

/// All slots that refer to at least one image, in the order of the schema walk.
std::vector<TextureSlot> texture_slots(const Context& context, const Animated& animated);

/// Pointer of the member `member` of the slot's owner: "/materials/3/normalScale".
std::string sibling_pointer(const TextureSlot& slot, std::string_view member);

/// The numbers of `member` of the slot's owner, or of its default; empty if it has neither, or may
/// be misspelt.
std::vector<double> factor_of(const Context& context, const schema::SlotUse& use,
                              std::string_view member);

/// Whether an object has a member that is unknown for its type. The member is reported, and may be
/// a misspelt name of another one: then absent members may not really be absent.
bool has_unknown_member(const Context& context, schema::TypeId type, json::NodeId object);

/// "image 3 ('wood.png')": the label by which artists identify an image.
std::string image_label(const Context& context, std::uint32_t image);

/// A finding on a texture slot.
void report_slot(const Context& context, Sink& sink, const TextureSlot& slot, Code code,
                 std::string message, std::string help = {},
                 std::optional<Severity> severity = std::nullopt);

}  // namespace gltfx::validate
