// SPDX-License-Identifier: Apache-2.0
// `gltfx report`: one page for any number of assets.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Report : public testing::Test {
 protected:
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "report");
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  static json data_in(const std::string& page) {
    const std::string begin = R"(<script id="data" type="application/json">)";
    const std::size_t from = page.find(begin) + begin.size();
    return json::parse(page.substr(from, page.find("</script>", from) - from));
  }
  json data_of(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"-o", "-", "--no-thumbnails"});
    return data_in(here(std::move(arguments)).out);
  }
  void write_both() const {
    folder_.write("in/faulty.gltf", kFaulty);
    folder_.write("in/sound.gltf", kSound);
  }
  TempFolder folder_;
};

TEST_F(Report, FoldersOfThePageAreMade) {
  write_both();
  EXPECT_EQ(here({"in", "-o", "new/deep/page.html", "--no-thumbnails", "-q"}).err, "");
  EXPECT_THAT(content("new/deep/page.html"), StartsWith("<!DOCTYPE html>"));
  folder_.write("file", "");
  const Outcome refused = here({"in", "-o", "file/page.html", "--no-thumbnails"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("cannot create 'file'"));
}

TEST_F(Report, OnePageForAFolder) {
  write_both();
  const Outcome outcome = here({"in", "-o", "page.html", "--no-thumbnails"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "page.html: 2 assets, 1 error, 0 warnings\n");
  const std::string page = content("page.html");
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  const json data = data_in(page);
  EXPECT_EQ(data["title"], "in");
  EXPECT_EQ(data["profile"], "default");
  EXPECT_EQ(data["assets"][0]["path"], "in/faulty.gltf");
  EXPECT_EQ(data["assets"][0]["counts"]["errors"], 1);
  EXPECT_EQ(data["assets"][0]["findings"][0]["excerpt"].size() >= 3, true);
  EXPECT_EQ(data["assets"][1]["counts"]["errors"], 0);
  EXPECT_EQ(data["assets"][1]["facts"]["version"], "2.0");
  EXPECT_EQ(here({"in", "-o", "-", "--no-thumbnails", "--jobs", "2"}).out, page);
}

TEST_F(Report, PicturesAreOfTheSizeThatWasAskedFor) {
  const std::string asset = fixture("legacy/awning.gltf");
  const std::string page = here({asset, "-o", "-", "--thumbnail-size", "32"}).out;
  const json seen = data_in(page)["assets"][0];
  EXPECT_THAT(seen["picture"]["src"].get<std::string>(),
              StartsWith("data:image/webp;base64,UklGR"));
  EXPECT_EQ(seen["picture"]["size"], 32);
  EXPECT_THAT(seen["upgraded"]["src"].get<std::string>(),
              StartsWith("data:image/webp;base64,UklGR"));
  EXPECT_EQ(seen["upgrade"][0]["done"], true);
  EXPECT_EQ(here({asset, "-o", "-", "--thumbnail-size", "32", "--jobs", "1"}).out, page);
  EXPECT_NE(here({asset, "-o", "-", "--thumbnail-size", "32", "--quality", "draft"}).out, page);
}

TEST_F(Report, WhatCannotBeDrawnSaysWhy) {
  folder_.write("sound.gltf", kSound);
  const json data = data_in(here({"sound.gltf", "-o", "-"}).out);
  EXPECT_THAT(data["assets"][0]["picture"]["problem"].get<std::string>(), HasSubstr("visible"));
}

TEST_F(Report, ExitCodesAreThoseOfValidate) {
  write_both();
  folder_.write("warning.gltf", kWarning);
  const auto code = [this](std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "page.html", "--no-thumbnails", "--quiet"});
    return here(std::move(words)).code;
  };
  EXPECT_EQ(code({"in/sound.gltf"}), 0);
  EXPECT_EQ(code({"in"}), 1);
  EXPECT_EQ(code({"in", "--fail-on", "never"}), 0);
  EXPECT_EQ(code({"warning.gltf"}), 0);
  EXPECT_EQ(code({"warning.gltf", "--fail-on", "warning"}), 1);
  EXPECT_EQ(code({"gone.gltf", "in"}), 3);
  EXPECT_EQ(data_of({"gone.gltf"})["assets"][0]["readable"], false);
}

