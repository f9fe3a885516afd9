// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "container/content.hpp"
#include "container/uri.hpp"
#include "model/fields.hpp"
#include "rules/core/use.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/image_fixes.hpp"
#include "rules/payload/phases.hpp"
#include "rules/payload/texture_slots.hpp"
#include "rules/phases.hpp"
#include "rules/resource_fetch.hpp"

namespace gltfx::validate {
namespace {

using image::Header;
using image::HeaderError;
using MediaTypes = std::vector<std::string_view>;
using namespace std::literals;

// The allowed formats of images: those of the specification and of declared extensions.
MediaTypes enabled_media_types(const Context& context) {
  MediaTypes types{"image/jpeg", "image/png"};
  for (const schema::Extension* extension : declared_extensions(context)) {
    for (const std::string& type : extension->image_mime_types) types.push_back(type);
  }
  return types;
}

bool contains(const MediaTypes& types, std::string_view type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

// Whether an image has an extension that is not supported, and is therefore skipped.
bool is_skipped(const Context& context, json::NodeId image) {
  const json::NodeId extensions = model::object_member(context.document, image, "extensions");
  if (extensions == json::kNoNode || !context.deviations.extended_images_are_skipped) return false;
  const ActiveExtensions active(context);
  for (const auto extension : context.document.members(extensions)) {
    if (!active.contains(context.document.key(extension.key_id))) return true;
  }
  return false;
}

class ImageCheck {
 public:
  /// `user`: an unknown extension that may use the image; empty if there is none.
  ImageCheck(const Resource& resource, const MediaTypes& enabled, std::string_view user)
      : resource_(resource),
        enabled_(enabled),
        user_(user),
        declared_(model::string_member(resource.context.document, resource.object, "mimeType")) {}

  void check(model::ImageData& data) const {
    const image::HeaderResult result = is_known(data.bytes->view())
                                           ? image::read_header(data.bytes->view())
                                           : image::HeaderError();
    if (const auto* error = std::get_if<HeaderError>(&result)) {
      check_unread(data, *error);
      return;
    }
    data.header = std::get<Header>(result);
    data.format = data.header->format;
    check_format(*data.format);
    describe(*data.header);
    check_header(*data.header);
  }

 private:
  // AVIF is a format like others if an extension allows it.
  bool is_known(std::span<const std::byte> bytes) const {
    if (image::sniff(bytes).format != image::Format::avif) return true;
    return !deviations().few_image_formats && contains(enabled_, "image/avif");
  }

  const Deviations& deviations() const { return resource_.context.deviations; }

  void check_unread(model::ImageData& data, const HeaderError& error) const {
    const image::Sniffed sniffed = image::sniff(data.bytes->view());
    const bool ktx2 = sniffed.known && sniffed.format == image::Format::ktx2;
    if (ktx2 && !deviations().few_image_formats) {
      data.format = sniffed.format;
      resource_.info.mime_type = image::media_type(sniffed.format);
      check_format(sniffed.format);
      check_ktx2(data);
      return;
    }
    switch (error.kind) {
      case HeaderError::Kind::unrecognized:
        report_unrecognized(*data.bytes);
        break;
      case HeaderError::Kind::unexpected_end:
        resource_.find(
            Code::IMAGE_UNEXPECTED_EOS, "",
            fmt::format("The image ends after {} bytes, inside its header.", data.bytes->size()));
        break;
      case HeaderError::Kind::invalid:
        resource_.find(Code::IMAGE_DATA_INVALID, "", error.problem);
        break;
    }
  }

  // The one format that read_header() leaves to a separate reader.
  void check_ktx2(model::ImageData& data) const {
    data.ktx2 = std::make_shared<const image::Ktx2>(image::read_ktx2(data.bytes->view()));
    for (const image::Ktx2Error& error : data.ktx2->errors) {
      resource_.find(error.code, "", error.problem, {},
                     error.tolerated ? std::optional(Severity::warning) : std::nullopt);
    }
    if (!data.ktx2->is_sound()) return;
    data.header = image::header_of(*data.ktx2);
    describe(*data.header);
  }

  void report_unrecognized(const container::Bytes& bytes) const {
    constexpr Code kCode = Code::IMAGE_UNRECOGNIZED_FORMAT;
    if (deviations().few_image_formats) {
      resource_.find(kCode, "", "The image is not a PNG, JPEG or WebP file.");
      return;
    }
    const container::Content found = container::name_content(bytes.text());
    if (is_of_an_extension(found) || is_only_thumbnail()) return;
    const std::string message = fmt::format(
        "The image is {}; it must be {}.", found.name.empty() ? "in an unknown format" : found.name,
        join_or(std::vector<std::string>(enabled_.begin(), enabled_.end())));
    if (!user_.empty() && (found.image || found.name.empty())) {
      resource_.find(
          kCode, "", message,
          fmt::format("convert the image, unless the unknown extension {} allows the format",
                      gltfx::quoted(user_)),
          Severity::warning);
      return;
    }
    resource_.find(kCode, "", message,
                   found.image || found.name.empty() ? "" : "export or download the image again");
  }

  // Formats without a reader here that a declared extension allows: identified by the declared type
  // of the image, unless its bytes contradict it.
  bool is_of_an_extension(const container::Content& found) const {
    if (!found.name.empty()) return contains(enabled_, found.media_type);
    constexpr std::array kTold{"image/jpeg"sv,        "image/png"sv,       "image/webp"sv,
                               "image/avif"sv,        "image/ktx2"sv,      "image/x-exr"sv,
                               "application/x-vdb"sv, "image/vnd-ms.dds"sv};
    return contains(enabled_, declared_) &&
           std::find(kTold.begin(), kTold.end(), declared_) == kTold.end();
  }

  void check_format(image::Format format) const {
    const std::string_view type = image::media_type(format);
    if (!contains(enabled_, type) && !is_only_thumbnail()) {
      resource_.find(Code::IMAGE_NON_ENABLED_MIME_TYPE, "",
                     fmt::format("The image is {}, which requires an extension.", type));
    }
    const std::string said = declared_.empty() || declared_ == type ? uri_type() : declared_;
    if (said.empty() || said == type) return;
    resource_.find(Code::IMAGE_MIME_TYPE_INVALID,
                   resource_.info.storage == "buffer-view" ? "bufferView" : "uri",
                   fmt::format("The declared type of the image is {}, but its data is {}.",
                               gltfx::quoted(said), type));
  }

  // After version 2.0, the thumbnail of the asset may have any format if no texture uses it.
  bool is_only_thumbnail() const {
    const Context& context = resource_.context;
    if (context.version <= schema::kVersion2) return false;
    const json::NodeId asset = context.document.find(context.document.root(), "asset");
    const auto index = context.asset.index(asset, "thumbnail", model::RootArray::images);
    const auto& images = context.asset.elements(model::RootArray::images);
    if (!index || images[*index] != resource_.object) return false;
    const auto& textures = context.asset.elements(model::RootArray::textures);
    return std::none_of(textures.begin(), textures.end(), [&](json::NodeId texture) {
      return context.asset.index(texture, "source", model::RootArray::images) == index;
    });
  }

  // The media type of a data URI, or empty.
  std::string uri_type() const {
    if (resource_.info.storage != "data-uri") return {};
    const json::NodeId member = resource_.context.document.find(resource_.object, "uri");
    std::string unescaped;
    const auto& uri = resource_.context.data_uris->get(
        member, resource_.context.document.string(member, unescaped));
    return uri ? uri->media_type : std::string();
  }

  void describe(const Header& header) const {
    resource_.info.mime_type = image::media_type(header.format);
    ResourceInfo::Image shown;
    shown.width = header.width;
    shown.height = header.height;
    shown.bits = header.bits;
    shown.format = image::channels_name(header.channels);
    shown.primaries = image::tag_name(header.primaries);
    shown.transfer = image::tag_name(header.transfer);
    resource_.info.image = std::move(shown);
  }

  void check_header(const Header& header) const {
    const bool checked = !deviations().few_image_formats;
    if (checked && !header.doubt.empty()) {
      resource_.find(Code::IMAGE_DATA_INVALID, "", header.doubt);
      return;
    }
    if (checked && !header.remark.empty()) {
      resource_.find(Code::IMAGE_DATA_INVALID, "", header.remark, {},
                     header.readers_differ ? Severity::warning : Severity::info);
    }
    const auto power_of_two = [](std::uint32_t size) {
      return size != 0 && (size & (size - 1)) == 0;
    };
    if (!power_of_two(header.width) || !power_of_two(header.height)) {
      resource_.find(Code::IMAGE_NPOT_DIMENSIONS, "",
                     fmt::format("The image has {}x{} pixels.", header.width, header.height));
    }
    if (header.bits == 16) {
      resource_.find(Code::IMAGE_16_BIT, "", "The image has 16 bits per channel.");
    }
    if (header.interlaced) {
      resource_.find(
          Code::IMAGE_INTERLACED, "",
          fmt::format("The image is {}.",
                      header.format == image::Format::jpeg ? "progressive" : "interlaced"));
    }
    check_features(header);
  }

  // Features that are ignored when the image is shown are only worth an info.
  void check_features(const Header& header) const {
    const bool webp = header.format == image::Format::webp;
    std::string features;
    const auto add = [&](bool there, std::string_view text) {
      if (there) features.append(features.empty() ? "" : ", ").append(text);
    };
    const bool all = !deviations().few_image_features;
    const bool profile = all && header.icc_profile;
    const bool own = header.primaries == image::Tag::custom ||
                     header.transfer == image::Tag::custom ||
                     (all && header.transfer == image::Tag::linear);
    add(profile, "a color profile");
    add(own && !profile, "a custom color space");
    add(!header.square_pixels, "non-square pixels");
    add(all && header.exif, "EXIF metadata");
    add(!all && header.animated && webp, "animation");
    if (!features.empty()) {
      resource_.find(Code::IMAGE_FEATURES_UNSUPPORTED, "",
                     fmt::format("The image has {}, which glTF ignores.", features));
    }
    if (all && header.animated) check_animation(webp);
  }

  // A PNG has a still image in addition to its frames, a WebP has only frames.
  void check_animation(bool webp) const {
    resource_.find(Code::IMAGE_FEATURES_UNSUPPORTED, "",
                   webp ? "The image is animated: some loaders show its first frame, others fail."
                        : "The image is animated; glTF only shows its still image.",
                   {}, Severity::warning);
  }

  const Resource& resource_;
  const MediaTypes& enabled_;
  std::string_view user_;
  std::string declared_;
};

// By image: whether a texture uses it without an extension.
std::vector<bool> plain_images(const Context& context, std::size_t count) {
  std::vector<bool> plain(count);
  for (const json::NodeId texture : context.asset.elements(model::RootArray::textures)) {
    const auto source = context.asset.index(texture, "source", model::RootArray::images);
    if (source) plain[*source] = true;
  }
  return plain;
}

// The declared type of an image, otherwise its actual type.
std::string image_type(const Context& context, const model::ResourceData& data,
                       std::uint32_t index) {
  const json::NodeId image = context.asset.elements(model::RootArray::images)[index];
  std::string declared = model::string_member(context.document, image, "mimeType");
  if (declared.empty() && data.images[index].format) {
    declared = image::media_type(*data.images[index].format);
  }
  return declared;
}

struct TextureCheck {
  const Context& context;
  const model::ResourceData& data;
  const MediaTypes& enabled;
  Sink& sink;

  // `object` is the texture or an extension of it.
  void check(json::NodeId object, const Path& path, const std::vector<std::string>& allowed) const {
    const auto source = context.asset.index(object, "source", model::RootArray::images);
    if (!source) return;
    const std::string type = image_type(context, data, *source);
    if (type.empty() || std::find(allowed.begin(), allowed.end(), type) != allowed.end()) return;
    // A format that no extension allows is an error of the image, and reported there.
    if (!contains(enabled, type) && !context.deviations.consequences_are_reported) return;
    report_member(
        sink, context, path, object, "source", Code::TEXTURE_INVALID_IMAGE_MIME_TYPE,
        fmt::format("The texture uses {}, which is {}; it must be {}.",
                    image_label(context, *source), gltfx::quoted(type), join_or(allowed)));
  }
};

constexpr FixEntry kImageFixes[] = {
    {Code::IMAGE_MIME_TYPE_INVALID, correct_image_type},
    {Code::IMAGE_NON_ENABLED_MIME_TYPE, request_conversion, FixStage::images},
    {Code::IMAGE_UNRECOGNIZED_FORMAT, request_conversion, FixStage::images}};

}  // namespace

const RuleGroup& images_rules() {
  static constexpr RuleGroup group{.fixes = kImageFixes};
  return group;
}

void load_images(const Context& context, Sink& sink, FileReport& report, Resources& resources) {
  const Path root;
  const Path array(root, "images");
  const auto& objects = context.asset.elements(model::RootArray::images);
  if (objects.empty()) return;
  const MediaTypes enabled = enabled_media_types(context);
  const std::string_view user = unseen_user(context);
  const std::vector<bool> plain = plain_images(context, objects.size());
  resources.data.images.resize(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] == json::kNoNode) continue;
    const Path path(array, static_cast<std::uint64_t>(i));
    ResourceInfo info;
    info.pointer = path.pointer();
    const Resource resource{context, sink, report, path, objects[i], info};
    model::ImageData& data = resources.data.images[i];
    if (!is_skipped(context, objects[i])) data.bytes = fetch_uri_or_view(resource, resources.data);
    if (data.bytes) ImageCheck(resource, enabled, plain[i] ? std::string_view() : user).check(data);
    resources.listed.push_back(std::move(info));
  }
}

void check_textures(DataPhase& phase) {
  const Path root;
  const Path array(root, "textures");
  const auto& textures = phase.context.asset.elements(model::RootArray::textures);
  if (textures.empty()) return;
  const MediaTypes enabled = enabled_media_types(phase.context);
  const TextureCheck check{phase.context, phase.resources, enabled, phase.sink};
  for (std::size_t i = 0; i < textures.size(); ++i) {
    check.check(textures[i], Path(array, static_cast<std::uint64_t>(i)),
                {"image/jpeg", "image/png"});
  }
  std::vector<const schema::Extension*> extensions = declared_extensions(phase.context);
  std::erase_if(extensions, [](const auto* each) { return each->image_mime_types.empty(); });
  for (std::size_t i = 0; i < textures.size() && !extensions.empty(); ++i) {
    const Path texture(array, static_cast<std::uint64_t>(i));
    const Path member(texture, "extensions");
    for (const schema::Extension* extension : extensions) {
      check.check(model::extension_object(phase.context.document, textures[i], extension->name),
                  Path(member, extension->name), extension->image_mime_types);
    }
  }
}

}  // namespace gltfx::validate
