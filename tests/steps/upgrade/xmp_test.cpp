// SPDX-License-Identifier: Apache-2.0
// KHR_xmp becomes JSON-LD.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kDublinCore = R"("dc":"http://purl.org/dc/elements/1.1/")";
const std::string kRdf = R"("rdf":"http://www.w3.org/1999/02/22-rdf-syntax-ns#")";

std::string xmp_document(const std::string& packets, const std::string& context = kDublinCore,
                         const std::string& others = "") {
  return R"({"extensionsUsed":["KHR_xmp"],)" + others + R"("extensions":{"KHR_xmp":{"@context":{)" +
         context + R"(},"packets":[)" + packets + "]}}}";
}

Json packet_after(const std::string& packet, const std::string& context = kDublinCore) {
  const Json root = upgraded(xmp_document(packet, context)).json();
  return root["extensions"]["KHR_xmp_json_ld"]["packets"][0];
}

TEST(Xmp, TheContextGoesIntoEveryPacket) {
  const Upgraded result =
      upgraded(xmp_document(R"({"dc:format":"a"},{"@id":"x","dc:format":"b"})"));
  EXPECT_EQ(result.json()["extensions"].dump(),
            R"({"KHR_xmp_json_ld":{"packets":[{"dc:format":"a","@context":{)" + kDublinCore +
                R"(},"@id":""},{"@id":"x","dc:format":"b","@context":{)" + kDublinCore + "}}]}}");
  EXPECT_THAT(result.json()["extensionsUsed"], testing::ElementsAre("KHR_xmp_json_ld"));
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::safe);
}

TEST(Xmp, ArraysSayWhetherTheirOrderCounts) {
  const Json packet =
      packet_after(R"({"dc:creator":["b","a"],"dc:subject":["x"],"dc:date":[],"dc:type":["t"]})");
  EXPECT_EQ(packet["dc:creator"].dump(), R"({"@list":["b","a"]})");
  EXPECT_EQ(packet["dc:subject"].dump(), R"({"@set":["x"]})");
  EXPECT_EQ(packet["dc:date"].dump(), R"({"@list":[]})");
  EXPECT_EQ(packet["dc:type"].dump(), R"({"@set":["t"]})");
}

TEST(Xmp, ArraysThatNobodyKnowsKeepTheirOrder) {
  const Upgraded result =
      upgraded(xmp_document(R"({"a:numbers":[1,2]},{"a:numbers":[3]})", R"("a":"urn:a")"));
  EXPECT_EQ(result.json()["extensions"]["KHR_xmp_json_ld"]["packets"][0]["a:numbers"].dump(),
            R"({"@list":[1,2]})");
  EXPECT_THAT(result.only().notes,
              testing::ElementsAre("the array 'a:numbers' is treated as ordered"));
}

TEST(Xmp, LanguagesBecomeAlternatives) {
  const Json packet = packet_after(R"({"dc:title":{"en-us":"My \u00e4","it-it":"Mio"}})");
  EXPECT_EQ(packet["dc:title"].dump(),
            R"({"@type":"rdf:Alt","rdf:_1":{"@language":"en-us","@value":"My ä"},)"
            R"("rdf:_2":{"@language":"it-it","@value":"Mio"}})");
  EXPECT_EQ(packet["@context"].dump(), "{" + kDublinCore + "," + kRdf + "}");
}

