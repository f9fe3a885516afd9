// SPDX-License-Identifier: Apache-2.0
// The library's door: the same as the program, as data.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

const std::string kLegacy = R"({"asset":{"version":"2.0"},
"extensionsUsed":["KHR_materials_translucency"],
"materials":[{"extensions":{"KHR_materials_translucency":{"translucencyFactor":1}}}]})";

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(UpgradeFile, TellsThePlanAndWritesNothingUnasked) {
  const TempFolder folder;
  const std::string path = folder.write("a.gltf", kLegacy).native();
  UpgradeOptions options;
  options.diff = true;
  const UpgradeReport report = upgrade_file(path, options);
  EXPECT_EQ(report.problem, EditProblem::none);
  ASSERT_EQ(report.actions.size(), 1U);
  EXPECT_TRUE(report.actions[0].done);
  EXPECT_TRUE(report.changes);
  EXPECT_FALSE(report.written);
  EXPECT_NE(report.diff.find("\n+\"extensionsUsed\""), std::string::npos);
  EXPECT_EQ(file_text(path), kLegacy);
}

TEST(UpgradeFile, TooManyObjectsAreAReasonNotAnEmptyPlan) {
  const TempFolder folder;
  std::string nodes(3 * 1'200'000, ' ');
  for (std::size_t i = 0; i < nodes.size(); i += 3) nodes.replace(i, 3, "{},");
  nodes.back() = ' ';
  const std::string path =
      folder.write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}").native();
  const std::string why = "its root arrays have 1200000 elements; at most ";
  const UpgradeReport report = upgrade_file(path, {});
  EXPECT_EQ(report.problem, EditProblem::unreadable);
  EXPECT_EQ(report.error.find(why), 0U) << report.error;
  EXPECT_EQ(inspect_file(path, {}).error, report.error);
}

