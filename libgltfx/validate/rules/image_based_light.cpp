// SPDX-License-Identifier: Apache-2.0
// The sizes of images are not in the document, so this file names the extension.
#include "validate/rules/image_based_light.hpp"

#include <bit>

#include <fmt/format.h>

#include "model/node.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"
#include "validate/rules/texture_slots.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"IMAGE_BASED_LIGHT_FACE_SIZE", Severity::error,
     "A face of an environment light has the wrong size",
     "The faces of one level make a cube, and levels a pyramid; the graphics card takes them only "
     "if their sizes go together.",
     "Make all faces square, of a power of two, level 0 of specularImageSize and each further "
     "level "
     "half as large.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_lights_image_based"],
 "scene": 0, "scenes": [{"nodes": [0], "extensions": {"EXT_lights_image_based": {"light": 0}}}], "nodes": [{"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "extensions": {"EXT_lights_image_based": {"lights": [{"specularImageSize": 4,
  "specularImages": [[0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]],
  "irradianceCoefficients": [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]}]}},
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAADklEQVR4nGPgBAMGCAUAAwIAbRcppVIAAAAASUVORK5CYII="},
  {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGPg5OQEAAA6ABztCJuOAAAAAElFTkSuQmCC"}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_lights_image_based"],
 "scene": 0, "scenes": [{"nodes": [0], "extensions": {"EXT_lights_image_based": {"light": 0}}}], "nodes": [{"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "extensions": {"EXT_lights_image_based": {"lights": [{"specularImageSize": 2,
  "specularImages": [[0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]],
  "irradianceCoefficients": [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]}]}},
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAADklEQVR4nGPgBAMGCAUAAwIAbRcppVIAAAAASUVORK5CYII="},
  {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGPg5OQEAAA6ABztCJuOAAAAAElFTkSuQmCC"}]})",
     Fix::none, false},
};

constexpr std::string_view kExtension = "EXT_lights_image_based";

// What a face is like instead of what it must be; empty: nothing is wrong.
std::string fault_of(const image::Header& header, std::size_t level,
                     std::optional<std::uint64_t> size) {
  if (header.width != header.height) {
    return fmt::format("has {} by {} pixels; faces are square", header.width, header.height);
  }
  if (!std::has_single_bit(header.width)) {
    return fmt::format("has {} pixels a side, which is no power of two", header.width);
  }
  if (!size) return {};
  const std::uint64_t wanted = level < 64 ? *size >> level : 0;
  if (header.width == wanted) return {};
  return fmt::format("has {} pixels a side; on level {} it must be {}", header.width, level,
                     wanted);
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
    const std::string fault = fault_of(*header, level, size);
    if (fault.empty()) return;
    Finding finding = finding_on(context_, json::kNoNode, "IMAGE_BASED_LIGHT_FACE_SIZE",
                                 fmt::format("{} {}.", image_label(context_, image), fault));
    finding.span = span;
    sink_.report(path, std::move(finding));
  }

  const Context& context_;
  const model::ResourceData& resources_;
  Sink& sink_;
};

}  // namespace

void check_image_based_lights(const Context& context, const model::ResourceData& resources,
                              Sink& sink) {
  const json::NodeId object = root_extension(context, kExtension);
  if (object == json::kNoNode) return;
  const LightCheck check(context, resources, sink);
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kExtension);
  const Path list(extension, "lights");
  const auto lights = object_list(context.document, object, "lights");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i] != json::kNoNode) check.check(lights[i], Path(list, i));
  }
}

const Family& image_based_light_family() {
  static const Family family{"image_based_light", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
