// SPDX-License-Identifier: Apache-2.0
// GLBs and data URIs are unpacked into files.
#include <fstream>

#include <gmock/gmock.h>

#include "convert_support.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::converted;
using test::glb_of;
using test::options_to;
using test::OrderedJson;
using test::picture;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using namespace std::literals;

class Unpack : public testing::Test {
 protected:
  fs::path out() const { return folder_.path() / "out"; }
  fs::path source(const std::string& text, std::string_view bin) const {
    return folder_.write("a.glb", glb_of(text, bin));
  }
  // Returns the text.
  std::string unpacked(const std::string& text, std::string_view bin) {
    report_ = converted(source(text, bin), out() / "a.gltf");
    return content_of(out() / "a.gltf");
  }

  TempFolder folder_;
  ConvertReport report_;
};

const std::string kHead = R"({"asset":{"version":"2.0"},)";

// Images with these members, each in a view of at least eight bytes.
struct Pictures {
  explicit Pictures(const std::vector<std::string>& members) {
    std::string images, views;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::string content = picture(std::to_string(1000 + i));
      const std::string comma = i == 0 ? "" : ",";
      images += comma + R"({"mimeType":"image/png","bufferView":)" + std::to_string(i) +
                (members[i].empty() ? "" : "," + members[i]) + "}";
      views += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(bin.size()) +
               R"(,"byteLength":)" + std::to_string(content.size()) + "}";
      bin += content;
      bin.resize((bin.size() + 7) / 8 * 8);
    }
    text = kHead + R"("images":[)" + images + R"(],"bufferViews":[)" + views +
           R"(],"buffers":[{"byteLength":)" + std::to_string(bin.size()) + "}]}";
  }
  std::string text, bin;
};

TEST_F(Unpack, StoresTheChunkInANamedFile) {
  EXPECT_EQ(unpacked(kHead + R"("buffers":[{"byteLength":6}]})", "abcdef\0\0"sv),
            kHead + R"("buffers":[{"byteLength":6,"uri":"a.bin"}]})");
  EXPECT_EQ(content_of(out() / "a.bin"), "abcdef");
  EXPECT_THAT(report_.new_files, ElementsAre("a.bin"));
}

TEST_F(Unpack, RemovesImagesAndMovesTheBytesAfterThem) {
  const std::string text =
      kHead +
      R"("accessors":[{"bufferView":2,"componentType":5126,"count":1,"type":"SCALAR"}],"images":[{"bufferView":1,)"
      R"("mimeType":"image/png","name":"leaf.png"}],"bufferViews":[{"buffer":0,"byteLength":4},)"
      R"({"buffer":0,"byteOffset":8,"byteLength":20},{"buffer":0,"byteOffset":32,"byteLength":4}],)"
      R"("buffers":[{"byteLength":36}]})";
  EXPECT_EQ(
      unpacked(text, "abcd\0\0\0\0"s + picture("leaf") + "\0\0\0\0\0\0\x80\x3f"s),
      kHead +
          R"("accessors":[{"bufferView":1,"componentType":5126,"count":1,"type":"SCALAR"}],"images":[{"uri":"leaf.png",)"
          R"("mimeType":"image/png","name":"leaf.png"}],"bufferViews":[{"buffer":0,"byteLength":4},)"
          R"({"buffer":0,"byteOffset":8,"byteLength":4}],)"
          R"("buffers":[{"byteLength":12,"uri":"a.bin"}]})");
  EXPECT_EQ(content_of(out() / "a.bin"), "abcd\0\0\0\0\0\0\x80\x3f"s);
  EXPECT_EQ(content_of(out() / "leaf.png"), picture("leaf"));
}

TEST_F(Unpack, RemovesABufferThatHasOnlyImages) {
  const Pictures one({R"("name":"one")"});
  EXPECT_EQ(unpacked(one.text, one.bin),
            kHead + R"("images":[{"mimeType":"image/png","uri":"one.png","name":"one"}]})");
  EXPECT_THAT(report_.new_files, ElementsAre("one.png"));
}

TEST_F(Unpack, CreatesCleanAndUniqueNames) {
  const Pictures all({R"("name":"../../etc/passwd")", R"("name":"C:\\temp\\wood")",
                      R"("name":"Wood")", R"("name":"con")", R"("name":"a:b*c?d")",
                      R"("name":"\u202egnp.exe")", R"("name":"...")", "", R"("name":"wood.PNG")",
                      R"("name":"50% \u00e9")"});
  const auto json = OrderedJson::parse(unpacked(all.text, all.bin));
  std::vector<std::string> uris;
  for (const auto& image : json["images"]) uris.push_back(image["uri"]);
  EXPECT_THAT(uris, ElementsAre("passwd.png", "wood.png", "Wood-2.png", "_con.png", "a_b_c_d.png",
                                "a_image5.png", "a_image6.png", "a_image7.png", "wood-3.png",
                                "50%25%20\xC3\xA9.png"));
  EXPECT_TRUE(fs::exists(out() / "50% \xC3\xA9.png"));
}