// A leaf whose map has no alpha, which the first generation does not read and later ones do.
std::string leaf_text(const std::string& legacy) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_translucency"],
"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"mode":0,"material":0}]}],
"accessors":[{"componentType":5126,"type":"VEC3","count":1,"min":[0,0,0],"max":[0,0,0]},
{"componentType":5126,"type":"VEC2","count":1}],"textures":[{"source":0}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}],
"materials":[{"extensions":{"KHR_materials_translucency":{)" +
         legacy + "}}}]}";
}

TEST(UpgradeFile, SaysInThePlanWhatWarningTheNewDocumentBrings) {
  const TempFolder folder;
  const std::string path =
      folder
          .write("a.gltf", leaf_text(R"("translucencyFactor":1,"translucencyTexture":{"index":0})"))
          .native();
  UpgradeOptions options;
  options.generation = "v2";
  const std::vector<std::string> planned = upgrade_file(path, options).new_warnings;
  ASSERT_EQ(planned.size(), 1U);
  EXPECT_EQ(planned[0].find("TEXTURE"), 0U) << planned[0];
  options.in_place = true;
  EXPECT_EQ(upgrade_file(path, options).new_warnings, planned);
  const std::string plain = folder.write("b.gltf", leaf_text(R"("translucencyFactor":1)")).native();
  EXPECT_TRUE(upgrade_file(plain, {}).new_warnings.empty());
}

std::string with_fix(std::string text, const ProposedFix& fix) {
  for (auto one = fix.replacements.rbegin(); one != fix.replacements.rend(); ++one) {
    text.replace(one->place.offset, one->place.length, one->text);
  }
  return text;
}

TEST(ProposedFix, IsWhatAnUpgradeWrites) {
  const TempFolder folder;
  const std::string path = folder.write("a.gltf", kLegacy).native();
  ValidateOptions asked;
  asked.propose_fixes = true;
  const FileReport report = validate_file(path, asked);
  const ProposedFix* fix = nullptr;
  for (const Diagnostic& one : report.diagnostics) {
    if (one.fix) fix = one.fix.get();
    EXPECT_EQ(one.fix != nullptr, one.code == "EXTENSION_LEGACY") << one.code;
  }
  ASSERT_NE(fix, nullptr);
  UpgradeOptions options;
  options.in_place = true;
  ASSERT_TRUE(upgrade_file(path, options).written);
  EXPECT_EQ(with_fix(kLegacy, *fix), file_text(path));
}

TEST(ProposedFix, IsNotMadeUnaskedNorWhereThereIsDoubt) {
  const auto fixes = [](std::string text, bool asked) {
    ValidateOptions options;
    options.propose_fixes = asked;
    std::size_t count = 0;
    for (const Diagnostic& one : validate_bytes(std::move(text), "a.gltf", options).diagnostics) {
      count += one.fix ? 1U : 0U;
    }
    return count;
  };
  EXPECT_EQ(fixes(kLegacy, true), 1U);
  EXPECT_EQ(fixes(kLegacy, false), 0U);
  EXPECT_EQ(fixes(kLegacy + ",", true), 0U);  // the text has an error
  std::string wrong = kLegacy;
  wrong.replace(wrong.find(":1}"), 3, ":\"x\"}");
  EXPECT_EQ(fixes(wrong, true), 0U);  // what stands there is not understood
}

TEST(UpgradeFile, WritesInPlaceOnce) {
  const TempFolder folder;
  const std::string path = folder.write("a.gltf", kLegacy).native();
  UpgradeOptions options;
  options.in_place = true;
  const UpgradeReport first = upgrade_file(path, options);
  EXPECT_TRUE(first.written);
  EXPECT_EQ(first.written_to, path);
  const UpgradeReport second = upgrade_file(path, options);
  EXPECT_TRUE(second.actions.empty());
  EXPECT_FALSE(second.written);
}

TEST(UpgradeFile, SaysWhyAFileCannotBeRead) {
  const TempFolder folder;
  for (const char* text : {"", "hello", "{\"asset\":", "glTF"}) {
    const UpgradeReport report = upgrade_file(folder.write("a.gltf", text).native());
    EXPECT_EQ(report.problem, EditProblem::unreadable) << text;
    EXPECT_FALSE(report.error.empty()) << text;
  }
  EXPECT_EQ(upgrade_file((folder.path() / "b.gltf").native()).problem, EditProblem::unreadable);
}

TEST(UpgradeFile, AFileThatWouldHaveANewErrorIsNotWritten) {
  const TempFolder folder;
  // The successor requires a member that the old object lacks.
  const auto file = [](const char* name, const char* members, const char* words) {
    return schema::SourceFile{
        name,
        fmt::format(R"({{"$schema": "https://json-schema.org/draft/2020-12/schema",
          "$id": "gltfx:ext/{0}", "title": "{0}", "description": "x", "type": "object", {1},
          "x-gltfx": {{"extension": "{0}", "on": ["node"], "status": "vendor"{2}}}}})",
                    name, members, words),
        true};
  };
  const schema::Compiled schemas = schema::compile_with(
      {file(
           "ACME_old", R"("properties": {"a": {"type": "number"}})",
           R"(, "upgrade": {"to": "ACME_new", "steps": [{"step": "move", "from": "a", "to": "b"}]})"),
       file("ACME_new", R"("properties": {"b": {"type": "number"}}, "required": ["b"])", "")});
  ASSERT_TRUE(schemas.errors.empty()) << schemas.errors.front().text();
  const std::string text = R"({"asset":{"version":"2.0"},"extensionsUsed":["ACME_old"],)"
                           R"("nodes":[{"extensions":{"ACME_old":{}}}]})";
  const std::string path = folder.write("a.gltf", text).native();
  UpgradeOptions options;
  options.in_place = true;
  options.schemas = schemas.set;
  const UpgradeReport report = upgrade_file(path, options);
  EXPECT_EQ(report.problem, EditProblem::refused);
  EXPECT_NE(report.error.find("UNDEFINED_PROPERTY"), std::string::npos) << report.error;
  EXPECT_EQ(report.left(), 1U);
  EXPECT_EQ(file_text(path), text);
}

TEST(UpgradeFiles, ReportInTheOrderOfTheInputs) {
  const TempFolder folder;
  std::vector<EditInput> inputs;
  for (int i = 0; i < 20; ++i) {
    const std::string name = std::to_string(i);
    inputs.push_back({folder.write(name + ".gltf", kLegacy).native(),
                      (folder.path() / "out" / (name + ".gltf")).native()});
  }
  std::size_t next = 0;
  upgrade_files(inputs, {}, 2, [&](UpgradeReport&& report) {
    EXPECT_EQ(report.path, inputs[next].path);
    EXPECT_EQ(report.written_to, inputs[next++].output);
  });
  EXPECT_EQ(next, inputs.size());
}

}  // namespace
}  // namespace gltfx
