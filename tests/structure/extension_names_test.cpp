// SPDX-License-Identifier: Apache-2.0
/// Facts about extensions are in schema/, not in C++.
#include <cctype>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Rules that need more than a schema, each in a file that has the name of its extension or of a
// family of them.
constexpr std::string_view kRules = "libgltfx/rules/extensions/";

// Other files that may name extensions, and why a schema cannot do it.
const std::map<std::string, std::string, std::less<>> kAllowed{
    {"libgltfx/interop/model_text.hpp", "tinygltf has a list of the lights of the extension"},
    {"libgltfx/model/draco.hpp", "decodes the payload of the extension it names"},
    {"libgltfx/model/instancing.cpp", "reads what the extension draws: transforms from accessors"},
    {"libgltfx/model/keyframes.cpp",
     "reads which property a channel moves, to move it before it is drawn"},
    {"libgltfx/model/light.cpp", "reads lights of both extensions as numbers, to draw by them"},
    {"libgltfx/model/material.cpp",
     "decides which of several texts about one thing counts: a relation between their values"},
    {"libgltfx/model/meshopt_view.hpp", "decodes the payloads of the two extensions it names"},
    {"libgltfx/model/pose.cpp", "asks the extension whether a node is to be seen"},
    {"libgltfx/model/texture.cpp", "reads how a slot moves its texture coordinates"},
    {"libgltfx/model/variants.cpp", "chooses the material of a primitive by what was asked for"},
    {"libgltfx/schema/extension_names.cpp",
     "names that have no schema, so that none is taken for a misspelt one"},
    {"libgltfx/steps/scale.cpp",
     "lengths that scales of nodes do not reach: a unit does not say in which space it is"},
    {"libgltfx/steps/quantize.cpp", "writes the extension that allows the formats"},
    {"libgltfx/steps/volume_materials.cpp", "changes a length in the units of the mesh"},
    {"libgltfx/steps/vertex_numbers.cpp",
     "ids of features are numbers of vertices where members that name other ids are absent"},
    {"libgltfx/steps/moved_members.hpp",
     "which extensions a version of glTF is to include, and which numbers one of them had there"},
    {"libgltfx/steps/upgrade/convert_scattering.cpp",
     "computes the values of one extension from those of two, and from which successor is chosen"},
    {"libgltfx/steps/upgrade/convert_specular_glossiness.cpp",
     "an option chooses the value that another extension gets"},
    {"libgltfx/steps/upgrade/object_textures.cpp",
     "compares what two textures show, for which the transform's members count with their "
     "defaults"},
    {"libgltfx/prove/drawn_items.cpp", "asks whether a node is to be seen"},
    {"libgltfx/prove/drawn_materials.cpp", "which extensions a material as numbers covers"},
    {"libgltfx/prove/forget_undrawn.cpp",
     "mappings of variants mean the same in another order: a relation between them"},
    {"libgltfx/rules/payload/element_check.cpp",
     "what numbers of attributes mean: the vocabulary states their formats only"},
    {"libgltfx/rules/core/material_needs.cpp",
     "a tangent space is needed by a value, with or without a texture"},
    {"libgltfx/rules/targets/geometry_features.cpp", "unlit primitives do not ask for normals"},
    {"libgltfx/rules/targets/material_features.cpp",
     "transforms of slots, places of shaders and pairs of lobes as features of engines"},
    {"libgltfx/rules/targets/scene_features.cpp", "types of lights as features of engines"},
    {"libgltfx/pipeline/example.cpp", "an engine made up for the examples of rules"},
    {"libgltfx/inspect/metadata_facts.cpp", "counts rows, columns and bytes of tables in buffers"},
    {"libgltfx/rules/payload/metadata/phase.hpp",
     "rules that need a schema which may be a file of its own, and values in buffers and images"},
    {"libgltfx/rules/payload/metadata/schema_source.cpp",
     "checks the file of a schema by the same definition as one inside the asset"},
    {"libgltfx/rules/shows/nothing_visible.cpp", "asks whether a node is hidden"},
    {"libgltfx/rules/shows/flat_nodes.cpp", "asks whether a behavior may change a scale later"},
    {"libgltfx/rules/shows/variants.cpp", "asks which primitives have materials for variants only"},
    {"libgltfx/rules/shows/waste_objects.cpp", "knows that variants use no vertices"},
    {"libgltfx/rules/shows/light_intensity.cpp", "where in the asset a light is"},
    {"libgltfx/rules/shows/shown_alpha.cpp", "asks whether other texels may be shown later"},
    {"libgltfx/rules/shows/texture_coordinates.cpp",
     "asks whether other materials may be shown later"},
    {"libgltfx/measure/drawn.cpp", "which nodes are lower levels of detail, and so not drawn"},
    {"libgltfx/rules/payload/metadata/feature_ids.cpp",
     "compares ids in buffers and images with counts elsewhere"},
    {"libgltfx/rules/payload/light_profiles.cpp", "the head of a file in a format of its own"},
    {"libgltfx/rules/payload/ktx2.cpp",
     "which payload an extension allows in a KTX2 file is told by its bytes"},
};

