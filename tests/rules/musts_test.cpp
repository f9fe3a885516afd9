// SPDX-License-Identifier: Apache-2.0
// Requirements of the specification and its extensions: each row of a table in musts/ violates one
// requirement in an otherwise valid asset, and names the error, or the warning for a
// recommendation. HACKING.md has the format.
#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rules/data_asset.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

using OrderedJson = nlohmann::ordered_json;

const std::filesystem::path kMusts = GLTFX_SOURCE_DIR "/tests/rules/musts";

OrderedJson read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  return OrderedJson::parse(file);
}

std::string deep_png(PngColor color, const std::string& texel) {
  return encode_png({1, 1, color, 16, texel, {}});
}

std::string picture_of(const std::string& name) {
  static const std::map<std::string, std::string> pictures{
      {"rgb8", rgb_png()},
      {"rgba8", rgba_png()},
      {"grey8", grey_png()},
      {"rgb16", deep_png(PngColor::rgb, "\x10\x80\xF0\x10\x80\xF0")},
      {"rgba16", deep_png(PngColor::rgba, "\x10\x80\xF0\x10\x80\xF0\x40\x40")},
      {"grey16", deep_png(PngColor::grey, "\x10\x80")},
      {"jpeg", jpeg_header()},
      {"cmyk", jpeg_header(4)},
      {"webp", webp_header(false)},
  };
  return pictures.at(name);
}

// --- Edits: JSON pointers and values; null deletes ---

void edit_value(OrderedJson& document, const std::string& pointer, const OrderedJson& value) {
  const OrderedJson::json_pointer place(pointer);
  if (!value.is_null()) {
    document[place] = value;
    return;
  }
  OrderedJson& holder = document.at(place.parent_pointer());
  if (holder.is_array()) {
    holder.erase(std::stoul(place.back()));
  } else {
    ASSERT_EQ(holder.erase(place.back()), 1U) << pointer;
  }
}

void edit_all(OrderedJson& document, const OrderedJson& row, const char* edits) {
  if (!row.contains(edits)) return;
  for (const auto& [pointer, value] : row.at(edits).items()) edit_value(document, pointer, value);
}

// --- Bytes: accessors have `values`, views have `bytes` or a `picture` ---

void append_little_endian(std::string& out, std::uint32_t bits, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) out += static_cast<char>((bits >> (8 * i)) & 0xFFU);
}

void append_component(std::string& out, const OrderedJson& value, int type) {
  if (type == kFloat) {
    const float number =
        value.is_string() ? std::stof(value.get<std::string>()) : value.get<float>();
    return append_little_endian(out, std::bit_cast<std::uint32_t>(number), 4);
  }
  const std::size_t size = type == kUint32 ? 4 : type < kInt16 ? 1 : 2;
  append_little_endian(out, static_cast<std::uint32_t>(value.get<std::int64_t>()), size);
}

