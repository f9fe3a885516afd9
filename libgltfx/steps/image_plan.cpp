// SPDX-License-Identifier: Apache-2.0
#include "steps/image_plan.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/content.hpp"
#include "image/ktx2.hpp"
#include "model/image_codec.hpp"
#include "steps/image_sources.hpp"

namespace gltfx::steps {
namespace {

using codec::EncodedFormat;
using image::Format;

constexpr std::uint32_t kJpegQuality = 90;
// In place of an image that was lossy before.
constexpr std::uint32_t kAgainQuality = 95;
constexpr std::uint32_t kAvifQuality = 80;
// Level of near-lossless WebP: values differ by at most 2 of 255.
constexpr std::uint32_t kNearLossless = 60;
// Limit for images whose size is unknown before decoding.
constexpr std::uint64_t kMostForeignTexels = std::uint64_t{1} << 26U;

EncodedFormat encoded_format(Format format) {
  switch (format) {
    case Format::png:
      return EncodedFormat::png;
    case Format::jpeg:
      return EncodedFormat::jpeg;
    case Format::webp:
      return EncodedFormat::webp;
    case Format::ktx2:
      return EncodedFormat::ktx2;
    case Format::avif:
      break;
  }
  return EncodedFormat::avif;
}

Format format_of(ImageTarget target) {
  switch (target) {
    case ImageTarget::webp:
      return Format::webp;
    case ImageTarget::jpeg:
      return Format::jpeg;
    case ImageTarget::ktx2:
      return Format::ktx2;
    case ImageTarget::avif:
      return Format::avif;
    default:
      return Format::png;
  }
}

bool has_quality(Format format) { return format != Format::png && format != Format::ktx2; }

codec::TexelKind texel_kind(ImageClass use) {
  if (use == ImageClass::color) return codec::TexelKind::color;
  return use == ImageClass::normal ? codec::TexelKind::normal : codec::TexelKind::data;
}

// RFC 9649: lossy image data is in a chunk of its own.
bool is_lossy_webp(std::string_view bytes) {
  constexpr std::size_t kHead = 8;  // type and length of a chunk
  for (std::size_t at = 12; at + kHead <= bytes.size();) {
    const std::string_view type = bytes.substr(at, 4);
    if (type == "VP8 " || type == "VP8L") return type == "VP8 ";
    std::size_t length = 0;
    for (std::size_t i = 4; i-- > 0;) {
      length = length << 8U | static_cast<unsigned char>(bytes[at + 4 + i]);
    }
    at += kHead + length + length % 2;
  }
  return false;
}

void read_known(ImageFile& file) {
  file.lossy =
      file.format == Format::webp ? is_lossy_webp(file.bytes.text()) : file.format != Format::png;
  file.media_type = image::media_type(*file.format);
  file.name = format_name(*file.format);
  if (file.format == Format::ktx2) {
    const image::Ktx2 ktx2 = image::read_ktx2(file.bytes.view());
    if (ktx2.is_sound()) {
      file.header = image::header_of(ktx2);
    } else {
      file.broken = true;
    }
    if (!file.header || !ktx2.is_2d() || !image::has_known_texels(ktx2)) {
      file.problem = "gltfx does not decode KTX 2 images of this kind";
    }
    return;
  }
  image::HeaderResult header = image::read_header(file.bytes.view());
  if (auto* found = std::get_if<image::Header>(&header)) {
    file.header = std::move(*found);
    if (!file.header->doubt.empty()) {
      file.problem = fmt::format("it is broken: {}", file.header->doubt);
      file.broken = true;
    } else if (file.header->animated) {
      file.problem = "it is animated";
    }
  } else if (std::get<image::HeaderError>(header).cmyk) {
    file.cmyk = true;
    file.name = "CMYK JPEG";
  } else {
    file.problem = "it is broken";
    file.broken = true;
  }
}

void read_other(ImageFile& file) {
  const container::Content content = container::name_content(file.bytes.text());
  file.media_type = content.media_type;
  file.foreign = image::sniff_foreign(file.bytes.view());
  if (file.foreign) {
    file.name = image::foreign_name(*file.foreign);
    return;
  }
  file.name = content.name;
  file.broken = file.bytes.size() == 0;
  file.floats = content.media_type == "image/vnd.radiance" || content.media_type == "image/x-exr";
  file.problem = content.name.empty() ? "it is in an unknown format"
                                      : fmt::format("it is {}", printable(content.name));
}

class Planner {
 public:
  Planner(const ImageFile& file, const ImageContext& context,
          const std::function<std::string(std::string_view)>& find_obstacle)
      : file_(file),
        options_(context.options),
        use_(context.use),
        context_(context),
        find_obstacle_(find_obstacle) {}

