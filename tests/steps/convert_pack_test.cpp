// SPDX-License-Identifier: Apache-2.0
// Buffers and images are packed into one GLB.
#include <fstream>

#include <gmock/gmock.h>

#include "convert_support.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::converted;
using test::glb_of;
using test::options_to;
using test::picture;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using namespace std::literals;

class Pack : public testing::Test {
 protected:
  fs::path output() const { return folder_.path() / "out" / "a.glb"; }
  StoredAsset packed(std::string_view text) {
    report_ = converted(folder_.write("a.gltf", text), output());
    return StoredAsset::at(output());
  }
  ConvertReport refused(std::string_view text, bool partial = false) {
    ConvertOptions options = options_to(output());
    options.partial = partial;
    ConvertReport report = convert_file(folder_.write("a.gltf", text).native(), options);
    EXPECT_EQ(report.written, partial) << report.error;
    EXPECT_EQ(fs::exists(output()), partial);
    EXPECT_EQ(report.problem == EditProblem::refused, !partial);
    for (const ConvertStep& step : report.steps) EXPECT_EQ(step.changes, partial);
    return report;
  }

  TempFolder folder_;
  ConvertReport report_;
};

const std::string kAsset = R"("asset": {"version": "2.0"})";

TEST_F(Pack, RemovesOnlyTheUriOfASingleBuffer) {
  folder_.write("b.bin", "abcdef");
  const StoredAsset now = packed(R"({ "asset": {"version": "2.0", "extras": {"n": 1.10}},
  "buffers" : [ {"uri":"b.bin", "byteLength": 6, "name" : "B"} ] })");
  EXPECT_EQ(now.text, R"({ "asset": {"version": "2.0", "extras": {"n": 1.10}},
  "buffers" : [ {"byteLength": 6, "name" : "B"} ] })");
  EXPECT_EQ(now.bin, "abcdef\0\0"s);
  EXPECT_THAT(report_.steps, SizeIs(1));
  EXPECT_EQ(report_.steps[0].what, "one GLB, 1 buffer");
  EXPECT_THAT(report_.steps[0].losses, IsEmpty());
}

// As gltfpack -cf writes it: readers of the extension do not load the second buffer.
TEST_F(Pack, LeavesThePlainCopyOfCompressedViews) {
  folder_.write("b.bin", "abcdef");
  folder_.write("plain.bin", "ghij");
  const StoredAsset now = packed("{" + kAsset + R"(,
    "extensionsUsed": ["EXT_meshopt_compression"], "buffers": [{"uri": "b.bin", "byteLength": 6},
      {"uri": "plain.bin", "byteLength": 4,
        "extensions": {"EXT_meshopt_compression": {"fallback": true}}}]})");
  EXPECT_EQ(now.bin, "abcdef\0\0"s);
  EXPECT_THAT(now.text, HasSubstr(R"("uri": "plain.bin")"));
  EXPECT_EQ(content_of(output().parent_path() / "plain.bin"), "ghij");
  ASSERT_THAT(report_.steps[0].left, SizeIs(1));
  EXPECT_EQ(report_.steps[0].left[0].pointer, "/buffers/1");
}

TEST_F(Pack, FillsAnEmptyChunk) {
  folder_.write("a.png", picture("leaf"));
  const fs::path path =
      folder_.write("empty.glb", glb_of("{" + kAsset + R"(, "images": [{"uri": "a.png"}]})", ""));
  ConvertOptions options = options_to(output());
  options.to = StoredAs::glb;
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_TRUE(StoredAsset::at(output()).bin.starts_with(picture("leaf")));
}

TEST_F(Pack, MergesBuffersAtMultiplesOfEight) {
  folder_.write("b.bin", "abcdef");
  const StoredAsset now = packed("{" + kAsset + R"(,
  "buffers": [{"byteLength": 6, "uri": "b.bin"}, {"uri": "data:;base64,MTIzNDU=", "byteLength": 5}],
  "bufferViews": [{"buffer": 1, "byteLength": 1}, {"buffer": 0, "byteLength": 2},
                  {"buffer": 1, "byteOffset": 4, "byteLength": 1}]})");
  EXPECT_EQ(now.text, "{" + kAsset + R"(,
  "buffers": [{"byteLength": 13}],
  "bufferViews": [{"buffer": 0, "byteLength": 1, "byteOffset": 8}, {"buffer": 0, "byteLength": 2},
                  {"buffer": 0, "byteOffset": 12, "byteLength": 1}]})");
  EXPECT_EQ(now.bin,
            "abcdef\0\x30"
            "12345\0\0\0"s.replace(7, 1, 1, '\0'));
}

TEST_F(Pack, StoresTheBytesOfAFileOnce) {
  folder_.write("b.bin", "abcdefgh");
  const StoredAsset now = packed("{" + kAsset + R"(,
  "buffers": [{"byteLength": 8, "uri": "b.bin"}, {"byteLength": 4, "uri": "./b.bin"}]})");
  EXPECT_EQ(now.bin, "abcdefgh");
}