// "KHR", "EXT", ...: the prefixes, before the first '_', of extensions with a schema.
std::set<std::string, std::less<>> prefixes() {
  std::set<std::string, std::less<>> found;
  for (const Source& source : files_below({"schema/extensions"})) {
    const std::string name = source.path.substr(source.path.rfind('/') + 1);
    found.insert(name.substr(0, name.find('_')));
  }
  return found;
}

// An extension's name in a text: a known prefix, '_', a lower-case letter. Codes of rules are all
// capitals; KHR_x is the name that messages use for any extension.
std::string extension_in(std::string_view text,
                         const std::set<std::string, std::less<>>& prefixes) {
  for (std::size_t at = 0; at < text.size();) {
    if (!is_part_of_name(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && is_part_of_name(text[end])) ++end;
    const std::string_view word = text.substr(at, end - at);
    at = end;
    const std::size_t bar = word.find('_');
    if (bar == std::string_view::npos || bar + 1 >= word.size() || word == "KHR_x") continue;
    const bool lower = std::islower(static_cast<unsigned char>(word[bar + 1])) != 0;
    if (lower && prefixes.count(word.substr(0, bar)) > 0) return std::string(word);
  }
  return {};
}

// Raw literals hold example assets and help texts, which show extensions without acting on them.
Problems check_names(const Source& source, const std::set<std::string, std::less<>>& known) {
  Problems problems;
  if (source.path.starts_with(kRules) || kAllowed.count(source.path) > 0) return problems;
  for (const Literal& literal : lex(source.text).literals) {
    if (literal.raw) continue;
    const std::string name = extension_in(literal.text, known);
    if (!name.empty()) problems.push_back(problem(source, literal.line, "names " + name));
  }
  return problems;
}

TEST(ExtensionNames, CppNamesNoExtensionOutsideTheList) {
  Problems problems;
  const auto known = prefixes();
  ASSERT_GE(known.size(), 5U);
  for (const Source& source : cpp_below({"libgltfx", "tools"})) {
    const Problems found = check_names(source, known);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(ExtensionNames, TheListHasNoEntryThatIsNotNeeded) {
  const auto known = prefixes();
  for (const auto& [path, reason] : kAllowed) {
    EXPECT_GT(reason.size(), 20U) << path;
    bool needed = false;
    for (const Source& source : files_below({path})) {
      needed = !check_names({"elsewhere.cpp", source.text}, known).empty();
    }
    EXPECT_TRUE(needed) << path << " names no extension: take it off the list";
  }
}

TEST(ExtensionNames, RulesOfExtensionsHaveAFolder) {
  const std::string text = "if (name == \"KHR_materials_ior\") return;\n";
  EXPECT_THAT(check_names({"libgltfx/rules/extensions/ior.cpp", text}, {"KHR"}), IsEmpty());
  EXPECT_THAT(check_names({"libgltfx/rules/core/material.cpp", text}, {"KHR"}), SizeIs(1));
  for (const auto& [path, reason] : kAllowed) EXPECT_FALSE(path.starts_with(kRules)) << path;
}

TEST(ExtensionNames, ANameIsFound) {
  EXPECT_THAT(check_names({"a.cpp", "\nif (name == \"KHR_materials_ior\") return;\n"}, {"KHR"}),
              ElementsAre("a.cpp:2: names KHR_materials_ior"));
  EXPECT_THAT(check_names({"a.cpp", "f(\"/extensions/EXT_texture_webp/source\");"}, {"EXT"}),
              ElementsAre(HasSubstr("names EXT_texture_webp")));
}

TEST(ExtensionNames, CodesCommentsAndExamplesAreNoNames) {
  EXPECT_THAT(check_names({"a.cpp",
                           "// KHR_materials_ior\nf(\"KHR_LIGHTS_SPOT\", \"KHR_x\", "
                           "R\"({\"KHR_materials_ior\": {}})\");"},
                          {"KHR"}),
              IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
