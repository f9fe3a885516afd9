// SPDX-License-Identifier: Apache-2.0
// Requirements of extensions on KTX2 images, and of the slots and samplers that use them. The
// errors of a file itself are found when its header is read; only their table is here.

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"

namespace gltfx::validate {
namespace {

using image::Ktx2;
using image::Ktx2Model;
using image::Ktx2Scheme;

// --- An image for an extension ---

struct ImageUse {
  const TexturePhase& phase;
  std::uint32_t image;
  const Ktx2& file;

  void report(Code code, std::string message) const {
    report_element(phase.sink, phase.context, model::RootArray::images, image, code,
                   std::move(message));
  }
};

// KHR_texture_basisu, "KTX header fields" for ETC1S and for UASTC.
bool is_basis(const Ktx2& file) {
  const auto scheme = static_cast<Ktx2Scheme>(file.scheme);
  if (!file.contents) return false;
  if (file.model == Ktx2Model::etc1s) return scheme == Ktx2Scheme::basis_lz;
  return file.model == Ktx2Model::uastc &&
         (scheme == Ktx2Scheme::none || scheme == Ktx2Scheme::zstd);
}

void check_payload(const ImageUse& use, std::string_view extension) {
  const bool astc = extension == "EXT_texture_astc";
  const bool basis = extension == "KHR_texture_basisu";
  const bool right = astc ? use.file.model == Ktx2Model::astc : !basis || is_basis(use.file);
  if (right) return;
  use.report(Code::KTX2_PAYLOAD_INVALID,
             fmt::format("The payload of the image is not allowed by {}; it must be {}.", extension,
                         astc ? "ASTC"
                              : "ETC1S with BasisLZ, or UASTC with or without Zstandard, with RGB, "
                                "RGBA, R or RG channels"));
}

void check_extents(const ImageUse& use, std::string_view extension) {
  if (!use.file.is_2d()) {
    use.report(Code::KTX2_NOT_2D,
               "The image is an array, a cube map or a volume; it must be a single 2D image.");
  }
  if (extension != "KHR_texture_basisu") return;
  if (use.file.width % 4 != 0 || use.file.height % 4 != 0) {
    use.report(Code::KTX2_DIMENSIONS_NOT_MULTIPLE_OF_4,
               fmt::format("The image has {}x{} pixels; both must be multiples of 4.",
                           use.file.width, use.file.height));
  }
}

void check_metadata(const ImageUse& use) {
  const Ktx2& file = use.file;
  if (file.orientation && *file.orientation != "rd") {
    use.report(Code::KTX2_ORIENTATION_INVALID, fmt::format("KTXorientation is {}; it must be 'rd'.",
                                                           gltfx::quoted(*file.orientation)));
  }
  if (file.swizzle && *file.swizzle != "rgba") {
    use.report(Code::KTX2_SWIZZLE_INVALID,
               fmt::format("KTXswizzle is {}; it must be 'rgba'.", gltfx::quoted(*file.swizzle)));
  }
  if (file.premultiplied) {
    use.report(Code::KTX2_PREMULTIPLIED_ALPHA, "The image has premultiplied alpha.");
  }
}

// --- A texture that uses it ---

// Whether the sampler of a texture uses smaller levels. Without a filter, readers choose.
bool wants_levels(const Context& context, json::NodeId texture) {
  const auto sampler = context.asset.index(texture, "sampler", model::RootArray::samplers);
  if (!sampler) return true;
  const json::NodeId object = context.asset.elements(model::RootArray::samplers)[*sampler];
  const auto filter = model::unsigned_member(context.document, object, "minFilter");
  constexpr std::uint64_t kFirstWithMipmaps = 9984;
  return filter && *filter >= kFirstWithMipmaps;
}

void check_levels(const ImageUse& use, json::NodeId texture, json::NodeId object,
                  const Path& path) {
  const std::uint32_t full = use.file.full_pyramid();
  if (use.file.level_count >= full || !wants_levels(use.phase.context, texture)) return;
  report_member(use.phase.sink, use.phase.context, path, object, "source",
                Code::KTX2_MIP_LEVELS_MISSING,
                fmt::format("The sampler uses mipmaps, but {} has only {} of {} levels.",
                            image_label(use.phase.context, use.image), use.file.level_count, full));
}

class TextureCheck {
 public:
  explicit TextureCheck(const TexturePhase& phase) : phase_(phase) {}

