// SPDX-License-Identifier: Apache-2.0
// What the lists of extensions promise, held against what the asset really uses.
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "schema/extension_names.hpp"
#include "schema/form_check.hpp"
#include "schema/phrases.hpp"
#include "validate/rules/attribute_formats.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/unseen_use.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMinimal = R"({"asset": {"version": "2.0"}})";

constexpr RuleDescription kRules[] = {
    {"EXTENSION_ARCHIVED", Severity::info, "The asset uses an archived extension",
     "It was withdrawn; new programs do not read it.", "Move to its successor where there is one.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 0.5}}}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"pbrMetallicRoughness": {"roughnessFactor": 0.5}}]})",
     Fix::safe, false},
    {"EXTENSION_DRAFT", Severity::info, "The asset uses a draft of an extension",
     "A draft changes until it is released; readers of one version misread another.",
     "Keep the source, and export again when the extension is released.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_scatter", "KHR_materials_transmission"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_scatter": {"scatterStrengthFactor": 1}, "KHR_materials_transmission": {"transmissionFactor": 1}}}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_transmission"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}]})",
     Fix::none, false},
    {"EXTENSION_LEGACY", Severity::info,
     "The asset uses an extension that was replaced before its release",
     "Hardly any program reads it; the material looks plain without it.",
     "Bring the asset up to date with its successor.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_translucency"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"KHR_materials_translucency": {"translucencyFactor": 0.5}}}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_diffuse_transmission"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5}}}]})",
     Fix::safe, false},
    {"EXTENSION_NAME_MISSPELT", Severity::warning,
     "The name of an extension is nearly that of another one",
     "Programs look extensions up by their exact name, capitals included: what the asset says by "
     "this one is ignored.",
     "Write the name that is meant.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_material_unlit"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_material_unlit": {}}}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_unlit": {}}}]})",
     Fix::none, false},
    {"EXTENSION_REQUIRED_WITH_FALLBACK", Severity::warning,
     "An extension is required although everything has a fallback",
     "Programs that do not know the extension refuse the asset, which they could show as well.",
     "Remove the extension from extensionsRequired, or remove the fallbacks.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_texture_webp"], "extensionsRequired": ["EXT_texture_webp"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
 "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="},
  {"uri": "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_texture_webp"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
 "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="},
  {"uri": "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}]})",
     Fix::safe, false},
    {"EXTENSION_SHOULD_BE_REQUIRED", Severity::warning,
     "An extension without a fallback is only declared as used",
     "A program that does not know it shows a broken asset instead of refusing it.",
     "List the extension in extensionsRequired too.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     Fix::none, false},
    {"EXTENSION_UNUSED", Severity::info, "An extension is declared but used nowhere",
     "Programs may load code for it, or refuse the asset for nothing.",
     "Remove it from extensionsUsed.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"]})", kMinimal,
     Fix::none, false},
    {"UNSUPPORTED_EXTENSION", Severity::info, "Nothing is known of an extension",
     "Its content was not looked at: the asset may have faults nobody reported.",
     "Describe it in a schema file and give that with --schema.",
     R"({"asset": {"version": "2.0", "extensions": {"ACME_sparkle": {}}}, "extensionsUsed": ["ACME_sparkle"]})",
     kMinimal, Fix::none, true},
    {"UNSUPPORTED_EXTENSION_REQUIRED", Severity::warning,
     "The asset requires an extension of which nothing is known",
     "The asset cannot be read without it, so hardly any program will show it, and it could "
     "not be checked.",
     "Describe it in a schema file and give that with --schema.",
     R"({"asset": {"version": "2.0", "extensions": {"ACME_sparkle": {}}}, "extensionsUsed": ["ACME_sparkle"], "extensionsRequired": ["ACME_sparkle"]})",
     kMinimal, Fix::none, false},
};

using NameSet = std::unordered_set<std::string_view>;

NameSet as_set(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

// So many extensions are told apart; what says the same of more is folded.
constexpr std::uint64_t kMostTold = 50;

// The three lists, to look names up in.
struct Names {
  NameSet used, required, seen, without_fallback;
  std::string_view unseen;                                          ///< see unseen_user()
  std::unordered_map<std::string_view, std::string_view> misspelt;  ///< to what is meant
  std::vector<std::string> required_unknown;  ///< in the order of extensionsUsed
  explicit Names(const Context& context)
      : used(as_set(context.checked.extensions_used)),
        required(as_set(context.checked.extensions_required)),
        seen(as_set(context.checked.extensions_seen)),
        without_fallback(as_set(context.checked.without_fallback)),
        unseen(unseen_user(context)) {
    std::uint64_t compared = 0;
    for (const std::string& name : context.checked.extensions_used) {
      if (context.schemas.find_extension(name) != schema::kNone) continue;
      const std::string_view meant = compared++ < kMostTold
                                         ? schema::misspelt_extension(context.schemas, name)
                                         : std::string_view();
      if (!meant.empty()) misspelt.emplace(name, meant);
      if (meant.empty() && required.count(name) != 0) required_unknown.push_back(name);
    }
  }
};

// One entry of extensionsUsed, or an extension that is used without being declared.
struct Entry {
  const Context& context;
  const Names& names;
  const Path& path;
  Span span;
  std::string name;

  void report(std::string_view code, std::string message, std::string help = {}) const {
    Finding finding;
    finding.code = code;
    finding.message = std::move(message);
    finding.help = std::move(help);
    finding.span = span;
    if (path.is_index() && path.index() < kMostTold) finding.about = name;
    context.link_sink.report(path, std::move(finding));
  }
};

// 'A', 'B' and 3 others.
std::string names_text(std::vector<std::string> names) {
  constexpr std::size_t kMostNamed = 5;
  if (names.size() <= kMostNamed + 1) return schema::all_of_phrase(names);
  const std::size_t others = names.size() - kMostNamed;
  names.resize(kMostNamed);
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}, ", gltfx::quoted(name));
  return fmt::format("{}and {} others", text, others);
}