TEST_F(Unpack, DoesNotReplaceAFileWithOtherBytes) {
  const Pictures one({R"("name":"one")"});
  folder_.write("out/one.png", "something else");
  const ConvertReport report =
      convert_file(source(one.text, one.bin).native(), options_to(out() / "a.gltf"));
  EXPECT_EQ(report.problem, EditProblem::refused);
  EXPECT_THAT(report.error, HasSubstr("one.png' is there already with other bytes"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out()), {}), 1);
  EXPECT_EQ(content_of(out() / "one.png"), "something else");
  folder_.write("out/one.png", picture("1000"));
  converted(folder_.path() / "a.glb", out() / "a.gltf");
}

TEST_F(Unpack, KeepsAViewThatHasAnotherUse) {
  Pictures one({R"("name":"one")"});
  one.text.insert(
      one.text.size() - 1,
      R"(,"accessors":[{"bufferView":0,"componentType":5121,"count":1,"type":"SCALAR"}])");
  const auto json = OrderedJson::parse(unpacked(one.text, one.bin));
  EXPECT_THAT(json["bufferViews"], SizeIs(1));
  EXPECT_EQ(content_of(out() / "a.bin"), one.bin);
}

TEST_F(Unpack, LeavesImagesIfAnUnknownExtensionMayReferToViews) {
  Pictures one({R"("name":"one","extensions":{"ACME_ref":{"view":0}})"});
  const auto json = OrderedJson::parse(unpacked(one.text, one.bin));
  EXPECT_EQ(json["images"][0]["bufferView"], 0);
  ASSERT_THAT(report_.steps[0].left, SizeIs(1));
  EXPECT_EQ(report_.steps[0].left[0].pointer, "/images/0");
  EXPECT_THAT(report_.steps[0].left[0].reason, HasSubstr("ACME_ref may hold indices"));
  EXPECT_EQ(content_of(out() / "a.bin"), one.bin);
}

TEST_F(Unpack, NamesAChunkThatAGltfCannotHold) {
  const fs::path file =
      folder_.write("a.glb", glb_of(kHead + R"("buffers":[{"byteLength":4}]})", "abcd",
                                    container::test::chunk(container::test::kChunkOther, "more")));
  const ConvertReport report = convert_file(file.native(), options_to(out() / "a.gltf"));
  EXPECT_THAT(report.error, HasSubstr("a .gltf cannot hold the chunk 'ALYL'"));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Unpack, ConvertsBetweenDataUrisAndFiles) {
  const std::string text =
      kHead + R"("buffers":[{"byteLength":4,"uri":"data:;base64,YWJjZA=="}],)"
              R"("images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUg==","name":"x"}]})";
  ConvertOptions options = options_to(out() / "a.gltf");
  options.to = StoredAs::gltf;
  EXPECT_TRUE(convert_file(folder_.write("a.gltf", text).native(), options).written);
  EXPECT_EQ(
      content_of(out() / "a.gltf"),
      kHead +
          R"("buffers":[{"byteLength":4,"uri":"a.bin"}],"images":[{"uri":"x.png","name":"x"}]})");
  EXPECT_EQ(content_of(out() / "a.bin"), "abcd");
  options.output = folder_.path() / "back" / "a.gltf";
  options.to = StoredAs::embedded;
  EXPECT_TRUE(convert_file((out() / "a.gltf").native(), options).written);
  EXPECT_EQ(
      content_of(options.output),
      kHead +
          R"("buffers":[{"byteLength":4,"uri":"data:application/octet-stream;base64,YWJjZA=="}],)"
          R"("images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUg==","name":"x"}]})");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "back"), {}), 1);
}

TEST_F(Unpack, AddsAHashToImageNamesInASharedFolder) {
  const Pictures one({R"("name":"one")"});
  ConvertOptions options = options_to(out() / "a.gltf");
  options.shared_folder = true;
  const ConvertReport report = convert_file(source(one.text, one.bin).native(), options);
  ASSERT_THAT(report.new_files, SizeIs(1));
  EXPECT_THAT(report.new_files[0], testing::MatchesRegex("one-[0-9a-f]{8}\\.png"));
  const Pictures named({R"("name":"wood.png")"});
  options.output = (out() / "b.gltf").native();
  const ConvertReport again = convert_file(source(named.text, named.bin).native(), options);
  ASSERT_THAT(again.new_files, SizeIs(1));
  EXPECT_THAT(again.new_files[0], testing::MatchesRegex("wood-[0-9a-f]{8}\\.png"));
}

