// SPDX-License-Identifier: Apache-2.0
/// Hostile files: the program reports them, within bounds, and reads nothing that it should not.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "container/temp_folder.hpp"
#include "process.hpp"
#include "sanitized.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kMany = kSanitized ? 8'000 : 100'000;
constexpr std::size_t kMostOutput = std::size_t{1} << 20U;

std::string times(std::size_t count, const std::string& text) {
  std::string all;
  all.reserve(count * text.size());
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

// The items of make(0), make(1), ... with commas between them.
template <typename Make>
std::string list(int count, const Make& make) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    if (i > 0) all += ',';
    all += make(i);
  }
  return all;
}

std::string asset(const std::string& members) {
  return R"({"asset": {"version": "2.0"}, )" + members + "}";
}

// An asset with one accessor whose numbers are the hostile ones.
std::string with_accessor(const std::string& accessor, const std::string& view,
                          const std::string& buffer) {
  return asset(R"("buffers": [{)" + buffer + R"(}], "bufferViews": [{"buffer": 0, )" + view +
               R"(}], "accessors": [{"componentType": 5126, "type": "VEC3", )" + accessor +
               R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
               "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}])");
}

class Hostile : public testing::Test {
 protected:
  // A minute of processor time is a hang; no case takes a second.
  Outcome validate(const std::string& name, const std::string& options = {}) {
    Outcome outcome = bash("ulimit -t 60; exec \"$GLTFX\" validate " + options + " '" + name + "'",
                           {folder_.path().native(), {}, {}});
    EXPECT_THAT(outcome.code, AnyOf(0, 1)) << outcome.err;
    EXPECT_LT(outcome.out.size(), kMostOutput);
    const auto size = std::filesystem::file_size(folder_.path() / name);
    const auto bound = static_cast<long>((std::uintmax_t{256} << 10U) + 12 * size / 1024);
    EXPECT_TRUE(kSanitized || outcome.peak_kib < bound) << outcome.peak_kib << " KiB of " << bound;
    return outcome;
  }
  Outcome check(const std::string& text, const std::string& options = {}) {
    folder_.write("hostile.gltf", text);
    return validate("hostile.gltf", options);
  }

  const TempFolder folder_;
};

TEST_F(Hostile, NumbersOfAnySizeAreOnlyNumbers) {
  const std::string huge[] = {
      "2147483648", "4294967295", "9007199254740992", "18446744073709551616", "1e300", "-1",
      "0.5",        "1e-320"};
  for (const std::string& n : huge) {
    const std::string sound_view = R"("byteLength": 36)";
    const std::string buffer = R"("byteLength": 36, "uri": "data:application/gltf-buffer;base64,)" +
                               times(12, "AAAA") + "\"";
    const std::string sparse =
        R"("count": 3, "sparse": {"count": )" + n +
        R"(, "indices": {"bufferView": 0, "componentType": 5125, "byteOffset": )" + n +
        R"(}, "values": {"bufferView": 0, "byteOffset": )" + n + "}}";
    check(with_accessor(R"("bufferView": 0, "count": )" + n, sound_view, buffer));
    check(with_accessor(R"("count": )" + n, sound_view, buffer));
    check(with_accessor(R"("bufferView": 0, "count": 3, "byteOffset": )" + n, sound_view, buffer));
    check(with_accessor(R"("count": 3, "bufferView": )" + n, sound_view, buffer));
    check(with_accessor(sparse, sound_view, buffer));
    check(with_accessor(R"("bufferView": 0, "count": 3)", R"("byteLength": )" + n, buffer));
    check(with_accessor(R"("bufferView": 0, "count": 3)",
                        R"("byteLength": 36, "byteOffset": )" + n + R"(, "byteStride": )" + n,
                        buffer));
    check(with_accessor(R"("bufferView": 0, "count": 3)", sound_view, R"("byteLength": )" + n));
  }
}

