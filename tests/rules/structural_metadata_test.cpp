// SPDX-License-Identifier: Apache-2.0
// Structural metadata: schemas in the asset and in files, and references to them.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "rules/data_asset.hpp"
#include "rules/metadata_findings.hpp"

namespace gltfx::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string kMetadataRoot = "/extensions/EXT_structural_metadata";

std::string metadata_asset(const std::string& members, const std::string& more = {}) {
  return asset_with(
      R"("extensionsUsed": ["EXT_structural_metadata", "EXT_mesh_features"], "extensions":
      {"EXT_structural_metadata": {)" +
      members + "}}" + more);
}
std::string metadata_schema(const std::string& classes, const std::string& enums = {}) {
  return R"("schema": {"id": "s", "classes": {)" + classes + "}" +
         (enums.empty() ? "" : R"(, "enums": {)" + enums + "}") + "}";
}
std::string class_property(const std::string& members) {
  return metadata_schema(R"("c": {"properties": {"p": {)" + members + "}}}");
}
Lines of_class_property(const std::string& members) {
  return metadata_findings(metadata_asset(class_property(members)));
}

const std::string kClassProperty = kMetadataRoot + "/schema/classes/c/properties/p";

TEST(MetadataSchema, ValuesHaveTheFormOfTheirProperty) {
  const auto value = [](const std::string& type, const std::string& text) {
    return of_class_property(type + R"(, "noData": )" + text);
  };
  const Lines wrong{"METADATA_VALUE_INVALID " + kClassProperty + "/noData"};
  const std::string scalar = R"("type": "SCALAR", "componentType": "INT16")";
  const std::string vector = R"("type": "VEC2", "componentType": "INT16")";
  const std::string pair = R"(, "array": true, "count": 2)";
  EXPECT_EQ(value(scalar, "1"), Lines{});
  EXPECT_EQ(value(scalar, "[1]"), wrong);
  EXPECT_EQ(value(scalar, "\"1\""), wrong);
  EXPECT_EQ(value(vector, "[1, 2]"), Lines{});
  EXPECT_EQ(value(vector, "[1, 2, 3]"), wrong);
  EXPECT_EQ(value(vector, "[1, \"2\"]"), wrong);
  EXPECT_EQ(value(scalar + pair, "[1, 2]"), Lines{});
  EXPECT_EQ(value(scalar + pair, "[1]"), wrong);
  EXPECT_EQ(value(vector + pair, "[[1, 2], [3, 4]]"), Lines{});
  EXPECT_EQ(value(vector + pair, "[1, 2, 3, 4]"), wrong);
  EXPECT_EQ(value(vector + pair, "[[1, 2], [3]]"), wrong);
  EXPECT_EQ(value(R"("type": "STRING")", "\"x\""), Lines{});
  EXPECT_EQ(value(R"("type": "STRING")", "1"), wrong);
  EXPECT_EQ(value(R"("type": "STRING", "array": true)", R"(["a", "b"])"), Lines{});
}

TEST(MetadataSchema, NumbersFitTheComponentType) {
  const auto value = [](const std::string& type, const std::string& text) {
    return of_class_property(R"("type": "SCALAR", "componentType": ")" + type +
                             R"(", "default": )" + text);
  };
  const Lines wrong{"METADATA_VALUE_OUT_OF_RANGE " + kClassProperty + "/default"};
  EXPECT_EQ(value("INT8", "-128"), Lines{});
  EXPECT_EQ(value("INT8", "-129"), wrong);
  EXPECT_EQ(value("UINT8", "1.5"), wrong);
  EXPECT_EQ(value("UINT64", "18446744073709551615"), Lines{});
  EXPECT_EQ(value("UINT64", "18446744073709551616"), wrong) << "the same as a double";
  EXPECT_EQ(value("UINT64", "-1"), wrong);
  EXPECT_EQ(value("INT64", "9223372036854775807"), Lines{});
  EXPECT_EQ(value("INT64", "9223372036854775808"), wrong);
  EXPECT_EQ(value("INT64", "1e3"), Lines{});
  EXPECT_EQ(value("FLOAT32", "1e39"), wrong);
  EXPECT_EQ(value("FLOAT64", "1e39"), Lines{});
  EXPECT_EQ(value("UINT8\", \"normalized\": true, \"semantic\": \"x", "0.5"), Lines{});
}

