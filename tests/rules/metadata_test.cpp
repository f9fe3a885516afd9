// SPDX-License-Identifier: Apache-2.0
// Packets of metadata, and sources of sound.
#include <gtest/gtest.h>

#include "rules/part.hpp"

namespace gltfx::test {
namespace {

const std::string kContext =
    R"("@context": {"dc": "http://purl.org/dc/elements/1.1/",
       "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#"})";
const std::string kPacket = " /extensions/KHR_xmp_json_ld/packets/0";

Lines packet(const std::string& members, const std::string& context = kContext) {
  return findings(R"("extensionsUsed": ["KHR_xmp_json_ld"], "extensions": {"KHR_xmp_json_ld":
    {"packets": [{)" + context +
                      ", " + members + "}]}}",
                  {"XMP"});
}

TEST(Metadata, OfAllFormsOfTheSpecificationIsSilent) {
  EXPECT_EQ(packet(R"("@id": "", "dc:contributor": {"@set": ["A", "B"]}, "dc:coverage": "here",
    "dc:creator": {"@list": ["A"]}, "dc:description": {"@type": "rdf:Alt",
      "rdf:_1": {"@language": "en-us", "@value": "x"}, "rdf:_2": {"@language": "it", "@value": "y"}},
    "dc:rating": 5, "dc:structure": {"dc:part": {"@list": [{"dc:deep": true}]}})"),
            Lines{});
}

TEST(Metadata, NamesHaveAKnownPrefix) {
  EXPECT_EQ(packet(R"("format": "x")"), Lines{"XMP_NAME_WITHOUT_PREFIX" + kPacket + "/format"});
  EXPECT_EQ(packet(R"(":format": "x")"), Lines{"XMP_NAME_WITHOUT_PREFIX" + kPacket + "/:format"});
  EXPECT_EQ(packet(R"("xmp:Rating": 5)"), Lines{"XMP_PREFIX_UNKNOWN" + kPacket + "/xmp:Rating"});
  EXPECT_EQ(packet(R"("dc:a": {"@list": [{"dc:b": {"c": 1}}]})"),
            Lines{"XMP_NAME_WITHOUT_PREFIX" + kPacket + "/dc:a/@list/0/dc:b/c"});
  EXPECT_EQ(packet(R"("dc:a": 1)", R"("@context": 3)"), Lines{});
}

TEST(Metadata, ArraysSayWhetherTheyAreOrdered) {
  EXPECT_EQ(packet(R"("dc:a": ["x"])"), Lines{"XMP_ARRAY_BARE" + kPacket + "/dc:a"});
  EXPECT_EQ(packet(R"("dc:a": [1, 2])"), Lines{"XMP_ARRAY_BARE" + kPacket + "/dc:a"});
  EXPECT_EQ(packet(R"("dc:a": {"@set": [1, 2]})"), Lines{});
}

TEST(Metadata, LanguagesAreNumberedAndComplete) {
  const auto languages = [](const std::string& members) {
    return packet(R"("dc:title": {"@type": "rdf:Alt", )" + members + "}");
  };
  const Lines first{"XMP_LANGUAGE_INVALID" + kPacket + "/dc:title/rdf:_1"};
  EXPECT_EQ(languages(R"("rdf:_1": "x")"), first);
  EXPECT_EQ(languages(R"("rdf:_1": {"@value": "x"})"), first);
  EXPECT_EQ(languages(R"("rdf:_1": {"@language": "en", "@value": 1})"), first);
  EXPECT_EQ(languages(R"("rdf:one": {"@language": "en", "@value": "x"})"),
            Lines{"XMP_LANGUAGE_INVALID" + kPacket + "/dc:title/rdf:one"});
}

TEST(Metadata, AValueStandsByItselfUnlessItHasALanguage) {
  EXPECT_EQ(packet(R"("dc:a": {"@language": "en", "@value": "x"})"), Lines{});
  EXPECT_EQ(packet(R"("dc:a": {"@context": {"@language": "en"}, "dc:b": "x"})"), Lines{});
  EXPECT_EQ(packet(R"("dc:a": {"@value": "x", "@type": "dc:b"})"),
            Lines{"XMP_FORM_FORBIDDEN" + kPacket + "/dc:a/@value"});
  EXPECT_EQ(packet(R"("dc:a": {"@set": [{"@value": 1}]})"),
            Lines{"XMP_FORM_FORBIDDEN" + kPacket + "/dc:a/@set/0/@value"});
  EXPECT_EQ(packet(R"("dc:a": {"@context": "http://example.org/", "dc:b": "x"})"),
            Lines{"XMP_FORM_FORBIDDEN" + kPacket + "/dc:a/@context"});
}

TEST(Metadata, ANamespaceHasOnePrefix) {
  EXPECT_EQ(packet(R"("a:x": 1)", R"("@context": {"a": "http://example.org/", "b":
    "http://example.org/", "c": "http://example.com/"})"),
            Lines{"XMP_NAMESPACE_REPEATED" + kPacket + "/@context/b"});
}

TEST(Metadata, OfTheOlderExtensionSharesItsPrefixes) {
  EXPECT_EQ(findings(R"("extensionsUsed": ["KHR_xmp"], "extensions": {"KHR_xmp": {"@context":
    {"dc": "http://purl.org/dc/elements/1.1/"}, "packets": [{"dc:a": ["x"]}, {"xmp:b": 1}]}})",
                     {"XMP"}),
            Lines{"XMP_PREFIX_UNKNOWN /extensions/KHR_xmp/packets/1/xmp:b"});
}

