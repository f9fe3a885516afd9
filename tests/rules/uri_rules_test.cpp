// SPDX-License-Identifier: Apache-2.0
// Findings on URIs in the default, strict and khronos profiles.
#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"
#include "json/writer.hpp"

namespace gltfx::test {
namespace {

using container::test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Said = std::vector<std::string>;

class Uris : public testing::Test {
 protected:
  Uris() {
    for (const char* name : {"a.bin", "a b.bin", "100%.bin", "a#b.bin", "sub/a.bin", "a[1].bin",
                             "a\x01.bin", "a+b.bin"}) {
      folder_.write(name, "0123");
    }
  }

  FileReport report_of(const std::string& asset, Profile profile = Profile::standard) {
    ValidateOptions options;
    options.profile = profile;
    options.ignore = {"UNUSED_OBJECT"};
    return validate_file(folder_.write("asset.gltf", asset).native(), options);
  }

  static Said said(const FileReport& report) {
    Said out;
    for (const Diagnostic& found : report.diagnostics) {
      out.push_back(std::string(severity_name(found.severity)) + " " + std::string(found.code));
    }
    return out;
  }

  FileReport report_of_uri(const std::string& uri, Profile profile = Profile::standard) {
    std::string text;
    json::append_string(text, uri);
    return report_of(
        R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": )" + text + "}]}",
        profile);
  }

  Said of(const std::string& uri, Profile profile = Profile::standard) {
    return said(report_of_uri(uri, profile));
  }

  TempFolder folder_;
};

TEST_F(Uris, WithASpaceAreReadAndRemarkedUpon) {
  EXPECT_THAT(of("a b.bin"), ElementsAre("info URI_NOT_ENCODED"));
  EXPECT_THAT(of("a b.bin", Profile::strict), ElementsAre("warning URI_NOT_ENCODED"));
  EXPECT_THAT(of("a b.bin", Profile::khronos), IsEmpty());
  EXPECT_THAT(of("a%20b.bin"), IsEmpty());
  const FileReport report = report_of_uri("a b.bin");
  EXPECT_THAT(report.diagnostics[0].message, HasSubstr("has a space"));
  EXPECT_EQ(report.diagnostics[0].help, "write 'a%20b.bin'");
}

TEST_F(Uris, WithAReservedCharacterAreErrors) {
  EXPECT_THAT(of("a[1].bin"), ElementsAre("error URI_NOT_ENCODED"));
  EXPECT_THAT(of("a[1].bin", Profile::khronos), IsEmpty());
  EXPECT_THAT(of("a+b.bin"), IsEmpty());
}

TEST_F(Uris, WithAQueryOrAFragmentAreErrorsThatNameTheEscape) {
  for (const auto& [uri, escape] : std::vector<std::pair<std::string, std::string>>{
           {"a#b.bin", "%23"}, {"a.bin?v=1", "%3F"}, {"a.bin#", "%23"}, {"sub/a.bin?#", "%3F"}}) {
    const FileReport report = report_of_uri(uri);
    EXPECT_THAT(said(report), ElementsAre("error NON_RELATIVE_URI")) << uri;
    EXPECT_THAT(report.diagnostics[0].help, HasSubstr(escape)) << uri;
    EXPECT_THAT(of(uri, Profile::khronos), ElementsAre("warning NON_RELATIVE_URI")) << uri;
  }
  EXPECT_THAT(of("a%23b.bin"), IsEmpty());
}

TEST_F(Uris, OfPlacesOnThisMachineOrItsNetworkAreErrors) {
  for (const char* uri : {"//server/share/a.bin", "\\\\server\\share\\a.bin", "file:///a.bin",
                          "/a.bin", "C:\\a.bin", "C:/a.bin", "c:a.bin"}) {
    EXPECT_THAT(of(uri), ElementsAre("error URI_OUTSIDE_ROOT")) << uri;
    EXPECT_THAT(of(uri, Profile::khronos), ElementsAre("warning NON_RELATIVE_URI")) << uri;
  }
  EXPECT_THAT(of("https://example.com/a.bin"), ElementsAre("warning NON_RELATIVE_URI"));
}

TEST_F(Uris, OfAWindowsDriveAreCalledThat) {
  const FileReport report = report_of_uri("C:\\Users\\me\\a.bin");
  EXPECT_THAT(report.diagnostics[0].message, HasSubstr("a path on a Windows drive"));
  EXPECT_THAT(report.diagnostics[0].help, HasSubstr("write 'a.bin'"));
}

TEST_F(Uris, ThatAreEmptyNameNoFile) {
  const FileReport report = report_of_uri("");
  EXPECT_THAT(said(report), ElementsAre("error INVALID_URI"));
  EXPECT_THAT(report.diagnostics[0].message, HasSubstr("The URI is empty"));
  EXPECT_THAT(of("", Profile::khronos), ElementsAre("error IO_ERROR"));
}

// The Khronos validator repairs URIs if possible, and opens the result.
TEST_F(Uris, AreRepairedInTheProfileOfTheKhronosValidator) {
  for (const char* uri : {"100%.bin", "sub\\a.bin", "a\x01.bin", "a%01.bin"}) {
    EXPECT_THAT(of(uri), ElementsAre("error INVALID_URI")) << uri;
    EXPECT_THAT(of(uri, Profile::khronos), IsEmpty()) << uri;
  }
  for (const char* uri : {"a%", "%zz", "a\n.bin", "a%00.bin", "..\\missing.bin"}) {
    EXPECT_THAT(of(uri, Profile::khronos), ElementsAre("error IO_ERROR")) << uri;
  }
  for (const char* uri :
       {":a", "1a:b", "a b:c", "http://example.com:ab/", "http://[::1", "data:"}) {
    EXPECT_THAT(of(uri, Profile::khronos), ElementsAre("error INVALID_URI")) << uri;
  }
}

TEST_F(Uris, WithDataAreRepairedThereToo) {
  const std::string head = "data:application/octet-stream";
  for (const char* data :
       {";base64,AAAAAA", ";base64,AAAAAA%3D%3D", ";base64,__--AA==", ",ab%zz", ",a b c", ",%4"}) {
    EXPECT_THAT(of(head + data, Profile::khronos),
                testing::Not(testing::Contains("error INVALID_URI")))
        << data;
  }
  for (const char* data :
       {";base64,AAAAAA", ";base64,AAAAAA%3D%3D", ";base64,__--AA==", ",ab%zz"}) {
    EXPECT_THAT(of(head + data), ElementsAre("error INVALID_URI")) << data;
  }
  for (const char* data :
       {";base64,AA AAAA==", ";base64,A", ";base64;x=y,AAAA", "/x;base64,AAAA"}) {
    EXPECT_THAT(of(head + data, Profile::khronos), ElementsAre("error INVALID_URI")) << data;
  }
}

TEST_F(Uris, AreMissingFromABuffer) {
  const std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4}]})";
  const FileReport report = report_of(text);
  EXPECT_THAT(said(report), ElementsAre("warning BUFFER_WITHOUT_DATA"));
  EXPECT_THAT(report.diagnostics[0].message, HasSubstr("no BIN chunk"));
  EXPECT_THAT(said(report_of(text, Profile::khronos)), IsEmpty());
  const std::string fallback =
      R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_meshopt_compression"],
          "buffers": [{"byteLength": 4, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}]})";
  EXPECT_THAT(said(report_of(fallback)),
              testing::Not(testing::Contains("warning BUFFER_WITHOUT_DATA")));
}