  void check(json::NodeId texture, const Path& path) {
    const json::Document& document = phase_.context.document;
    const json::NodeId extensions = model::object_member(document, texture, "extensions");
    if (extensions == json::kNoNode) return;
    const Path list(path, "extensions");
    for (const auto member : document.members(extensions)) {
      const auto image =
          phase_.context.asset.index(member.value, "source", model::RootArray::images);
      if (!image) continue;
      const auto& file = phase_.resources.images[*image].ktx2;
      if (!file || !file->is_sound()) continue;
      const std::string_view name = document.key(member.key_id);
      const ImageUse use{phase_, *image, *file};
      check_levels(use, texture, member.value, Path(list, name));
      if (!reported_.emplace(*image, name).second) continue;
      check_payload(use, name);
      check_extents(use, name);
      check_metadata(use);
    }
  }

 private:
  const TexturePhase& phase_;
  std::map<std::uint32_t, std::string_view> reported_;  // each extension has one kind of image
};

// --- A slot that reads it ---

bool holds(image::Channels contents, char channel) {
  if (contents == image::Channels::red) return channel == 'r';
  return contents != image::Channels::red_green || channel != 'b';
}

void check_contents(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t image,
                    const Ktx2& file) {
  if (!file.contents) return;
  for (const char channel : {'g', 'b'}) {
    if (!slot.effective.has(channel) || holds(*file.contents, channel)) continue;
    report_slot(phase.context, phase.sink, slot, Code::KTX2_CHANNELS_MISSING,
                fmt::format("{} reads {}, but {} only has {}.", slot.property,
                            slot.effective.text(), image_label(phase.context, image),
                            *file.contents == image::Channels::red ? "R" : "R and G"));
    return;
  }
}

std::string transfer_text(std::uint8_t transfer) {
  if (transfer == image::kKtx2TransferSrgb) return "an sRGB transfer function";
  if (transfer == image::kKtx2TransferLinear) return "a linear transfer function";
  return fmt::format("transfer function {}", transfer);
}

std::string primaries_text(std::uint8_t primaries) {
  if (primaries == image::kKtx2PrimariesBt709) return "BT.709 primaries";
  return primaries == 0 ? "UNSPECIFIED primaries" : fmt::format("primaries {}", primaries);
}

// A wrong transfer function changes the picture; wrong primaries do not, since readers ignore them.
void check_color_space(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t image,
                       const Ktx2& file) {
  if (slot.effective.colors() == 0) return;
  const std::uint8_t transfer = slot.srgb ? image::kKtx2TransferSrgb : image::kKtx2TransferLinear;
  const std::uint8_t primaries = slot.srgb ? image::kKtx2PrimariesBt709 : std::uint8_t{0};
  const bool wrong_transfer = file.transfer != transfer;
  if (!wrong_transfer && file.primaries == primaries) return;
  const std::string_view wanted =
      wrong_transfer ? (slot.srgb ? "an sRGB transfer function" : "a linear transfer function")
                     : (slot.srgb ? "BT.709 primaries" : "UNSPECIFIED primaries");
  report_slot(
      phase.context, phase.sink, slot, Code::KTX2_COLOR_SPACE_INVALID,
      fmt::format("{} requires {}, but {} declares {}.", slot.property, wanted,
                  image_label(phase.context, image),
                  wrong_transfer ? transfer_text(file.transfer) : primaries_text(file.primaries)),
      {}, wrong_transfer ? std::nullopt : std::optional(Severity::warning));
}

}  // namespace

void check_ktx2_slots(const TexturePhase& phase) {
  TextureCheck textures(phase);
  const Path root;
  const Path array(root, "textures");
  const auto& objects = phase.context.asset.elements(model::RootArray::textures);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    textures.check(objects[i], Path(array, static_cast<std::uint64_t>(i)));
  }
  for (const TextureSlot& slot : phase.slots) {
    for (const std::uint32_t image : slot.images) {
      const auto& file = phase.resources.images[image].ktx2;
      if (!file || !file->is_sound()) continue;
      check_contents(phase, slot, image, *file);
      check_color_space(phase, slot, image, *file);
    }
  }
}

}  // namespace gltfx::validate
