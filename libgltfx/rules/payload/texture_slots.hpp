// SPDX-License-Identifier: Apache-2.0
/// The filled texture slots of an asset with all that decides whether their images can serve them,
/// and where their texels come to lie on a surface.
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

/// The set of texture coordinates, and how they are transformed (KHR_texture_transform, or whatever
/// extension of the texture info has such members).
struct UvMapping {
  double texcoord = 0;
  double rotation = 0;  ///< radians
  std::array<double, 2> offset{0, 0}, scale{1, 1};

  /// The first thing that differs, as it is called in the text; empty: nothing does.
  std::string_view difference(const UvMapping& other) const;
};

UvMapping read_uv_mapping(const json::Document& document, json::NodeId texture_info);

/// A set of the channels R, G, B, A.
class ChannelSet {
 public:
  constexpr ChannelSet() = default;
  /// Those named in a text such as "gb".
  explicit ChannelSet(std::string_view names);
  constexpr bool has(char name) const { return (bits_ & bit(name)) != 0; }
  constexpr void remove(char name) { bits_ &= static_cast<std::uint8_t>(~bit(name)); }
  constexpr bool empty() const { return bits_ == 0; }
  /// Number of R, G and B in it.
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

/// One filled slot. Numbers, and nodes and texts that live as long as the Context.
struct TextureSlot {
  const schema::SlotUse* use = nullptr;
  json::NodeId material = json::kNoNode;  ///< the one it belongs to, or kNoNode
  std::uint32_t material_index = 0;       ///< where there is a material
  std::string_view property;              ///< "baseColorTexture"
  std::uint32_t texture = 0;              ///< index
  std::optional<std::uint32_t> sampler;   ///< index
  std::vector<std::uint32_t> images;      ///< what may be shown, the texture's own source first
  /// Channels that are read. Without alpha where `coverage` says so but alphaMode does not.
  ChannelSet channels;
  /// Those of them that a factor of 0 does not hide.
  ChannelSet effective;
  /// The factor that hides all of them, or empty: "clearcoatFactor".
  std::string_view hidden_by;
  bool coverage = false;  ///< alpha, where there is one, is coverage by the material's alphaMode
  bool srgb = false;      ///< how R, G and B are read
  bool normal_map = false;
};

/// All slots that lead to at least one image, in the order in which the schema walk met them.
std::vector<TextureSlot> texture_slots(const Context& context, const Animated& animated);

/// Pointer of the member `member` beside the slot: "/materials/3/normalScale".
std::string sibling_pointer(const TextureSlot& slot, std::string_view member);

/// The numbers of `member` of the slot's owner, or of its default; empty when it has neither, or
/// may have been misspelt.
std::vector<double> factor_of(const Context& context, const schema::SlotUse& use,
                              std::string_view member);

/// Whether an object has a member that its type does not know. It has been reported, and may be
/// another one misspelt: what is missing beside it is not known to be missing.
bool has_unknown_member(const Context& context, schema::TypeId type, json::NodeId object);

/// "image 3 ('wood.png')": what an artist knows an image by.
std::string image_label(const Context& context, std::uint32_t image);

/// A finding on a texture slot.
void report_slot(const Context& context, Sink& sink, const TextureSlot& slot, Code code,
                 std::string message, std::string help = {},
                 std::optional<Severity> severity = std::nullopt);

}  // namespace gltfx::validate
