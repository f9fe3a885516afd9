// SPDX-License-Identifier: Apache-2.0
// The library throws nothing: it reports missing memory. Pictures are left to the runs of the
// program: Embree ends a program that has no memory left when a device is released.
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <new>
#include <string>

#include <gtest/gtest.h>

#include "codec/program_path.hpp"
#include "container/temp_folder.hpp"
#include "each_fails.hpp"

namespace gltfx::test {
namespace {

using container::test::TempFolder;

std::string text_of(const FileReport& report) {
  count_allocations(false);
  std::string text = report.readable ? "" : "unreadable ";
  for (const Diagnostic& each : report.diagnostics) {
    text.append(each.code).append(each.pointer).append(each.message).append("\n");
  }
  return text + "end";
}

class Validation : public testing::TestWithParam<const char*> {};

TEST_P(Validation, SaysThatMemoryIsMissing) {
  ValidateOptions options;
  options.jobs = 1;
  options.profile = Profile::strict;
  options.pixels = PixelLevel::headers;
  options.propose_fixes = true;
  const std::string path = fixture(GetParam());
  let_each_fail([&] { return text_of(validate_file(path, options)); });
}

INSTANTIATE_TEST_SUITE_P(Fixtures, Validation,
                         testing::Values("good/beacon.gltf", "good/bowl.glb", "good/chair.gltf",
                                         "good/coral.glb", "good/flag.gltf", "good/kelp.gltf",
                                         "good/leaf.gltf", "good/reed.gltf", "good/stone.gltf",
                                         "bad/kelp-bounds.gltf", "bad/leaf-wrong-members.gltf",
                                         "tour/lamp.gltf"));

class Upgrade : public testing::TestWithParam<const char*> {};

TEST_P(Upgrade, SaysThatMemoryIsMissing) {
  const TempFolder folder;
  const std::string path = fixture(GetParam());
  UpgradeOptions options;
  options.unsafe = true;
  options.diff = true;
  options.output = (folder.path() / "out" / "a.gltf").native();
  const auto work = [&] {
    const UpgradeReport report = upgrade_file(path, options);
    count_allocations(false);
    std::string said = report.error + (report.written ? " written" : " not written");
    for (const UpgradeAction& action : report.actions) said += action.pointer;
    return said + std::to_string(report.diff.size());
  };
  let_each_fail(work, folder.path());
}

INSTANTIATE_TEST_SUITE_P(Fixtures, Upgrade,
                         testing::Values("legacy/awning.gltf", "legacy/chalice.gltf",
                                         "legacy/curtain.gltf", "legacy/lantern.glb",
                                         "legacy/poster.gltf", "legacy/shop.gltf"));

// Not in a test of validation: there workers are looked for once in a process.
TEST(Workers, AreFoundOrMemoryIsMissing) {
  let_each_fail([] {
    try {
      std::string path = codec::program_path("", "gltfx-codec-image");
      count_allocations(false);
      return path;
    } catch (const std::bad_alloc&) {
      count_allocations(false);
      return std::string("not enough memory");
    }
  });
}

TEST(Batches, SayThatMemoryIsMissing) {
  const std::vector<std::string> paths{fixture("good/leaf.gltf"), fixture("good/reed.gltf")};
  const ValidateOptions options;
  let_each_fail([&] {
    std::string said;
    validate_files(paths, options, 1, [&](FileReport&& report) {
      said += text_of(report);
      count_allocations(true);
    });
    count_allocations(false);
    return said;
  });
}

TEST(Bytes, SayThatMemoryIsMissing) {
  const std::string text = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 3}]})";
  const ValidateOptions options;
  let_each_fail([&] {
    count_allocations(false);
    std::string own = text;
    count_allocations(true);
    return text_of(validate_bytes(std::move(own), "-", options));
  });
}

}  // namespace
}  // namespace gltfx::test
