// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_texels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prove/column.hpp"
#include "prove/images.hpp"

namespace gltfx::prove {
namespace {

constexpr double kFull = 255;

/// What was measured of two images of one size.
struct TexelStatistics {
  double mean = 0, greatest = 0;  ///< of the channels that are read; 1: a full step
  double square = 0;              ///< mean
  double angle = 0;               ///< normal maps: degrees that 99 % of the texels do not exceed
  bool unread_differs = false;    ///< only what nothing reads, or what is transparent, differs
  bool green_inverted = false;
  double coverage =
      0;  ///< masks: part of the texels whose alpha is on the other side of the cutoff
};

double normal_angle(const Texel& a, const Texel& b) {
  const auto vector = [](const Texel& texel) {
    return model::Vector3{texel[0] / kFull * 2 - 1, texel[1] / kFull * 2 - 1,
                          texel[2] / kFull * 2 - 1};
  };
  const model::Vector3 p = vector(a);
  const model::Vector3 q = vector(b);
  const model::Vector3 across = model::cross(p, q);
  return std::atan2(std::sqrt(model::dot(across, across)), model::dot(p, q)) * 180 /
         std::numbers::pi;
}

TexelStatistics measure_texels(const codec::Image& ours, const codec::Image& theirs,
                               const ImageUse& use) {
  const Texels here(ours);
  const Texels there(theirs);
  const double full = ours.bits == 32 ? 1 : kFull;
  const double cutoff = use.cutoff.value_or(0) * full;
  constexpr std::size_t kAngles = 1800;  // of a tenth of a degree
  std::vector<std::uint64_t> angles(use.normal ? kAngles + 1 : 0);
  TexelStatistics found;
  std::uint64_t inverted = 0;
  std::uint64_t across = 0;
  const auto count = static_cast<double>(ours.texels());
  const auto channels =
      static_cast<double>(std::count(std::begin(use.channels), std::end(use.channels), true));
  for (std::size_t i = 0; i < ours.texels(); ++i) {
    const Texel a = here.at(i);
    const Texel b = there.at(i);
    const bool transparent = use.channels[3] && a[3] == 0 && b[3] == 0;
    double most = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double distance = apart(a[k], b[k]) / full;
      if (distance == 0) continue;
      if (!use.channels[k] || (transparent && k < 3)) {
        found.unread_differs = true;
      } else {
        most = std::max(most, distance);
        sum += distance;
      }
    }
    found.mean += sum / channels;
    found.square += most * most;
    found.greatest = std::max(found.greatest, most);
    inverted += std::fabs(a[1] + b[1] - full) <= full / 128 && apart(a[0], b[0]) <= full / 128;
    across += (a[3] >= cutoff) != (b[3] >= cutoff);
    if (!use.normal) continue;
    const double angle = normal_angle(a, b);
    ++angles[std::isfinite(angle) ? static_cast<std::size_t>(std::ceil(angle * 10)) : kAngles];
  }
  found.mean /= count;
  found.square /= count;
  found.coverage = use.cutoff ? static_cast<double>(across) / count : 0;
  found.green_inverted = found.greatest > 0.1 && static_cast<double>(inverted) >= 0.95 * count;
  std::uint64_t above = 0;
  const auto most_above = static_cast<std::uint64_t>(0.01 * count);
  for (std::size_t bin = angles.size(); bin-- > 0;) {
    above += angles[bin];
    if (above <= most_above) continue;
    found.angle = static_cast<double>(bin) / 10;
    break;
  }
  return found;
}

class TexelComparison {
 public:
  explicit TexelComparison(const Comparison& all)
      : all_(all), uses_(image_uses(all.ours)), their_uses_(image_uses(all.theirs)) {}

  void run() {
    all_.for_each_pair("/images", [this](ItemId ours, ItemId theirs) { compare(ours, theirs); });
  }

 private:
  void compare(ItemId ours, ItemId theirs) {
    const auto& here = all_.ours.side().resources().images;
    const auto& there = all_.theirs.side().resources().images;
    if (ours.index >= here.size() || theirs.index >= there.size()) return;
    const auto& before = here[ours.index].bytes;
    const auto& after = there[theirs.index].bytes;
    if (before && after && container::same_bytes(*before, *after)) {
      return compare_members(ours, theirs, "mimeType");
    }
    if (!before || !after) {
      if (!before && !after) {
        compare_members(ours, theirs, "uri");
        return all_.log.leave_out(fmt::format("{} cannot be read.", all_.our_pointer(ours)));
      }
      return tell("image.texels", ours, theirs,
                  fmt::format("can be read in the {} asset only", before ? "old" : "new"));
    }
    const auto left = decode_image(all_.ours.side(), ours.index);
    const auto right = decode_image(all_.theirs.side(), theirs.index);
    const auto* one = std::get_if<codec::Image>(&left);
    const auto* other = std::get_if<codec::Image>(&right);
    if (one == nullptr && other == nullptr) {
      return all_.log.leave_out(fmt::format("{} cannot be decoded.", all_.our_pointer(ours)));
    }
    if (one == nullptr || other == nullptr) {
      return tell("image.texels", ours, theirs,
                  fmt::format("can be decoded in the {} asset only", one ? "old" : "new"));
    }
    compare_decoded(ours, *one, theirs, *other);
  }

