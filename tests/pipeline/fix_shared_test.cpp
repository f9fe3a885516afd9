// SPDX-License-Identifier: Apache-2.0
// Assets that share files: one correction for all who read the same bytes, or none.
#include <gltfx/pipeline.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

std::string bytes_at(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string packed_floats(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

constexpr std::string_view kVec3 = R"("componentType":5126,"type":"VEC3","count":3)";
const std::string kNormals = R"("POSITION":0,"NORMAL":1)";

/// An asset with a triangle: view and accessor 0 are its positions, the first 36 bytes of buffer 0;
/// others follow.
struct Triangle {
  std::string uri = "shared.bin";
  std::string attributes = kNormals;
  std::string views = R"(,{"buffer":0,"byteOffset":36,"byteLength":36,"target":34962})";
  std::string accessors = fmt::format(R"(,{{"bufferView":1,{}}})", kVec3);
  std::string buffers;  ///< more of them
  std::string more;     ///< members of the root

  std::string json() const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{{}}}}}]}}],
"accessors":[{{"bufferView":0,{},"min":[0,0,0],"max":[1,1,0]}}{}],
"bufferViews":[{{"buffer":0,"byteLength":36,"target":34962}}{}],
"buffers":[{{"byteLength":108,"uri":"{}"}}{}]{}}})",
        attributes, kVec3, accessors, views, uri, buffers, more);
  }
};

// Positions, and twice three vectors along z.
std::string shared_bytes(float first, float second) {
  return packed_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
         packed_floats({0, 0, first, 0, 0, first, 0, 0, first}) +
         packed_floats({0, 0, second, 0, 0, second, 0, 0, second});
}

Triangle with_second_normals() {
  Triangle asset;
  asset.views = R"(,{"buffer":0,"byteOffset":72,"byteLength":36,"target":34962})";
  return asset;
}

// What another asset takes the first vectors for.
Triangle with_positions_there() {
  Triangle asset;
  asset.attributes = R"("POSITION":1)";
  asset.accessors = fmt::format(R"(,{{"bufferView":1,{},"min":[0,0,2],"max":[0,0,2]}})", kVec3);
  return asset;
}

class FixShared : public testing::Test {
 protected:
  void SetUp() override { folder_.write("shared.bin", shared_bytes(2, 4)); }

  void write(const std::string& name, const Triangle& asset) const {
    folder_.write(name, asset.json());
  }
  std::string bytes(const std::string& name) const { return bytes_at(folder_.path() / name); }

  std::vector<FixReport> fix(const std::vector<std::string>& names, FixOptions options,
                             const std::string& output = {}, unsigned jobs = 1) const {
    std::vector<EditInput> inputs;
    for (const std::string& name : names) {
      inputs.push_back({(folder_.path() / name).native(),
                        output.empty() ? "" : (folder_.path() / output / name).native()});
    }
    std::vector<FixReport> reports;
    fix_files(inputs, options, jobs,
              [&](FixReport&& report) { reports.push_back(std::move(report)); });
    return reports;
  }
  std::vector<FixReport> fix_in_place(const std::vector<std::string>& names,
                                      unsigned jobs = 1) const {
    FixOptions options;
    options.in_place = true;
    return fix(names, options, {}, jobs);
  }

  TempFolder folder_;
};

void expect_fixed(const std::vector<FixReport>& reports, std::uint64_t each) {
  for (const FixReport& report : reports) {
    EXPECT_EQ(report.error, "") << report.path;
    EXPECT_EQ(report.fixed(), each) << report.path;
    EXPECT_EQ(report.left(), 0U) << report.path;
  }
}

void expect_left(const FixReport& report, const std::string& why) {
  EXPECT_EQ(report.error, "");
  EXPECT_FALSE(report.changes);
  EXPECT_EQ(report.fixed(), 0U);
  ASSERT_EQ(report.actions.size(), 1U);
  EXPECT_EQ(report.actions[0].code, "ACCESSOR_VECTOR3_NON_UNIT");
  EXPECT_THAT(report.actions[0].why_not, HasSubstr(why));
}

TEST_F(FixShared, AllCorrectionsOfAFileAreOneChange) {
  write("a.gltf", {});
  write("b.gltf", with_second_normals());
  write("c.gltf", {});
  for (unsigned jobs = 1; jobs <= 4; ++jobs) {
    for (int run = 0; run < 5; ++run) {
      folder_.write("shared.bin", shared_bytes(2, 4));
      const auto reports = fix_in_place({"a.gltf", "b.gltf", "c.gltf"}, jobs);
      ASSERT_EQ(reports.size(), 3U);
      expect_fixed(reports, 1);
      EXPECT_EQ(bytes("shared.bin"), shared_bytes(1, 1)) << jobs;
      EXPECT_EQ(bytes("a.gltf"), Triangle().json());
    }
  }
}

