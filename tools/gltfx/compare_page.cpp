// SPDX-License-Identifier: Apache-2.0
#include "compare_page.hpp"

#include <gltfx/version.hpp>

#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "container/base64.hpp"
#include "pipeline/encode_pixels.hpp"
#include "report/page_source.hpp"

namespace gltfx::tool {
namespace {

constexpr std::uint32_t kPageQuality = 88;  // WebP

constexpr std::string_view kSideNames[] = {"old", "new", "difference"};

// A block of JSON. `id`: empty: that of a pair.
void append_block(std::string& out, std::string_view id, std::string json) {
  out += "<script type=\"application/json\"";
  if (!id.empty()) out += fmt::format(" id=\"{}\"", id);
  out += '>';
  report::append_page_json(out, std::move(json));
  out += "</script>\n";
}

/// The pictures of a pair. They are elements of their own, which the page reads when it shows them:
/// the text with the changes stays short.
class PagePictures {
 public:
  explicit PagePictures(std::uint64_t pair) : pair_(pair) {}

  // A view that shows no change has one picture.
  void write(json::Writer& writer, const ComparePicture& picture) {
    const bool same = picture.has_both() && !picture.changed();
    const BakedPixels none;
    const BakedPixels* sides[] = {same ? &none : &picture.old_pixels, &picture.new_pixels,
                                  same ? &none : &picture.difference};
    writer.begin_object();
    write_picture_verdict(writer, picture);
    for (std::size_t i = 0; i < 3; ++i) {
      writer.key(kSideNames[i]);
      write_source(writer, *sides[i], fmt::format("p{}-{}-{}", pair_, count_, kSideNames[i]));
    }
    ++count_;
    write_regions(writer, picture);
    writer.end_object();
  }

  const std::string& elements() const { return elements_; }

 private:
  void write_source(json::Writer& writer, const BakedPixels& pixels, const std::string& id) {
    if (pixels.bytes.empty()) return writer.null();
    const auto bytes = encode_pixels(pixels, codec::EncodedFormat::webp, kPageQuality);
    if (!bytes) return writer.null();
    writer.string(id);
    elements_ += fmt::format("<data id=\"{}\" value=\"{}\"></data>\n", id,
                             container::data_uri("image/webp", *bytes));
  }

  static void write_regions(json::Writer& writer, const ComparePicture& picture);

  std::uint64_t pair_, count_ = 0;
  std::string elements_;
};

// Four digits: a part of a picture.
void write_part(json::Writer& writer, std::string_view name, double part) {
  writer.key(name);
  writer.number(std::round(part * 1e4) / 1e4);
}

void PagePictures::write_regions(json::Writer& writer, const ComparePicture& picture) {
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
}

}  // namespace

void ComparePageWriter::begin(const std::string& title, std::string& out) {
  out += report::compare_page_begin();
  std::string json;
  json::Writer writer(json);
  writer.begin_object();
  writer.member("gltfx", version());
  writer.member("title", title);
  writer.end_object();
  append_block(out, "head", std::move(json));
}

void ComparePageWriter::pair(const CompareReport& report, std::string& out) {
  PagePictures pictures(pairs_++);
  std::string json;
  json::Writer writer(json);
  write_compare_pair(writer, report, [&](json::Writer& to, const ComparePicture& picture) {
    pictures.write(to, picture);
  });
  out += pictures.elements();
  append_block(out, "", std::move(json));
}

void ComparePageWriter::end(const CompareSummary& summary, std::string& out) {
  std::string json;
  json::Writer writer(json);
  write_compare_summary(writer, summary);
  append_block(out, "tail", std::move(json));
  out += report::compare_page_end();
}

}  // namespace gltfx::tool