  // What a reader gets without other bytes. That one of both lacks it is storage.
  void compare_members(ItemId ours, ItemId theirs, std::string_view member) {
    const json::Document& left = all_.ours.side().document();
    const json::Document& right = all_.theirs.side().document();
    const json::NodeId here = left.find(all_.ours.item(ours).node, member);
    const json::NodeId there = right.find(all_.theirs.item(theirs).node, member);
    if (here == json::kNoNode && there == json::kNoNode) return;
    if (here == json::kNoNode || there == json::kNoNode) {
      // Only of bytes in a buffer, it says what they are.
      const bool needed = member == "mimeType" &&
                          left.find(all_.ours.item(ours).node, "bufferView") != json::kNoNode &&
                          right.find(all_.theirs.item(theirs).node, "bufferView") != json::kNoNode;
      const bool lost = there == json::kNoNode;
      if (needed) {
        tell("image.value", ours, theirs,
             fmt::format("{} was {}", member, lost ? "removed" : "added"));
      }
      return;
    }
    if (left.raw(here) == right.raw(there)) return;
    tell("image.value", ours, theirs,
         fmt::format("{} {} -> {}", member, short_value(left, here), short_value(right, there)));
  }

  void compare_decoded(ItemId ours, const codec::Image& one, ItemId theirs,
                       const codec::Image& other) {
    if (one.width != other.width || one.height != other.height) {
      return tell("image.size", ours, theirs,
                  fmt::format("{} x {} -> {} x {} texels", one.width, one.height, other.width,
                              other.height));
    }
    if ((one.bits == 32) != (other.bits == 32)) {
      return tell("image.texels", ours, theirs, "has another type of texels");
    }
    ImageUse use = uses_[ours.index];
    const ImageUse& their_use = their_uses_[theirs.index];
    for (std::size_t k = 0; k < 4; ++k) use.channels[k] = use.channels[k] || their_use.channels[k];
    use.normal = use.normal || their_use.normal;
    use.data = use.data || their_use.data;
    if (!use.cutoff) use.cutoff = their_use.cutoff;
    if (!use.used()) std::fill(std::begin(use.channels), std::end(use.channels), true);
    const TexelStatistics found = measure_texels(one, other, use);
    if (found.greatest == 0) {
      return all_.log.note_storage(
          found.unread_differs
              ? fmt::format("texels of {} that nothing reads were changed", all_.our_pointer(ours))
              : std::string("images are encoded differently"));
    }
    tell_texels(ours, theirs, use, found);
  }

  void tell_texels(ItemId ours, ItemId theirs, const ImageUse& use, const TexelStatistics& found) {
    const CompareBounds& bounds = all_.options.bounds;
    const bool near = use.normal ? found.angle <= 4 * bounds.normal
                      : use.data
                          ? found.greatest <= 2 * bounds.image
                          : found.mean <= bounds.image && found.greatest <= 16 * bounds.image;
    const double decibels = found.square > 0 ? -10 * std::log10(found.square) : 99;
    Change change;
    change.kind = "image.texels";
    change.level = near && found.coverage <= 0.01 ? CompareLevel::bounds : CompareLevel::differs;
    if (found.green_inverted) {
      change.what = "green is inverted (DirectX and OpenGL conventions of normal maps)";
    } else {
      change.what = fmt::format("{} (PSNR {:.3g} dB, greatest step {:.3g} of 255)",
                                decibels < 15 ? "was replaced" : "has other texels", decibels,
                                found.greatest * kFull);
    }
    change.measure =
        use.normal ? CompareMeasure{"normal", found.angle, "deg", 4 * bounds.normal}
        : use.data
            ? CompareMeasure{"image", found.greatest * kFull, "/255", 2 * bounds.image * kFull}
            : CompareMeasure{"image", found.mean * kFull, "/255", bounds.image * kFull};
    add(std::move(change), ours, theirs);
  }

  void tell(std::string_view kind, ItemId ours, ItemId theirs, std::string what) {
    Change change;
    change.kind = kind;
    change.what = std::move(what);
    add(std::move(change), ours, theirs);
  }

  void add(Change&& change, ItemId ours, ItemId theirs) {
    change.name = all_.our_name(ours);
    change.old_pointer = all_.our_pointer(ours);
    change.new_pointer = all_.their_pointer(theirs);
    all_.log.add(std::move(change));
  }

  const Comparison& all_;
  const std::vector<ImageUse> uses_, their_uses_;
};

}  // namespace

void compare_image_texels(const Comparison& comparison) { TexelComparison(comparison).run(); }

}  // namespace gltfx::prove
