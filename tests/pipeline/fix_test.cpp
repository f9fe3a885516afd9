// SPDX-License-Identifier: Apache-2.0
// Fixes from outside: a file in, the fixed file and what is said of it out.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string floats(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// A triangle with normals, in a buffer of its own; `uri` leads to it.
std::string triangle(const std::string& uri, std::string_view more = "") {
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"type":"VEC3","count":3}}{}],
"bufferViews":[{{"buffer":0,"byteLength":36,"target":34962}},
{{"buffer":0,"byteOffset":36,"byteLength":36,"target":34962}}],
"buffers":[{{"byteLength":72,"uri":"{}"}}]}})",
                     more, uri);
}

const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0};

std::string triangle_bytes(float length) {
  return floats(kCorners) + floats({0, 0, length, 0, 0, length, 0, 0, length});
}

FixOptions in_place() {
  FixOptions options;
  options.in_place = true;
  return options;
}

TEST(FixFile, WritesNothingUnasked) {
  const TempFolder folder;
  folder.write("a.bin", triangle_bytes(0.5F));
  const auto path = folder.write("a.gltf", triangle("a.bin"));
  const FixReport report = fix_file(path.native());
  EXPECT_TRUE(report.changes);
  EXPECT_FALSE(report.written);
  ASSERT_EQ(report.actions.size(), 1U);
  EXPECT_EQ(report.actions[0].code, "ACCESSOR_VECTOR3_NON_UNIT");
  EXPECT_TRUE(report.actions[0].done);
  EXPECT_EQ(text_of(path), triangle("a.bin"));
  EXPECT_EQ(text_of(folder.path() / "a.bin"), triangle_bytes(0.5F));
}

TEST(FixFile, WritesABufferBesideTheAssetAndKeepsBoth) {
  const TempFolder folder;
  folder.write("a.bin", triangle_bytes(0.5F));
  const auto path = folder.write("a.gltf", triangle("a.bin"));
  FixOptions options = in_place();
  options.backup = true;
  const FixReport report = fix_file(path.native(), options);
  EXPECT_EQ(report.error, "");
  EXPECT_EQ(report.changed_files, std::vector<std::string>{"a.bin"});
  EXPECT_EQ(text_of(path), triangle("a.bin"));
  EXPECT_EQ(text_of(folder.path() / "a.bin"), triangle_bytes(1));
  EXPECT_EQ(text_of(folder.path() / "a.bin.bak"), triangle_bytes(0.5F));
  EXPECT_FALSE(fix_file(path.native()).changes);
}

TEST(FixFile, LeavesABufferOfTheOldAssetAlone) {
  const TempFolder folder;
  folder.write("a.bin", triangle_bytes(0.5F));
  const auto path = folder.write("a.gltf", triangle("a.bin"));
  FixOptions options;
  options.output = (folder.path() / "b.gltf").native();
  const FixReport report = fix_file(path.native(), options);
  EXPECT_NE(report.error.find("a.bin"), std::string::npos) << report.error;
  EXPECT_EQ(text_of(folder.path() / "a.bin"), triangle_bytes(0.5F));
  options.output = (folder.path() / "other" / "a.gltf").native();
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  EXPECT_EQ(text_of(folder.path() / "other" / "a.bin"), triangle_bytes(1));
  EXPECT_EQ(text_of(folder.path() / "a.bin"), triangle_bytes(0.5F));
}

TEST(FixFile, ChangesADataUri) {
  const auto uri = [](float length) {
    return "data:application/octet-stream;base64," +
           container::encode_base64(triangle_bytes(length));
  };
  const TempFolder folder;
  const auto path = folder.write("a.gltf", triangle(uri(2)));
  EXPECT_EQ(fix_file(path.native(), in_place()).error, "");
  EXPECT_EQ(text_of(path), triangle(uri(1)));
}