// What is required and unknown is one finding, whatever the number: nothing more can be said.
void report_unknown(const Entry& entry) {
  const auto misspelt = entry.names.misspelt.find(entry.name);
  if (misspelt != entry.names.misspelt.end()) {
    entry.report("EXTENSION_NAME_MISSPELT",
                 fmt::format("{} is no extension that is known here.", gltfx::quoted(entry.name)),
                 fmt::format("did you mean {}?", gltfx::quoted(misspelt->second)));
    return;
  }
  if (!schema::is_extension_name(entry.name) && !schema::is_known_without_schema(entry.name)) {
    entry.report("INVALID_EXTENSION_NAME_FORMAT",
                 fmt::format("{} is no name of an extension; names look like VENDOR_what_it_does.",
                             gltfx::quoted(entry.name)));
  }
  if (entry.names.required.count(entry.name) != 0) {
    if (entry.name != entry.names.required_unknown.front()) return;
    entry.report("UNSUPPORTED_EXTENSION_REQUIRED",
                 fmt::format("The asset cannot be read without {}, of which nothing is known here.",
                             names_text(entry.names.required_unknown)));
  } else {
    entry.report("UNSUPPORTED_EXTENSION",
                 fmt::format("Nothing is known of {}; what it says was not checked.",
                             gltfx::quoted(entry.name)));
  }
}

std::string successor_help(const schema::Extension& extension) {
  if (extension.successor.empty()) return {};
  const bool mendable = extension.upgrade.to == extension.successor;
  std::string help = fmt::format("its successor is {}", extension.successor);
  if (!mendable) return help;
  const bool on_request = !extension.upgrade.opt_in.empty();
  return fmt::format("{}; 'gltfx upgrade{}{}' brings the file there", help,
                     on_request ? " --only " : "", on_request ? extension.name : "");
}

void report_status(const Entry& entry, const schema::Extension& extension) {
  switch (extension.status) {
    case schema::Status::legacy:
      entry.report("EXTENSION_LEGACY",
                   fmt::format("{} was replaced before it was released.", extension.name),
                   successor_help(extension));
      break;
    case schema::Status::archived:
      entry.report("EXTENSION_ARCHIVED", fmt::format("{} is archived.", extension.name),
                   successor_help(extension));
      break;
    case schema::Status::draft:
      entry.report("EXTENSION_DRAFT",
                   fmt::format("{} is a draft and may still change.", extension.name),
                   successor_help(extension));
      break;
    default:
      break;
  }
}

// An extension either has objects, or formats of attributes alone.
bool is_unused(const Entry& entry, const schema::Extension& extension) {
  if (!extension.homes.empty()) return entry.names.seen.count(extension.name) == 0;
  const bool formats = !extension.vertex_attributes.empty() || !extension.morph_attributes.empty();
  return formats && !uses_formats_of(entry.context, extension);
}

void report_use(const Entry& entry, const schema::Extension& extension) {
  if (is_unused(entry, extension)) {
    // It may be used inside of one that is not looked into, such as a transform of its textures.
    if (!entry.names.unseen.empty()) return;
    entry.report("EXTENSION_UNUSED",
                 fmt::format("{} is declared but used nowhere.", extension.name));
  } else if (extension.must_be_required == schema::MustBeRequired::recommended &&
             entry.names.required.count(extension.name) == 0) {
    entry.report(
        "EXTENSION_SHOULD_BE_REQUIRED",
        fmt::format("{} has no fallback, but the asset does not require it.", extension.name));
  } else if (extension.optional_with_fallback && entry.names.required.count(extension.name) != 0 &&
             entry.names.without_fallback.count(extension.name) == 0) {
    entry.report("EXTENSION_REQUIRED_WITH_FALLBACK",
                 fmt::format("The asset requires {}, but {} serves readers without it everywhere.",
                             extension.name, gltfx::quoted(extension.fallback)));
  }
}

void check_entry(const Entry& entry, bool declared) {
  const schema::ExtensionId id = entry.context.schemas.find_extension(entry.name);
  if (id == schema::kNone) {
    if (declared) report_unknown(entry);
    return;
  }
  const schema::Extension& extension = entry.context.schemas.extensions()[id];
  report_status(entry, extension);
  if (declared) report_use(entry, extension);
}

void check_declared(const Context& context, const Names& names) {
  const json::Document& document = context.document;
  const json::NodeId list = document.find(document.root(), "extensionsUsed");
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return;
  const Path root;
  const Path used(root, "extensionsUsed");
  std::unordered_set<std::string> done;
  std::uint64_t index = 0;
  for (const json::NodeId element : document.elements(list)) {
    const Path path(used, index++);
    if (!document.is_string(element)) continue;
    std::string name = document.string(element);
    if (!done.insert(name).second) continue;
    check_entry({context, names, path, document.span(element), std::move(name)}, true);
  }
}

void check_undeclared(const Context& context, const Names& names) {
  const Path root;
  for (const std::string& name : context.checked.extensions_seen) {
    if (names.used.count(name) != 0) continue;
    check_entry({context, names, root, Span{}, name}, false);
  }
}

void check_extension_use(const Context& context) {
  if (context.khronos()) return;
  const Names names(context);
  check_declared(context, names);
  check_undeclared(context, names);
}

constexpr LinkRule kLinkRules[] = {check_extension_use};

}  // namespace

const Family& extension_use_family() {
  static const Family family{"extension_use", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate
