// SPDX-License-Identifier: Apache-2.0
// The bytes of property tables: lengths, offsets, strings, flags, enums, limits.
#include <limits>

#include <gtest/gtest.h>

#include "rules/data_asset.hpp"
#include "rules/part.hpp"

namespace gltfx::test {
namespace {

const std::string kTableColumn =
    "/extensions/EXT_structural_metadata/propertyTables/0/properties/p";

/// A table with one column p.
struct ColumnTable {
  std::string property = {};       ///< members of the class property
  std::size_t rows = 2;            ///< count
  std::string values = {};         ///< bytes
  std::string array_offsets = {};  ///< bytes; empty: none
  std::string string_offsets = {};
  std::string more = {};   ///< further members of the column, each begun with a comma
  std::string enums = {};  ///< enums of the schema

  std::string text() const {
    DataAsset asset;
    std::string column = R"("values": )" + std::to_string(asset.view(values));
    if (!array_offsets.empty()) {
      column += R"(, "arrayOffsets": )" + std::to_string(asset.view(array_offsets));
    }
    if (!string_offsets.empty()) {
      column += R"(, "stringOffsets": )" + std::to_string(asset.view(string_offsets));
    }
    return asset.text(
        R"("extensionsUsed": ["EXT_structural_metadata"], "extensions": {"EXT_structural_metadata":
        {"schema": {"id": "s", "classes": {"c": {"properties": {"p": {)" +
        property + "}}}}" + (enums.empty() ? "" : R"(, "enums": {)" + enums + "}") +
        R"(}, "propertyTables": [{"class": "c", "count": )" + std::to_string(rows) +
        R"(, "properties": {"p": {)" + column + more + "}}}]}}");
  }

  Lines lines() const {
    Lines found;
    for (const std::string& line : verdict(text())) {
      if (!line.starts_with("UNUSED_")) found.push_back(line);
    }
    return found;
  }
};

Lines at_column(const std::string& code, const std::string& member = "values") {
  return {code + " " + kTableColumn + (member.empty() ? "" : "/" + member)};
}

const std::string kFloatProperty = R"("type": "SCALAR", "componentType": "FLOAT32")";
const std::string kByteProperty = R"("type": "SCALAR", "componentType": "UINT8")";
const std::string kStringProperty = R"("type": "STRING")";

TEST(PropertyTable, ValuesHaveTheLengthOfTheirType) {
  EXPECT_EQ((ColumnTable{kFloatProperty, 2, floats({1, 2})}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{kFloatProperty, 3, floats({1, 2})}.lines()),
            at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
  EXPECT_EQ((ColumnTable{kFloatProperty, 1, floats({1, 2})}.lines()),
            at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
  const std::string fixed = R"("type": "VEC2", "componentType": "INT8", "array": true, "count": 3)";
  EXPECT_EQ((ColumnTable{fixed, 2, std::string(12, 'x')}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{fixed, 2, std::string(11, 'x')}.lines()),
            at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
}

TEST(PropertyTable, AnyCountIsComparedWithTheBytes) {
  for (const std::string count : {"9007199254740991", "4611686018427387904", "1e300"}) {
    ColumnTable table{R"("type": "MAT4", "componentType": "FLOAT64", "array": true, "count": 4096)",
                      7, floats({1, 2})};
    std::string text = table.text();
    text.replace(text.find(R"("count":7)"), 9, R"("count":)" + count);
    EXPECT_FALSE(verdict(text).empty()) << count;
  }
  const std::string wide =
      R"("type": "SCALAR", "componentType": "UINT8", "array": true, "count": 9007199254740991)";
  EXPECT_EQ((ColumnTable{wide, 2, "ab"}.lines()), at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
}

TEST(PropertyTable, OffsetsOfStringsAscendInsideTheValues) {
  const auto strings = [](std::initializer_list<std::uint32_t> offsets) {
    return ColumnTable{kStringProperty, 2, "oakpine", {}, packed<std::uint32_t>(offsets)}.lines();
  };
  const auto wrong = at_column("PROPERTY_TABLE_OFFSETS_INVALID", "stringOffsets");
  EXPECT_EQ(strings({0, 3, 7}), Lines{});
  EXPECT_EQ(strings({0, 0, 7}), Lines{}) << "an empty string";
  EXPECT_EQ(strings({0, 8, 7}), wrong);
  EXPECT_EQ(strings({0, 3, 8}), wrong);
  EXPECT_EQ(strings({0, 3, UINT32_MAX}), wrong);
  EXPECT_EQ(strings({1, 3, 7}), wrong) << "bytes before the first string";
  EXPECT_EQ(strings({0, 3, 6}), at_column("PROPERTY_TABLE_LENGTH_MISMATCH"))
      << "a byte of no string";
  EXPECT_EQ(strings({0, 3}), at_column("PROPERTY_TABLE_LENGTH_MISMATCH", "stringOffsets"));
}

TEST(PropertyTable, OffsetsHaveTheirType) {
  const std::string type = R"(, "stringOffsetType": ")";
  ColumnTable table{kStringProperty, 2, "oakpine", {}, packed<std::uint8_t>({0, 3, 7}),
                    type + "UINT8\""};
  EXPECT_EQ(table.lines(), Lines{});
  table.string_offsets = packed<std::uint16_t>({0, 3, 7});
  table.more = type + "UINT16\"";
  EXPECT_EQ(table.lines(), Lines{});
  table.string_offsets = packed<std::uint64_t>({0, 3, 7});
  table.more = type + "UINT64\"";
  EXPECT_EQ(table.lines(), Lines{});
  table.string_offsets = packed<std::uint64_t>({0, 3, std::uint64_t{1} << 63U});
  EXPECT_EQ(table.lines(), at_column("PROPERTY_TABLE_OFFSETS_INVALID", "stringOffsets"));
  table.more = type + "FLOAT32\"";
  EXPECT_EQ(table.lines(), at_column("VALUE_NOT_IN_LIST", "stringOffsetType"));
}

TEST(PropertyTable, OffsetsAreThereWhereLengthsVary) {
  EXPECT_EQ((ColumnTable{kStringProperty, 2, "oakpine"}.lines()),
            at_column("PROPERTY_TABLE_OFFSETS_MISSING", "stringOffsets"));
  const std::string list = kByteProperty + R"(, "array": true)";
  EXPECT_EQ((ColumnTable{list, 2, "abc"}.lines()),
            at_column("PROPERTY_TABLE_OFFSETS_MISSING", "arrayOffsets"));
  EXPECT_EQ((ColumnTable{list, 2, "abc", packed<std::uint32_t>({0, 2, 3})}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{list, 2, "abc", packed<std::uint32_t>({0, 2, 2})}.lines()),
            at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
  EXPECT_EQ((ColumnTable{list, 2, "abc", packed<std::uint32_t>({0, 2, 4})}.lines()),
            at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
  EXPECT_EQ((ColumnTable{list, 2, "abc", packed<std::uint32_t>({2, 0, 3})}.lines()),
            at_column("PROPERTY_TABLE_OFFSETS_INVALID", "arrayOffsets"));
  EXPECT_EQ((ColumnTable{kByteProperty, 2, "ab", packed<std::uint32_t>({0, 1, 2})}.lines()),
            at_column("PROPERTY_TABLE_OFFSETS_UNUSED", "arrayOffsets"));
}

TEST(PropertyTable, ListsOfStringsHaveBothOffsets) {
  ColumnTable table{kStringProperty + R"(, "array": true)", 2, "oakpinefir",
                    packed<std::uint32_t>({0, 2, 3}), packed<std::uint32_t>({0, 3, 7, 10})};
  EXPECT_EQ(table.lines(), Lines{});
  table.array_offsets = packed<std::uint32_t>({0, 2, 4});
  EXPECT_EQ(table.lines(), at_column("PROPERTY_TABLE_LENGTH_MISMATCH", "stringOffsets"));
  table.array_offsets = packed<std::uint32_t>({0, 2, UINT32_MAX});
  EXPECT_EQ(table.lines(), at_column("PROPERTY_TABLE_LENGTH_MISMATCH", "stringOffsets"));
}

TEST(PropertyTable, EachStringIsUtf8) {
  const auto strings = [](const std::string& values, std::uint32_t middle) {
    const auto end = static_cast<std::uint32_t>(values.size());
    return ColumnTable{kStringProperty, 2, values, {}, packed<std::uint32_t>({0, middle, end})}
        .lines();
  };
  EXPECT_EQ(strings("ch\xC3\xAAne", 4), Lines{});
  EXPECT_EQ(strings("ch\xC3\xAAne", 3), at_column("PROPERTY_TABLE_STRING_INVALID")) << "cut in two";
  EXPECT_EQ(strings("ch\xC3ne", 2), at_column("PROPERTY_TABLE_STRING_INVALID"));
  EXPECT_EQ(strings("abc\xC3", 2), at_column("PROPERTY_TABLE_STRING_INVALID")) << "at the end";
}

TEST(PropertyTable, ManyStringsAreReadInBlocks) {
  std::vector<std::uint32_t> offsets;
  std::string values;
  for (std::uint32_t i = 0; i <= 20000; ++i) {
    offsets.push_back(static_cast<std::uint32_t>(values.size()));
    if (i < 20000) values += "\xC3\xAA";
  }
  ColumnTable table{kStringProperty, 20000, values, {}, packed(offsets)};
  EXPECT_EQ(table.lines(), Lines{});
  offsets[4096] += 1;  // inside a character, between two blocks
  table.string_offsets = packed(offsets);
  EXPECT_EQ(table.lines(), at_column("PROPERTY_TABLE_STRING_INVALID"));
  offsets[12285] = 0;
  table.string_offsets = packed(offsets);
  EXPECT_EQ(table.lines().back(),
            at_column("PROPERTY_TABLE_OFFSETS_INVALID", "stringOffsets").front());
}

TEST(PropertyTable, FlagsAreBits) {
  const std::string flags = R"("type": "BOOLEAN")";
  EXPECT_EQ((ColumnTable{flags, 9, std::string("\xFF\x01")}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{flags, 9, std::string("\xFF\x03")}.lines()),
            at_column("PROPERTY_TABLE_PADDING"));
  EXPECT_EQ((ColumnTable{flags, 8, "\xFF"}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{flags, 9, "\xFF"}.lines()), at_column("PROPERTY_TABLE_LENGTH_MISMATCH"));
}

TEST(PropertyTable, EnumValuesAreListed) {
  const std::string property = R"("type": "ENUM", "enumType": "e")";
  const auto kinds = [](const std::string& type, const std::string& other) {
    return R"("e": {"valueType": ")" + type +
           R"(", "values": [{"name": "a", "value": 0}, {"name": "b", "value": )" + other + "}]}";
  };
  const auto column = [&](const std::string& values, const std::string& enums) {
    return ColumnTable{property, 2, values, {}, {}, {}, enums}.lines();
  };
  EXPECT_EQ(column(packed<std::int8_t>({0, -1}), kinds("INT8", "-1")), Lines{});
  EXPECT_EQ(column(packed<std::int8_t>({1, -1}), kinds("INT8", "-1")),
            at_column("METADATA_ENUM_VALUE_UNKNOWN", ""));
  EXPECT_EQ(column(packed<std::uint16_t>({0, 65535}), kinds("UINT16", "65535")), Lines{});
  EXPECT_EQ(column(packed<std::uint32_t>({0, 1}), kinds("UINT32", "4000000000")),
            at_column("METADATA_ENUM_VALUE_UNKNOWN", ""));
  EXPECT_EQ(column(packed<std::int64_t>({0, INT64_MIN}), kinds("INT64", "-9223372036854775808")),
            Lines{});
  EXPECT_EQ(column(packed<std::uint64_t>({0, UINT64_MAX}), kinds("UINT64", "18446744073709551615")),
            Lines{});
  EXPECT_EQ(
      column(packed<std::uint64_t>({0, UINT64_MAX - 1}), kinds("UINT64", "18446744073709551615")),
      at_column("METADATA_ENUM_VALUE_UNKNOWN", ""));
}

TEST(PropertyTable, FloatsAreFinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ((ColumnTable{kFloatProperty, 2, floats({1, kInfinity})}.lines()),
            at_column("METADATA_VALUE_NOT_FINITE", ""));
  const std::string wide = R"("type": "SCALAR", "componentType": "FLOAT64")";
  EXPECT_EQ(
      (ColumnTable{wide, 2, packed<double>({std::numeric_limits<double>::quiet_NaN(), 1})}.lines()),
      at_column("METADATA_VALUE_NOT_FINITE", ""));
  const std::string list = kFloatProperty + R"(, "array": true)";
  EXPECT_EQ(
      (ColumnTable{list, 2, floats({1, kInfinity}), packed<std::uint32_t>({0, 0, 2})}.lines()),
      at_column("METADATA_VALUE_NOT_FINITE", ""));
}

TEST(PropertyTable, ValuesLieWithinTheLimits) {
  const auto limited = [](const std::string& limits, const std::string& own) {
    return ColumnTable{kFloatProperty + limits, 3, floats({1, -9, 3}), {}, {}, own}.lines();
  };
  EXPECT_EQ(limited(R"(, "min": -9, "max": 3)", ""), Lines{});
  EXPECT_EQ(limited(R"(, "min": -9, "max": 2.5)", ""),
            at_column("METADATA_VALUE_BEYOND_LIMIT", ""));
  EXPECT_EQ(limited(R"(, "min": 0)", ""), at_column("METADATA_VALUE_BEYOND_LIMIT", ""));
  EXPECT_EQ(limited(R"(, "min": 0, "noData": -9)", ""), Lines{});
  EXPECT_EQ(limited("", R"(, "min": -9, "max": 3)"), Lines{});
  EXPECT_EQ(limited("", R"(, "max": 3.5)"), at_column("METADATA_LIMIT_NOT_REACHED", "max"));
  EXPECT_EQ(limited("", R"(, "min": -9.5)"), at_column("METADATA_LIMIT_NOT_REACHED", "min"));
  EXPECT_EQ(limited("", R"(, "min": -8)"), at_column("METADATA_VALUE_BEYOND_LIMIT", ""));
  EXPECT_EQ(limited(R"(, "noData": -9)", R"(, "min": 1, "max": 3)"), Lines{});
}

TEST(PropertyTable, LimitsAreOfEachComponent) {
  const std::string pair = R"("type": "VEC2", "componentType": "INT16", "noData": [-1, -1])";
  const std::string values = packed<std::int16_t>({1, 5, -1, -1, 3, 2});
  EXPECT_EQ((ColumnTable{pair, 3, values, {}, {}, R"(, "min": [1, 2], "max": [3, 5])"}.lines()),
            Lines{});
  EXPECT_EQ((ColumnTable{pair, 3, values, {}, {}, R"(, "min": [1, 2], "max": [3, 6])"}.lines()),
            at_column("METADATA_LIMIT_NOT_REACHED", "max"));
  const std::string list = kByteProperty + R"(, "array": true, "count": 5, "max": [9, 9, 9, 9, 4])";
  EXPECT_EQ((ColumnTable{list, 2, std::string("\1\1\1\1\4\2\2\2\2\3", 10)}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{list, 2, std::string("\1\1\1\1\4\2\2\2\2\5", 10)}.lines()),
            at_column("METADATA_VALUE_BEYOND_LIMIT", ""));
}

TEST(PropertyTable, NormalizedValuesAreCompared) {
  const std::string share = kByteProperty + R"(, "normalized": true, "offset": 10, "scale": -2)";
  const std::string values("\0\xFF", 2);
  EXPECT_EQ((ColumnTable{share, 2, values, {}, {}, R"(, "min": 8, "max": 10)"}.lines()), Lines{});
  EXPECT_EQ((ColumnTable{share, 2, values, {}, {}, R"(, "min": 0, "max": 10)"}.lines()),
            at_column("METADATA_LIMIT_NOT_REACHED", "min"));
  EXPECT_EQ(
      (ColumnTable{share, 2, values, {}, {}, R"(, "scale": 1, "offset": 0, "max": 1)"}.lines()),
      Lines{});
}

TEST(PropertyTable, EachNumberTypeHasLimits) {
  const auto column = [](const std::string& type, const std::string& values) {
    return ColumnTable{R"("type": "SCALAR", "max": 5, "componentType": ")" + type + "\"", 2, values}
        .lines();
  };
  const auto beyond = at_column("METADATA_VALUE_BEYOND_LIMIT", "");
  EXPECT_EQ(column("INT8", packed<std::int8_t>({-3, 5})), Lines{});
  EXPECT_EQ(column("INT8", packed<std::int8_t>({-3, 6})), beyond);
  EXPECT_EQ(column("UINT16", packed<std::uint16_t>({0, 6})), beyond);
  EXPECT_EQ(column("INT32", packed<std::int32_t>({-3, 5})), Lines{});
  EXPECT_EQ(column("INT32", packed<std::int32_t>({6, 0})), beyond);
  EXPECT_EQ(column("UINT32", packed<std::uint32_t>({UINT32_MAX, 0})), beyond);
  EXPECT_EQ(column("INT64", packed<std::int64_t>({-3, 5})), Lines{});
  EXPECT_EQ(column("INT64", packed<std::int64_t>({INT64_MAX, 5})), beyond);
  EXPECT_EQ(column("UINT64", packed<std::uint64_t>({UINT64_MAX, 5})), beyond);
  EXPECT_EQ(column("FLOAT64", packed<double>({-3, 5})), Lines{});
  EXPECT_EQ(column("FLOAT64", packed<double>({5.001, 5})), beyond);
}

TEST(PropertyTable, ColumnsThatShareBytesCostNoMoreThanTheFile) {
  const std::string values(1 << 16U, '\1');
  std::string columns, properties;
  for (int i = 0; i < 9000; ++i) {
    const std::string name = "\"p" + std::to_string(i) + "\": ";
    columns += (i == 0 ? "" : ", ") + name + R"({"values": 0, "max": 1})";
    properties += (i == 0 ? "" : ", ") + name + "{" + kByteProperty + "}";
  }
  DataAsset asset;
  asset.view(values);
  const std::string text = asset.text(
      R"("extensionsUsed": ["EXT_structural_metadata"], "extensions": {"EXT_structural_metadata":
      {"schema": {"id": "s", "classes": {"c": {"properties": {)" +
      properties + R"(}}}}, "propertyTables": [{"class": "c", "count": 65536, "properties": {)" +
      columns + "}}]}}");
  EXPECT_FALSE(places(text, "ACCESSOR_DATA_NOT_CHECKED").empty());
}

}  // namespace
}  // namespace gltfx::test
