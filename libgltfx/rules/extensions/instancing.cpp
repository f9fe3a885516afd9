// SPDX-License-Identifier: Apache-2.0
// Extensions that draw the mesh of a node many times: the schema files name them and the formats of
// their attributes (`instanceAttributes`).
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/accessor.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

// The name of a component type in schema files: "BYTE_NORM".
std::string schema_name(const model::Format& format) {
  std::string name(model::component_type_name(format.component));
  constexpr std::string_view kUnsigned = "UNSIGNED_";
  if (name.starts_with(kUnsigned)) name.erase(1, kUnsigned.size() - 1);
  return format.normalized ? name + "_NORM" : name;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const schema::AttributeFormat* find_format(const schema::Extension& extension,
                                           std::string_view name) {
  const auto& all = extension.instance_attributes;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.semantic == name; });
  return found == all.end() ? nullptr : &*found;
}

class InstancingCheck {
 public:
  InstancingCheck(const Context& context, const schema::Extension& extension)
      : context_(context), extension_(extension) {}

  void check(const ExtensionPlace& place, const Path& path) {
    check_host(place, path);
    const json::NodeId attributes =
        model::object_member(context_.document, place.object, "attributes");
    if (attributes == json::kNoNode) return;
    const Path at(path, "attributes");
    std::optional<std::uint64_t> count;
    for (const auto& attribute : model::read_attributes(context_.asset, attributes)) {
      if (!attribute.accessor) continue;
      const Path member(at, attribute.name);
      check_format(attribute, member);
      const auto own = context_.views.accessors[*attribute.accessor].count;
      if (own && count && *own != *count) report_count(attribute, *own, *count, member);
      if (!count) count = own;
    }
  }

 private:
  void check_host(const ExtensionPlace& place, const Path& path) {
    if (context_.document.find(place.host, "mesh") == json::kNoNode) {
      report_link(context_, path, place.object, Code::INSTANCING_NODE_WITHOUT_MESH,
                  "The instanced node has no mesh.");
    } else if (context_.asset.index(place.host, "skin", model::RootArray::skins)) {
      report_link(context_, path, place.object, Code::INSTANCING_NODE_WITH_SKIN,
                  "The instanced node has a skin.");
    }
  }

  void check_format(const model::Attribute& attribute, const Path& path) {
    const schema::AttributeFormat* wanted = find_format(extension_, attribute.name);
    const model::Format& format = context_.views.accessors[*attribute.accessor].format;
    if (wanted == nullptr || !format.known()) return;
    if (contains(wanted->types, model::element_type_name(format.type)) &&
        contains(wanted->components, schema_name(format))) {
      return;
    }
    report_link(context_, path, attribute.value, Code::INSTANCING_ACCESSOR_INVALID_FORMAT,
                fmt::format("Accessor {} for {} is {}; it must be {} of {}.", *attribute.accessor,
                            attribute.name, format_text(format), fmt::join(wanted->types, " or "),
                            fmt::join(wanted->components, " or ")));
  }

  void report_count(const model::Attribute& attribute, std::uint64_t own, std::uint64_t first,
                    const Path& path) {
    report_link(context_, path, attribute.value, Code::INSTANCING_UNEQUAL_COUNT,
                fmt::format("{} has {} elements, but the first attribute has {}.",
                            gltfx::quoted(attribute.name), own, first));
  }

  const Context& context_;
  const schema::Extension& extension_;
};

void check_instances(const Context& context) {
  for (const schema::Extension* extension : instancing_extensions(context)) {
    InstancingCheck check(context, *extension);
    for_each_extension(
        context, model::RootArray::nodes, extension->name,
        [&](const ExtensionPlace& place, const Path& path) { check.check(place, path); });
  }
}

}  // namespace

const RuleGroup& instancing_rules() {
  static constexpr LinkRule kLinkRules[] = {check_instances};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