  ImagePlan plan() {
    plan_.color = use_.kind == ImageClass::color;
    choose_target();
    const bool too_large = is_too_large();
    const bool again = options_.shrink && file_.format == Format::png;
    const bool unknown_size = file_.broken && options_.texture_size;
    plan_.requested = target_ || too_large || unknown_size;
    if (options_.texture_size && file_.foreign && !target_) {
      plan_.left.push_back(not_encoded());
    }
    if (!plan_.requested && !again) return std::move(plan_);
    if (file_.floats && target_) {
      plan_.refused = fmt::format(
          "{}: its bright colors need tone mapping, which gltfx does not do", file_.problem);
      return std::move(plan_);
    }
    if (!file_.problem.empty()) return give_up();
    if (too_large && !use_.kind && file_.header) {
      plan_.left.push_back(fmt::format("not resized: {}", use_.doubt));
    }
    resized_ = too_large && use_.kind;
    if (target_) try_target();
    if (resized_) try_same();
    if (again && !resized_) add({Format::png, false});
    return std::move(plan_);
  }

 private:
  struct Choice {
    Format format;
    bool may_grow;
    bool legal = false;  ///< the old format is not allowed
    bool rgb = false;    ///< as ImageAttempt::rgb
  };

  // A format that gltfx does not convert is left, unless the asset is invalid with it.
  ImagePlan give_up() {
    const bool refuse = (plan_.requested && file_.broken) || (target_ && target_->legal);
    if (refuse) {
      plan_.refused = file_.problem;
    } else {
      plan_.left.push_back(file_.problem);
    }
    return std::move(plan_);
  }

  void choose_target() {
    choose_by_options();
    if (context_.repair == ImageRepair::none) return;
    // A format that an engine does not read goes, whatever the size of the other one.
    if (target_ && find_obstacle_(image::media_type(target_->format)).empty()) {
      target_->may_grow |= context_.repair == ImageRepair::core;
      return;
    }
    target_ = {Format::png, true, true, context_.repair == ImageRepair::rgb};
  }

  // Sets the target to the first conversion that applies, unless the format already matches.
  void choose_by_options() {
    for (const ImageConversion& conversion : options_.images) {
      if (conversion.only && conversion.only != use_.kind) continue;
      const bool legal = conversion.target == ImageTarget::legal;
      if (legal && context_.allowed && !file_.cmyk) continue;
      const Format format = format_of(conversion.target);
      if (file_.format == format && !file_.cmyk) {
        if (options_.quality && has_quality(format)) {
          plan_.left.push_back(
              fmt::format("it is {} already, which --quality would make worse", file_.name));
        }
        return;
      }
      // A core format may be larger than a file that is not allowed or needs an extension.
      const bool stays_core = file_.format && is_core_type(file_.media_type) && !file_.cmyk;
      target_ = {format,
                 legal || !file_.format || format == Format::ktx2 ||
                     (!stays_core && is_core_type(image::media_type(format))),
                 legal};
      return;
    }
  }

  bool is_too_large() const {
    const std::uint32_t most = options_.texture_size.value_or(0);
    if (most == 0) return false;
    if (!file_.header) return (file_.foreign.has_value() || file_.cmyk) && target_;
    return std::max(file_.header->width, file_.header->height) > most;
  }

  void try_target() {
    const std::string obstacle = find_obstacle_(image::media_type(target_->format));
    if (obstacle.empty()) {
      if (is_lossy_color()) add_again();
      return add(*target_);
    }
    plan_.left.push_back(fmt::format("not {}: {}", format_name(target_->format), obstacle));
  }

  // An image that an engine does not read is stored as JPEG if it is lossy and opaque already.
  bool is_lossy_color() const {
    return context_.repair == ImageRepair::core && target_->legal && file_.lossy && file_.header &&
           !image::can_be_transparent(*file_.header) && use_.kind == ImageClass::color;
  }

  void add_again() {
    add({Format::jpeg, true});
    if (!plan_.attempts.empty() && !options_.quality) {
      plan_.attempts.back().request.quality = kAgainQuality;
      plan_.attempts.back().request.options.subsampled = false;
    }
  }

  // Resizes an image without changing its format.
  void try_same() {
    if (file_.format) return add({*file_.format, true});
    if (!plan_.attempts.empty()) return;
    plan_.left.push_back(not_encoded());
  }

  std::string not_encoded() const {
    return fmt::format(
        "not resized: gltfx does not encode {} (choose another format with --images)", file_.name);
  }

