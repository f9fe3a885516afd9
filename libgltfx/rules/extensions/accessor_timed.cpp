// SPDX-License-Identifier: Apache-2.0
// Accessors whose elements arrive while the scene runs (MPEG_accessor_timed), and their users: the
// texts of other extensions state in prose which members need such accessors, so this file has a
// table of them.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/accessor.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kTimed = "MPEG_accessor_timed";
constexpr std::string_view kCircular = "MPEG_buffer_circular";

bool is_timed(const Context& context, std::uint32_t accessor) {
  const json::NodeId object = context.asset.elements(model::RootArray::accessors)[accessor];
  return model::extension_object(context.document, object, kTimed) != json::kNoNode;
}

std::string not_timed(std::uint32_t accessor) {
  return fmt::format("Accessor {} has no {}.", accessor, kTimed);
}

void check_member(const Context& context, json::NodeId object, const Path& path) {
  const auto index = context.asset.index(object, "accessor", model::RootArray::accessors);
  if (!index || is_timed(context, *index)) return;
  report_member(context.link_sink, context, path, object, "accessor", Code::ACCESSOR_NOT_TIMED,
                not_timed(*index));
}

// --- Sources of sound: a list of accessors each ---

void check_sources(const Context& context, json::NodeId object, const Path& path) {
  const Path list(path, "sources");
  const auto sources = object_list(context.document, object, "sources");
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Path source(list, i);
    const Path accessors(source, "accessors");
    model::for_each_index(
        context.asset, context.document.find(sources[i], "accessors"), model::RootArray::accessors,
        [&](std::uint64_t position, std::optional<std::uint32_t> index, Span span) {
          if (!index || is_timed(context, *index)) return;
          report_link(context, Path(accessors, position), span, Code::ACCESSOR_NOT_TIMED,
                      not_timed(*index));
        });
  }
}

// --- The events of animations ---

void check_circular(const Context& context, json::NodeId object, const Path& path) {
  const auto index = context.asset.index(object, "accessor", model::RootArray::accessors);
  if (!index) return;
  const model::BufferView* view = context.views.view_of(context.views.accessors[*index]);
  if (view == nullptr || !view->buffer) return;
  const json::NodeId buffer = context.asset.elements(model::RootArray::buffers)[*view->buffer];
  if (model::extension_object(context.document, buffer, kCircular) != json::kNoNode) return;
  report_member(context.link_sink, context, path, object, "accessor",
                Code::TIMED_BUFFER_NOT_CIRCULAR,
                fmt::format("Accessor {} uses buffer {}, which has no {}.", *index, *view->buffer,
                            kCircular));
}

// --- Frames of video: as many components as the format has channels ---

unsigned channels_of(std::string_view format) {
  if (format == "RG") return 2;
  if (format == "RGB" || format == "BGR" || format.empty()) return 3;
  if (format == "RGBA" || format == "BGRA") return 4;
  return 1;
}

void check_frames(const Context& context, json::NodeId object, const Path& path) {
  const auto index = context.asset.index(object, "accessor", model::RootArray::accessors);
  if (!index) return;
  const model::Format& format = context.views.accessors[*index].format;
  const std::string name = model::string_member(context.document, object, "format");
  const unsigned channels = channels_of(name);
  if (!format.known() || model::component_count(format.type) == channels) return;
  report_member(context.link_sink, context, path, object, "accessor",
                Code::EXTENSION_ACCESSOR_INVALID_FORMAT,
                fmt::format("Accessor {} is {}, but the pixel format {} has {} channel{}.", *index,
                            format_text(format), name.empty() ? "RGB" : name, channels,
                            channels == 1 ? "" : "s"));
}

void check_root(const Context& context) {
  const Path root;
  const Path extensions(root, "extensions");
  constexpr std::string_view kTiming = "MPEG_animation_timing";
  constexpr std::string_view kAudio = "MPEG_audio_spatial";
  if (const json::NodeId object = root_extension(context, kTiming); object != json::kNoNode) {
    check_member(context, object, Path(extensions, kTiming));
    check_circular(context, object, Path(extensions, kTiming));
  }
  if (const json::NodeId object = root_extension(context, kAudio); object != json::kNoNode) {
    check_sources(context, object, Path(extensions, kAudio));
  }
  for_each_extension(context, model::RootArray::nodes, kAudio,
                     [&](const ExtensionPlace& place, const Path& path) {
                       check_sources(context, place.object, path);
                     });
}

void check_textures(const Context& context) {
  for_each_extension(context, model::RootArray::textures, "MPEG_texture_video",
                     [&](const ExtensionPlace& place, const Path& path) {
                       check_member(context, place.object, path);
                       check_frames(context, place.object, path);
                     });
}

}  // namespace

const RuleGroup& accessor_timed_rules() {
  static constexpr LinkRule kLinkRules[] = {check_root, check_textures};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
