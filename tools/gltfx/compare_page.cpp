// SPDX-License-Identifier: Apache-2.0
#include "compare_page.hpp"

#include <gltfx/version.hpp>

#include <cmath>
#include <string_view>

#include "container/base64.hpp"
#include "pipeline/encode_pixels.hpp"
#include "report/page_source.hpp"

namespace gltfx::tool {
namespace {

constexpr std::uint32_t kPageQuality = 88;  // WebP

void write_source(json::Writer& writer, std::string_view name, const BakedPixels& pixels) {
  writer.key(name);
  if (pixels.bytes.empty()) return writer.null();
  const auto bytes = encode_pixels(pixels, codec::EncodedFormat::webp, kPageQuality);
  if (!bytes) return writer.null();
  writer.string(container::data_uri("image/webp", *bytes));
}

// Four digits: a part of a picture.
void write_part(json::Writer& writer, std::string_view name, double part) {
  writer.key(name);
  writer.number(std::round(part * 1e4) / 1e4);
}

void write_picture(json::Writer& writer, const ComparePicture& picture) {
  writer.begin_object();
  write_picture_verdict(writer, picture);
  write_source(writer, "old", picture.old_pixels);
  write_source(writer, "new", picture.new_pixels);
  write_source(writer, "difference", picture.difference);
  writer.key("regions");
  writer.begin_array();
  for (const PictureRegion& region : picture.regions) {
    writer.begin_object();
    writer.member("change", std::uint64_t{region.change});
    writer.member("old", region.is_old);
    write_part(writer, "left", region.left);
    write_part(writer, "top", region.top);
    write_part(writer, "right", region.right);
    write_part(writer, "bottom", region.bottom);
    writer.end_object();
  }
  writer.end_array();
  writer.end_object();
}

}  // namespace

void ComparePageWriter::begin(const std::string& title, std::string& out) {
  out += report::compare_page_begin();
  std::string json;
  json::Writer writer(json);
  writer.begin_object();
  writer.member("gltfx", version());
  writer.member("title", title);
  writer.key("pairs");
  report::append_page_json(out, json);
  out += "[";
}

void ComparePageWriter::pair(const CompareReport& report, std::string& out) {
  out += has_pairs_ ? ",\n" : "\n";
  has_pairs_ = true;
  std::string json;
  json::Writer writer(json);
  write_compare_pair(writer, report, write_picture);
  report::append_page_json(out, json);
}

void ComparePageWriter::end(const CompareSummary& summary, std::string& out) {
  std::string json;
  json::Writer writer(json);
  write_compare_summary(writer, summary);
  out += "\n],\"summary\":";
  report::append_page_json(out, json);
  out += "}";
  out += report::compare_page_end();
}

}  // namespace gltfx::tool