TEST_F(Pack, AddsOneViewForEachImageFile) {
  folder_.write("leaf.png", picture("leaf"));
  const StoredAsset now = packed("{" + kAsset + R"(,
  "images": [{"uri": "leaf.png", "name": "L"}, {"name": "M", "mimeType": "image/png", "uri": "./leaf.png"}]})");
  EXPECT_EQ(now.text, "{" + kAsset + R"(,
  "images": [{"bufferView": 0, "name": "L", "mimeType": "image/png"}, {"name": "M", "mimeType": "image/png", "bufferView": 0}], "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 20}], "buffers": [{"byteLength": 20}]})");
  EXPECT_EQ(now.bin, picture("leaf"));
  EXPECT_EQ(folder_.entries(), 3);  // the asset, its image, the folder of the GLB
  EXPECT_EQ(std::distance(fs::directory_iterator(output().parent_path()), {}), 1);
}

TEST_F(Pack, UpdatesObjectsOfExtensions) {
  folder_.write("b.bin", "abcdefgh");
  folder_.write("c.bin", "12345678");
  const StoredAsset now = packed("{" + kAsset + R"(,
  "buffers": [{"byteLength": 8, "uri": "b.bin"},
    {"byteLength": 64, "extensions": {"EXT_meshopt_compression": {"fallback": true}}},
    {"byteLength": 8, "uri": "c.bin"}],
  "bufferViews": [{"buffer": 1, "byteLength": 16, "extensions": {"EXT_meshopt_compression":
    {"buffer": 2, "byteLength": 8, "byteStride": 4, "count": 4, "mode": "ATTRIBUTES"}}}]})");
  EXPECT_EQ(
      now.json()["buffers"].dump(),
      R"([{"byteLength":16},{"byteLength":64,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}])");
  const auto view = now.json()["bufferViews"][0];
  EXPECT_EQ(view["buffer"], 1);
  EXPECT_EQ(view["extensions"]["EXT_meshopt_compression"]["buffer"], 0);
  EXPECT_EQ(view["extensions"]["EXT_meshopt_compression"]["byteOffset"], 8);
}

const std::string kTwoBuffers = "{" + kAsset + R"(,
  "buffers": [{"byteLength": 4, "uri": "b.bin"}, {"byteLength": 4, "uri": "c.bin", "name": "C"}],
  "nodes": [{"extensions": {"ACME_ref": {"curve": VALUE}}}]})";

std::string with_value(std::string_view value) {
  std::string text = kTwoBuffers;
  return text.replace(text.find("VALUE"), 5, value);
}

TEST_F(Pack, RefusesToMergeIfAnUnknownExtensionHasAnInteger) {
  folder_.write("b.bin", "abcd");
  folder_.write("c.bin", "efgh");
  const ConvertReport report = refused(with_value("[0.5, 1]"));
  EXPECT_THAT(report.error, HasSubstr("/buffers/1: /nodes/0/extensions/ACME_ref may hold indices"));
  EXPECT_EQ(report.refused(), 1U);
  // With `partial`, the rest is written.
  refused(with_value("[0.5, 1]"), true);
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_EQ(now.bin, "abcd");
  EXPECT_EQ(now.json()["buffers"][1]["uri"], "c.bin");
  EXPECT_EQ(content_of(output().parent_path() / "c.bin"), "efgh");
}

TEST_F(Pack, MergesIfAnUnknownExtensionHasNoInteger) {
  folder_.write("b.bin", "abcd");
  folder_.write("c.bin", "efgh");
  EXPECT_EQ(packed(with_value(R"([0.5, "1", true, null])")).bin, "abcd\0\0\0\0efgh"s);
  ASSERT_THAT(report_.steps[0].losses, SizeIs(1));
  EXPECT_EQ(report_.steps[0].losses[0].quantity, "the name of /buffers/1");
}

TEST_F(Pack, MergesIfASchemaDescribesTheExtension) {
  folder_.write("b.bin", "abcd");
  folder_.write("c.bin", "efgh");
  const schema::Compiled compiled = schema::compile_with({{"ref.json", R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "gltfx:ext/ACME_ref", "title": "ACME_ref", "description": "A curve.",
    "x-gltfx": {"extension": "ACME_ref", "on": ["node"], "status": "vendor",
                "spec": "https://example.com/"},
    "type": "object", "properties": {"curve": {"description": "A number.",
      "type": "integer", "minimum": 0}}})",
                                                           true}});
  ASSERT_TRUE(compiled.set) << compiled.errors.at(0).message;
  ConvertOptions options = options_to(output());
  options.schemas = compiled.set;
  EXPECT_TRUE(convert_file(folder_.write("a.gltf", with_value("1")).native(), options).written);
}

TEST_F(Pack, DoesNotMergeABufferWithOtherMembers) {
  folder_.write("b.bin", "abcd");
  folder_.write("c.bin", "efgh");
  EXPECT_THAT(refused("{" + kAsset + R"(, "buffers": [{"byteLength": 4, "uri": "b.bin"},
    {"byteLength": 4, "uri": "c.bin", "extras": {"of": "us"}}]})")
                  .error,
              HasSubstr("/buffers/1: its 'extras' would be lost"));
}

