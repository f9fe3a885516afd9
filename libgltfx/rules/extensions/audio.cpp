// SPDX-License-Identifier: Apache-2.0
// Sources of sound (MPEG_audio_spatial, KHR_audio_emitter): lists of equal length, the order of
// distances, emitters in wrong places, and formats of sound data. This file is about sound and
// names its extensions.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kAudio = "MPEG_audio_spatial";

std::optional<std::uint64_t> length_of(const json::Document& document, json::NodeId object,
                                       std::string_view member) {
  const json::NodeId array = document.find(object, member);
  if (array == json::kNoNode) return 0;
  return document.is_array(array) ? std::optional(document.array_size(array)) : std::nullopt;
}

void check_gains(const Context& context, json::NodeId source, const Path& path) {
  const auto feeds = length_of(context.document, source, "reverbFeed");
  const auto gains = length_of(context.document, source, "reverbFeedGain");
  if (!feeds || !gains || *feeds == *gains) return;
  report_member(
      context.link_sink, context, path, source, "reverbFeedGain", Code::AUDIO_GAIN_COUNT,
      fmt::format("reverbFeedGain has {} numbers, but reverbFeed has {}.", *gains, *feeds));
}

void check_sources(const Context& context, json::NodeId object, const Path& path) {
  const Path list(path, "sources");
  const auto sources = object_list(context.document, object, "sources");
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i] == json::kNoNode) continue;
    check_gains(context, sources[i], Path(list, i));
  }
}

void check_audio(const Context& context) {
  for_each_extension(context, model::RootArray::nodes, kAudio,
                     [&](const ExtensionPlace& place, const Path& path) {
                       check_sources(context, place.object, path);
                     });
  const json::NodeId object = root_extension(context, kAudio);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  check_sources(context, object, Path(extensions, kAudio));
}

constexpr std::string_view kEmitter = "KHR_audio_emitter";

// The linear model divides by the difference of the two.
void check_distances(const Context& context) {
  const json::Document& document = context.document;
  const auto emitters = object_list(document, root_extension(context, kEmitter), "emitters");
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const json::NodeId positional = model::object_member(document, emitters[i], "positional");
    if (model::string_member(document, positional, "distanceModel") != "linear") continue;
    const auto most = model::number_member(document, positional, "maxDistance");
    const double near = model::number_member(document, positional, "refDistance").value_or(1);
    if (!most || *most > near) continue;
    report_at(
        context.link_sink,
        fmt::format("/extensions/{}/emitters/{}/positional/maxDistance", kEmitter, i),
        finding_on(context, document.find(positional, "maxDistance"), Code::AUDIO_DISTANCE_ORDER,
                   fmt::format("maxDistance is {}; it must be above refDistance, {}.",
                               number_text(*most), number_text(near))));
  }
}

void check_scene_emitters(const Context& context) {
  const json::Document& document = context.document;
  const auto emitters = object_list(document, root_extension(context, kEmitter), "emitters");
  std::vector<bool> positional;
  for (const json::NodeId emitter : emitters) {
    positional.push_back(model::string_member(document, emitter, "type") == "positional");
  }
  for_each_extension(
      context, model::RootArray::scenes, kEmitter,
      [&](const ExtensionPlace& place, const Path& path) {
        const json::NodeId list = document.find(place.object, "emitters");
        if (list == json::kNoNode || document.kind(list) != json::Kind::number_array) return;
        const Path at(path, "emitters");
        std::uint64_t position = 0;
        for (json::NumberCursor index(document, list); index.valid(); index.advance()) {
          const Path element(at, position++);
          const double number = index.number().value;
          if (!(number >= 0) || number >= static_cast<double>(positional.size())) continue;
          const auto emitter = static_cast<std::size_t>(number);
          if (!positional[emitter]) continue;
          report_link(
              context, element, index.number().span, Code::AUDIO_EMITTER_NOT_GLOBAL,
              fmt::format("Emitter {} is positional; those of a scene must be global.", emitter));
        }
      });
}

// A format that sound data may have, and the extension that defines it.
struct AudioFormat {
  std::string_view mime_type, suffix, extension;
};
constexpr AudioFormat kAudioFormats[] = {
    {"audio/mpeg", ".mp3", ""},
    {"audio/ogg", ".ogg", "OMI_audio_ogg_vorbis"},
    {"audio/opus", ".opus", "OMI_audio_opus"},
    {"audio/webm", ".webm", "OMI_audio_opus"},
    {"video/webm", ".webm", "OMI_audio_opus"},
};

// Sound data that a source, or the object of `extension` on a source, refers to.
void check_audio_format(const Context& context, json::NodeId audio, std::size_t index,
                        std::string_view extension) {
  const json::Document& document = context.document;
  const std::string type = model::string_member(document, audio, "mimeType");
  const std::string uri = model::string_member(document, audio, "uri");
  const bool by_name = type.empty();
  if (by_name && (uri.empty() || extension.empty() || uri.starts_with("data:"))) return;
  std::vector<std::string> allowed;
  for (const AudioFormat& format : kAudioFormats) {
    if (format.extension != extension) continue;
    if (by_name ? uri.ends_with(format.suffix) : type == format.mime_type) return;
    if (by_name && format.mime_type == "video/webm") continue;  // reported as audio/webm
    allowed.emplace_back(by_name ? format.suffix : format.mime_type);
  }
  const std::string_view member = by_name ? "uri" : "mimeType";
  report_at(context.link_sink, fmt::format("/extensions/{}/audio/{}/{}", kEmitter, index, member),
            finding_on(context, document.find(audio, member), Code::AUDIO_MIME_TYPE_INVALID,
                       fmt::format("The {} is {}; for {} it must {}{}.", member,
                                   gltfx::quoted(by_name ? uri : type),
                                   extension.empty() ? kEmitter : extension,
                                   by_name ? "end with " : "be ", join_or(allowed, 3))));
}

void check_audio_formats(const Context& context) {
  const json::Document& document = context.document;
  const json::NodeId object = root_extension(context, kEmitter);
  const auto audio = object_list(document, object, "audio");
  const auto check = [&](json::NodeId source, std::string_view extension) {
    const auto index = model::unsigned_member(document, source, "audio");
    if (!index || *index >= audio.size()) return;
    check_audio_format(context, audio[*index], *index, extension);
  };
  for (const json::NodeId source : object_list(document, object, "sources")) {
    check(source, {});
    std::string_view last;
    for (const AudioFormat& format : kAudioFormats) {
      if (format.extension == last) continue;
      last = format.extension;
      check(model::extension_object(document, source, last), last);
    }
  }
}

}  // namespace

const RuleGroup& audio_rules() {
  static constexpr LinkRule kLinkRules[] = {check_audio, check_distances, check_scene_emitters,
                                            check_audio_formats};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