// Other readers of the same bytes would read other values.
TEST(FixFile, LeavesBytesAloneThatAreReadTwice) {
  const TempFolder folder;
  folder.write("a.bin", triangle_bytes(0.5F));
  const std::string twice = R"(,{"bufferView":1,"componentType":5126,"type":"SCALAR","count":9})";
  const auto path = folder.write("a.gltf", triangle("a.bin", twice));
  const FixReport report = fix_file(path.native(), in_place());
  EXPECT_FALSE(report.changes);
  EXPECT_EQ(report.left(), 1U);
  EXPECT_EQ(text_of(folder.path() / "a.bin"), triangle_bytes(0.5F));
}

TEST(FixFile, RunsUntilNothingIsLeft) {
  const TempFolder folder;
  const auto path = folder.write(
      "a.gltf", R"({"asset": {"version": "2.0",}, "extensionsUsed": [], "nodes": [],})");
  const FixReport report = fix_file(path.native(), in_place());
  EXPECT_EQ(report.error, "");
  EXPECT_EQ(text_of(path), R"({"asset": {"version": "2.0"}})");
  EXPECT_EQ(report.fixed(), 4U);
}

TEST(FixFile, DoesWhatItIsAskedFor) {
  const TempFolder folder;
  const std::string text =
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit"],"nodes":[]})";
  const auto path = folder.write("a.gltf", text);
  FixOptions options = in_place();
  options.only = {"EMPTY_ENTITY"};
  options.skip = {"EMPTY_ENTITY"};
  EXPECT_FALSE(fix_file(path.native(), options).changes);
  options.skip.clear();
  EXPECT_EQ(fix_file(path.native(), options).fixed(), 1U);
  EXPECT_EQ(text_of(path),
            R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit"]})");
  options.only.clear();
  options.skip = {"EXTENSION_UNUSED"};
  EXPECT_FALSE(fix_file(path.native(), options).changes);
}

const char kPixel[] =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg==";

// An asset of images whose URIs have a backslash.
std::string images(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += fmt::format(R"({}{{"uri":"images\\{}"}})", list.empty() ? "" : ",", name);
  }
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"images":[{}]}})", list);
}

// A valid URI would lead to a file that is no image, which the old one hides.
TEST(FixFile, LeavesAPlaceOutWhoseFixBringsANewFinding) {
  const TempFolder folder;
  std::vector<std::string> names;
  for (int i = 0; i < 9; ++i) {
    names.push_back(fmt::format("{}.png", i));
    const bool broken = i == 4 || i == 8;
    folder.write("images/" + names.back(), broken ? "no image" : *container::decode_base64(kPixel));
  }
  const auto path = folder.write("a.gltf", images(names));
  EXPECT_EQ(validate_file(path.native()).fixable, 9U);
  const FixReport report = fix_file(path.native(), in_place());
  EXPECT_EQ(report.fixed(), 7U);
  EXPECT_EQ(report.left(), 2U);
  ASSERT_EQ(report.actions.size(), 2U);
  EXPECT_EQ(report.actions[1].pointers,
            (std::vector<std::string>{"/images/4/uri", "/images/8/uri"}));
  EXPECT_NE(report.actions[1].why_not, "");
  EXPECT_FALSE(fix_file(path.native()).changes);
}

// Without a file no change is planned; a change to a file that is not an image is left out.
TEST(FixFile, TellsWhatItLeavesOutFromWhatItDoesNotPlan) {
  const TempFolder folder;
  folder.write("images/broken.png", "no image");
  const auto path = folder.write("a.gltf", images({"missing.png", "broken.png"}));
  const FixReport report = fix_file(path.native());
  ASSERT_EQ(report.actions.size(), 2U);
  EXPECT_EQ(report.actions[0].pointers, std::vector<std::string>{"/images/1/uri"});
  EXPECT_NE(report.actions[0].why_not, "");
  EXPECT_EQ(report.actions[1].pointers, std::vector<std::string>{"/images/0/uri"});
  EXPECT_EQ(report.actions[1].why_not, "");
}