TEST_F(Hostile, ZerosThatTakeNoBytesAreNotCountedForYears) {
  const std::string accessor =
      R"({"componentType": 5126, "type": "SCALAR", "count": 4294967295, "min": [0], "max": [1],
          "sparse": {"count": 1, "indices": {"bufferView": 0, "componentType": 5125},
                     "values": {"bufferView": 0, "byteOffset": 4}}})";
  const Outcome outcome = check(asset(
      R"("buffers": [{"byteLength": 8, "uri": "data:application/gltf-buffer;base64,AAAAAAAAAAA="}],
               "bufferViews": [{"buffer": 0, "byteLength": 8}], "accessors": [)" +
      list(2000, [&](int) { return accessor; }) + "]"));
  EXPECT_THAT(outcome.out, HasSubstr("ACCESSOR_DATA_NOT_CHECKED"));
}

TEST_F(Hostile, ChainsAndLoopsOfNodesAreWalkedWithoutRecursion) {
  const auto child = [](int i) { return R"({"children": [)" + std::to_string(i) + "]}"; };
  check(asset(R"("nodes": [)" + list(kMany, [&](int i) { return child(i + 1); }) +
              R"(, {}], "scenes": [{"nodes": [0]}])"));
  const Outcome loop =
      check(asset(R"("nodes": [)" + list(kMany, [&](int i) { return child((i + 1) % kMany); }) +
                  R"(], "scenes": [{"nodes": [0]}])"));
  EXPECT_THAT(loop.out, HasSubstr("NODE_LOOP"));
  check(asset(R"("nodes": [)" + list(kMany, child) + "]"));
  check(asset(R"("nodes": [{"children": [)" + list(kMany, [](int) { return "1"; }) + "]}, {}]"));
}

TEST_F(Hostile, DepthIsRefusedAndNotRecursedInto) {
  for (const std::string& text :
       {times(kMany, "["), times(kMany, "[") + times(kMany, "]"),
        asset(R"("extras": )" + times(kMany, "[") + times(kMany, "]")),
        asset(R"("extras": )" + times(kMany, R"({"a":)") + "1" + times(kMany, "}"))}) {
    EXPECT_EQ(check(text).code, 1);
  }
}

TEST_F(Hostile, ManyDifferentErrorsAreFoldedInTheEnd) {
  const auto member = [](int i) { return "\"k" + std::to_string(i) + "\": 1"; };
  const Outcome in_one = check(asset(list(kMany, member)));
  const std::string warnings = std::to_string(kMany) + " warnings";
  EXPECT_THAT(in_one.out, HasSubstr(warnings));
  const Outcome in_each = check(
      asset(R"("nodes": [)" + list(kMany, [&](int i) { return "{" + member(i) + "}"; }) + "]"));
  EXPECT_THAT(in_each.out, HasSubstr(warnings));
  check(asset(R"("extras": {)" + list(kMany, [](int) { return R"("k": 1)"; }) + "}"));
  check(asset(R"("nodes": [)" + list(kMany, [](int) { return "{,}"; }) + "]"));
}

TEST_F(Hostile, NamesReachNeitherATerminalNorACiLogRaw) {
  const std::string escape = "\x1b]0;owned\x07";
  const std::string quoted = R"(\u001b]0;owned\u0007\n::error::owned\n##vso[owned])";
  for (const std::string& text :
       {asset(R"("nodes": [{"name": ")" + quoted + R"(", "matrix": [1]}])"),
        asset("\"" + quoted + "\": 1"), asset(R"("images": [{"uri": ")" + quoted + "\"}]"),
        R"({"asset": {"version": ")" + quoted + "\"}}",
        asset("\"" + escape + "\n::error::owned\n##vso[owned]")}) {
    for (const std::string format : {"text", "github", "json", "khronos"}) {
      const Outcome outcome = check(text, "--format " + format);
      EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b]0")));
      EXPECT_THAT("\n" + outcome.out, Not(HasSubstr("\n::error::owned")));
      EXPECT_THAT("\n" + outcome.out, Not(HasSubstr("\n##vso")));
    }
  }
}

