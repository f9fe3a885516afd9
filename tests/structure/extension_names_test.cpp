// SPDX-License-Identifier: Apache-2.0
/// What is known of an extension stands in schema/, not in C++.
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

// Files that may name extensions, and why a schema cannot do it.
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
    {"libgltfx/upgrade/convert_scattering.cpp",
     "computes the values of one extension from those of two, and from which successor is chosen"},
    {"libgltfx/upgrade/convert_specular_glossiness.cpp",
     "an option chooses the value that another extension gets"},
    {"libgltfx/upgrade/object_textures.cpp",
     "compares what two textures show, for which the transform's members count with their "
     "defaults"},
    {"libgltfx/rules/data/check.cpp",
     "what numbers of attributes mean: the vocabulary states their formats only"},
    {"libgltfx/rules/rules/animation_pointer.cpp",
     "resolves pointers against the object model, which needs the whole document"},
    {"libgltfx/rules/rules/audio.cpp",
     "compares lists and distances of one object, and asks emitters and sound data elsewhere for "
     "their types"},
    {"libgltfx/rules/rules/bodies.cpp",
     "whether a part or joint lies below the body it belongs to, the scene graph tells"},
    {"libgltfx/rules/rules/expressions.cpp",
     "indices of morph targets behind the mesh of a node, and lists that must be alike"},
    {"libgltfx/rules/rules/humanoid.cpp",
     "whether nodes lie below each other as bones do, the scene graph tells"},
    {"libgltfx/rules/rules/humanoid_pose.cpp",
     "where bones are, the transforms of all nodes above them tell"},
    {"libgltfx/rules/rules/avatar.cpp",
     "annotations that must not repeat, and one extension inside another's asset"},
    {"libgltfx/rules/rules/node_constraint.cpp", "cycles among nodes that follow each other"},
    {"libgltfx/rules/rules/nonvisual.cpp",
     "mode and attributes of the primitive that carries the extension"},
    {"libgltfx/rules/rules/spring_bone.cpp",
     "whether joints lie below each other, and what lies between them, the scene graph tells"},
    {"libgltfx/rules/rules/thumbnail.cpp", "the size of an image is not in the document"},
    {"libgltfx/rules/rules/toon.cpp", "the alpha mode of the material that carries the extension"},
    {"libgltfx/rules/rules/node_transform.cpp",
     "the length of a quaternion: a relation between numbers"},
    {"libgltfx/rules/rules/xmp.cpp", "names and forms of members that no schema knows"},
    {"libgltfx/rules/rules/extension_accessors.cpp",
     "formats of accessors that extensions refer to: the vocabulary says that a member is one, not "
     "of what"},
    {"libgltfx/rules/rules/interactivity.cpp",
     "order of a graph's nodes, lengths of values, indices inside configurations"},
    {"libgltfx/rules/rules/interactivity_draft.cpp",
     "tells graphs of earlier drafts by their form"},
    {"libgltfx/rules/data/edge_visibility.cpp", "edges are coded in the bits of an accessor"},
    {"libgltfx/rules/data/expression_weights.cpp",
     "what an animation writes as weights stands in an accessor"},
    {"libgltfx/rules/data/manifolds.cpp", "whether a surface is closed is told by its indices"},
    {"libgltfx/rules/data/outlines.cpp",
     "whether two vertices have an edge, and are there, is told by indices"},
    {"libgltfx/rules/data/volumes.cpp", "whether a surface is closed is told by its indices"},
    {"libgltfx/rules/targets/geometry_features.cpp", "unlit primitives do not ask for normals"},
    {"libgltfx/rules/targets/material_features.cpp",
     "transforms of slots and places of shaders as features of engines"},
    {"libgltfx/rules/targets/scene_features.cpp", "types of lights as features of engines"},
    {"libgltfx/pipeline/example.cpp", "an engine made up for the examples of rules"},
    {"libgltfx/inspect/metadata_facts.cpp", "counts rows, columns and bytes of tables in buffers"},
    {"libgltfx/rules/metadata/phase.hpp",
     "rules that need a schema which may be a file of its own, and values in buffers and images"},
    {"libgltfx/rules/metadata/schema_source.cpp",
     "checks the file of a schema by the same definition as one inside the asset"},
    {"libgltfx/rules/metadata/feature_ids.cpp",
     "compares ids in buffers and images with counts elsewhere"},
    {"libgltfx/rules/light_profiles.cpp", "the head of a file in a format of its own"},
    {"libgltfx/rules/rules/image_based_light.cpp", "sizes of images, which only their bytes tell"},
    {"libgltfx/rules/rules/lod.cpp", "cycles among levels of detail"},
    {"libgltfx/rules/rules/ktx2.cpp",
     "which payload an extension allows in a KTX2 file is told by its bytes"},
    {"libgltfx/rules/rules/material_lobes.cpp",
     "lobes that hide each other: relations between the values of several extensions"},
    {"libgltfx/rules/rules/material_needs.cpp",
     "a tangent space is needed by a value, with or without a texture"},
    {"libgltfx/rules/rules/mdl.cpp", "the type of what a call elsewhere returns"},
    {"libgltfx/rules/rules/mesh_groups.cpp", "compares the primitives of a mesh"},
    {"libgltfx/rules/rules/name_registries.cpp", "names that must be unique over a list"},
    {"libgltfx/rules/rules/packed_geometry.cpp",
     "compares compressed data with the primitive or buffer view it sits on"},
    {"libgltfx/rules/rules/single_root.cpp",
     "an extension without objects whose name promises how the scene looks"},
    {"libgltfx/rules/rules/techniques.cpp",
     "names of one object that must be those of another, which a third one refers to"},
    {"libgltfx/rules/rules/timed_accessors.cpp",
     "asks the accessors of several extensions for another one"},
    {"libgltfx/rules/rules/splats.cpp", "attributes that must stand together"},
    {"libgltfx/rules/rules/lights_punctual.cpp",
     "compares the two angles of a spot light: a relation between values"},
    {"libgltfx/rules/rules/material_extensions.cpp",
     "rules that compare properties of one extension, or ask for tangents beside a texture"},
    {"libgltfx/rules/rules/variants.hpp",
     "variants are indices into an array elsewhere that must not repeat over all mappings"},
};

// "KHR", "EXT", ...: what stands before the first '_' of the extensions we have schemas of.
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
  if (kAllowed.count(source.path) > 0) return problems;
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