// Both primitives lack the bounds of one accessor.
TEST(FixFile, CountsTheFindingsThatValidateMarks) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},
"meshes":[{"primitives":[{"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"mode":0}]}],
"accessors":[{"componentType":5126,"type":"VEC3","count":3}]})");
  const FixReport report = fix_file(path.native());
  EXPECT_EQ(report.fixed(), 2U);
  EXPECT_EQ(validate_file(path.native()).fixable, 2U);
}

TEST(FixFile, TakesFilesAlongToWhichOnlyTheFixedUriLeads) {
  const TempFolder folder;
  folder.write("images/a.png", *container::decode_base64(kPixel));
  const auto path = folder.write("a.gltf", images({"a.png"}));
  FixOptions options;
  options.output = (folder.path() / "other" / "a.gltf").native();
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  EXPECT_EQ(text_of(folder.path() / "other" / "images" / "a.png"),
            *container::decode_base64(kPixel));
}

TEST(FixFile, UrisThatNameNoFileAreNotTakenAlong) {
  const TempFolder folder;
  folder.write("folder/a.png", *container::decode_base64(kPixel));
  const auto path = folder.write("a.gltf", R"({"asset": {"version": "2.0"},
    "extensionsRequired": ["ACME_a"], "images": [{"uri": ""}, {"uri": "folder/"}, {"uri": "."}]})");
  FixOptions options;
  options.output = (folder.path() / "other" / "a.gltf").native();
  const FixReport report = fix_file(path.native(), options);
  EXPECT_EQ(report.error, "");
  EXPECT_TRUE(report.changes);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "other" / "folder"));
}

TEST(FixFile, DeclaresNoExtensionWhoseObjectsHaveErrors) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "materials": [
    {"extensions": {"KHR_materials_ior": {"ior": 1.4}}},
    {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 7}}},
    {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.7}}}]})");
  const FixReport report = fix_file(path.native(), in_place());
  EXPECT_EQ(report.error, "");
  EXPECT_NE(text_of(path).find(R"("extensionsUsed": ["KHR_materials_ior"])"), std::string::npos);
  const auto left = std::find_if(report.actions.begin(), report.actions.end(),
                                 [](const FixAction& action) { return !action.done; });
  ASSERT_NE(left, report.actions.end());
  EXPECT_EQ(left->why_not, "objects of KHR_materials_clearcoat have errors");
}

TEST(FixFile, WhatABackslashLeadsToIsTakenAlong) {
  const TempFolder folder;
  folder.write("folder/a.png", *container::decode_base64(kPixel));
  // The URI stays: the image is no WebP, which a reader of the new URI would find.
  const auto path = folder.write("a.gltf", R"({"asset": {"version": "2.0"},
    "extensionsRequired": ["ACME_a"],
    "images": [{"uri": ".\\folder\\a.png", "mimeType": "image/webp"}]})");
  FixOptions options;
  options.output = (folder.path() / "other" / "a.gltf").native();
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  EXPECT_EQ(text_of(folder.path() / "other" / "folder" / "a.png"),
            *container::decode_base64(kPixel));
}

TEST(FixFile, DoesNothingUnsafeUnasked) {
  const TempFolder folder;
  const RuleDescription& rule = *find_rule("EXTENSION_NAME_MISSPELT");
  const auto path = folder.write("a.gltf", example_bytes(rule.bad));
  EXPECT_FALSE(fix_file(path.native(), in_place()).changes);
  FixOptions options = in_place();
  options.unsafe = true;
  EXPECT_FALSE(fix_file(path.native(), options).changes);
  options.only = {"EXTENSION_NAME_MISSPELT"};
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  EXPECT_EQ(text_of(path), example_bytes(rule.fixed));
}

