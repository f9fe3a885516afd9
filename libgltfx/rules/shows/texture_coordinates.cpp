// SPDX-License-Identifier: Apache-2.0
// Whether texture coordinates show the textures that materials read by them.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "measure/uv_plane.hpp"
#include "model/texture.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/uv_reading.hpp"

namespace gltfx::validate {
namespace {

using measure::UvPoint;
using measure::UvSurface;
using measure::UvTriangle;

// A texture that a primitive shows.
struct TextureUse {
  PlacedPrimitive by;
  const TextureSlot* slot = nullptr;
  UvMapping mapping;
  model::AccessorData uvs;
  UvSample sample;
};

bool is_point(const UvTriangle& triangle) {
  return triangle[0] == triangle[1] && triangle[0] == triangle[2];
}

// Whether at least `part` of a list fulfils a condition.
template <class List, class Condition>
bool holds_for(const List& list, double part, Condition condition) {
  const auto count = std::count_if(list.begin(), list.end(), condition);
  return !list.empty() && static_cast<double>(count) >= part * static_cast<double>(list.size());
}

class CoordinateCheck {
 public:
  explicit CoordinateCheck(DataPhase& phase) : phase_(phase), context_(phase.context) {}

  void run() {
    const auto users = primitives_of_materials(context_);
    for (const TextureSlot& slot : phase_.textures->slots) {
      if (slot.material == json::kNoNode || slot.effective.empty()) {
        unknown_.insert(slot.images.begin(), slot.images.end());
        continue;
      }
      for (const PlacedPrimitive& user : users[slot.material_index]) add(slot, user);
    }
    for (const auto& [texture, uses] : uses_) check_collapsed(uses);
    for (const auto& [texture, uses] : uses_) {
      const model::Sampler sampler = sampler_of(texture);
      for (const TextureUse& use : uses) {
        check_tangent_space(use);
        check_clamped(use, sampler);
      }
    }
    check_sizes();
  }

 private:
  void add(const TextureSlot& slot, const PlacedPrimitive& by) {
    constexpr std::size_t kMostUses = std::size_t{1} << 16U;  // of a kilobyte each
    const UvMapping mapping = read_uv_mapping(context_.document, slot.use->texture_info);
    auto uvs = open_uvs(phase_, *by.primitive, set_of(mapping));
    UvSample sample;
    if (uvs && count_ < kMostUses) sample = sample_uvs(phase_, *by.primitive, *uvs);
    if (sample.triangles.empty()) {
      unknown_.insert(slot.images.begin(), slot.images.end());
      incomplete_.insert(slot.texture);
      return;
    }
    ++count_;
    uses_[slot.texture].push_back({by, &slot, mapping, *std::move(uvs), std::move(sample)});
  }

  // One finding for a set of coordinates.
  void report(const TextureUse& use, Code code, std::string message,
              std::optional<Severity> severity = std::nullopt) {
    const auto set = set_of(use.mapping);
    if (!reported_.insert({use.by.mesh, use.by.index, set}).second) return;
    const model::Attribute* attribute = use.by.primitive->find(model::SemanticKind::texcoord, set);
    Finding finding = finding_on(context_, attribute->value, code, std::move(message));
    finding.severity = severity;
    report_at(phase_.sink,
              fmt::format("/meshes/{}/primitives/{}/attributes/{}", use.by.mesh, use.by.index,
                          attribute->name),
              std::move(finding));
  }
  std::string shown(const TextureUse& use) const {
    return fmt::format(
        "{} of {}", use.slot->property,
        object_label(context_, model::RootArray::materials, use.slot->material_index));
  }

  // --- All at one place ---

  // Where all corners are, or nothing.
  std::optional<UvPoint> place_of(const TextureUse& use) {
    const UvPoint place = use.sample.triangles.front()[0];
    const auto is_there = [&](const UvTriangle& each) {
      return is_point(each) && each[0] == place;
    };
    if (!holds_for(use.sample.triangles, 1, is_there)) return std::nullopt;
    const auto all = read_uvs(phase_, *use.by.primitive, use.uvs);
    if (!all || all->triangles.empty()) return std::nullopt;
    for (std::size_t i = 0; i < all->triangles.size(); ++i) {
      if (!is_there(all->corners(i))) return std::nullopt;
    }
    return place;
  }

  // Images that may have one color only, which any coordinates show.
  bool may_be_plain(const TextureSlot& slot) const {
    const std::uint32_t index = slot.images.front();
    constexpr std::uint32_t kSmall = 16;
    const auto& header = phase_.resources.images[index].header;
    if (!header || (header->width <= kSmall && header->height <= kSmall)) return true;
    const codec::Image* image = phase_.textures->pixels.of(index);
    return image != nullptr &&
           std::all_of(image->statistics.begin(), image->statistics.begin() + image->channels,
                       [](const codec::ChannelStatistics& each) { return each.constant(); });
  }

