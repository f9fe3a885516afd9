// SPDX-License-Identifier: Apache-2.0
// Data of buffers and images: files, data URIs, the BIN chunk of a GLB.
#include <string>

#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

using container::test::TempFolder;

const std::set<std::string, std::less<>>& resource_codes() {
  static const std::set<std::string, std::less<>> codes{"BUFFER_BYTE_LENGTH_MISMATCH",
                                                        "BUFFER_GLB_CHUNK_TOO_BIG",
                                                        "BUFFER_MISSING_GLB_DATA",
                                                        "GIT_LFS_POINTER",
                                                        "IO_ERROR",
                                                        "RESOURCE_NOT_A_FILE",
                                                        "RESOURCE_NOT_CHECKED",
                                                        "URI_OUTSIDE_ROOT",
                                                        "ACCESSOR_MIN_MISMATCH"};
  return codes;
}

Lines lines_of(const FileReport& report) {
  Lines lines;
  for (const Diagnostic& found : report.diagnostics) {
    lines.push_back(std::string(found.code) + " " + found.pointer);
  }
  return lines;
}

ValidateOptions options_for(Profile profile = Profile::standard) {
  ValidateOptions options;
  options.profile = profile;
  options.select = resource_codes();
  return options;
}

// A folder that contains an asset with one buffer.
class Folder {
 public:
  FileReport report(const std::string& buffer, Profile profile = Profile::standard) {
    folder_.write("asset/a.gltf", asset_with(R"("buffers": [)" + buffer + "]"));
    return validate_file((folder_.path() / "asset/a.gltf").native(), options_for(profile));
  }
  Lines found(const std::string& buffer, Profile profile = Profile::standard) {
    return lines_of(report(buffer, profile));
  }
  const TempFolder& files() const { return folder_; }

 private:
  TempFolder folder_;
};

TEST(Files, ThatAreThereAndLongEnoughAreSilent) {
  Folder folder;
  folder.files().write("asset/a b.bin", "12345678");
  EXPECT_EQ(folder.found(R"({"uri": "a%20b.bin", "byteLength": 8})"), Lines());
  EXPECT_EQ(folder.found(R"({"uri": "a b.bin", "byteLength": 5})"), Lines());
}

TEST(Files, WithFewerBytesThanDeclared) {
  Folder folder;
  folder.files().write("asset/a.bin", "1234567");
  folder.files().write("asset/empty.bin", "");
  const Lines error{"BUFFER_BYTE_LENGTH_MISMATCH /buffers/0"};
  EXPECT_EQ(folder.found(R"({"uri": "a.bin", "byteLength": 8})"), error);
  EXPECT_EQ(folder.found(R"({"uri": "empty.bin", "byteLength": 1})"), error);
  EXPECT_EQ(folder.found(R"({"uri": "a.bin", "byteLength": 9007199254740992})"), error);
}

TEST(Files, ThatCannotBeRead) {
  Folder folder;
  folder.files().write("asset/dir/x", "");
  folder.files().write("outside.bin", "12345678");
  EXPECT_EQ(folder.found(R"({"uri": "missing.bin", "byteLength": 8})"),
            (Lines{"IO_ERROR /buffers/0/uri"}));
  EXPECT_EQ(folder.found(R"({"uri": "dir", "byteLength": 8})"),
            (Lines{"RESOURCE_NOT_A_FILE /buffers/0/uri"}));
  const std::string outside = R"({"uri": "../outside.bin", "byteLength": 8})";
  EXPECT_EQ(folder.found(outside), (Lines{"URI_OUTSIDE_ROOT /buffers/0/uri"}));
  EXPECT_EQ(folder.found(outside, Profile::khronos), (Lines{"IO_ERROR /buffers/0/uri"}));
}