TEST(FixFile, SaysWhyAFileCannotBeFixed) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset": [})");
  const FixReport report = fix_file(path.native(), in_place());
  EXPECT_EQ(report.problem, EditProblem::unreadable);
  EXPECT_EQ(fix_file((folder.path() / "b.gltf").native()).problem, EditProblem::unreadable);
}

TEST(Fixable, IsCountedAndMarked) {
  const TempFolder folder;
  const auto path = folder.write(
      "a.gltf", R"({"asset":{"version":"2.0"},"nodes":[],"meshes":[{"primitives":[]}]})");
  const FileReport report = validate_file(path.native());
  EXPECT_EQ(report.fixable, 1U);
  for (const Diagnostic& finding : report.diagnostics) {
    EXPECT_EQ(finding.fixable, finding.pointer == "/nodes") << finding.pointer;
  }
  ValidateOptions options;
  options.profile = Profile::khronos;
  EXPECT_EQ(validate_file(path.native(), options).fixable, 0U);
}

std::map<std::string, std::uint64_t> counts_of(const FileReport& report) {
  std::map<std::string, std::uint64_t> counts;
  for (const Diagnostic& finding : report.diagnostics) {
    counts[std::string(finding.code)] += finding.count;
  }
  return counts;
}

// Whether the normals of a triangle count, in a buffer that is padded to a size.
std::uint64_t fixable_in_buffer(std::size_t size) {
  const TempFolder folder;
  std::string bytes = triangle_bytes(0.5F);
  bytes.resize(size);
  folder.write("a.bin", bytes);
  std::string text = triangle("a.bin");
  const std::string length = R"("byteLength":72)";
  text.replace(text.find(length), length.size(), fmt::format(R"("byteLength":{})", size));
  const auto path = folder.write("a.gltf", text);
  EXPECT_TRUE(fix_file(path.native()).changes);
  return validate_file(path.native()).fixable;
}

TEST(Fixable, ChangesOfLargeBuffersAreNotCounted) {
  EXPECT_EQ(fixable_in_buffer(16U << 20U), 1U);
  EXPECT_EQ(fixable_in_buffer((16U << 20U) + 4), 0U);
}

TEST(Fixable, IsWhatOneRunRemovesOrLeavesWithAReason) {
  ValidateOptions strict;
  strict.profile = Profile::strict;
  std::uint64_t marked = 0;
  for (const RuleDescription& rule : rules()) {
    if (rule.fix != Fix::safe) continue;
    const TempFolder folder;
    const std::string bytes = example_bytes(rule.bad);
    const std::string name = bytes.starts_with("glTF") ? "a.glb" : "a.gltf";
    const auto path = folder.write(name, bytes);
    const FileReport before = validate_file(path.native(), strict);
    FixOptions options = in_place();
    options.validation = [&strict](const std::string&) { return strict; };
    const FixReport fixed = fix_file(path.native(), options);
    EXPECT_EQ(before.fixable > 0, fixed.written) << rule.code;
    EXPECT_GE(before.fixable, fixed.fixed()) << rule.code;
    EXPECT_LE(before.fixable, fixed.fixed() + fixed.left()) << rule.code;
    auto after = counts_of(validate_file(path.native(), strict));
    std::uint64_t gone = 0;
    for (const auto& [code, count] : counts_of(before)) {
      if (find_rule(code)->fix == Fix::safe && count > after[code]) gone += count - after[code];
    }
    EXPECT_EQ(fixed.fixed(), gone) << rule.code;
    marked += gone;
  }
  EXPECT_GT(marked, 50U);
}

TEST(ProposedFix, IsThatOfTheRule) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[]})");
  ValidateOptions options;
  options.propose_fixes = true;
  const FileReport report = validate_file(path.native(), options);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  ASSERT_NE(report.diagnostics[0].fix, nullptr);
  ASSERT_EQ(report.diagnostics[0].fix->replacements.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].fix->replacements[0].place.offset, 26U);
  EXPECT_EQ(report.diagnostics[0].fix->replacements[0].text, "");
}

}  // namespace
}  // namespace gltfx