TEST_F(Report, MistakesOfTheCommandAreNamed) {
  write_both();
  EXPECT_THAT(here({"in"}).err, HasSubstr("--output"));
  EXPECT_THAT(here({"-o", "a.html"}).err, HasSubstr("at least one file"));
  EXPECT_THAT(here({"-", "-o", "a.html"}).err, HasSubstr("standard input"));
  EXPECT_THAT(here({"in", "-o", "a.html", "--thumbnail-size", "9"}).err, HasSubstr("at least 32"));
  EXPECT_THAT(here({"in", "-o", "a.html", "--quality", "best"}).err,
              HasSubstr("--quality: 'best'"));
  EXPECT_THAT(here({"in", "-o", "a.html", "--thumbnail-size", "4096"}).err,
              HasSubstr("32 to 1024"));
  EXPECT_THAT(here({"in/sound.gltf", "-o", "in/sound.gltf"}).err,
              HasSubstr("is an input of this run"));
  EXPECT_FALSE(fs::exists(folder_.path() / "a.html"));
}

TEST_F(Report, OptionsOfValidationCount) {
  folder_.write("w.gltf", kWarning);
  const json plain = data_of({"w.gltf"})["assets"][0];
  ASSERT_GT(plain["findings"].size(), 0U);
  const std::string code = plain["findings"][0]["code"];
  EXPECT_EQ(data_of({"w.gltf", "--ignore", code})["assets"][0]["counts"]["warnings"], 0);
  EXPECT_EQ(data_of({"w.gltf", "--select", "IO_ERROR"})["assets"][0]["findings"].size(), 0U);
  EXPECT_EQ(data_of({"w.gltf", "--severity", code + "=error"})["assets"][0]["counts"]["errors"], 1);
  EXPECT_EQ(data_of({"w.gltf", "--profile", "strict", "--pixels", "all"})["pixels"], "all");
  EXPECT_EQ(data_of({"w.gltf", "--title", "Props & more"})["title"], "Props & more");
  EXPECT_EQ(data_of({"w.gltf", "--max-file-size", "1"})["assets"][0]["counts"]["errors"], 1);
  EXPECT_EQ(data_of({"w.gltf", "--profile", "strict", "--max-issues", "0"})["profile"], "strict");
  EXPECT_EQ(gltfx({"validate", "w.gltf", "--write-baseline", "known.json"},
                  {folder_.path().native(), {}, {}})
                .code,
            0);
  EXPECT_EQ(data_of({"w.gltf", "--baseline", "known.json"})["assets"][0]["suppressed"], 1);
  folder_.write("gltfx.toml", "[[overrides]]\npaths = [\"w.gltf\"]\nignore = [\"" + code + "\"]\n");
  EXPECT_EQ(data_of({"w.gltf"})["assets"][0]["counts"]["warnings"], 0);
  EXPECT_EQ(data_of({"w.gltf", "--isolated"})["assets"][0]["counts"]["warnings"], 1);
}

TEST_F(Report, InputsAreNamedAsForValidate) {
  write_both();
  folder_.write("list.txt", "in/faulty.gltf\nin/sound.gltf\n");
  EXPECT_EQ(data_of({"--files-from", "list.txt"})["assets"].size(), 2U);
  const Outcome piped = gltfx({"report", "--files-from", "-", "-o", "-", "--no-thumbnails"},
                              {folder_.path().native(), "in/sound.gltf\n", {}});
  EXPECT_EQ(data_in(piped.out)["assets"].size(), 1U);
  EXPECT_EQ(data_of({"in", "--shard", "1/2"})["assets"].size() +
                data_of({"in", "--shard", "2/2"})["assets"].size(),
            2U);
  const json first = data_of({"in", "--cache", "kept"});
  EXPECT_TRUE(fs::exists(folder_.path() / "kept"));
  EXPECT_EQ(data_of({"in", "--cache", "kept", "--color", "never"}), first);
}