TEST(Files, OutsideOfTheFolderAreErrorsInAnySpelling) {
  Folder folder;
  folder.files().write("outside.bin", "12345678");
  folder.files().write("asset/in.bin", "12345678");
  const Lines outside{"URI_OUTSIDE_ROOT /buffers/0/uri"};
  for (const char* const uri :
       {"../outside.bin", "%2e%2e/outside.bin", "..%2foutside.bin", "x//../../outside.bin",
        "..%5coutside.bin", "./.././outside.bin", "../outside.bin?a=b", "../outside.bin#x",
        "/etc/hostname", "///etc/hostname", "%2fetc/hostname", "file:///etc/hostname", "C:/x.bin",
        "../asset/../outside.bin"}) {
    EXPECT_EQ(folder.found(R"({"byteLength": 8, "uri": ")" + std::string(uri) + "\"}"), outside)
        << uri;
  }
  for (const char* const uri :
       {"in.bin", "../asset/in.bin", "%2E%2e/asset/in.bin", "..//asset//in.bin",
        "..%2fasset%2fin.bin", "./../asset/./in.bin", "x/../../asset/in.bin"}) {
    EXPECT_EQ(folder.found(R"({"byteLength": 8, "uri": ")" + std::string(uri) + "\"}"), Lines{})
        << uri;
  }
}

TEST(Files, ThatStandForThemselvesInGitLfsAreCountedAsNotVerified) {
  Folder folder;
  folder.files().write("asset/a.bin",
                       "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 8\n");
  const std::string buffer = R"({"uri": "a.bin", "byteLength": 4096})";
  const FileReport report = folder.report(buffer);
  EXPECT_EQ(lines_of(report), (Lines{"GIT_LFS_POINTER /buffers/0/uri"}));
  EXPECT_EQ(report.unverified, 1U);
  EXPECT_EQ(folder.found(buffer, Profile::khronos),
            (Lines{"BUFFER_BYTE_LENGTH_MISMATCH /buffers/0"}));
}

TEST(Files, AreNotLookedForWithoutAFolder) {
  const std::string asset = asset_with(R"("buffers": [{"uri": "a.bin", "byteLength": 8}])");
  EXPECT_EQ(verdict(asset, options_for()), (Lines{"RESOURCE_NOT_CHECKED /buffers/0/uri"}));
}

TEST(Files, OfBuffersWithoutALengthAreNotOpened) {
  Folder folder;
  EXPECT_EQ(folder.found(R"({"uri": "missing.bin"})"), Lines());
  EXPECT_EQ(folder.found(R"({"uri": "missing.bin", "byteLength": 0})"), Lines());
}

TEST(Files, AreListedWithWhatWasFound) {
  Folder folder;
  folder.files().write("asset/a b.bin", "12345678");
  const FileReport report = folder.report(R"({"uri": "a b.bin", "byteLength": 4})");
  ASSERT_TRUE(report.info);
  ASSERT_EQ(report.info->resources.size(), 1U);
  const ResourceInfo& listed = report.info->resources[0];
  EXPECT_EQ(listed.pointer, "/buffers/0");
  EXPECT_EQ(listed.mime_type, "application/gltf-buffer");
  EXPECT_EQ(listed.storage, "external");
  EXPECT_EQ(listed.uri, "a%20b.bin");
  EXPECT_EQ(listed.byte_length, 8U);
}

// An asset with one accessor with a wrong minimum, whose data is in `buffer`.
std::string with_accessor(const std::string& buffer, const std::string& view_more = {}) {
  return asset_with(
      R"("accessors": [{"bufferView": 0, "componentType": 5121, "type": "SCALAR", "count": 8, "min": [9], "max": [200]}],
         "bufferViews": [{"buffer": 0, "byteLength": 8)" +
      view_more + R"(}], "buffers": [)" + buffer + "]");
}

std::string inline_buffer(const std::string& bytes, std::size_t declared) {
  return R"({"byteLength": )" + std::to_string(declared) + R"(, "uri": ")" + buffer_uri(bytes) +
         "\"}";
}

