// SPDX-License-Identifier: Apache-2.0
// VRMC_vrm: annotations that must not name a node twice, and restrictions of avatars on texture
// transforms.
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kAvatarWithMeshes = "VRMC_vrm";
constexpr std::string_view kTextureTransform = "KHR_texture_transform";

void check_annotations(const Context& context) {
  const json::Document& document = context.document;
  const json::NodeId person =
      model::object_member(document, root_extension(context, kAvatarWithMeshes), "firstPerson");
  const auto list = object_list(document, person, "meshAnnotations");
  std::unordered_map<std::uint32_t, std::size_t> known;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto node = context.asset.index(list[i], "node", model::RootArray::nodes);
    if (!node) continue;
    const auto [first, fresh] = known.emplace(*node, i);
    if (fresh) continue;
    report_at(
        context.link_sink,
        fmt::format("/extensions/{}/firstPerson/meshAnnotations/{}/node", kAvatarWithMeshes, i),
        finding_on(context, document.find(list[i], "node"), Code::ANNOTATION_REPEATED,
                   fmt::format("Annotation {} is already about {}.", first->second,
                               object_label(context, model::RootArray::nodes, *node))));
  }
}

// Avatar loaders only apply offset and scale to textures.
void check_texture_transforms(const Context& context) {
  if (root_extension(context, kAvatarWithMeshes) == json::kNoNode) return;
  const json::Document& document = context.document;
  for (const schema::SlotUse& slot : context.checked.slots) {
    const json::NodeId transform =
        model::extension_object(document, slot.texture_info, kTextureTransform);
    if (transform == json::kNoNode) continue;
    const bool turned = model::number_member(document, transform, "rotation").value_or(0) != 0;
    const bool moved = document.find(transform, "texCoord") != json::kNoNode;
    if (!turned && !moved) continue;
    const std::string_view member = turned ? "rotation" : "texCoord";
    report_at(context.link_sink,
              fmt::format("{}/extensions/{}/{}", slot.pointer, kTextureTransform, member),
              finding_on(context, document.find(transform, member), Code::AVATAR_TEXTURE_TRANSFORM,
                         fmt::format("Loaders of avatars ignore {}.", member)));
  }
}

}  // namespace

const RuleGroup& vrm_avatar_rules() {
  static constexpr LinkRule kLinkRules[] = {check_annotations, check_texture_transforms};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
