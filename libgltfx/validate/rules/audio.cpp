// SPDX-License-Identifier: Apache-2.0
// Sources of sound (MPEG_audio_spatial, KHR_audio_emitter): lists that go together, distances in
// order, and which emitters have no place. This file is about sound and names its extensions.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "model/node.hpp"
#include "validate/context.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/finding.hpp"

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

}  // namespace

const Family& audio_family() {
  static constexpr LinkRule kLinkRules[] = {check_audio, check_distances, check_scene_emitters};
  static constexpr Family family{.order = 580, .link_rules = kLinkRules};
  return family;
}

}  // namespace gltfx::validate