  void check_collapsed(const std::vector<TextureUse>& uses) {
    std::vector<std::pair<const TextureUse*, UvPoint>> collapsed;
    for (const TextureUse& use : uses) {
      if (may_be_plain(*use.slot)) return;
      if (const auto place = place_of(use)) collapsed.emplace_back(&use, *place);
    }
    if (collapsed.empty()) return;
    const UvPoint first = collapsed.front().second;
    const bool at_one = std::all_of(collapsed.begin(), collapsed.end(),
                                    [&](const auto& each) { return each.second == first; });
    const bool all =
        collapsed.size() == uses.size() && incomplete_.count(uses.front().slot->texture) == 0;
    for (const auto& [use, place] : collapsed) {
      const bool zero = place == UvPoint{0, 0} || place == UvPoint{0, 1};
      // Several places are a palette; so is one of them where others use all of the texture.
      if (!(all && at_one) && !(zero && collapsed.size() < uses.size())) continue;
      report(*use, Code::UV_COLLAPSED,
             fmt::format("All texture coordinates are ({:.6g}, {:.6g}), so {} shows a single "
                         "texel.",
                         place[0], place[1], shown(*use)),
             all ? std::nullopt : std::optional(Severity::info));
    }
  }

  // --- Normal maps without directions ---

  void check_tangent_space(const TextureUse& use) {
    const bool exact = use.uvs.format().component == model::ComponentType::float32;
    if (!use.slot->normal_map || !exact) return;
    constexpr double kMost = 0.5;
    constexpr double kSuspicious = 0.2;
    const auto is_flat = [](const UvTriangle& each) {
      return measure::is_finite(each) && measure::is_degenerate(each);
    };
    if (!holds_for(use.sample.triangles, kSuspicious, is_flat)) return;
    const auto all = read_uvs(phase_, *use.by.primitive, use.uvs);
    if (!all) return;
    std::uint64_t flat = 0;
    for (std::size_t i = 0; i < all->triangles.size(); ++i)
      flat += is_flat(all->corners(i)) ? 1 : 0;
    const std::size_t count = all->triangles.size();
    if (static_cast<double>(flat) <= kMost * static_cast<double>(count)) return;
    report(use, Code::UV_COLLAPSED,
           fmt::format("{} of {} triangles have no area in their texture coordinates, so {} has no "
                       "direction there.",
                       flat, count, shown(use)));
  }

  // --- Beyond the edge ---

  model::Sampler sampler_of(std::uint32_t texture) const {
    const auto& textures = context_.asset.elements(model::RootArray::textures);
    return model::read_texture(context_.asset, textures[texture]).sampler;
  }

  void check_clamped(const TextureUse& use, const model::Sampler& sampler) {
    const std::array<bool, 2> clamped{sampler.wrap_s == model::Wrap::clamp_to_edge,
                                      sampler.wrap_t == model::Wrap::clamp_to_edge};
    if (!clamped[0] && !clamped[1]) return;
    // Decals end in a transparent edge.
    if (use.slot->coverage && use.slot->channels.has('a')) return;
    // A transform that leaves the image has a finding of its own.
    for (std::size_t k = 0; k < 2; ++k) {
      const double end = use.mapping.offset[k] + use.mapping.scale[k];
      if (std::min(use.mapping.offset[k], end) < -1e-6 ||
          std::max(use.mapping.offset[k], end) > 1 + 1e-6) {
        return;
      }
    }
    constexpr double kMany = 0.25;
    constexpr double kSuspicious = 0.1;
    const auto is_outside = [&](const UvTriangle& each) {
      const std::array<std::array<double, 2>, 3> at{
          mapped(each[0], use.mapping), mapped(each[1], use.mapping), mapped(each[2], use.mapping)};
      for (std::size_t k = 0; k < 2; ++k) {
        if (!clamped[k]) continue;
        const auto [least, most] = std::minmax({at[0][k], at[1][k], at[2][k]});
        constexpr double kNear = 1e-3;
        if (most < -kNear || least > 1 + kNear) return true;
      }
      return false;
    };
    if (!holds_for(use.sample.triangles, kSuspicious, is_outside) || may_be_plain(*use.slot))
      return;
    const auto all = read_uvs(phase_, *use.by.primitive, use.uvs);
    if (!all) return;
    std::uint64_t outside = 0;
    for (std::size_t i = 0; i < all->triangles.size(); ++i) {
      outside += is_outside(all->corners(i)) ? 1 : 0;
    }
    const std::size_t count = all->triangles.size();
    if (static_cast<double>(outside) < kMany * static_cast<double>(count)) return;
    report(use, Code::UV_OUTSIDE_CLAMPED,
           fmt::format("{} of {} triangles are outside of {}, whose sampler clamps to the edge.",
                       outside, count, shown(use)));
  }