TEST_F(Unpack, FillsInAnEmptyUri) {
  const Pictures one({R"("name":"one","uri":"")"});
  const OrderedJson json = OrderedJson::parse(unpacked(one.text, one.bin));
  EXPECT_EQ(json["images"][0].dump(), R"({"mimeType":"image/png","name":"one","uri":"one.png"})");
}

// A buffer of one asset and another asset may have similar names.
TEST_F(Unpack, CreatesUniqueBufferNamesInASharedFolder) {
  const auto text = [](const std::string& buffers) {
    return kHead + R"("buffers":[)" + buffers + "]}";
  };
  const std::string first = R"({"byteLength":4,"uri":"data:;base64,YWJjZA=="})";
  const std::string second = R"({"byteLength":4,"uri":"data:;base64,ZWZnaA=="})";
  const std::string third = R"({"byteLength":4,"uri":"data:;base64,aWprbA=="})";
  const std::vector<EditInput> inputs{
      {folder_.write("m.gltf", text(first + "," + second)).native(), out() / "m.gltf"},
      {folder_.write("m-1.gltf", text(third)).native(), out() / "m-1.gltf"}};
  ConvertOptions options;
  options.to = StoredAs::gltf;
  options.shared_folder = true;
  convert_files(inputs, options, 4, [](ConvertReport&& report) {
    EXPECT_TRUE(report.written) << report.path << ": " << report.error;
  });
  const auto content = [&](const char* asset, std::size_t buffer) {
    const OrderedJson json = OrderedJson::parse(content_of(out() / asset));
    return content_of(out() / json["buffers"][buffer]["uri"].get<std::string>());
  };
  EXPECT_EQ(content("m.gltf", 0), "abcd");
  EXPECT_EQ(content("m.gltf", 1), "efgh");
  EXPECT_EQ(content("m-1.gltf", 0), "ijkl");
}

TEST_F(Unpack, CopiesFilesThatExtensionsReferTo) {
  folder_.write("classes.json", "{}");
  folder_.write("a.gltf", kHead + R"("extensionsUsed":["EXT_structural_metadata"],"extensions":)"
                                  R"({"EXT_structural_metadata":{"schemaUri":"classes.json"}}})");
  converted(folder_.path() / "a.gltf", out() / "a.gltf");
  EXPECT_EQ(content_of(out() / "classes.json"), "{}");
}

TEST_F(Unpack, DoesNotGiveAnImageTheNameOfTheAsset) {
  const std::string text = kHead +
                           R"("images":[{"mimeType":"image/x","bufferView":0,"name":"a.gltf"}],)"
                           R"("bufferViews":[{"buffer":0,"byteLength":8}],)"
                           R"("buffers":[{"byteLength":8}]})";
  const OrderedJson json = OrderedJson::parse(unpacked(text, "no image"));
  const std::string uri = json["images"][0]["uri"];
  EXPECT_NE(uri, "a.gltf");
  EXPECT_EQ(content_of(out() / uri), "no image");
}

// Each reference to a file would be encoded separately.
TEST_F(Unpack, RefusesTextLongerThan4GiBBeforeEncoding) {
  std::ofstream(folder_.path() / "b.bin");
  fs::resize_file(folder_.path() / "b.bin", 100'000'000);  // a sparse file
  std::string buffers;
  for (int i = 0; i < 50; ++i) {
    buffers += std::string(i == 0 ? "" : ",") + R"({"byteLength":100000000,"uri":"b.bin"})";
  }
  ConvertOptions options = options_to(out() / "a.gltf");
  options.to = StoredAs::embedded;
  const ConvertReport report = convert_file(
      folder_.write("a.gltf", kHead + R"("buffers":[)" + buffers + "]}").native(), options);
  EXPECT_THAT(report.error, HasSubstr("JSON text has at most 4 GiB"));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Unpack, OmitsAMediaTypeThatADataUriCannotHold) {
  folder_.write("x.any", "no image");
  ConvertOptions options = options_to(out() / "a.gltf");
  options.to = StoredAs::embedded;
  const std::string text = kHead + R"("images":[{"uri":"x.any","mimeType":"image/x,AAAA"}]})";
  EXPECT_TRUE(convert_file(folder_.write("a.gltf", text).native(), options).written);
  EXPECT_THAT(content_of(out() / "a.gltf"),
              HasSubstr("data:application/octet-stream;base64,bm8gaW1hZ2U="));
}

}  // namespace
}  // namespace gltfx
