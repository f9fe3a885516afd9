// SPDX-License-Identifier: Apache-2.0
// Images by their headers: no pixel is decoded.
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "base/checked.hpp"
#include "measure/image_facts.hpp"
#include "measure/mesh_memory.hpp"
#include "measure/take.hpp"

namespace gltfx::measure {
namespace {

using model::RootArray;

bool is_power_of_two(std::uint32_t side) { return std::has_single_bit(side); }

class ImageColumns {
 public:
  explicit ImageColumns(Taking& taking) : taking_(taking) {}

  // What needs the bytes of the image.
  void take_header(std::size_t image, const ImageFacts& facts) {
    constexpr std::string_view kUnread = "The header of the image could not be read.";
    const bool read = facts.width > 0 && facts.height > 0;
    const auto set = [&](Name name, auto value) {
      Column* column = taking_.column(MeasureScope::image, name);
      if (column == nullptr) return;
      if (!read) return column->could_not_be_taken(image, kUnread);
      column->set(image, value());
    };
    const std::uint64_t longer = std::max(facts.width, facts.height);
    const std::uint64_t shorter = std::min(facts.width, facts.height);
    const std::uint64_t pixels = std::uint64_t{facts.width} * facts.height;
    set(Name::width_pixels, [&] { return std::uint64_t{facts.width}; });
    set(Name::height_pixels, [&] { return std::uint64_t{facts.height}; });
    set(Name::texture_size, [&] { return longer; });
    set(Name::pixels, [&] { return pixels; });
    set(Name::aspect,
        [&] { return MeasureValue(static_cast<double>(longer) / static_cast<double>(shorter)); });
    set(Name::power_of_two, [&] {
      return MeasureValue(is_power_of_two(facts.width) && is_power_of_two(facts.height));
    });
    set(Name::bits, [&] { return std::uint64_t{facts.bits}; });
    set(Name::levels, [&] { return std::uint64_t{facts.levels}; });
    set(Name::image_format, [&] { return MeasureValue(facts.format); });
    set(Name::channels_image, [&] { return MeasureValue(facts.channels); });
    set(Name::gpu_bytes, [&] { return facts.gpu_bytes; });
    total_ = saturating_add(total_, pixels);
    memory_ = saturating_add(memory_, facts.gpu_bytes);
    if (!read && unread_.empty()) {
      unread_ = "The header of image " + std::to_string(image) + " could not be read.";
    }
  }

  void take_totals() {
    set_total(Name::total_pixels, total_);
    set_total(Name::gpu_image_bytes, memory_);
  }
  // Images and meshes together.
  void take_memory(std::uint64_t meshes) {
    set_total(Name::gpu_bytes, saturating_add(memory_, meshes));
  }

 private:
  void set_total(Name name, std::uint64_t value) {
    Column* column = taking_.column(MeasureScope::asset, name);
    if (column == nullptr) return;
    if (!unread_.empty()) return column->could_not_be_taken(0, unread_);
    column->set(0, value);
  }

  Taking& taking_;
  std::uint64_t total_ = 0, memory_ = 0;
  std::string unread_;  // a sentence about the first image without a header
};

}  // namespace

void take_images(Taking& taking) {
  const Source& source = taking.source();
  std::vector<std::string> problems;  // a value that is missing has its reason
  const auto facts = image_facts(source.asset(), source.resources(), {}, problems);
  ImageColumns columns(taking);
  Column* bytes = taking.column(MeasureScope::image, Name::image_bytes);
  for (std::size_t i = 0; i < facts.size(); ++i) {
    columns.take_header(i, facts[i]);
    if (bytes == nullptr) continue;
    const auto& encoded = source.resources().images[i].bytes;
    if (encoded) {
      bytes->set(i, std::uint64_t{encoded->size()});
    } else {
      bytes->could_not_be_taken(i, "The image could not be read.");
    }
  }
  columns.take_totals();
  if (taking.column(MeasureScope::asset, Name::gpu_bytes) != nullptr) {
    columns.take_memory(mesh_memory(source));
  }
}

}  // namespace gltfx::measure