TEST_F(Hostile, PlacesOutsideTheFolderAreNamedAndNotOpened) {
  folder_.write("outside/secret.bin", "secret");
  folder_.write("in/a.bin", "data");
  folder_.link("in/link.bin", "../outside/secret.bin");
  folder_.link("in/folder", "../outside");
  folder_.link("in/absolute.bin", folder_.path() / "outside/secret.bin");
  folder_.link("in/zero.bin", "/dev/zero");
  const std::string here = folder_.path().native();
  for (const std::string& uri :
       {std::string("../outside/secret.bin"), std::string("%2e%2e/outside/secret.bin"),
        std::string("..%2foutside%2fsecret.bin"), std::string("./a/../../outside/secret.bin"),
        std::string("link.bin"), std::string("folder/secret.bin"), std::string("absolute.bin"),
        std::string("zero.bin"), here + "/outside/secret.bin",
        "file://" + here + "/outside/secret.bin", std::string("/dev/zero"),
        std::string("C:\\\\a.bin"), std::string("\\\\\\\\host\\\\a.bin")}) {
    folder_.write("in/hostile.gltf",
                  asset(R"("buffers": [{"byteLength": 4, "uri": ")" + uri + "\"}]"));
    const Outcome outcome = validate("in/hostile.gltf");
    EXPECT_EQ(outcome.code, 1) << uri;
    EXPECT_THAT(outcome.out, HasSubstr("URI_OUTSIDE_ROOT")) << uri;
  }
}

TEST_F(Hostile, PipesAndFoldersAreNotWaitedFor) {
  std::filesystem::create_directories(folder_.path() / "folder");
  ASSERT_EQ(::mkfifo((folder_.path() / "pipe.bin").c_str(), 0600), 0);
  for (const std::string uri : {"pipe.bin", "folder"}) {
    const Outcome outcome =
        check(asset(R"("buffers": [{"byteLength": 4, "uri": ")" + uri + "\"}]"));
    EXPECT_THAT(outcome.out, HasSubstr("RESOURCE_NOT_A_FILE")) << uri;
  }
}

TEST_F(Hostile, ABufferThatIsCutDuringTheRunIsAFindingAndNoSignal) {
  const std::string text = asset(R"("buffers": [{"byteLength": 40000000, "uri": "big.bin"}],
            "bufferViews": [{"buffer": 0, "byteLength": 40000000}], "accessors": [{"bufferView": 0,
            "componentType": 5126, "type": "SCALAR", "count": 10000000, "min": [0], "max": [0]}])");
  folder_.write("cut.gltf", text);
  folder_.write("big.bin", std::string(40000000, '\0'));
  const Outcome outcome = bash(
      "(while [ ! -e done ]; do truncate -s 4096 big.bin; truncate -s 40000000 big.bin; done) &"
      "for i in 1 2 3 4 5 6 7 8; do \"$GLTFX\" validate cut.gltf > last.txt; code=$?;"
      " [ $code -le 1 ] || [ $code -eq 3 ] || break; done; touch done; wait; exit $code",
      {folder_.path().native(), {}, {}});
  EXPECT_THAT(outcome.code, AnyOf(0, 1, 3)) << read_file((folder_.path() / "last.txt").native());
  if (outcome.code == 1) {
    EXPECT_THAT(read_file((folder_.path() / "last.txt").native()),
                AnyOf(HasSubstr("IO_ERROR"), HasSubstr("BUFFER_BYTE_LENGTH_MISMATCH")));
  }
}

TEST_F(Hostile, SetsOfJointsByTheThousandAreCheckedOnceEach) {
  const std::string sets = list(kMany, [](int i) {
    const std::string n = std::to_string(i);
    return "\"JOINTS_" + n + R"(": 1, "WEIGHTS_)" + n + "\": 2";
  });
  const Outcome outcome = check(asset(
      R"("buffers": [{"byteLength": 16, "uri": "data:application/gltf-buffer;base64,AAAAAAAAAAAAAAAAAAAAAA=="}],
         "bufferViews": [{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteLength": 4}, {"buffer": 0, "byteLength": 16}],
         "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
                       {"bufferView": 1, "componentType": 5121, "type": "VEC4", "count": 1},
                       {"bufferView": 2, "componentType": 5126, "type": "VEC4", "count": 1}],
         "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, )" +
      sets + R"(}}]}], "nodes": [{"mesh": 0, "skin": 0}], "skins": [{"joints": [0]}],
         "scenes": [{"nodes": [0]}])"));
  EXPECT_THAT(outcome.out, HasSubstr("ACCESSOR_WEIGHTS_NON_NORMALIZED"));
}

}  // namespace
}  // namespace gltfx::program