TEST_F(Report, ResourcesSchemasAndBudgetsCount) {
  folder_.write("data.bin", std::string(8, 'x'));
  folder_.write("in/a.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_leaf"],
    "extras": {"gltfx": {"ignore": [{"code": "UNUSED_OBJECT", "reason": "kept for later"}]}},
    "buffers": [{"byteLength": 8, "uri": "../data.bin"}]})");
  folder_.write("ACME_leaf.schema.json",
                R"({"$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "gltfx:ext/ACME_leaf", "title": "ACME_leaf", "description": "A leaf.", "type": "object",
    "x-gltfx": {"extension": "ACME_leaf", "on": ["material"], "status": "vendor"}})");
  const auto of = [this](std::vector<std::string> words) {
    words.insert(words.begin(), {"in/a.gltf", "--root", "."});
    return data_of(std::move(words))["assets"][0];
  };
  EXPECT_EQ(data_of({"in/a.gltf"})["assets"][0]["facts"]["files"].size(), 1U);
  EXPECT_EQ(of({})["facts"]["files"].size(), 2U);
  EXPECT_EQ(of({})["facts"]["extensions"][0]["status"], "unknown");
  EXPECT_EQ(of({"--schema", "ACME_leaf.schema.json"})["facts"]["extensions"][0]["status"],
            "vendor");
  EXPECT_EQ(of({"--schema-dir", "."})["facts"]["extensions"][0]["status"], "vendor");
  EXPECT_EQ(of({})["leftOut"], 0);
  EXPECT_EQ(of({"--inline-suppressions"})["leftOut"], 1);
  const std::string pointer = fixture("bad/triangle-lfs-buffer.gltf");
  EXPECT_EQ(data_of({pointer})["assets"][0]["counts"]["errors"], 0);
  EXPECT_EQ(data_of({pointer, "--lfs", "error"})["assets"][0]["counts"]["errors"], 1);
  folder_.write("empty.toml", "");
  const json budgets =
      data_of({fixture("good/stone.gltf"), "--max-texture-size", "1", "--max-total-pixels", "1",
               "--max-triangles", "1", "--max-draw-calls", "1", "--config",
               (folder_.path() / "empty.toml").native()});
  EXPECT_GE(budgets["rules"].size(), 3U);
}

TEST_F(Report, AnEarlierReportIsOneThatValidateWrote) {
  write_both();
  const auto compare = [this] {
    return here({"in", "-o", "page.html", "--no-thumbnails", "-q", "--previous", "before.json"});
  };
  EXPECT_EQ(compare().code, 2);
  EXPECT_THAT(compare().err, HasSubstr("--previous: "));
  folder_.write("before.json", "{\"files\": [");
  EXPECT_EQ(compare().code, 2);
  folder_.write("before.json", gltfx({"validate", fixture("good"), "--format", "json"}).out);
  EXPECT_EQ(compare().code, 1) << compare().err;
}

TEST_F(Report, AnOldPageStaysUntilTheNewOneIsComplete) {
  write_both();
  folder_.write("page.html", "old");
  const fs::path page = folder_.path() / "page.html";
  fs::permissions(page, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(here({"in", "-o", "page.html", "--no-thumbnails", "-q"}).code, 1);
  EXPECT_THAT(content("page.html"), StartsWith("<!DOCTYPE"));
  EXPECT_EQ(fs::status(page).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_THAT(here({"none.gltf", "in", "-o", "page.html", "--no-thumbnails", "-q"}).out, IsEmpty());
}

}  // namespace
}  // namespace gltfx::program