TEST_F(FixShared, AllCorrectionsOfAFileAreInTheCopy) {
  write("a.gltf", {});
  write("b.gltf", with_second_normals());
  for (unsigned jobs = 1; jobs <= 4; ++jobs) {
    const std::string output = "out" + std::to_string(jobs);
    expect_fixed(fix({"a.gltf", "b.gltf"}, {}, output, jobs), 1);
    EXPECT_EQ(bytes(output + "/shared.bin"), shared_bytes(1, 1));
    EXPECT_EQ(bytes(output + "/b.gltf"), with_second_normals().json());
  }
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
}

TEST_F(FixShared, ReportsComeInTheOrderOfTheInputs) {
  write("a.gltf", {});
  folder_.write("own.bin", shared_bytes(2, 4));
  Triangle alone;
  alone.uri = "own.bin";
  write("b.gltf", alone);
  write("c.gltf", {});
  const auto reports = fix_in_place({"a.gltf", "b.gltf", "missing.gltf", "c.gltf"}, 2);
  ASSERT_EQ(reports.size(), 4U);
  EXPECT_THAT(reports[1].path, HasSubstr("b.gltf"));
  EXPECT_EQ(reports[2].problem, EditProblem::unreadable);
  EXPECT_THAT(reports[3].path, HasSubstr("c.gltf"));
  EXPECT_EQ(bytes("own.bin"), shared_bytes(1, 4));
}

// What it reads is unknown; it may have failed for want of memory or of descriptors.
TEST_F(FixShared, BytesStayWhereAnAssetThatNamesTheFileCannotBeRead) {
  write("a.gltf", {});
  std::string nodes = R"(,"cameras":[0)";
  for (int i = 0; i < 2'000'000; ++i) nodes += ",0";
  Triangle large;
  large.more = nodes + "]";
  write("b.gltf", large);
  using Names = std::vector<std::string>;
  for (const Names& named : {Names{"a.gltf", "b.gltf"}, Names{"a.gltf"}}) {
    expect_left(fix_in_place(named, 2)[0], "b.gltf' cannot be read, and may read the same bytes");
    EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
  }
}

TEST_F(FixShared, BytesThatAnotherAssetReadsAsSomethingElseStay) {
  write("a.gltf", {});
  write("b.gltf", with_positions_there());
  for (const std::string output : {"", "out"}) {
    FixOptions options;
    options.in_place = output.empty();
    const auto reports = fix({"a.gltf", "b.gltf"}, options, output, 2);
    ASSERT_EQ(reports.size(), 2U);
    expect_left(reports[0], "b.gltf' reads the same bytes of 'shared.bin'");
    EXPECT_EQ(reports[1].error, "");
    EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
  }
  EXPECT_EQ(bytes("out/shared.bin"), shared_bytes(2, 4));
}

TEST_F(FixShared, OtherFindingsOfSuchAnAssetAreFixed) {
  Triangle asset;
  asset.more = R"(,"extensionsUsed":["KHR_materials_unlit","KHR_materials_unlit"])";
  write("a.gltf", asset);
  write("b.gltf", with_positions_there());
  const auto reports = fix_in_place({"a.gltf", "b.gltf"});
  EXPECT_EQ(reports[0].error, "");
  EXPECT_GE(reports[0].fixed(), 1U);
  EXPECT_EQ(reports[0].left(), 1U);
  EXPECT_NE(bytes("a.gltf"), asset.json());
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
}

// One place may stay while another one in the same file is fixed.
TEST_F(FixShared, OnlyTheBytesThatAreReadStay) {
  Triangle asset;
  asset.views += R"(,{"buffer":0,"byteOffset":72,"byteLength":36,"target":34962})";
  asset.accessors += fmt::format(R"(,{{"bufferView":2,{}}})", kVec3);
  std::string json = asset.json();
  const std::string primitive = R"({"attributes":{"POSITION":0,"NORMAL":1}})";
  json.replace(json.find(primitive), primitive.size(),
               primitive + R"(,{"attributes":{"POSITION":0,"NORMAL":2}})");
  folder_.write("a.gltf", json);
  write("b.gltf", with_positions_there());
  const auto reports = fix_in_place({"a.gltf", "b.gltf"});
  EXPECT_EQ(reports[0].left(), 1U);
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 1));
}