std::size_t components_of(const OrderedJson& accessor) {
  static const std::map<std::string, std::size_t> counts{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  return counts.at(accessor.at("type"));
}

class DocumentPacker {
 public:
  explicit DocumentPacker(OrderedJson document) : document_(std::move(document)) {}

  OrderedJson build() {
    if (document_.contains("bufferViews")) {
      for (OrderedJson& view : document_["bufferViews"]) add_given(view);
    }
    if (document_.contains("accessors")) {
      for (OrderedJson& accessor : document_["accessors"]) add_accessor(accessor);
    }
    if (made_.json.contains("bufferViews")) document_["bufferViews"] = made_.json["bufferViews"];
    if (!made_.bytes.empty()) {
      document_["buffers"][0] = {{"byteLength", made_.bytes.size()},
                                 {"uri", buffer_uri(made_.bytes)}};
    }
    embed_pictures(document_);
    return document_;
  }

  static void embed_pictures(OrderedJson& document) {
    if (!document.contains("images")) return;
    for (OrderedJson& image : document["images"]) {
      if (!image.contains("picture")) continue;
      const std::string bytes = picture_of(image["picture"]);
      const std::string type = image.value("type", Textured::type_of(bytes));
      image.erase("picture");
      image.erase("type");
      image["uri"] = "data:" + type + ";base64," + base64(bytes);
    }
  }

 private:
  // A view without either is kept unchanged.
  void add_given(OrderedJson& view) {
    if (view.contains("picture")) {
      const std::string bytes = picture_of(view["picture"]);
      view.erase("picture");
      made_.view(bytes, view);
    } else if (view.contains("bytes")) {
      const std::string bytes = raw(view["bytes"]);
      view.erase("bytes");
      made_.view(bytes, view);
    } else {
      made_.add("bufferViews", view);
    }
  }

  static std::string raw(const OrderedJson& numbers) {
    std::string bytes;
    for (const OrderedJson& number : numbers) append_component(bytes, number, kUint8);
    return bytes;
  }

  static std::string pack(const OrderedJson& values, int type, std::size_t components,
                          std::size_t stride) {
    std::string bytes;
    for (std::size_t i = 0; i < values.size(); ++i) {
      append_component(bytes, values[i], type);
      const bool last = (i + 1) % components == 0;
      if (last && stride != 0) bytes.resize((i + 1) / components * stride);
    }
    return bytes;
  }

  void add_accessor(OrderedJson& accessor) {
    const OrderedJson more = accessor.value("view", OrderedJson::object());
    accessor.erase("view");
    const int type = accessor.value("componentType", 0);
    if (accessor.contains("values")) {
      const OrderedJson values = accessor["values"];
      const std::size_t components = components_of(accessor);
      accessor.erase("values");
      if (!accessor.contains("count")) accessor["count"] = values.size() / components;
      const std::size_t stride = more.value("byteStride", std::size_t{0});
      accessor["bufferView"] = made_.view(pack(values, type, components, stride), more);
    }
    if (accessor.contains("bytes")) {
      accessor["bufferView"] = made_.view(raw(accessor["bytes"]), more);
      accessor.erase("bytes");
    }
    if (!accessor.contains("sparse")) return;
    OrderedJson& indices = accessor["sparse"]["indices"];
    indices["bufferView"] = made_.view(pack(indices["values"], indices["componentType"], 1, 0));
    indices.erase("values");
    OrderedJson& values = accessor["sparse"]["values"];
    values["bufferView"] = made_.view(pack(values["values"], type, components_of(accessor), 0));
    values.erase("values");
  }

  OrderedJson document_;
  AssetBuilder made_;
};

// --- Rows ---

// An asset, or another one with edits.
OrderedJson base_of(const std::string& name, const OrderedJson& bases) {
  const OrderedJson& base = bases.at(name);
  if (!base.contains("from")) return base;
  OrderedJson document = base_of(base.at("from"), bases);
  edit_all(document, base, "given");
  return document;
}

// `given` changes the base into its variant; `values` are edits before bytes are packed, `set`
// after.
std::string asset_of_row(const OrderedJson& row, const OrderedJson& bases, bool violating) {
  OrderedJson document = base_of(row.at("base"), bases);
  edit_all(document, row, "given");
  if (violating) edit_all(document, row, "values");
  document = DocumentPacker(std::move(document)).build();
  if (!violating) return document.dump();
  edit_all(document, row, "set");
  DocumentPacker::embed_pictures(document);
  return document.dump();
}

std::set<std::string> findings_of(const std::string& asset, Severity least) {
  std::set<std::string> lines;
  for (const Diagnostic& each : validate_bytes(asset, "test").diagnostics) {
    if (each.severity <= least) lines.insert(std::string(each.code) + " " + each.pointer);
  }
  return lines;
}

std::set<std::string> lines_of(const OrderedJson& lines) {
  if (lines.is_array()) return lines.get<std::set<std::string>>();
  return {lines.get<std::string>()};
}

class Musts : public testing::TestWithParam<std::string> {};

TEST_P(Musts, AreErrorsWhereTheyAreBroken) {
  const OrderedJson bases = read_table(kMusts / "bases.json");
  std::set<std::string> names;
  for (const OrderedJson& row : read_table(kMusts / (GetParam() + ".json"))) {
    const bool must = row.contains("must");
    const std::string name = row.at(must ? "must" : "should");
    SCOPED_TRACE(name);
    EXPECT_TRUE(names.insert(name).second) << "is there twice";
    EXPECT_EQ(findings_of(asset_of_row(row, bases, false), Severity::warning),
              std::set<std::string>{});
    const std::set<std::string> expected = lines_of(row.at(must ? "error" : "warning"));
    EXPECT_FALSE(expected.empty());
    const std::string broken = asset_of_row(row, bases, true);
    EXPECT_EQ(findings_of(broken, must ? Severity::error : Severity::warning), expected);
    if (must) continue;
    EXPECT_EQ(findings_of(broken, Severity::error), std::set<std::string>{});
  }
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kMusts)) {
    if (entry.path().stem() != "bases") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Tables, Musts, testing::ValuesIn(table_names()),
                         [](const auto& table) { return table.param; });

}  // namespace
}  // namespace gltfx::test
