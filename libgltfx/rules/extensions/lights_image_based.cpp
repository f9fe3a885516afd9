// SPDX-License-Identifier: Apache-2.0
// EXT_lights_image_based: rotations of lights, as for nodes. The sizes of their images are not in
// the document, so they are checked with the images.
#include <bit>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/core/rotation.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kImageBasedLightExtension = "EXT_lights_image_based";

// The actual form of a face that is invalid; empty: it is valid.
std::string error_of(const image::Header& header, std::size_t level,
                     std::optional<std::uint64_t> size) {
  if (header.width != header.height) {
    return fmt::format("is {}x{}; it must be square", header.width, header.height);
  }
  if (!std::has_single_bit(header.width)) {
    return fmt::format("is {0}x{0}; it must be a power of two", header.width);
  }
  if (!size) return {};
  const std::uint64_t wanted = level < 64 ? *size >> level : 0;
  if (header.width == wanted) return {};
  return fmt::format("is {0}x{0}; on level {1} it must be {2}x{2}", header.width, level, wanted);
}

class LightCheck {
 public:
  LightCheck(const Context& context, const model::ResourceData& resources, Sink& sink)
      : context_(context), resources_(resources), sink_(sink) {}

  void check(json::NodeId light, const Path& path) const {
    const auto size = model::unsigned_member(context_.document, light, "specularImageSize");
    const json::NodeId levels = context_.document.find(light, "specularImages");
    if (levels == json::kNoNode || context_.document.kind(levels) != json::Kind::array) return;
    const Path list(path, "specularImages");
    std::size_t level = 0;
    for (const json::NodeId faces : context_.document.elements(levels)) {
      const Path at(list, level);
      model::for_each_index(
          context_.asset, faces, model::RootArray::images,
          [&](std::uint64_t position, std::optional<std::uint32_t> image, Span span) {
            if (image) check_face(*image, level, size, span, Path(at, position));
          });
      ++level;
    }
  }

 private:
  void check_face(std::uint32_t image, std::size_t level, std::optional<std::uint64_t> size,
                  Span span, const Path& path) const {
    const auto& header = resources_.images[image].header;
    if (!header || !header->doubt.empty()) return;
    const std::string error = error_of(*header, level, size);
    if (error.empty()) return;
    Finding finding =
        finding_on(context_, json::kNoNode, Code::IMAGE_BASED_LIGHT_FACE_SIZE,
                   fmt::format("The size of {} {}.", image_label(context_, image), error));
    finding.span = span;
    sink_.report(path, std::move(finding));
  }

  const Context& context_;
  const model::ResourceData& resources_;
  Sink& sink_;
};

}  // namespace

void check_image_based_lights(DataPhase& phase) {
  const json::NodeId object = root_extension(phase.context, kImageBasedLightExtension);
  if (object == json::kNoNode) return;
  const LightCheck check(phase.context, phase.resources, phase.sink);
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kImageBasedLightExtension);
  const Path list(extension, "lights");
  const auto lights = object_list(phase.context.document, object, "lights");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i] != json::kNoNode) check.check(lights[i], Path(list, i));
  }
}

const RuleGroup& lights_image_based_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"EXT_lights_image_based.light", check_rotation}};
  static constexpr RuleGroup group{.object_rules = kObjectRules};
  return group;
}

}  // namespace gltfx::validate