TEST_F(FixShared, AnAssetBesideItCountsThoughTheRunDoesNotNameIt) {
  write("a.gltf", {});
  write("b.gltf", with_positions_there());
  expect_left(fix_in_place({"a.gltf"})[0], "b.gltf' reads the same bytes");
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
  expect_left(fix({"a.gltf"}, {})[0], "b.gltf' reads the same bytes");
  // A copy is not what that asset reads.
  expect_fixed(fix({"a.gltf"}, {}, "out"), 1);
  EXPECT_EQ(bytes("out/shared.bin"), shared_bytes(1, 4));
}

TEST_F(FixShared, AnAssetBesideItThatAgreesIsNotInTheWay) {
  write("a.gltf", {});
  write("b.gltf", {});
  write("c.gltf", with_second_normals());
  expect_fixed(fix_in_place({"a.gltf"}), 1);
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(1, 4));
}

// The text of an asset that the run does not name stays as it is, and so must what it states.
TEST_F(FixShared, AnAssetBesideItWhoseBoundsWouldBeWrongIsInTheWay) {
  write("a.gltf", {});
  Triangle bounded;
  bounded.accessors = fmt::format(R"(,{{"bufferView":1,{},"min":[0,0,2],"max":[0,0,2]}})", kVec3);
  write("b.gltf", bounded);
  expect_left(fix_in_place({"a.gltf"})[0], "b.gltf' reads the same bytes");
  expect_fixed(fix_in_place({"a.gltf", "b.gltf"}), 1);
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(1, 4));
  EXPECT_THAT(bytes("b.gltf"), HasSubstr(R"("min":[0,0,1],"max":[0,0,1])"));
}

// Elements of one view lie between each other: only those that are read count.
TEST_F(FixShared, ElementsBesideThoseThatChangeAreNotRead) {
  folder_.write("shared.bin",
                packed_floats({0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 0, 2, 0, 1, 0, 0, 0, 2}));
  const auto interleaved = [](bool normals) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{}}}}}]}}],
"accessors":[{{"bufferView":0,{},"min":[0,0,0],"max":[1,1,0]}}{}],
"bufferViews":[{{"buffer":0,"byteLength":72,"byteStride":24,"target":34962}}],
"buffers":[{{"byteLength":72,"uri":"shared.bin"}}]}})",
        normals ? R"(,"NORMAL":1)" : "", kVec3,
        normals ? fmt::format(R"(,{{"bufferView":0,"byteOffset":12,{}}})", kVec3) : "");
  };
  folder_.write("a.gltf", interleaved(true));
  folder_.write("b.gltf", interleaved(false));
  expect_fixed(fix_in_place({"a.gltf"}), 1);
  EXPECT_EQ(bytes("shared.bin"),
            packed_floats({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}));
}

TEST_F(FixShared, LinksLeadToTheSameFile) {
  Triangle linked = with_second_normals();
  linked.uri = "link.bin";
  folder_.link("link.bin", "shared.bin");
  write("a.gltf", {});
  write("b.gltf", linked);
  expect_fixed(fix_in_place({"a.gltf", "b.gltf"}, 2), 1);
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(1, 1));
  EXPECT_TRUE(fs::is_symlink(folder_.path() / "link.bin"));

  folder_.write("shared.bin", shared_bytes(2, 4));
  Triangle other = with_positions_there();
  other.uri = "hard.bin";
  fs::create_hard_link(folder_.path() / "shared.bin", folder_.path() / "hard.bin");
  write("c.gltf", other);
  expect_left(fix({"a.gltf", "c.gltf"}, {}, "out")[0], "c.gltf' reads the same bytes");
  EXPECT_EQ(bytes("out/hard.bin"), shared_bytes(2, 4));
}

