// SPDX-License-Identifier: Apache-2.0
/// `gltfx report` on several machines, and with what earlier runs have drawn.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::HasSubstr;
using testing::Not;

class Pages : public testing::Test {
 protected:
  Outcome here(std::vector<std::string> words, const std::string& decoders = {}) const {
    Setting setting{folder_.path().native(), {}, {}};
    if (!decoders.empty()) setting.environment.emplace_back("GLTFX_CODEC_WORKERS", decoders);
    return gltfx(std::move(words), setting);
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  void write_library(int count) const {
    for (int i = 0; i < count; ++i) {
      folder_.write("in/" + std::to_string(i) + "/a.gltf", i % 3 == 0 ? kFaulty : kWarning);
    }
    folder_.write("in/unread.gltf", "");
    fs::permissions(folder_.path() / "in/unread.gltf", fs::perms::none);
  }
  // The parts of a report on "in", and the page that becomes of them.
  Outcome merged(int parts, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> merge{"merge", "-o", "merged.html"};
    for (int i = parts; i > 0; --i) {
      const std::string part = std::to_string(i) + ".html";
      std::vector<std::string> report{"report", "in", "--no-thumbnails", "-o", part};
      report.insert(report.end(), {"--shard", std::to_string(i) + "/" + std::to_string(parts)});
      report.insert(report.end(), more.begin(), more.end());
      here(report);
      merge.push_back(part);
    }
    return here(merge);
  }

  TempFolder folder_;
};

TEST_F(Pages, OfAllPartsAreThatOfOneRun) {
  write_library(20);
  const Outcome whole = here({"report", "in", "--no-thumbnails", "-o", "whole.html"});
  for (const int parts : {2, 3, 40}) {
    const Outcome outcome = merged(parts);
    EXPECT_EQ(outcome.code, whole.code) << outcome.err;
    EXPECT_EQ(content("merged.html"), content("whole.html"));
  }
}

TEST_F(Pages, KeepTargetsAndWhatMakesTheRunFail) {
  write_library(4);
  const std::vector<std::string> more{"--target", "three", "--fail-on", "never", "--title", "<b>"};
  std::vector<std::string> report{"report", "in", "--no-thumbnails", "-o", "whole.html"};
  report.insert(report.end(), more.begin(), more.end());
  const Outcome whole = here(report);
  EXPECT_EQ(merged(2, more).code, whole.code);
  EXPECT_EQ(content("merged.html"), content("whole.html"));
}

TEST_F(Pages, ThatDoNotBelongTogetherAreRefused) {
  write_library(5);
  merged(3);
  const auto refused = [&](const std::vector<std::string>& pages, const std::string& why) {
    std::vector<std::string> words{"merge", "-o", "new.html"};
    words.insert(words.end(), pages.begin(), pages.end());
    const Outcome outcome = here(words);
    EXPECT_EQ(outcome.code, 3) << why;
    EXPECT_THAT(outcome.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(folder_.path() / "new.html"));
  };
  refused({"1.html", "3.html"}, "shard 2/3 is missing");
  refused({"1.html", "1.html", "2.html", "3.html"}, "'1.html' is shard 1/3 once more");
  refused({"merged.html"}, "no page that 'gltfx report --shard' of version");
  here({"report", "in", "--no-thumbnails", "-o", "1.html", "--shard", "1/3", "--title", "x"});
  refused({"1.html", "2.html", "3.html"}, "with another title");
}

// Data copied into the new page must not be markup, whatever its source.
TEST_F(Pages, ThatAreForgedAreRefused) {
  write_library(3);
  merged(2);
  for (const char* forged : {"<script>", "\"}],\n\"", "\\u00zz"}) {
    std::string part = content("1.html");
    const std::size_t at = part.find("\"path\":\"");
    ASSERT_NE(at, std::string::npos);
    part.insert(at + 8, forged);
    folder_.write("forged.html", part);
    EXPECT_EQ(here({"merge", "-o", "new.html", "forged.html", "2.html"}).code, 3) << forged;
  }
  const std::string part = content("1.html");
  for (std::size_t length = 0; length < part.size(); length += part.size() / 40) {
    folder_.write("cut.html", part.substr(0, length));
    EXPECT_EQ(here({"merge", "-o", "new.html", "cut.html", "2.html"}).code, 3) << length;
  }
}

TEST_F(Pages, NeedAPlaceForTheWhole) {
  const Outcome outcome = here({"merge", "1.html", "2.html"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--output"));
  EXPECT_EQ(here({"merge", "1.html", "-o", "a.html", "--format", "json"}).code, 2);
}

// Without decoders nothing can be drawn: what has a picture then was drawn before.
class KeptPictures : public Pages {
 protected:
  KeptPictures() {
    for (const char* name : {"leaf.gltf", "leaf.bin", "leaf_color.png", "leaf_transmission.png"}) {
      fs::create_directories(folder_.path() / "in");
      fs::copy(fixture("good/" + std::string(name)), folder_.path() / "in" / name);
    }
    TempFolder::wait_for_tick();
  }
  std::string page(const std::string& decoders, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"report",           "in", "-o", "page.html", "--cache", "kept",
                                   "--thumbnail-size", "32"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = here(words, decoders);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return content("page.html");
  }
  static constexpr const char* kPicture = "data:image/webp";
  const std::string nowhere_ = folder_.path() / "no decoders";
};

TEST_F(KeptPictures, AreNotDrawnAgain) {
  const std::string first = page({});
  if (first.find(kPicture) == std::string::npos) GTEST_SKIP() << "no renderer";
  EXPECT_EQ(page(nowhere_), first);
}

TEST_F(KeptPictures, OfTheSameBytesElsewhereAreNotDrawnAgain) {
  if (page({}).find(kPicture) == std::string::npos) GTEST_SKIP() << "no renderer";
  fs::rename(folder_.path() / "in", folder_.path() / "old");
  fs::copy(folder_.path() / "old", folder_.path() / "in");
  EXPECT_THAT(page(nowhere_), HasSubstr(kPicture));
}

TEST_F(KeptPictures, AreDrawnAgainWhereSomethingChanged) {
  if (page({}).find(kPicture) == std::string::npos) GTEST_SKIP() << "no renderer";
  EXPECT_THAT(page(nowhere_, {"--quality", "draft"}), Not(HasSubstr(kPicture)));
  EXPECT_THAT(page(nowhere_, {"--profile", "strict"}), Not(HasSubstr(kPicture)));
  fs::copy_file(fixture("good/leaf_transmission.png"), folder_.path() / "in/leaf_color.png",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(page(nowhere_), Not(HasSubstr(kPicture)));
  EXPECT_THAT(page({}), HasSubstr(kPicture));
}

}  // namespace
}  // namespace gltfx::program