  void add(const Choice& choice) {
    ImageAttempt attempt;
    attempt.format = choice.format;
    attempt.may_grow = choice.may_grow;
    codec::TranscodeRequest& request = attempt.request;
    request.format = encoded_format(choice.format);
    request.image = image_request();
    request.options.smallest = options_.shrink || choice.format == Format::jpeg;
    if (choice.format == Format::jpeg) {
      request.quality = options_.quality.value_or(kJpegQuality);
      request.options.subsampled = use_.kind == ImageClass::color;
      attempt.lossy = true;
    } else if (choice.format == Format::avif || choice.format == Format::ktx2) {
      if (choice.format == Format::avif) request.quality = options_.quality.value_or(kAvifQuality);
      attempt.lossy = true;
    } else if (choice.format == Format::webp && options_.quality && use_.kind) {
      attempt.lossy = true;
      if (use_.kind == ImageClass::color) {
        request.quality = *options_.quality;
      } else {
        request.options.near_lossless = kNearLossless;
      }
    }
    attempt.rgb = choice.rgb;
    attempt.may_reduce_bits = options_.quality.has_value() || choice.rgb;
    if (use_.kind && (attempt.lossy || resized_)) set_resize(request);
    const std::string why = find_refusal(attempt);
    if (why.empty()) return plan_.attempts.push_back(std::move(attempt));
    plan_.left.push_back(fmt::format("not {}: {}", format_name(choice.format), why));
  }

  std::string find_refusal(const ImageAttempt& attempt) const {
    if (attempt.lossy && !use_.kind) return fmt::format("it would lose data, and {}", use_.doubt);
    if (attempt.format == Format::avif && use_.kind != ImageClass::color) {
      return "gltfx encodes only colors as AVIF";
    }
    const bool drops_alpha = attempt.format == Format::jpeg && use_.alpha && file_.header &&
                             image::can_be_transparent(*file_.header);
    if (drops_alpha) return "a texture slot reads its alpha, which the format does not support";
    const bool wide = file_.header && file_.header->bits > 8;
    if (!wide || attempt.format == Format::png) return {};
    return attempt.lossy && attempt.may_reduce_bits ? std::string()
                                                    : wide_reason(file_.header->bits);
  }

  codec::ImageRequest image_request() const {
    codec::ImageRequest request;
    request.bytes = file_.bytes.view();
    request.format =
        file_.format ? model::codec_format(*file_.format) : model::codec_format(*file_.foreign);
    request.max_pixels = std::min(
        request.max_pixels, file_.header ? image::texels_of(*file_.header) : kMostForeignTexels);
    request.origin = context_.origin;
    return request;
  }

  // Equal files get equal requests, except where the use makes a difference.
  void set_resize(codec::TranscodeRequest& request) const {
    codec::Resize& resize = request.image.resize;
    resize.kind = texel_kind(*use_.kind);
    if (resized_) resize.max_side = *options_.texture_size;
    if (!resized_ && request.format != EncodedFormat::ktx2) return;
    resize.weigh_alpha = use_.coverage;
    resize.alpha_cutoff = use_.alpha_cutoff;
    resize.wrap_u = use_.wrap_u;
    resize.wrap_v = use_.wrap_v;
  }

  const ImageFile& file_;
  const ConvertOptions& options_;
  const ImageUse& use_;
  const ImageContext& context_;
  const std::function<std::string(std::string_view)>& find_obstacle_;
  std::optional<Choice> target_;
  bool resized_ = false;
  ImagePlan plan_;
};

}  // namespace

bool is_requested(const ConvertOptions& options, const ImageUse& use) {
  return options.texture_size || options.shrink ||
         std::any_of(options.images.begin(), options.images.end(),
                     [&](const ImageConversion& conversion) {
                       return !conversion.only || conversion.only == use.kind;
                     });
}

std::string wide_reason(std::uint32_t bits) {
  return fmt::format("it has {} bits per channel (--quality reduces them to 8)", bits);
}

std::string_view format_name(Format format) {
  switch (format) {
    case Format::png:
      return "PNG";
    case Format::jpeg:
      return "JPEG";
    case Format::webp:
      return "WebP";
    case Format::avif:
      return "AVIF";
    case Format::ktx2:
      break;
  }
  return "KTX2";
}

ImageFile read_image_file(container::Bytes bytes) {
  ImageFile file;
  file.bytes = std::move(bytes);
  const image::Sniffed sniffed = image::sniff(file.bytes.view());
  if (sniffed.known) {
    file.format = sniffed.format;
    read_known(file);
  } else {
    read_other(file);
  }
  return file;
}

ImagePlan plan_image(const ImageFile& file, const ImageContext& context,
                     const std::function<std::string(std::string_view)>& find_obstacle) {
  return Planner(file, context, find_obstacle).plan();
}

}  // namespace gltfx::steps
