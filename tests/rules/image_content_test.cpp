// SPDX-License-Identifier: Apache-2.0
// Bytes that are not an image allowed for their slot, and their findings.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "image/ktx2_builder.hpp"
#include "image/png_builder.hpp"
#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

using namespace std::literals;
using container::test::TempFolder;
using testing::HasSubstr;

// An asset whose texture uses an image with these bytes.
std::string shown(const std::string& bytes, const std::string& more = {},
                  const std::string& texture = R"("source": 0)", const std::string& root = {}) {
  DataAsset asset;
  asset.view(bytes);
  return asset.text(R"("images": [{"bufferView": 0)" + more + R"(}], "textures": [{)" + texture +
                    "}]" + root);
}

// The first finding on the image's format.
Diagnostic finding(const std::string& asset, Profile profile = Profile::standard) {
  ValidateOptions options;
  options.profile = profile;
  options.select = {"IMAGE_UNRECOGNIZED_FORMAT", "IMAGE_UNEXPECTED_EOS"};
  const FileReport report = validate_bytes(asset, "test", options);
  return report.diagnostics.empty() ? Diagnostic() : report.diagnostics.front();
}

const std::string kTail(32, '\x01');

TEST(ImageContent, IsNamedWhereItIsNoImageForTextures) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"<!DOCTYPE html><html>" + kTail, "an HTML page (a failed download?)"},
      {"\xEF\xBB\xBF\n <HTML lang=\"en\">" + kTail, "an HTML page (a failed download?)"},
      {R"(<?xml version="1.0"?><Error><Code>AccessDenied</Code></Error>)",
       "an XML document (a failed download?)"},
      {R"(<?xml version="1.0"?><svg xmlns="x"></svg>)", "an SVG drawing"},
      {R"({"message": "Not Found", "status": "404"})", "JSON text (a failed download?)"},
      {"data:image/png;base64,iVBORw0KGgo", "text of a data URI"},
      {"GIF89a" + kTail, "a GIF"},
      {"BM\x46\x00\x00\x00\x00\x00\x00\x00\x36\x00\x00\x00"s + kTail, "a BMP"},
      {"II*\0"s + kTail, "a TIFF"},
      {"MM\0*"s + kTail, "a TIFF"},
      {"\xabKTX 11\xbb\r\n\x1a\n" + kTail, "KTX 1, not KTX 2"},
      {"\x76\x2f\x31\x01" + kTail, "an OpenEXR file"},
      {"DDS " + kTail, "a DDS texture"},
      {"\0\0\0\x1c"s + "ftypavif" + kTail, "an AVIF"},
      {"8BPS" + kTail, "a Photoshop document"},
      {std::string(64, '\0'), "a file of zeros"},
      {"\x89PNG\r\n\x1a\n", "a truncated PNG"},
      {"\xff\xd8\xff", "a truncated JPEG"},
      {"RIFF\x10\0\0\0WAVEfmt "s, "a RIFF file, but not a WebP image"},
      {"PK\x03\x04" + kTail, "a ZIP archive"},
      {"once upon a time", "in an unknown format"},
  };
  for (const auto& [bytes, name] : cases) {
    const Diagnostic found = finding(shown(bytes, R"(, "mimeType": "image/png")"));
    EXPECT_EQ(found.severity, Severity::error) << name;
    EXPECT_EQ(found.pointer, "/images/0") << name;
    EXPECT_EQ(found.message, "The image is " + name + "; it must be image/jpeg or image/png.");
  }
}

TEST(ImageContent, ForKhronosItIsAWarning) {
  const Diagnostic found = finding(shown("GIF89a" + kTail), Profile::khronos);
  EXPECT_EQ(found.code, "IMAGE_UNRECOGNIZED_FORMAT");
  EXPECT_EQ(found.severity, Severity::warning);
}

TEST(ImageContent, FilesAreToldTheSameWay) {
  TempFolder folder;
  folder.write("empty.png", "");
  folder.write("a.gltf", asset_with(R"("images": [{"uri": "empty.png"}])"));
  ValidateOptions options;
  options.select = {"IMAGE_UNRECOGNIZED_FORMAT"};
  const FileReport report = validate_file((folder.path() / "a.gltf").native(), options);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::error);
  EXPECT_THAT(report.diagnostics[0].message, HasSubstr("The image is an empty file;"));
  EXPECT_EQ(report.diagnostics[0].help, "export or download the image again");
}

TEST(ImageContent, FormatsOfDeclaredExtensionsAreToldByTheirBytesToo) {
  const std::string dds = R"(, "extensionsUsed": ["MSFT_texture_dds"])";
  const std::string slot = R"("extensions": {"MSFT_texture_dds": {"source": 0}})";
  const std::string type = R"(, "mimeType": "image/vnd-ms.dds")";
  EXPECT_EQ(finding(shown("DDS " + kTail, type, slot, dds)).code, "");
  EXPECT_EQ(finding(shown("DDS " + kTail, {}, slot, dds)).code, "");
  EXPECT_EQ(finding(shown("<html>" + kTail, type, slot, dds)).severity, Severity::error);
  EXPECT_EQ(finding(shown(kTail, type, slot, dds)).severity, Severity::error);
  const std::string basis = R"(, "extensionsUsed": ["KHR_texture_basisu"])";
  const std::string source = R"("extensions": {"KHR_texture_basisu": {"source": 0}})";
  const Diagnostic old = finding(
      shown("\xabKTX 11\xbb\r\n\x1a\n" + kTail, R"(, "mimeType": "image/ktx2")", source, basis));
  EXPECT_EQ(old.severity, Severity::error);
  EXPECT_THAT(old.message, HasSubstr("KTX 1, not KTX 2"));
}

TEST(ImageContent, WhatAnUnknownExtensionShowsMayBeOfAnyImageFormat) {
  const std::string unknown = R"(, "extensionsUsed": ["ACME_texture_avif"])";
  const std::string slot = R"("extensions": {"ACME_texture_avif": {"source": 0}})";
  const std::string avif = "\0\0\0\x1c"s + "ftypavif" + kTail;
  const Diagnostic other = finding(shown(avif, {}, slot, unknown));
  EXPECT_EQ(other.severity, Severity::warning);
  EXPECT_THAT(other.help, HasSubstr("'ACME_texture_avif'"));
  EXPECT_EQ(finding(shown("<html>" + kTail, {}, slot, unknown)).severity, Severity::error);
  EXPECT_EQ(finding(shown(avif, {}, R"("source": 0, )" + slot, unknown)).severity, Severity::error)
      << "a reader without the extension shows it as well";
}

TEST(OtherContent, IsNamedOfBuffersAndGlbFiles) {
  TempFolder folder;
  folder.write("a.bin", "<!DOCTYPE html><html></html>");
  folder.write("a.gltf", asset_with(R"("buffers": [{"uri": "a.bin", "byteLength": 4096}])"));
  folder.write("b.glb", "<!DOCTYPE html><html></html>");
  ValidateOptions options;
  options.select = {"BUFFER_BYTE_LENGTH_MISMATCH", "GLB_INVALID_MAGIC"};
  for (const char* const name : {"a.gltf", "b.glb"}) {
    const FileReport report = validate_file((folder.path() / name).native(), options);
    ASSERT_EQ(report.diagnostics.size(), 1U) << name;
    EXPECT_THAT(report.diagnostics[0].message + report.diagnostics[0].help,
                HasSubstr("an HTML page (a failed download?)"));
  }
}

}  // namespace
}  // namespace gltfx::test
