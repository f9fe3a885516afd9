// SPDX-License-Identifier: Apache-2.0
/// Files that replace others: the attributes that they keep, and the cost of rewriting.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/xattr.h>

#include "program/upgrade_support.hpp"
#include "sanitized.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Rewrite : public UpgradeTest {
 protected:
  // False where the file system has no extended attributes.
  bool mark(const std::string& name) const {
    return ::setxattr((folder_.path() / name).c_str(), "user.note", "mine", 4, 0) == 0;
  }
  std::string mark_of(const std::string& name) const {
    std::string value(16, '\0');
    const ssize_t size = ::getxattr((folder_.path() / name).c_str(), "user.note", value.data(), 16);
    return size < 0 ? "none" : value.substr(0, static_cast<std::size_t>(size));
  }
  unsigned mode_of(const std::string& name) const { return status(name).st_mode & 07777U; }
  Outcome run_here(std::vector<std::string> arguments) const {
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
};

TEST_F(Rewrite, InPlaceAndItsBackupKeepAttributesAndPermissions) {
  folder_.write("leaf.gltf", kLegacy);
  if (!mark("leaf.gltf")) GTEST_SKIP() << "the file system has no extended attributes";
  fs::permissions(folder_.path() / "leaf.gltf", fs::perms(0600));
  EXPECT_EQ(here({"leaf.gltf", "--in-place", "--backup"}).code, 0);
  EXPECT_EQ(content("leaf.gltf"), kUpgraded);
  EXPECT_EQ(content("leaf.gltf.bak"), kLegacy);
  for (const std::string name : {"leaf.gltf", "leaf.gltf.bak"}) {
    EXPECT_EQ(mark_of(name), "mine") << name;
    EXPECT_EQ(mode_of(name), 0600U) << name;
  }
}

TEST_F(Rewrite, AnOutputThatIsThereKeepsAttributesAndPermissions) {
  folder_.write("leaf.gltf", kLegacy);
  folder_.write("new.gltf", "old");
  folder_.write("report.json", "old");
  folder_.write("picture.png", "old");
  folder_.write("bowl.glb", read_file(fixture("good/bowl.glb")));
  const std::string outputs[] = {"new.gltf", "report.json", "picture.png", "bowl.glb"};
  for (const std::string& name : outputs) {
    if (!mark(name)) GTEST_SKIP() << "the file system has no extended attributes";
    fs::permissions(folder_.path() / name, fs::perms(0640));
  }
  EXPECT_EQ(here({"leaf.gltf", "-o", "new.gltf"}).code, 0);
  EXPECT_EQ(run_here({"validate", "leaf.gltf", "--format", "json=report.json"}).code, 0);
  EXPECT_EQ(run_here({"bake", "bowl.glb", "-o", "picture.png", "--size", "8"}).code, 0);
  EXPECT_EQ(run_here({"bake", "bowl.glb", "--embed", "--size", "8"}).code, 0);
  EXPECT_EQ(content("new.gltf"), kUpgraded);
  for (const std::string& name : outputs) {
    EXPECT_NE(content(name), "old") << name;
    EXPECT_EQ(mark_of(name), "mine") << name;
    EXPECT_EQ(mode_of(name), 0640U) << name;
  }
}

// A GLB of `mebibytes` with one accessor of floats, which are holes of the file and read as zeros.
class LargeGlb {
 public:
  explicit LargeGlb(std::uint64_t mebibytes) : bin_((mebibytes << 20U) / 12 * 12) {
    const std::string size = std::to_string(bin_);
    json_ = R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_translucency"],)"
            R"("buffers":[{"byteLength":)" +
            size + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + size +
            R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
            std::to_string(bin_ / 12) +
            R"(,"min":[0,0,0],"max":[0,0,0]}],"materials":[{"extensions":{)"
            R"("KHR_materials_translucency":{"translucencyFactor":0.5}}}],"meshes":[{"primitives":)"
            R"([{"attributes":{"POSITION":0},"material":0,"mode":0}]}],"nodes":[{"mesh":0}]})";
    json_.resize((json_.size() + 3) / 4 * 4, ' ');
  }

  void write(const fs::path& path) const {
    std::ofstream file(path, std::ios::binary);
    file << "glTF" << word(2) << word(size()) << word(json_.size()) << "JSON" << json_
         << word(bin_);
    file.write("BIN\0", 4);
    file.close();
    fs::resize_file(path, size());
  }
  std::uint64_t size() const { return 28 + json_.size() + bin_; }

 private:
  static std::string word(std::uint64_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>((value >> shift) & 0xFFU);
    }
    return bytes;
  }

  std::uint64_t bin_;
  std::string json_;
};

constexpr long kMostKib = 64 << 10;

TEST_F(Rewrite, ALargeFileIsNotHeldInMemory) {
  const LargeGlb glb(kSanitized ? 16 : 160);
  glb.write(folder_.path() / "large.glb");
  const auto before = status("large.glb");
  const Outcome elsewhere = here({"large.glb", "-o", "new/large.glb"});
  EXPECT_EQ(elsewhere.code, 0) << elsewhere.err;
  const Outcome in_place = here({"large.glb", "--in-place", "--backup"});
  EXPECT_EQ(in_place.code, 0) << in_place.err;
  const Outcome copied = here({"large.glb", "-o", "copy.glb"});  // nothing legacy is left
  EXPECT_EQ(copied.code, 0) << copied.err;
  for (const Outcome& outcome : {elsewhere, in_place, copied}) {
    EXPECT_TRUE(kSanitized || outcome.peak_kib < kMostKib) << outcome.peak_kib << " KiB";
  }
  EXPECT_NE(status("large.glb").st_ino, before.st_ino);
  EXPECT_EQ(fs::file_size(folder_.path() / "large.glb.bak"), glb.size());
  const Outcome same = bash("cmp large.glb new/large.glb && cmp large.glb copy.glb",
                            {folder_.path().native(), {}, {}});
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  EXPECT_EQ(here({"large.glb", "--check"}).code, 0);
}

TEST_F(Rewrite, BuffersThatGoWithAnAssetAreNotHeldInMemory) {
  constexpr std::uint64_t kSize = std::uint64_t{128} << 20U;
  std::string text = kLegacy;
  text.insert(
      text.find("  \"materials\""),
      "  \"buffers\": [{ \"uri\": \"a.bin\", \"byteLength\": " + std::to_string(kSize) + " }],\n");
  folder_.write("in/leaf.gltf", text);
  folder_.write("in/a.bin", "");
  fs::resize_file(folder_.path() / "in/a.bin", kSize);
  for (int i = 0; i < 2; ++i) {  // made, then found to be the same
    const Outcome outcome = here({"in/leaf.gltf", "-o", "out/"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(kSanitized || outcome.peak_kib < kMostKib) << outcome.peak_kib << " KiB";
  }
  EXPECT_EQ(fs::file_size(folder_.path() / "out/a.bin"), kSize);
}

}  // namespace
}  // namespace gltfx::program