TEST_F(FixShared, TwoBuffersOfAnAssetThatAreOneFileGetOneContent) {
  folder_.link("link.bin", "shared.bin");
  for (const std::string name : {"shared.bin", "link.bin"}) {
    folder_.write("shared.bin", shared_bytes(2, 4));
    Triangle asset;
    asset.buffers = fmt::format(R"(,{{"byteLength":108,"uri":"{}"}})", name);
    asset.views += R"(,{"buffer":1,"byteOffset":72,"byteLength":36,"target":34962})";
    asset.accessors += fmt::format(R"(,{{"bufferView":2,{}}})", kVec3);
    std::string json = asset.json();
    const std::string primitive = R"({"attributes":{"POSITION":0,"NORMAL":1}})";
    json.replace(json.find(primitive), primitive.size(),
                 primitive + R"(,{"attributes":{"POSITION":0,"NORMAL":2}})");
    folder_.write("a.gltf", json);
    expect_fixed(fix_in_place({"a.gltf"}), 2);
    EXPECT_EQ(bytes("shared.bin"), shared_bytes(1, 1)) << name;
    EXPECT_TRUE(fs::is_symlink(folder_.path() / "link.bin"));
  }
}

TEST_F(FixShared, BytesThatAnotherBufferOfTheAssetReadsStay) {
  Triangle asset;
  asset.attributes += R"(,"_RAW":2)";
  asset.buffers = R"(,{"byteLength":108,"uri":"shared.bin"})";
  asset.views += R"(,{"buffer":1,"byteOffset":36,"byteLength":36,"target":34962})";
  asset.accessors += fmt::format(R"(,{{"bufferView":2,{}}})", kVec3);
  write("a.gltf", asset);
  expect_left(fix_in_place({"a.gltf"})[0], "buffer 1 reads the same bytes of 'shared.bin'");
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
}

TEST_F(FixShared, ABufferThatIsAnImageStays) {
  Triangle asset;
  asset.more = R"(,"images":[{"uri":"shared.bin"}])";
  write("a.gltf", asset);
  const auto report = fix_in_place({"a.gltf"})[0];
  EXPECT_EQ(report.error, "");
  EXPECT_THAT(report.actions,
              Contains(Field(&FixAction::why_not, HasSubstr("'shared.bin' is not only a buffer"))));
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));

  write("a.gltf", {});
  Triangle other = with_second_normals();
  other.uri = "other.bin";
  other.more = asset.more;
  folder_.write("other.bin", shared_bytes(1, 1));
  write("b.gltf", other);
  expect_left(fix_in_place({"a.gltf", "b.gltf"})[0], "b.gltf' reads the same bytes");
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
}

TEST_F(FixShared, NothingIsWrittenWhereOneOfThoseThatShareCannotBe) {
  Triangle bounded;
  bounded.accessors = fmt::format(R"(,{{"bufferView":1,{},"min":[0,0,2],"max":[0,0,2]}})", kVec3);
  write("a.gltf", {});
  write("b.gltf", bounded);
  fs::permissions(folder_.path() / "b.gltf", fs::perms(0444));
  const auto reports = fix_in_place({"a.gltf", "b.gltf"});
  for (const FixReport& report : reports) {
    EXPECT_EQ(report.problem, EditProblem::not_written);
    EXPECT_THAT(report.error, HasSubstr("read-only"));
    EXPECT_EQ(report.fixed(), 0U);
  }
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(2, 4));
  EXPECT_EQ(bytes("b.gltf"), bounded.json());
}

TEST_F(FixShared, CopiesOfTheOldBytesAreKeptOnce) {
  write("a.gltf", {});
  write("b.gltf", with_second_normals());
  FixOptions options;
  options.in_place = options.backup = true;
  expect_fixed(fix({"a.gltf", "b.gltf"}, options), 1);
  EXPECT_EQ(bytes("shared.bin.bak"), shared_bytes(2, 4));
  EXPECT_EQ(bytes("shared.bin"), shared_bytes(1, 1));
}

// A binary file may be the buffer of another asset: whatever moves its bytes breaks that.
TEST_F(FixShared, AnAssetThatIsABufferOfAnotherOneIsNotReplaced) {
  const std::string glb = bytes_at(fs::path(GLTFX_SOURCE_DIR) / "fixtures/good/bowl.glb");
  folder_.write("bowl.glb", glb);
  Triangle reader;
  reader.uri = "bowl.glb";
  write("reader.gltf", reader);
  DeleteOptions options;
  options.in_place = true;
  options.pointers = {"/asset/generator"};
  const std::string path = (folder_.path() / "bowl.glb").native();
  DeleteReport report = delete_objects(path, options);
  EXPECT_EQ(report.problem, EditProblem::refused);
  EXPECT_THAT(report.error, HasSubstr("reader.gltf' refers to this file"));
  EXPECT_EQ(bytes("bowl.glb"), glb);
  fs::remove(folder_.path() / "reader.gltf");
  EXPECT_EQ(delete_objects(path, options).error, "");
}

}  // namespace
}  // namespace gltfx