TEST(Xmp, APrefixOfRdfIsReused) {
  const Json packet =
      packet_after(R"({"dc:title":{"en":"x"}})",
                   kDublinCore + R"(,"r":"http://www.w3.org/1999/02/22-rdf-syntax-ns#")");
  EXPECT_EQ(packet["dc:title"]["@type"], "r:Alt");
  EXPECT_TRUE(packet["dc:title"].contains("r:_1"));
}

TEST(Xmp, StructuresStayAndWhatIsInThemFollows) {
  const Json packet = packet_after(
      R"({"xmpMM:Pantry":[{"dc:title":{"en":"x"},"a:b":{"a:c":["y"]}}],"a:d":{"a:e":"f"}})",
      kDublinCore + R"(,"xmpMM":"http://ns.adobe.com/xap/1.0/mm/","a":"urn:a")");
  EXPECT_EQ(packet["xmpMM:Pantry"].dump(),
            R"({"@set":[{"dc:title":{"@type":"rdf:Alt","rdf:_1":{"@language":"en",)"
            R"("@value":"x"}},"a:b":{"a:c":{"@list":["y"]}}}]})");
  EXPECT_EQ(packet["a:d"].dump(), R"({"a:e":"f"})");
}

TEST(Xmp, TheDocumentsLayoutIsFollowed) {
  const std::string text =
      "{\n  \"extensions\": {\n    \"KHR_xmp\": {\n      \"@context\": {},\n      \"packets\": [\n"
      "        {\n          \"dc:creator\": [\n            \"a\"\n          ]\n        }\n"
      "      ]\n    }\n  }\n}\n";
  EXPECT_THAT(
      upgraded(text).text,
      HasSubstr("          \"dc:creator\": {\"@list\": [\n            \"a\"\n          ]},\n"
                "          \"@context\": {},\n          \"@id\": \"\"\n        }\n"));
}

TEST(Xmp, EveryReferenceIsRenamed) {
  const std::string reference = R"({"extensions":{"KHR_xmp":{"packet":0}}})";
  std::string others = R"("asset":)" + reference + ",";
  for (const char* array : {"scenes", "nodes", "meshes", "materials", "images", "animations"}) {
    others.append("\"").append(array).append(R"(":[{},)").append(reference).append("],");
  }
  const Upgraded result = upgraded(xmp_document(R"({"dc:format":"a"})", kDublinCore, others));
  EXPECT_EQ(result.plan.actions.size(), 8U);
  EXPECT_EQ(result.text.find("\"KHR_xmp\""), std::string::npos) << result.text;
  EXPECT_THAT(upgraded(result.text).plan.actions, IsEmpty());
}

// Packets of both extensions, and objects that refer to them.
std::string beside(const std::string& packets, const std::string& there,
                   const std::string& others = "") {
  std::string text = xmp_document(packets, kDublinCore, others);
  const std::string name = R"("KHR_xmp":{)";
  return text.insert(text.find(name, text.find(R"("@context")") - name.size()),
                     R"("KHR_xmp_json_ld":{"packets":[)" + there + "]},");
}

const std::string kThere = R"({"@context":{},"@id":"0"},{"@context":{},"@id":"1"})";

TEST(Xmp, BesideItsSuccessorThePacketsFollowAndIndicesShift) {
  const Upgraded result =
      upgraded(beside(R"({"dc:rights":{"en":"mine"},"dc:type":["a"]},{"@id":"x"})", kThere,
                      R"("asset":{"extensions":{"KHR_xmp":{"packet":1}}},)"
                      R"("nodes":[{"extensions":{"KHR_xmp":{"packet":0}}},)"
                      R"({"extensions":{"KHR_xmp_json_ld":{"packet":1}}}],)"));
  const Json root = result.json();
  const Json& packets = root["extensions"]["KHR_xmp_json_ld"]["packets"];
  ASSERT_EQ(packets.size(), 4U) << result.text;
  EXPECT_EQ(packets[1]["@id"], "1");
  EXPECT_EQ(packets[2].dump(),
            R"({"dc:rights":{"@type":"rdf:Alt","rdf:_1":{"@language":"en","@value":"mine"}},)"
            R"("dc:type":{"@set":["a"]},"@context":{)" +
                kDublinCore + "," + kRdf + R"(},"@id":""})");
  EXPECT_EQ(packets[3].dump(), R"({"@id":"x","@context":{)" + kDublinCore + "}}");
  EXPECT_EQ(root["asset"]["extensions"]["KHR_xmp_json_ld"]["packet"], 3);
  EXPECT_EQ(root["nodes"][0]["extensions"]["KHR_xmp_json_ld"]["packet"], 2);
  EXPECT_EQ(root["nodes"][1]["extensions"]["KHR_xmp_json_ld"]["packet"], 1);
  EXPECT_EQ(root["extensions"].size(), 1U);
  EXPECT_THAT(root["extensionsUsed"], testing::ElementsAre("KHR_xmp_json_ld"));
  for (const UpgradeAction& action : result.plan.actions) {
    EXPECT_EQ(action.outcome, UpgradeOutcome::safe);
  }
  EXPECT_THAT(upgraded(result.text).plan.actions, IsEmpty());
}

TEST(Xmp, AnObjectWithBothReferencesKeepsTheNewOne) {
  const Upgraded result = upgraded(beside(
      "{}", kThere,
      R"("nodes":[{"extensions":{"KHR_xmp":{"packet":0},"KHR_xmp_json_ld":{"packet":1}}}],)"));
  EXPECT_EQ(result.json()["nodes"][0].dump(), R"({"extensions":{"KHR_xmp_json_ld":{"packet":1}}})");
  EXPECT_EQ(result.json()["extensions"]["KHR_xmp_json_ld"]["packets"].size(), 3U);
  EXPECT_THAT(result.plan.actions.back().notes, Contains(R"(its own values are '{"packet":0}')"));
}

TEST(Xmp, PacketsInATextOfManyLinesKeepTheirIndentation) {
  const std::string text =
      "{\n  \"extensionsUsed\": [\"KHR_xmp\"],\n  \"extensions\": {\n    \"KHR_xmp_json_ld\": {\n  "
      "    \"packets\": [\n"
      "        {\n          \"@context\": {}\n        }\n      ]\n    },\n"
      "    \"KHR_xmp\": {\n      \"@context\": {},\n      \"packets\": [\n"
      "        {\n          \"dc:format\": \"a\"\n        }\n      ]\n    }\n  }\n}\n";
  EXPECT_EQ(upgraded(text).text,
            "{\n  \"extensionsUsed\": [\"KHR_xmp_json_ld\"],\n  \"extensions\": {\n    "
            "\"KHR_xmp_json_ld\": {\n      \"packets\": [\n"
            "        {\n          \"@context\": {}\n        },\n"
            "        {\n          \"dc:format\": \"a\",\n          \"@context\": {},\n"
            "          \"@id\": \"\"\n        }\n      ]\n    }\n  }\n}\n");
}

TEST(Xmp, ExtrasOfTheRootsObjectAreNotLostUnasked) {
  std::string text = beside("{}", kThere);
  text.insert(text.find(R"("@context":{)" + kDublinCore), R"("extras":{"by":"me"},)");
  EXPECT_EQ(upgraded(text).text, text);
  EXPECT_EQ(upgraded(text).only().outcome, UpgradeOutcome::unsafe);
  UpgradeOptions unsafe;
  unsafe.unsafe = true;
  EXPECT_TRUE(upgraded(text, unsafe).only().done);
}

class XmpLeft : public testing::TestWithParam<std::pair<std::string, const char*>> {};

TEST_P(XmpLeft, Alone) {
  const auto& [text, says] = GetParam();
  const Upgraded result = upgraded(text);
  EXPECT_EQ(result.text, text);
  std::vector<std::string> notes;
  for (const UpgradeAction& action : result.plan.actions) {
    EXPECT_EQ(action.outcome, UpgradeOutcome::impossible);
    notes.insert(notes.end(), action.notes.begin(), action.notes.end());
  }
  EXPECT_THAT(notes, Contains(HasSubstr(says)));
}

INSTANTIATE_TEST_SUITE_P(
    Upgrade, XmpLeft,
    testing::Values(
        std::pair{xmp_document("{},7"), "a packet is not an object"},
        std::pair{beside("{}", ""), "KHR_xmp_json_ld is invalid"},
        std::pair{beside("{}", "7"), "KHR_xmp_json_ld is invalid"},
        std::pair{
            beside("{}", kThere, R"("nodes":[{"extensions":{"KHR_xmp_json_ld":{"packet":2}}}],)"),
            "/nodes/0/extensions/KHR_xmp_json_ld is invalid"},
        std::pair{xmp_document("{}", kDublinCore,
                               R"("nodes":[{"extensions":{"KHR_xmp_json_ld":{"packet":0}}}],)"),
                  "/nodes/0/extensions/KHR_xmp_json_ld is invalid"},
        std::pair{
            xmp_document("{}", kDublinCore, animated("/extensions/KHR_xmp/packets/0/dc:title")),
            "references it"},
        std::pair{xmp_document(R"({"@context":{}})"), "already has an @context"},
        std::pair{xmp_document("{}", R"("dc":7)"), "@context is invalid"},
        std::pair{xmp_document(R"({"dc:title":{"en":"x"}})", R"("rdf":"urn:x")"),
                  "does not have the RDF namespace"},
        std::pair{std::string(R"({"extensions":{"KHR_xmp":{"@context":{}}}})"), "packets"},
        std::pair{std::string(R"({"asset":{"extensions":{"KHR_xmp":{"packet":0}}}})"),
                  "does not reference a packet"},
        std::pair{xmp_document("{}", kDublinCore,
                               R"("nodes":[{"extensions":{"KHR_xmp":{"packet":1}}}],)"),
                  "all must be upgraded together"},
        std::pair{xmp_document("{}", kDublinCore,
                               R"("textures":[{"extensions":{"KHR_xmp":{"packet":0}}}],)"),
                  "all must be upgraded together"}));

}  // namespace
}  // namespace gltfx::upgrade::test