TEST(MetadataSchema, MembersAreThereWhereTheyMeanSomething) {
  const auto code = [](const std::string& members) {
    const Lines lines = of_class_property(members);
    return lines.empty() ? "" : lines.front().substr(0, lines.front().find(' '));
  };
  const std::string scalar = R"("type": "SCALAR", "componentType": )";
  EXPECT_EQ(code(R"("type": "SCALAR")"), "UNDEFINED_PROPERTY");
  EXPECT_EQ(code(R"("type": "STRING", "componentType": "INT8")"), "CONDITION_MISMATCH");
  EXPECT_EQ(code(R"("type": "ENUM")"), "UNDEFINED_PROPERTY");
  EXPECT_EQ(code(R"("type": "STRING", "enumType": "e")"), "CONDITION_MISMATCH");
  EXPECT_EQ(code(scalar + R"("INT8", "count": 2)"), "UNDEFINED_PROPERTY");
  EXPECT_EQ(code(scalar + R"("INT8", "scale": 2)"), "CONDITION_MISMATCH");
  EXPECT_EQ(code(scalar + R"("INT8", "normalized": true, "scale": 2)"), "");
  EXPECT_EQ(code(scalar + R"("FLOAT32", "scale": 2)"), "");
  EXPECT_EQ(code(scalar + R"("FLOAT32", "normalized": true)"), "VALUE_NOT_IN_LIST");
  EXPECT_EQ(code(scalar + R"("FLOAT32", "array": true, "min": 2)"), "CONDITION_MISMATCH");
  EXPECT_EQ(code(scalar + R"("FLOAT32", "required": true, "noData": 2)"), "CONDITION_MISMATCH");
  EXPECT_EQ(code(R"("type": "BOOLEAN", "noData": "x")"), "CONDITION_MISMATCH");
}

TEST(MetadataSchema, NamesAndSemanticsAreUnique) {
  const auto two = [](const std::string& one, const std::string& other) {
    return metadata_findings(
        metadata_asset(metadata_schema(R"("c": {"properties": {"p": {"type": "STRING", )" + one +
                                       R"(}, "q": {"type": "STRING", )" + other + "}}}")));
  };
  const std::string q = kMetadataRoot + "/schema/classes/c/properties/q/";
  EXPECT_EQ(two(R"("semantic": "A")", R"("semantic": "B")"), Lines{});
  EXPECT_EQ(two(R"("semantic": "A")", R"("semantic": "\u0041")"),
            Lines{"METADATA_REPEATED " + q + "semantic"});
  EXPECT_EQ(two(R"("name": "A")", R"("name": "A")"), Lines{"METADATA_REPEATED " + q + "name"});
}

TEST(MetadataSchema, EnumsHaveDifferentValuesInTheirRange) {
  const auto values = [](const std::string& more, const std::string& list) {
    return metadata_findings(metadata_asset(
        metadata_schema(R"("c": {})", R"("e": {)" + more + R"("values": [)" + list + "]}")));
  };
  const std::string place = kMetadataRoot + "/schema/enums/e/values/";
  EXPECT_EQ(values("", R"({"name": "a", "value": 0}, {"name": "b", "value": 1})"), Lines{});
  EXPECT_EQ(values("", R"({"name": "a", "value": 0}, {"name": "a", "value": 1})"),
            Lines{"METADATA_REPEATED " + place + "1/name"});
  EXPECT_EQ(values("", R"({"name": "a", "value": 0}, {"name": "b", "value": 0})"),
            Lines{"METADATA_REPEATED " + place + "1/value"});
  EXPECT_EQ(values("", R"({"name": "a", "value": -1})"),
            Lines{"METADATA_ENUM_OUT_OF_RANGE " + place + "0/value"});
  EXPECT_EQ(values(R"("valueType": "INT8", )", R"({"name": "a", "value": -1})"), Lines{});
  const auto largest = [&](const std::string& value) {
    return values(R"("valueType": "INT64", )", R"({"name": "a", "value": )" + value + "}");
  };
  EXPECT_EQ(largest("9223372036854775807"), Lines{});
  EXPECT_EQ(largest("9223372036854775808"),
            Lines{"METADATA_ENUM_OUT_OF_RANGE " + place + "0/value"});
}