  // --- Large images of which little is seen ---

  // At least the texels that triangles touch.
  static double touched(const UvTriangle& triangle, const TextureUse& use, double width,
                        double height) {
    std::array<std::array<double, 2>, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = mapped(triangle[k], use.mapping);
      at[k] = {at[k][0] * width, at[k][1] * height};
    }
    const auto [left, right] = std::minmax({at[0][0], at[1][0], at[2][0]});
    const auto [top, bottom] = std::minmax({at[0][1], at[1][1], at[2][1]});
    const double area = std::abs((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                                 (at[2][0] - at[0][0]) * (at[1][1] - at[0][1])) /
                        2;
    constexpr double kAround = 4;  // texels that a filter reads at a place
    return area + (right - left) + (bottom - top) + kAround;
  }

  // The texels that a use touches at most, estimated; infinite: nobody can tell.
  static double estimated(const TextureUse& use, double width, double height) {
    double sum = 0;
    for (const UvTriangle& each : use.sample.triangles) sum += touched(each, use, width, height);
    return sum * static_cast<double>(use.sample.of) /
           static_cast<double>(use.sample.triangles.size());
  }

  void check_sizes() {
    constexpr double kLarge = 1024.0 * 1024;
    constexpr double kPart = 1e-3;
    std::map<std::uint32_t, std::vector<const TextureUse*>> by_image;
    for (const auto& [texture, uses] : uses_) {
      for (const TextureUse& use : uses) by_image[use.slot->images.front()].push_back(&use);
    }
    for (const auto& [image, uses] : by_image) {
      const auto& header = phase_.resources.images[image].header;
      if (!header || unknown_.count(image) > 0) continue;
      const double width = header->width;
      const double height = header->height;
      const double most = width * height * kPart;
      if (width * height < kLarge) continue;
      double guess = 0;
      for (const TextureUse* use : uses) {
        guess += estimated(*use, width, height);
        constexpr double kRough = 8;
        if (!(guess <= kRough * most)) break;
      }
      constexpr double kRough = 8;
      if (!(guess <= kRough * most)) continue;
      const double sum = exact_sum(uses, width, height, most);
      if (!(sum <= most)) continue;
      report(*uses.front(), Code::TEXTURE_BARELY_USED,
             fmt::format("The triangles that show {} touch at most {:.0f} of its {:.0f} texels, "
                         "{:.2g} %.",
                         image_label(context_, image), std::ceil(sum), width * height,
                         100 * sum / (width * height)));
    }
  }

  double exact_sum(const std::vector<const TextureUse*>& uses, double width, double height,
                   double most) {
    double sum = 0;
    for (const TextureUse* use : uses) {
      const auto all = read_uvs(phase_, *use->by.primitive, use->uvs);
      if (!all) return INFINITY;
      for (std::size_t i = 0; i < all->triangles.size(); ++i) {
        sum += touched(all->corners(i), *use, width, height);
        if (!(sum <= most)) return INFINITY;
      }
    }
    return sum;
  }

  DataPhase& phase_;
  const Context& context_;
  std::map<std::uint32_t, std::vector<TextureUse>> uses_;  // by texture
  std::size_t count_ = 0;                                  // of uses
  std::set<std::uint32_t> incomplete_;                     // textures with uses that cannot be read
  std::set<std::uint32_t> unknown_;                        // images, likewise
  std::set<std::array<std::uint64_t, 3>> reported_;
};

// Coordinates may move, and other materials may be chosen.
bool may_change_coordinates(const Context& context) {
  const bool moves =
      std::any_of(context.views.animations.begin(), context.views.animations.end(),
                  [](const model::Animation& animation) {
                    return std::any_of(animation.channels.begin(), animation.channels.end(),
                                       [](const model::AnimationChannel& channel) {
                                         return channel.path == model::AnimationPath::other;
                                       });
                  });
  const auto& used = context.checked.extensions_used;
  return moves || std::any_of(used.begin(), used.end(), [](const auto& name) {
           return std::string_view(name) == "KHR_materials_variants";
         });
}

}  // namespace

void check_texture_coordinates(DataPhase& phase) {
  if (!phase.textures || may_change_coordinates(phase.context)) return;
  CoordinateCheck(phase).run();
}

}  // namespace gltfx::validate
