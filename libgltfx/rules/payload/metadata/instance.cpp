// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/metadata/instance.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/extension_walk.hpp"
#include "rules/payload/metadata/value_scan.hpp"
#include "rules/payload/metadata/values.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataClass;
using model::MetadataProperty;

const MetadataClass* class_of(MetadataPhase& phase, json::NodeId object, const Path& path) {
  const json::NodeId value = phase.document().find(object, "class");
  if (value == json::kNoNode || !phase.document().is_string(value) || !phase.schema.exists()) {
    return nullptr;
  }
  const std::string id = phase.document().string(value);
  const MetadataClass* found = phase.schema.find_class(id);
  if (found == nullptr) {
    report_in(phase.sink(), Path(path, "class"), phase.document(), value,
              Code::METADATA_UNRESOLVED_ID,
              fmt::format("The schema has no class {}.", gltfx::quoted(id)));
  }
  return found;
}

// The first required property that is missing. All previous ones exist, so the time is linear in
// the object.
void check_required(MetadataPhase& phase, const MetadataClass& owner, json::NodeId object,
                    const Path& path, const json::KeyTable& found) {
  for (const MetadataProperty& property : owner.properties) {
    if (!property.required || found.contains(property.id)) continue;
    return report_in(phase.sink(), path, phase.document(), object, Code::METADATA_PROPERTY_MISSING,
                     fmt::format("The property {} of class {} is required, but missing.",
                                 gltfx::quoted(property.id), gltfx::quoted(owner.id)));
  }
}

}  // namespace

void for_each_property(MetadataPhase& phase, json::NodeId object, const Path& path,
                       const std::function<void(const PropertyUse&)>& use) {
  const MetadataClass* owner = class_of(phase, object, path);
  if (owner == nullptr) return;
  const json::Document& document = phase.document();
  const json::NodeId properties = model::object_member(document, object, "properties");
  json::KeyTable found;
  if (properties != json::kNoNode) {
    const Path list(path, "properties");
    for (const auto member : document.members(properties)) {
      const std::string_view id = document.key(member.key_id);
      const Path at(list, id);
      found.insert(id);
      if (const MetadataProperty* property = owner->find(id)) {
        use({*property, member.value, at});
      } else if (!owner->derived) {
        report_in(phase.sink(), at, document, member.key, Code::METADATA_UNRESOLVED_ID,
                  fmt::format("Class {} has no property {}.", gltfx::quoted(owner->id),
                              gltfx::quoted(id)));
      }
    }
  }
  check_required(phase, *owner, object, path, found);
}

void for_each_listed(
    MetadataPhase& phase, std::string_view list,
    const std::function<void(std::size_t, json::NodeId, const PropertyUse&)>& use) {
  with_metadata_path([&](const Path& path) {
    const Path array(path, list);
    const auto objects = object_list(phase.document(), phase.root, list);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] == json::kNoNode) continue;
      for_each_property(phase, objects[i], Path(array, i), [&](const PropertyUse& property) {
        if (!phase.document().is_object(property.value)) return;
        check_metadata_limits({phase.document(), property.value, property.path, phase.sink()},
                              property.property, true);
        use(i, objects[i], property);
      });
    }
  });
}

void for_each_index(const MetadataPhase& phase, json::NodeId object, const Path& path,
                    std::string_view list, std::size_t size,
                    const std::function<void(std::size_t, json::NodeId, const Path&)>& use) {
  const json::Document& document = phase.document();
  const json::NodeId indices = document.find(object, list);
  if (indices == json::kNoNode || document.kind(indices) != json::Kind::number_array) return;
  const Path array(path, list);
  std::uint64_t i = 0;
  for (json::NumberCursor at(document, indices); at.valid(); at.advance(), ++i) {
    const double index = at.number().value;
    if (!at.number().is_integer() || index < 0 || index >= static_cast<double>(size)) continue;
    use(static_cast<std::size_t>(index), indices, Path(array, i));
  }
}

void check_enum_type(const model::MetadataSchema& schema, const MetadataProperty& property,
                     const Path& path, Sink& sink) {
  const json::Document& document = schema.document();
  const json::NodeId value = document.find(property.node, "enumType");
  if (value == json::kNoNode || !document.is_string(value) || property.enumeration != nullptr) {
    return;
  }
  report_in(sink, Path(path, "enumType"), document, value, Code::METADATA_UNRESOLVED_ID,
            fmt::format("The schema has no enum {}.", gltfx::quoted(document.string(value))));
}

void report_unstorable(MetadataPhase& phase, const PropertyUse& use, std::string_view what,
                       std::string_view why) {
  report_in(phase.sink(), use.path, phase.document(), use.value,
            Code::METADATA_PROPERTY_NOT_STORABLE,
            fmt::format("Property {} cannot be stored in {}, because {}.",
                        gltfx::quoted(use.property.id), what, why));
}

void check_metadata_of_objects(MetadataPhase& phase) {
  for (std::size_t i = 0; i < model::kRootArrayCount; ++i) {
    for_each_extension(phase.context(), static_cast<model::RootArray>(i), kMetadataExtension,
                       [&](const ExtensionPlace& place, const Path& path) {
                         for_each_property(phase, place.object, path, [&](const PropertyUse& use) {
                           check_metadata_value(
                               {phase.document(), place.object, *use.path.parent(), phase.sink()},
                               use.property.id, use.value, use.property,
                               MetadataNumber::transformed);
                           check_json_bounds(phase, use);
                         });
                       });
  }
}

}  // namespace gltfx::validate