TEST(Data, OfABufferThatIsTooShortIsNotLookedAtButByKhronosWhereItIsInline) {
  const std::string whole = "\x01\x02\x03\x04\x05\x06\x07\x08";
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_EQ(verdict(with_accessor(inline_buffer(whole.substr(0, size), 8)), options_for()),
              (Lines{"BUFFER_BYTE_LENGTH_MISMATCH /buffers/0"}))
        << size;
  }
  EXPECT_EQ(verdict(with_accessor(inline_buffer(whole, 8)), options_for()),
            (Lines{"ACCESSOR_MIN_MISMATCH /accessors/0/min/0"}));
  EXPECT_EQ(verdict(with_accessor(inline_buffer(whole, 9)), options_for(Profile::khronos)),
            (Lines{"BUFFER_BYTE_LENGTH_MISMATCH /buffers/0",
                   "ACCESSOR_MIN_MISMATCH /accessors/0/min/0"}));
}

TEST(Data, OfAViewThatLiesElsewhereIsNotLookedAt) {
  const std::string whole = "\x01\x02\x03\x04\x05\x06\x07\x08";
  for (const char* offset : {"1", "8", "9", "9007199254740992", "18446744073709551608", "-1"}) {
    EXPECT_EQ(
        verdict(with_accessor(inline_buffer(whole, 8), R"(, "byteOffset": )" + std::string(offset)),
                options_for()),
        Lines())
        << offset;
  }
}

TEST(Data, ThatAnExtensionPacksElsewhereIsLeftToIt) {
  const std::string compressed =
      R"(, "extensions": {"EXT_meshopt_compression": {"buffer": 1, "byteLength": 4, "byteStride": 1, "count": 8, "mode": "ATTRIBUTES"}})";
  const std::string fallback =
      R"({"byteLength": 8, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}, )";
  EXPECT_EQ(verdict(with_accessor(fallback + inline_buffer("1234", 4), compressed), options_for()),
            Lines());
}

std::string le32(std::size_t value) {
  return packed<std::uint32_t>({static_cast<std::uint32_t>(value)});
}

// A GLB whose JSON has one buffer of `declared` bytes, with the BIN chunk `bin` if there is one.
std::string glb(std::size_t declared, std::optional<std::string> bin,
                const std::string& more = {}) {
  std::string json =
      asset_with(R"("buffers": [{"byteLength": )" + std::to_string(declared) + more + "}]");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string chunks = le32(json.size()) + "JSON" + json;
  if (bin) chunks += le32(bin->size()) + std::string("BIN\0", 4) + *bin;
  return "glTF" + le32(2) + le32(chunks.size() + 12) + chunks;
}

TEST(Glb, TheFirstBufferIsTheBinChunk) {
  EXPECT_EQ(verdict(glb(8, std::string(8, 'x')), options_for()), Lines());
  EXPECT_EQ(verdict(glb(8, std::nullopt), options_for()),
            (Lines{"BUFFER_MISSING_GLB_DATA /buffers/0"}));
  EXPECT_EQ(verdict(glb(9, std::string(8, 'x')), options_for()),
            (Lines{"BUFFER_BYTE_LENGTH_MISMATCH /buffers/0"}));
}

TEST(Glb, TheBinChunkMayBePaddedToFourBytes) {
  for (std::size_t declared = 5; declared <= 8; ++declared) {
    EXPECT_EQ(verdict(glb(declared, std::string(8, 'x')), options_for()), Lines()) << declared;
  }
  const std::string big = glb(4, std::string(8, 'x'));
  EXPECT_EQ(verdict(big, options_for()), (Lines{"BUFFER_GLB_CHUNK_TOO_BIG /buffers/0"}));
  EXPECT_EQ(message(big, "BUFFER_GLB_CHUNK_TOO_BIG"),
            "The BIN chunk is 4 bytes longer than the padded buffer.");
}

TEST(Glb, ABufferThatIsOnlyAFallbackNeedsNoBinChunk) {
  const std::string fallback = R"(, "extensions": {"EXT_meshopt_compression": {"fallback": true}})";
  EXPECT_EQ(verdict(glb(8, std::nullopt, fallback), options_for()), Lines());
}

TEST(Glb, WhatACutTookAwayIsNotMissed) {
  const std::string whole = glb(64, std::string(64, 'x'));
  for (std::size_t size = whole.size() - 71; size < whole.size(); ++size) {
    EXPECT_EQ(verdict(whole.substr(0, size), options_for()), Lines()) << size;
  }
}

}  // namespace
}  // namespace gltfx::test
