// SPDX-License-Identifier: Apache-2.0
/// Pictures and the page of `gltfx compare`: files, links, limits, refusals.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;

// A square of one color, named as asked for, and a second one to its right.
std::string two_squares(const std::string& name, const std::string& color,
                        const std::string& place = "[3, 0, 0]") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"name": ")" +
         name + R"(", "mesh": 0}, {"name": "Right", "mesh": 1, "translation": )" + place + R"(}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]},
             {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 1}]}],
  "materials": [{"doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": )" +
         color +
         R"(}}, {"doubleSided": true}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}],
  "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 6}],
  "buffers": [{"byteLength": 54, "uri": "data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAECAAID\"}]}";
}
const std::string kRed = "[1, 0, 0, 1]";
const std::string kBlue = "[0, 0, 1, 1]";

class ComparePictures : public testing::Test {
 protected:
  void put(const std::string& path, const std::string& text) const { folder_.write(path, text); }
  std::string at(const std::string& path) const { return (folder_.path() / path).native(); }
  std::string read(const std::string& path) const { return read_file(at(path)); }
  std::vector<std::string> files_in(const std::string& path) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(at(path))) {
      names.push_back(entry.path().filename().native());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  Outcome compare(std::vector<std::string> words) const {
    words.insert(words.begin(), "compare");
    return gltfx(std::move(words));
  }

  container::test::TempFolder folder_;
};

TEST_F(ComparePictures, AreWrittenForEachViewAndSayWhatChanged) {
  put("old.gltf", two_squares("Left", kRed));
  put("new.gltf", two_squares("Left", kBlue));
  const Outcome outcome = compare(
      {at("old.gltf"), at("new.gltf"), "--format", "json", "--pictures", at("pr"), "--size", "64"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(files_in("pr"),
              ElementsAre("new.gltf.change.difference.png", "new.gltf.change.new.png",
                          "new.gltf.change.old.png", "new.gltf.difference.png", "new.gltf.new.png",
                          "new.gltf.old.png", "new.gltf.opposite.difference.png",
                          "new.gltf.opposite.new.png", "new.gltf.opposite.old.png"));
  EXPECT_THAT(read("pr/new.gltf.old.png"), StartsWith("\x89PNG"));
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  const nlohmann::json& pictures = report["pairs"][0]["pictures"];
  ASSERT_EQ(pictures.size(), 3U);
  EXPECT_EQ(pictures[0]["view"], "usual");
  EXPECT_EQ(pictures[0]["old"], "new.gltf.old.png");
  EXPECT_EQ(pictures[0]["changed"], true);
  EXPECT_GT(pictures[0]["distance"], pictures[0]["limit"]);
  EXPECT_EQ(pictures[1]["view"], "opposite");
  EXPECT_EQ(pictures[2]["view"], "change");
  EXPECT_EQ(pictures[2]["change"], 0);
}

TEST_F(ComparePictures, DoNotChangeWhereNothingIsDrawnDifferently) {
  put("old.gltf", two_squares("Left", kRed));
  put("new.gltf", two_squares("Other", kRed));
  const Outcome outcome = compare(
      {at("old.gltf"), at("new.gltf"), "--format", "json", "--pictures", at("pr"), "--size", "64"});
  EXPECT_EQ(outcome.code, 1) << "a name is a change, pictures do not decide";
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  const nlohmann::json& pictures = report["pairs"][0]["pictures"];
  ASSERT_GE(pictures.size(), 2U);
  EXPECT_EQ(pictures[0]["changed"], false);
  EXPECT_EQ(pictures[1]["changed"], false);
  EXPECT_EQ(read("pr/new.gltf.old.png"), read("pr/new.gltf.new.png"));
}

TEST_F(ComparePictures, OfOneAssetAloneAreOneFile) {
  put("old/gone.gltf", two_squares("Left", kRed));
  put("new/sub/come.gltf", two_squares("Left", kRed));
  const Outcome outcome =
      compare({at("old"), at("new"), "--pictures", at("pr"), "--size", "64", "--format", "markdown",
               "--picture-url", "https://example.org/a b(1)/"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(files_in("pr"), ElementsAre("gone.gltf.old.png", "sub-come.gltf.new.png"));
  EXPECT_THAT(outcome.out, HasSubstr("![old](https://example.org/a%20b%281%29/gone.gltf.old.png)"));
  EXPECT_THAT(outcome.out,
              HasSubstr("![new](https://example.org/a%20b%281%29/sub-come.gltf.new.png)"));
}

TEST_F(ComparePictures, HaveNamesThatAreUniqueAndPlain) {
  for (const std::string name : {"a/b.gltf", "a-b.gltf", "A-b.gltf", "x](y) z.gltf"}) {
    put("old/" + name, two_squares("Left", kRed));
    put("new/" + name, two_squares("Left", kBlue));
  }
  const Outcome outcome = compare({at("old"), at("new"), "--pictures", at("pr"), "--size", "32"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const auto names = files_in("pr");
  EXPECT_EQ(names.size(), 4 * 9U);
  for (const std::string& name : names) {
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789._-"),
              std::string::npos)
        << name;
  }
}

TEST_F(ComparePictures, ReplaceOlderFilesWhole) {
  put("old.gltf", two_squares("Left", kRed));
  put("new.gltf", two_squares("Left", kBlue));
  put("pr/new.gltf.old.png", std::string(100000, 'x'));
  const Outcome outcome =
      compare({at("old.gltf"), at("new.gltf"), "--pictures", at("pr"), "--size", "32"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(read("pr/new.gltf.old.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(read("pr/new.gltf.old.png"), Not(HasSubstr("xxxx")));
}

TEST_F(ComparePictures, AreRefusedWhereTheyCannotBeWritten) {
  put("old.gltf", two_squares("Left", kRed));
  put("file", "not a folder");
  const Outcome outcome = compare({at("old.gltf"), at("old.gltf"), "--pictures", at("file/below")});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("--pictures: "));
  EXPECT_EQ(compare({at("old.gltf"), at("old.gltf"), "-o", at("file/page.html")}).code, 4);
  EXPECT_EQ(compare({at("old.gltf"), at("old.gltf"), "--picture-url", "x/"}).code, 2);
  EXPECT_EQ(compare({at("old.gltf"), at("old.gltf"), "--size", "64"}).code, 2);
}

TEST_F(ComparePictures, OfEqualBytesAreNotDrawn) {
  put("old.gltf", two_squares("Left", kRed));
  const Outcome outcome = compare({at("old.gltf"), at("old.gltf"), "--pictures", at("pr")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(files_in("pr"), IsEmpty());
}

TEST_F(ComparePictures, MarkdownStaysWithinItsLimit) {
  for (int i = 0; i < 16; ++i) {
    const std::string name = std::to_string(i) + std::string(200, '_') + ".gltf";
    put("old/" + name, two_squares("<b>&|" + std::string(300, '*'), kRed));
    put("new/" + name, two_squares("<i>&|" + std::string(300, '*'), kBlue, "[4, 0, 0]"));
  }
  const Outcome outcome =
      compare({at("old"), at("new"), "--pictures", at("pr"), "--size", "32", "--format", "markdown",
               "--picture-url", "https://example.org/" + std::string(300, 'u') + "/"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_LE(outcome.out.size(), 60000U);
  EXPECT_GE(outcome.out.size(), 40000U);
  EXPECT_THAT(outcome.out, StartsWith("**16 assets: 16 differ**"));
}

TEST_F(ComparePictures, PageHasAllInOneFileAndKeepsNamesAsData) {
  put("old.gltf", two_squares("</script><img src=x onerror=alert(1)>", kRed));
  put("new.gltf", two_squares("</script><img src=x onerror=alert(1)>", kBlue));
  const Outcome outcome =
      compare({at("old.gltf"), at("new.gltf"), "-o", at("out/page.html"), "--size", "64"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("differs: "));
  const std::string page = read("out/page.html");
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("data:image/webp;base64,"));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  const std::string mark = "<script type=\"application/json\">";
  const std::size_t begin = page.find(mark) + mark.size();
  const nlohmann::json pair =
      nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_FALSE(pair["pictures"][0]["regions"].empty());
  EXPECT_THAT(page.substr(0, begin), HasSubstr("<data id=\"p0-0-old\" value=\"data:image/webp;"))
      << "the pictures of a pair come before it";
  EXPECT_THAT(page, HasSubstr("\"differs\":1"));
}

TEST_F(ComparePictures, AnswerGoesToANamedFile) {
  put("old.gltf", two_squares("Left", kRed));
  const Outcome outcome =
      compare({at("old.gltf"), at("old.gltf"), "--format", "json", "-o", at("answer.json")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(nlohmann::json::parse(read("answer.json"))["summary"]["identical"], 1);
}

TEST_F(ComparePictures, ChangesHaveLinesAndStorageHasSizes) {
  put("old.gltf", two_squares("Left", kRed));
  put("new.gltf", "\n" + two_squares("Left", "[0, 0, 1, 1]"));
  const Outcome outcome = compare({at("old.gltf"), at("new.gltf"), "--format", "json"});
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  const nlohmann::json& change = report["pairs"][0]["changes"][0];
  EXPECT_EQ(change["oldLine"], 5);
  EXPECT_EQ(change["newLine"], 6);
  EXPECT_EQ(change["oldColumn"], change["newColumn"]);
  const nlohmann::json& sizes = report["pairs"][0]["sizes"];
  EXPECT_EQ(sizes[0]["what"], "files");
  EXPECT_EQ(sizes[0]["new"].get<int>() - sizes[0]["old"].get<int>(), 1);
  put("spaced.gltf", two_squares("Left", kRed) + std::string(500, ' '));
  const Outcome stored = compare({at("old.gltf"), at("spaced.gltf")});
  EXPECT_EQ(stored.code, 0);
  EXPECT_THAT(stored.out, HasSubstr("storage: files "));
}

}  // namespace
}  // namespace gltfx::program
