// SPDX-License-Identifier: Apache-2.0
// MPEG_audio_spatial: lists that go together. This file is about sources of sound and names the
// extension.
#include <fmt/format.h>

#include "base/codes.hpp"
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

}  // namespace

const Family& audio_family() {
  static constexpr LinkRule kLinkRules[] = {check_audio};
  static constexpr Family family{.order = 580, .link_rules = kLinkRules};
  return family;
}

}  // namespace gltfx::validate