TEST_F(Pack, NamesUnreadableObjects) {
  const std::string missing = "{" + kAsset + R"(, "images": [{"uri": "no.png"}]})";
  EXPECT_THAT(refused(missing).error, HasSubstr("/images/0: "));
  EXPECT_EQ(refused(missing, true).refused(), 1U);
  EXPECT_EQ(StoredAsset::at(output()).json()["images"][0]["uri"], "no.png");
}

TEST_F(Pack, RefusesAShortBuffer) {
  folder_.write("b.bin", "abc");
  EXPECT_THAT(refused("{" + kAsset + R"(, "buffers": [{"byteLength": 4, "uri": "b.bin"}]})").error,
              HasSubstr("/buffers/0: its data has only 3 bytes"));
}

TEST_F(Pack, RefusesTooManyBytesBeforeWriting) {
  std::ofstream(folder_.path() / "b.bin");
  fs::resize_file(folder_.path() / "b.bin", 4'300'000'000);  // a sparse file
  const fs::path path = folder_.write(
      "a.gltf", "{" + kAsset + R"(, "buffers": [{"byteLength": 4300000000, "uri": "b.bin"}]})");
  ConvertOptions options = options_to(output());
  options.later.glb_version = GlbVersion::two;
  EXPECT_THAT(convert_file(path.native(), options).error,
              HasSubstr("a GLB of version 2 has at most 4 GiB; use --glb 3, or --to gltf"));
  EXPECT_FALSE(fs::exists(output()));
}

TEST_F(Pack, RemovesTemporaryFilesOfALargeGlb) {
  std::ofstream(folder_.path() / "b.bin");
  fs::resize_file(folder_.path() / "b.bin", 20'000'000);
  folder_.write("c.bin", "abcd");
  const StoredAsset now = packed("{" + kAsset + R"(, "buffers": [{"byteLength": 20000000, "uri":
    "b.bin"}, {"byteLength": 4, "uri": "c.bin"}]})");
  EXPECT_EQ(now.bin.size(), 20'000'004U);
  EXPECT_TRUE(now.bin.ends_with("\0abcd"s));
  EXPECT_EQ(std::distance(fs::directory_iterator(output().parent_path()), {}), 1);
  EXPECT_EQ(folder_.entries(), 4);
  // Replaces an existing file.
  converted(folder_.path() / "a.gltf", output());
  // A dry run.
  ConvertOptions options;
  options.to = StoredAs::glb;
  const ConvertReport report = convert_file((folder_.path() / "a.gltf").native(), options);
  EXPECT_TRUE(report.changes);
  EXPECT_EQ(report.steps[0].bytes_after, fs::file_size(output()));
  EXPECT_EQ(folder_.entries(), 4);
}

TEST_F(Pack, MovesExternalFilesIntoAGlbAndKeepsItsChunks) {
  folder_.write("leaf.png", picture("leaf"));
  const fs::path file = folder_.write(
      "a.glb",
      glb_of("{" + kAsset + R"(,"buffers":[{"byteLength":4}],"images":[{"uri":"leaf.png"}]})",
             "abcd", container::test::chunk(container::test::kChunkOther, "more")));
  ConvertOptions options = options_to(output());
  EXPECT_FALSE(convert_file(file.native(), options).changes);  // a copy: nothing else was requested
  EXPECT_EQ(content_of(output()), content_of(file));
  fs::remove_all(output().parent_path());
  options.to = StoredAs::glb;
  EXPECT_TRUE(convert_file(file.native(), options).written);
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_EQ(now.bin, "abcd\0\0\0\0"s + picture("leaf"));
  ASSERT_THAT(now.container.chunks, SizeIs(3));
  EXPECT_EQ(now.chunk(now.container.chunks[2]), "more");
}

TEST_F(Pack, KeepsBytesAfterTheByteLengthOfAChunk) {
  folder_.write("leaf.png", picture("leaf"));
  const fs::path file = folder_.write(
      "a.glb",
      glb_of("{" + kAsset + R"(,"buffers":[{"byteLength":4}],"images":[{"uri":"leaf.png"}]})",
             "abcdmore bytes  "));
  ConvertOptions options = options_to(output());
  options.to = StoredAs::glb;
  EXPECT_TRUE(convert_file(file.native(), options).written);
  EXPECT_EQ(StoredAsset::at(output()).bin, "abcdmore bytes  " + picture("leaf"));
}

TEST_F(Pack, KeepsTheContainerInPlace) {
  const fs::path file = folder_.write("a.gltf", "{" + kAsset + "}");
  ConvertOptions options;
  options.in_place = true;
  options.to = StoredAs::glb;
  const ConvertReport report = convert_file(file.native(), options);
  EXPECT_EQ(report.problem, EditProblem::refused);
  EXPECT_THAT(report.error, HasSubstr("in place, an asset keeps its container"));
  EXPECT_EQ(content_of(file), "{" + kAsset + "}");
}

}  // namespace
}  // namespace gltfx