TEST(MetadataSchema, EnumValuesRepeatHoweverTheyAreWritten) {
  const auto repeated = [](const std::string& one, const std::string& other) {
    return metadata_findings(metadata_asset(metadata_schema(
        R"("c": {})", R"("e": {"valueType": "INT8", "values": [{"name": "a", "value": )" + one +
                          R"(}, {"name": "b", "value": )" + other + "}]}")));
  };
  const Lines wrong{"METADATA_REPEATED " + kMetadataRoot + "/schema/enums/e/values/1/value"};
  EXPECT_EQ(repeated("1", "1.0"), wrong);
  EXPECT_EQ(repeated("-0", "0"), wrong);
  EXPECT_EQ(repeated("-1e0", "-1"), wrong);
  EXPECT_EQ(repeated("1", "10"), Lines{});
}

TEST(MetadataSchema, VersionsAreSemantic) {
  const auto version = [](const std::string& text) {
    return metadata_findings(metadata_asset(R"("schema": {"id": "s", "version": ")" + text +
                                            R"(", "classes": {"c": {}}})"));
  };
  const Lines wrong{"PATTERN_MISMATCH " + kMetadataRoot + "/schema/version"};
  EXPECT_EQ(version("1.0.0"), Lines{});
  EXPECT_EQ(version("0.12.3-rc.1+build.5"), Lines{});
  EXPECT_EQ(version("1.0"), wrong);
  EXPECT_EQ(version("01.0.0"), wrong);
  EXPECT_EQ(version("v1.0.0"), wrong);
}

TEST(MetadataSchema, IdsLeadSomewhere) {
  EXPECT_EQ(of_class_property(R"("type": "ENUM", "enumType": "e")"),
            Lines{"METADATA_UNRESOLVED_ID " + kClassProperty + "/enumType"});
  const std::string string = class_property(R"("type": "STRING", "required": true)");
  EXPECT_EQ(metadata_findings(
                metadata_asset(string + R"(, "propertyTables": [{"class": "d", "count": 1}])")),
            Lines{"METADATA_UNRESOLVED_ID " + kMetadataRoot + "/propertyTables/0/class"});
  EXPECT_EQ(metadata_findings(
                metadata_asset(string + R"(, "propertyTables": [{"class": "c", "count": 1}])")),
            Lines{"METADATA_PROPERTY_MISSING " + kMetadataRoot + "/propertyTables/0"});
}

