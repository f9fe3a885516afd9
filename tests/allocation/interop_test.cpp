// SPDX-License-Identifier: Apache-2.0
#include <gltfx/tinygltf.hpp>

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "each_fails.hpp"

namespace gltfx::test {
namespace {

class Interop : public testing::TestWithParam<const char*> {};

std::string text_of(const TinygltfReport& report) {
  count_allocations(false);
  std::string text = report.error + (report.done ? " done" : " not done");
  for (const Diagnostic& each : report.validation.diagnostics) text += each.message;
  return text;
}

TEST_P(Interop, SaysThatMemoryIsMissing) {
  const std::string path = fixture(GetParam());
  ToTinygltfOptions options;
  options.jobs = 1;
  options.images = TinygltfImages::encoded;
  let_each_fail([&] {
    tinygltf::Model model;
    return text_of(to_tinygltf(path, model, options));
  });
  tinygltf::Model model;
  ASSERT_TRUE(to_tinygltf(path, model, options).done);
  FromTinygltfOptions back;
  back.jobs = 1;
  let_each_fail([&] {
    MemoryAsset asset;
    asset.name = "a.glb";
    return text_of(from_tinygltf(model, asset, back));
  });
}

INSTANTIATE_TEST_SUITE_P(Fixtures, Interop,
                         testing::Values("good/beacon.gltf", "good/bowl.glb", "good/kelp.gltf",
                                         "good/lamp.gltf", "good/leaf.gltf"));

}  // namespace
}  // namespace gltfx::test
