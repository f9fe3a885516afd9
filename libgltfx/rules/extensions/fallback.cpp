// SPDX-License-Identifier: Apache-2.0
// Extensions with data in another form: unless there is a copy that every program can read, the
// asset must require them. The schema files name these extensions, and their host object is the
// place of a copy.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/buffer_chunk.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {
namespace {

bool is_required(const Context& context, std::string_view name) {
  const auto& required = context.checked.extensions_required;
  return std::find(required.begin(), required.end(), name) != required.end();
}

// Whether a member names an accessor without data of its own; sparse values count as data.
bool accessor_is_hollow(const Context& context, json::NodeId object, std::string_view member) {
  const auto index = context.asset.index(object, member, model::RootArray::accessors);
  if (!index) return false;
  const json::NodeId accessor = context.asset.elements(model::RootArray::accessors)[*index];
  return context.document.find(accessor, "bufferView") == json::kNoNode &&
         context.document.find(accessor, "sparse") == json::kNoNode;
}

// Whether the primitive lacks data for a program that ignores the extension.
bool primitive_lacks_data(const Context& context, json::NodeId primitive, json::NodeId extension) {
  const json::Document& document = context.document;
  if (accessor_is_hollow(context, primitive, "indices")) return true;
  const json::NodeId attributes = document.find(primitive, "attributes");
  const json::NodeId packed = document.find(extension, "attributes");
  if (packed == json::kNoNode || !document.is_object(packed)) return false;
  for (const auto& member : document.members(packed)) {
    if (accessor_is_hollow(context, attributes, document.key(member.key_id))) return true;
  }
  return false;
}

// A buffer that is neither a file, a data URI nor the BIN chunk has no bytes.
bool buffer_view_lacks_data(const Context& context, json::NodeId view, json::NodeId) {
  const auto index = context.asset.index(view, "buffer", model::RootArray::buffers);
  if (!index) return false;
  const json::NodeId buffer = context.asset.elements(model::RootArray::buffers)[*index];
  const bool is_chunk =
      model::chunk_of(context.container, context.document, buffer, *index, context.version)
          .has_value();
  return context.document.find(buffer, "uri") == json::kNoNode && !is_chunk;
}

using LacksData = bool (*)(const Context&, json::NodeId, json::NodeId);

void check_object(const Context& context, json::NodeId object, const Path& path, LacksData lacks) {
  const json::Document& document = context.document;
  const json::NodeId extensions = document.find(object, "extensions");
  if (extensions == json::kNoNode || !document.is_object(extensions)) return;
  const Path at_extensions(path, "extensions");
  for (const auto& member : document.members(extensions)) {
    const std::string_view name = document.key(member.key_id);
    const schema::ExtensionId id = context.schemas.find_extension(name);
    if (id == schema::kNone) continue;
    const schema::Extension& extension = context.schemas.extensions()[id];
    // If there is a `fallback` member, the schema walk decides.
    if (extension.must_be_required != schema::MustBeRequired::without_fallback ||
        !extension.fallback.empty() || is_required(context, name) ||
        !lacks(context, object, member.value)) {
      continue;
    }
    Finding finding(Code::NON_REQUIRED_EXTENSION);
    finding.message =
        fmt::format("The data has no fallback for {}, which is not in extensionsRequired.", name);
    finding.help = fmt::format("add \"{}\" to extensionsRequired", name);
    finding.span = document.span(member.key);
    context.link_sink.report(Path(at_extensions, name), std::move(finding));
  }
}

void check_buffer_views(const Context& context) {
  const Path root;
  const Path views(root, "bufferViews");
  const auto& objects = context.asset.elements(model::RootArray::buffer_views);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    check_object(context, objects[i], Path(views, i), buffer_view_lacks_data);
  }
}

void check_primitives(const Context& context) {
  const json::Document& document = context.document;
  const Path root;
  const Path meshes(root, "meshes");
  const auto& objects = context.asset.elements(model::RootArray::meshes);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const json::NodeId primitives = document.find(objects[i], "primitives");
    if (primitives == json::kNoNode || document.kind(primitives) != json::Kind::array) continue;
    const Path mesh(meshes, i);
    const Path list(mesh, "primitives");
    std::uint64_t index = 0;
    for (const json::NodeId primitive : document.elements(primitives)) {
      const Path path(list, index++);
      check_object(context, primitive, path, primitive_lacks_data);
    }
  }
}

}  // namespace

const RuleGroup& fallback_rules() {
  static constexpr LinkRule kLinkRules[] = {check_buffer_views, check_primitives};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
