// SPDX-License-Identifier: Apache-2.0
// Checks that need decoded pixels: images that cannot be decoded, constant ones, normal maps.

#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"

namespace gltfx::validate {
namespace {

// --- Images that cannot be decoded ---

void report_image(const TexturePhase& phase, std::uint32_t image, Code code, std::string message,
                  std::optional<Severity> severity) {
  report_element(phase.sink, phase.context, model::RootArray::images, image, code,
                 std::move(message), severity);
}

void report_error(const TexturePhase& phase, std::uint32_t image, const codec::DecodeError& error) {
  const bool malformed = error.kind == codec::ErrorKind::malformed;
  // A stall is not necessarily caused by the bytes.
  const bool stalled = error.kind == codec::ErrorKind::stalled;
  const std::string label = image_label(phase.context, image);
  const std::string reason = printable(error.message);
  report_image(
      phase, image, malformed ? Code::IMAGE_PIXELS_INVALID : Code::IMAGE_NOT_DECODED,
      malformed ? fmt::format("The pixels of {} cannot be decoded: {}", label, reason)
                : fmt::format("The pixels of {} are not checked: {}", label, reason),
      codec::is_costly(error) && !stalled ? std::optional(Severity::warning) : std::nullopt);
}

// Decoders that continue after damaged data show different pictures.
void report_doubt(const TexturePhase& phase, std::uint32_t image, const std::string& doubt) {
  report_image(phase, image, Code::IMAGE_PIXELS_INVALID,
               fmt::format("The pixels of {} can only be decoded in part: {}",
                           image_label(phase.context, image), printable(doubt)),
               Severity::warning);
}

void check_decoded(const TexturePhase& phase) {
  for (std::size_t i = 0; i < phase.resources.images.size(); ++i) {
    const auto image = static_cast<std::uint32_t>(i);
    const codec::DecodeError* error = phase.pixels.error(image);
    if (error != nullptr) report_error(phase, image, *error);
    const codec::Image* decoded = phase.pixels.of(image);
    if (decoded != nullptr && !decoded->doubt.empty()) report_doubt(phase, image, decoded->doubt);
  }
}

// --- Channels that are the same everywhere ---

bool has_channel(const codec::Image& image, char channel) {
  return channel != 'a' || image.has_alpha();
}

// Whether all channels that the slot reads are constant in the image.
bool is_constant(const TextureSlot& slot, const codec::Image& image) {
  bool any = false;
  for (const char channel : {'r', 'g', 'b', 'a'}) {
    if (!slot.effective.has(channel) || !has_channel(image, channel)) continue;
    if (!statistics_of(image, channel).constant()) return false;
    any = true;
  }
  return any;
}

bool reads_constant_alpha(const TextureSlot& slot, const codec::Image& image) {
  return !slot.coverage && slot.effective.has('a') && image.has_alpha() && image.alpha().constant();
}

void report_alpha(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t index,
                  const codec::Image& image) {
  const bool full = image.alpha().least == image.full();
  const std::string label = image_label(phase.context, index);
  std::string message =
      full ? fmt::format("{} reads A, but alpha of {} is 1 in every texel, so it has no effect.",
                         slot.property, label)
           : fmt::format("{} reads A, but alpha is {} of {} in every texel of {}.", slot.property,
                         image.alpha().least, image.full(), label);
  report_slot(phase.context, phase.sink, slot, Code::TEXTURE_ALPHA_CONSTANT, std::move(message), {},
              full ? std::nullopt : std::optional(Severity::hint));
}

// A texture of one texel is constant on purpose.
void check_constant(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t index,
                    const codec::Image& image) {
  if (slot.effective.empty() || image.texels() <= 1) return;
  if (reads_constant_alpha(slot, image)) {
    report_alpha(phase, slot, index, image);
  } else if (is_constant(slot, image) && !slot.normal_map) {
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_CONSTANT,
                fmt::format("All {}x{} texels of {} are equal.", image.width, image.height,
                            image_label(phase.context, index)));
  }
}

// --- Normal maps ---

// The share of texels that may have any value: seams, and effects of lossy coding.
constexpr double kStrayShare = 0.05;
// One step of 8 bits above or below the middle, which 8 bits cannot represent.
constexpr double kFlat = 3.0 / 255;

double share(std::uint64_t count, const codec::NormalStatistics& normals) {
  return normals.vectors == 0 ? 0
                              : static_cast<double>(count) / static_cast<double>(normals.vectors);
}

void report_normals(const TexturePhase& phase, const TextureSlot& slot, Code code,
                    std::string message) {
  report_slot(phase.context, phase.sink, slot, code, std::move(message));
}

// The share of texels with a vector that is too long above which a map with full B has no Z: maps
// of unit vectors have none of them.
constexpr double kTwoChannels = 0.01;

// Whether B, but no other channel, is never below 250 of 255.
bool is_full_blue(const codec::Image& image) {
  const auto& [red, green, blue, alpha] = image.statistics;
  return !(red.constant() && green.constant()) &&
         std::uint64_t{blue.least} * 255 >= std::uint64_t{image.full()} * 250;
}

void check_lengths(const TexturePhase& phase, const TextureSlot& slot, const codec::Image& image,
                   const std::string& label) {
  const codec::NormalStatistics& normals = image.normals;
  const double far_off = share(normals.far_off, normals);
  if (is_full_blue(image) && share(normals.not_unit, normals) > kTwoChannels) {
    report_normals(phase, slot, Code::NORMAL_MAP_NOT_UNIT,
                   fmt::format("B of {} is {}{} in every texel, although the normals are tilted; "
                               "it may be a two-channel map, but glTF reads Z from B.",
                               label, image.statistics[2].least,
                               image.statistics[2].constant() ? "" : " or more"));
  } else if (far_off > kStrayShare) {
    report_normals(
        phase, slot, Code::NORMAL_MAP_NOT_UNIT,
        fmt::format(
            "{:.0f} % of the normals of {} are not of unit length; their mean length is {:.2f}.",
            far_off * 100, label, normals.mean_length));
  }
}

void check_normal_map(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t index,
                      const codec::Image& image) {
  const bool whole = slot.effective.has('r') && slot.effective.has('g') && slot.effective.has('b');
  if (!slot.normal_map || !whole || image.channels < 3 || image.normals.vectors == 0) return;
  const codec::NormalStatistics& normals = image.normals;
  const std::string label = image_label(phase.context, index);
  const double inward = share(normals.inward, normals);
  if (image.statistics[2].greatest == 0) {
    report_normals(phase, slot, Code::NORMAL_MAP_INWARD,
                   fmt::format("B of {} is 0 in every texel, so all normals point into the "
                               "surface; it may be a two-channel map, but glTF reads Z from B.",
                               label));
  } else if (inward > kStrayShare) {
    report_normals(
        phase, slot, Code::NORMAL_MAP_INWARD,
        fmt::format("{:.0f} % of the normals of {} point into the surface.", inward * 100, label));
  } else if (normals.steepest <= kFlat && image.texels() > 1) {
    report_normals(phase, slot, Code::NORMAL_MAP_FLAT,
                   fmt::format("All normals of {} are perpendicular to the surface.", label));
  } else {
    check_lengths(phase, slot, image, label);
  }
}

}  // namespace

const codec::ChannelStatistics& statistics_of(const codec::Image& image, char channel) {
  if (channel == 'a') return image.alpha();
  if (image.channels < 3) return image.statistics[0];
  return image.statistics[channel == 'r' ? 0 : channel == 'g' ? 1 : 2];
}

void check_pixels(const TexturePhase& phase) {
  check_decoded(phase);
  std::set<std::uint32_t> reported;
  for (const TextureSlot& slot : phase.slots) {
    const std::uint32_t index = slot.images.front();
    const codec::Image* image = phase.pixels.of(index);
    if (image == nullptr) continue;
    check_normal_map(phase, slot, index, *image);
    if (reported.insert(index).second) check_constant(phase, slot, index, *image);
  }
}

}  // namespace gltfx::validate