TEST_F(Uris, OfDataInAGlbAreNotExternal) {
  const std::string json =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"data:application/octet-stream;base64,AAAAAA=="}]})";
  std::string padded = json;
  padded.resize((json.size() + 3) / 4 * 4, ' ');
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>((value >> shift) & 0xFFU);
    }
    return bytes;
  };
  const std::string glb =
      "glTF" + number(2) + number(20 + padded.size()) + number(padded.size()) + "JSON" + padded;
  ValidateOptions options;
  options.ignore = {"UNUSED_OBJECT"};
  EXPECT_THAT(said(validate_bytes(glb, "a.glb", options)), ElementsAre("warning DATA_URI_GLB"));
  options.profile = Profile::khronos;
  EXPECT_THAT(said(validate_bytes(glb, "a.glb", options)),
              testing::UnorderedElementsAre("info URI_GLB", "warning DATA_URI_GLB"));
}

TEST_F(Uris, OfMissingFilesNameTheNearOnes) {
  const auto help = [this](const std::string& uri) {
    const FileReport report = report_of_uri(uri);
    return report.diagnostics.empty() ? std::string() : report.diagnostics[0].help;
  };
  EXPECT_EQ(help("Sub/A.BIN"), "write 'sub/a.bin': upper and lower case differ");
  EXPECT_EQ(help("textures/100%25.bin"),
            "write '100%25.bin' if that file is meant, or add the missing one");
  EXPECT_THAT(help("other.bin"), HasSubstr("or add the file"));
  folder_.link("away.bin", "/etc/hostname");
  EXPECT_EQ(help("away.bin"),
            "a symbolic link leads out of the folder: replace it by the file, or "
            "set a common parent folder with --root");
  folder_.link("gone.bin", "nothing.bin");
  EXPECT_THAT(help("gone.bin"), HasSubstr("or add the file"));
}

}  // namespace
}  // namespace gltfx::test