TEST(Metadata, OfTheOlderExtensionHasLanguagesWithoutPrefix) {
  const auto title = [](const std::string& value) {
    return findings(R"("extensionsUsed": ["KHR_xmp"], "extensions": {"KHR_xmp": {"@context":
      {"dc": "http://purl.org/dc/elements/1.1/"}, "packets": [{"dc:title": )" +
                        value + "}]}}",
                    {"XMP"});
  };
  EXPECT_EQ(title(R"({"en-us": "x", "x-default": "y"})"), Lines{});
  EXPECT_EQ(title(R"({"en-us": 1})"),
            Lines{"XMP_NAME_WITHOUT_PREFIX /extensions/KHR_xmp/packets/0/dc:title/en-us"});
}

TEST(Metadata, MayBeDeepAndWide) {
  std::string deep = "1", wide;
  for (int i = 0; i < 400; ++i) deep = R"({"dc:a": )" + deep + "}";
  for (int i = 0; i < 50000; ++i) wide += R"(, "dc:)" + std::to_string(i) + "\": 1";
  EXPECT_EQ(packet("\"dc:a\": " + deep + wide), Lines{});
}

Lines source(const std::string& members) {
  return findings(
      R"("extensionsUsed": ["MPEG_audio_spatial", "MPEG_accessor_timed"],
    "accessors": [{"type": "SCALAR", "componentType": 5126, "count": 1,
      "extensions": {"MPEG_accessor_timed": {}}}, {"type": "SCALAR", "componentType": 5126, "count": 1}],
    "nodes": [{"extensions": {"MPEG_audio_spatial": {"sources": [{"id": 1, "type": "Object", )" +
          members + "}]}}}]",
      {"AUDIO", "ACCESSOR_NOT_TIMED"});
}
const std::string kSource = " /nodes/0/extensions/MPEG_audio_spatial/sources/0/";

TEST(Sound, HasOneGainForEachReverb) {
  EXPECT_EQ(source(R"("accessors": [0])"), Lines{});
  EXPECT_EQ(source(R"("accessors": [0], "reverbFeed": [1, 2], "reverbFeedGain": [0, 3])"), Lines{});
  const Lines wrong{"AUDIO_GAIN_COUNT" + kSource + "reverbFeedGain"};
  EXPECT_EQ(source(R"("accessors": [0], "reverbFeed": [1, 2], "reverbFeedGain": [0])"), wrong);
  EXPECT_EQ(source(R"("accessors": [0], "reverbFeed": [1])"), wrong);
  EXPECT_EQ(source(R"("accessors": [0], "reverbFeedGain": [1])"), wrong);
}

TEST(Sound, ComesFromTimedAccessors) {
  EXPECT_EQ(source(R"("accessors": [0, 1])"),
            Lines{"ACCESSOR_NOT_TIMED" + kSource + "accessors/1"});
}

TEST(Timed, VideoHasAsManyComponentsAsChannels) {
  const auto video = [](const std::string& type, const std::string& format) {
    return findings(
        R"("extensionsUsed": ["MPEG_texture_video", "MPEG_accessor_timed"],
    "accessors": [{"type": ")" +
            type +
            R"(", "componentType": 5121, "count": 4, "extensions": {"MPEG_accessor_timed": {}}}],
    "textures": [{"extensions": {"MPEG_texture_video": {"accessor": 0, "width": 2, "height": 2)" +
            format + "}}}]",
        {"EXTENSION_ACCESSOR", "ACCESSOR_NOT_TIMED"});
  };
  const Lines wrong{
      "EXTENSION_ACCESSOR_INVALID_FORMAT /textures/0/extensions/MPEG_texture_video/accessor"};
  EXPECT_EQ(video("VEC3", ""), Lines{}) << "RGB, by default";
  EXPECT_EQ(video("VEC4", ""), wrong);
  EXPECT_EQ(video("VEC4", R"(, "format": "BGRA")"), Lines{});
  EXPECT_EQ(video("VEC2", R"(, "format": "RG")"), Lines{});
  EXPECT_EQ(video("SCALAR", R"(, "format": "DEPTH_COMPONENT")"), Lines{});
  EXPECT_EQ(video("VEC2", R"(, "format": "RED")"), wrong);
}

TEST(Environment, IsTurnedByAUnitQuaternion) {
  const auto light = [](const std::string& rotation) {
    return findings(
        R"("extensionsUsed": ["EXT_lights_image_based"], "extensions": {"EXT_lights_image_based":
      {"lights": [{"rotation": )" +
            rotation + "}]}}",
        {"ROTATION"});
  };
  EXPECT_EQ(light("[0, 1, 0, 0]"), Lines{});
  EXPECT_EQ(light("[0, 1, 0, 1]"),
            Lines{"ROTATION_NON_UNIT /extensions/EXT_lights_image_based/lights/0/rotation"});
}

}  // namespace
}  // namespace gltfx::test
