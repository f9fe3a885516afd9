// SPDX-License-Identifier: Apache-2.0
// The library throws nothing: each allocation of a call fails once, and the call says so or gives
// what it always gives. GLTFX_ALLOCATION_STRIDE (1: all of them) says how many are tried.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <new>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};
std::atomic<long> fail_at{0};

void* take(std::size_t size) {
  if (counting && allocations.fetch_add(1) + 1 == fail_at) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}

void* take_or_throw(std::size_t size) {
  void* memory = take(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return take_or_throw(size); }
void* operator new[](std::size_t size) { return take_or_throw(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return take(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return take(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;

std::string fixture(const std::string& name) {
  return (fs::path(GLTFX_SOURCE_DIR) / "fixtures" / name).native();
}

long stride() {
  const char* text = std::getenv("GLTFX_ALLOCATION_STRIDE");
  return text == nullptr ? 13 : std::max(1L, std::atol(text));
}

/// Calls with the allocation of that number failing. Empty when it threw.
std::string call(const std::function<std::string()>& work, long number) {
  allocations = 0;
  fail_at = number;
  counting = true;
  std::string said;
  try {
    said = work();
  } catch (const std::exception&) {
    said.clear();
  }
  counting = false;
  return said;
}

void let_each_fail(const std::function<std::string()>& work, const fs::path& folder = {}) {
  call(work, 0);  // what is built once and kept is there from now on
  if (!folder.empty()) fs::remove_all(folder / "out");
  const std::string sound = call(work, 0);
  const long all = allocations;
  std::set<std::string> faults;
  for (long number = 1; number <= all; number += stride()) {
    if (!folder.empty()) fs::remove_all(folder / "out");
    const std::string said = call(work, number);
    if (said == sound || said.find("not enough memory") != std::string::npos) continue;
    faults.insert(std::to_string(number) + (said.empty() ? " throws" : " says " + said));
    if (faults.size() > 5) break;
  }
  EXPECT_THAT(faults, testing::IsEmpty()) << all << " allocations";
  testing::Test::RecordProperty("allocations", std::to_string(all));
}

std::string text_of(const FileReport& report) {
  counting = false;
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
    counting = false;
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

class Bake : public testing::TestWithParam<const char*> {};

TEST_P(Bake, SaysThatMemoryIsMissing) {
  BakeOptions options;
  options.sizes = {{4, 4}};
  options.samples = 1;
  options.jobs = 1;
  const std::string path = fixture(GetParam());
  let_each_fail([&] {
    const BakeReport report = bake_file(path, options);
    counting = false;
    std::string said = report.error + " " + std::to_string(report.pixels.bytes.size());
    for (const std::string& note : report.notes) said += note;
    for (const Diagnostic& each : report.validation.diagnostics) said += each.message;
    return said;
  });
}

INSTANTIATE_TEST_SUITE_P(Fixtures, Bake,
                         testing::Values("good/triangle.gltf", "good/leaf.gltf", "good/bowl.glb"));

TEST(Batches, SayThatMemoryIsMissing) {
  const std::vector<std::string> paths{fixture("good/leaf.gltf"), fixture("good/reed.gltf")};
  const ValidateOptions options;
  let_each_fail([&] {
    std::string said;
    validate_files(paths, options, 1, [&](FileReport&& report) {
      said += text_of(report);
      counting = true;
    });
    counting = false;
    return said;
  });
}

TEST(Bytes, SayThatMemoryIsMissing) {
  const std::string text = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 3}]})";
  const ValidateOptions options;
  let_each_fail([&] {
    counting = false;
    std::string own = text;
    counting = true;
    return text_of(validate_bytes(std::move(own), "-", options));
  });
}

}  // namespace
}  // namespace gltfx::test