TEST(MetadataOfObjects, HasTheFormOfItsClass) {
  const auto node = [](const std::string& members) {
    return metadata_findings(
        metadata_asset(class_property(R"("type": "VEC2", "componentType": "FLOAT32")"),
                       R"(, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"extensions":
                             {"EXT_structural_metadata": {)" +
                           members + "}}}]"));
  };
  const std::string place = "/nodes/0/extensions/EXT_structural_metadata";
  EXPECT_EQ(node(R"("class": "c", "properties": {"p": [1, 2]})"), Lines{});
  EXPECT_EQ(node(R"("class": "c", "properties": {"p": 1})"),
            Lines{"METADATA_VALUE_INVALID " + place + "/properties/p"});
  EXPECT_EQ(node(R"("class": "c", "properties": {"q": 1})"),
            Lines{"METADATA_UNRESOLVED_ID " + place + "/properties/q"});
  EXPECT_EQ(node(R"("class": "d")"), Lines{"METADATA_UNRESOLVED_ID " + place + "/class"});
}

TEST(MetadataOfObjects, StaysWithinTheBoundsOfItsClass) {
  const auto node = [](const std::string& value) {
    return metadata_findings(metadata_asset(
        class_property(
            R"("type": "VEC2", "componentType": "INT8", "min": [0, 0], "max": [9, 5], "noData": [-1, -1])"),
        R"(, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"extensions":
           {"EXT_structural_metadata": {"class": "c", "properties": {"p": )" +
            value + "}}}}]"));
  };
  const Lines wrong{
      "METADATA_VALUE_BEYOND_LIMIT /nodes/0/extensions/EXT_structural_metadata/properties/p"};
  EXPECT_EQ(node("[9, 5]"), Lines{});
  EXPECT_EQ(node("[9, 6]"), wrong);
  EXPECT_EQ(node("[-1, 0]"), wrong);
  EXPECT_EQ(node("[-1, -1]"), Lines{});
}

// --- schemaUri ---

class SchemaFile : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  FileReport validate(const std::string& uri) const {
    write("asset/a.gltf", metadata_asset(R"("schemaUri": ")" + uri + "\""));
    return validate_file((folder_.path() / "asset/a.gltf").string(), {});
  }
  static Lines codes(const FileReport& report) {
    Lines lines;
    for (const Diagnostic& each : report.diagnostics) {
      if (each.code.ends_with("UNUSED") || each.code.starts_with("UNUSED_")) continue;
      lines.push_back(std::string(each.code) + " " + each.pointer);
    }
    return lines;
  }
  container::test::TempFolder folder_;
};

TEST_F(SchemaFile, IsCheckedAsOneInTheAsset) {
  const std::string member = " " + kMetadataRoot + "/schemaUri";
  write("asset/s.json",
        R"({"id": "s", "classes": {"c": {"properties": {"p": {"type": "STRING"}}}}})");
  EXPECT_THAT(codes(validate("s.json")), IsEmpty());
  write("asset/s.json",
        "{\"id\": \"s\",\n \"classes\": {\"c\": {\"properties\": {\"p\": {\n\"type\": 1}}}}}");
  const FileReport report = validate("s.json");
  EXPECT_EQ(codes(report), Lines{"TYPE_MISMATCH" + member});
  EXPECT_THAT(report.diagnostics.back().message, HasSubstr("Line 3 of 's.json': "));
  write("asset/s.json", R"({"id": "s", "classes": {"c": {"properties": {"p": {"type": "ENUM",
    "enumType": "e"}}}}})");
  EXPECT_EQ(codes(validate("s.json")), Lines{"METADATA_UNRESOLVED_ID" + member});
}

TEST_F(SchemaFile, IsReadInsideTheRootOnly) {
  write("s.json", R"({"id": "s"})");
  const std::string member = " " + kMetadataRoot + "/schemaUri";
  EXPECT_EQ(codes(validate("../s.json")), Lines{"URI_OUTSIDE_ROOT" + member});
  EXPECT_EQ(codes(validate("missing.json")), Lines{"IO_ERROR" + member});
  std::filesystem::create_symlink(folder_.path() / "s.json", folder_.path() / "asset/link.json");
  EXPECT_EQ(codes(validate("link.json")), Lines{"URI_OUTSIDE_ROOT" + member});
}

TEST_F(SchemaFile, IsJson) {
  const std::string member = " " + kMetadataRoot + "/schemaUri";
  for (const std::string text : {"", "{", "[]", "{\"id\": }", "\xFF\xFE"}) {
    write("asset/s.json", text);
    EXPECT_EQ(codes(validate("s.json")), Lines{"METADATA_SCHEMA_UNREADABLE" + member}) << text;
  }
  write("asset/s.json", std::string(5000, '[') + std::string(5000, ']'));
  EXPECT_EQ(codes(validate("s.json")), Lines{"METADATA_SCHEMA_UNREADABLE" + member}) << "deep";
}

}  // namespace
}  // namespace gltfx::test
