// SPDX-License-Identifier: Apache-2.0
// What is kept: the report of the validation; the notes; the first picture as PNG where its own
// file does not hold it exactly; for each file what stands between the name and the ending, and the
// hash of its bytes.
#include "pipeline/cached_picture.hpp"

#include <gltfx/result_cache.hpp>
#include <gltfx/validate.hpp>
#include <gltfx/version.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <variant>

#include "base/build_id.hpp"
#include "base/text.hpp"
#include "container/container.hpp"
#include "pipeline/byte_list.hpp"
#include "pipeline/picture_file.hpp"
#include "pipeline/picture_names.hpp"
#include "report/packed.hpp"
#include "schema/set.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using codec::EncodedFormat;

// Whether the file of the first picture holds what the report has of it.
bool holds_exactly(EncodedFormat format, const BakeOptions& options) {
  const bool alone = options.layout == BakeLayout::files ||
                     (options.clip.empty() && options.turntable == 0) ||
                     (options.layout == BakeLayout::automatic && format == EncodedFormat::png);
  return alone && (format == EncodedFormat::png || format == EncodedFormat::webp);
}

void add(HashParts& parts, double number) { parts.add(std::bit_cast<std::uint64_t>(number)); }

void add_environment(HashParts& parts, const std::string& path) {
  if (path.empty()) return;
  const auto file = container::open_file(path);
  parts.add(file ? hash_bytes(file->bytes.text()) : Hash128());
}

// What was put between name and ending of the output.
std::string_view suffix_of(const std::string& written, const std::string& output) {
  const std::size_t name = fs::path(output).replace_extension().native().size();
  const std::size_t ending = fs::path(output).extension().native().size();
  return std::string_view(written).substr(name, written.size() - name - ending);
}

std::optional<BakedPixels> decoded(std::span<const std::byte> bytes, codec::ImageFormat format) {
  codec::ImageRequest request;
  request.bytes = bytes;
  request.format = format;
  request.pixels = true;
  const auto result = codec::Client::shared().decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  if (image == nullptr || image->bits != 8) return std::nullopt;
  const auto* first = reinterpret_cast<const std::uint8_t*>(image->pixels.data());
  return BakedPixels{
      image->width, image->height, image->channels, {first, first + image->pixels.size()}};
}

std::optional<BakeReport> report_without_pictures(ByteCursor& cursor, const std::string& path) {
  BakeReport report;
  report.path = path;
  std::string_view text;
  if (!cursor.take_text(text)) return std::nullopt;
  auto validation = report::unpack(text, rules());
  std::uint64_t notes = 0;
  if (!validation || !cursor.take(notes)) return std::nullopt;
  report.validation = *std::move(validation);
  report.validation.path = path;
  for (std::uint64_t i = 0; i < notes; ++i) {
    if (!cursor.take_text(text)) return std::nullopt;
    report.notes.emplace_back(text);
  }
  return report;
}

bool can_be_kept(const BakeOptions& options) {
  return options.cache && !options.output.empty() && !options.embed && options.seconds == 0;
}

}  // namespace

// Taken apart by name: a member that is added to the options has to be decided upon here.
Hash128 picture_key(const BakeOptions& options, const ResultCache& cache) {
  const auto& [sizes, turntable, clip, fps, layout, layers, quality, samples, bounces, seed,
               denoise, seconds, noise, literal_shader, lights, environment, environment_rotation,
               exposure, background, tone_map, overlay, cameras, projection, frame, interior, scene,
               animation, time, variant, if_present, strict, output, format, embed, root, searched,
               jobs, schemas, own_cache, progress] = options;
  // Where pictures lie is no part of them; the same come of any number of threads.
  static_cast<void>(output);
  static_cast<void>(jobs);
  static_cast<void>(searched);  // says whether the asset may be opened
  static_cast<void>(progress);
  static_cast<void>(own_cache);
  static_cast<void>(embed);
  static_cast<void>(seconds);
  HashParts parts;
  for (const std::string& text : {std::string("bake"), std::string(version()), build_id(), frame,
                                  scene, animation, variant, clip}) {
    parts.add(text);
  }
  for (const double number : {noise, exposure, time, environment_rotation, fps}) add(parts, number);
  for (const std::uint64_t number :
       {std::uint64_t{turntable}, static_cast<std::uint64_t>(layout),
        std::uint64_t{format ? static_cast<std::uint64_t>(*format) + 1 : 0},
        static_cast<std::uint64_t>(quality), std::uint64_t{samples.value_or(0)},
        std::uint64_t{bounces ? *bounces + 1ULL : 0}, std::uint64_t{seed}, std::uint64_t{denoise},
        std::uint64_t{literal_shader}, static_cast<std::uint64_t>(lights),
        static_cast<std::uint64_t>(projection), static_cast<std::uint64_t>(interior),
        static_cast<std::uint64_t>(background.kind), static_cast<std::uint64_t>(tone_map),
        static_cast<std::uint64_t>(overlay), std::uint64_t{strict}, std::uint64_t{if_present}}) {
    parts.add(number);
  }
  for (const std::uint8_t part : background.color) parts.add(std::uint64_t{part});
  parts.add(std::uint64_t{cameras.size()});
  for (const std::string& camera : cameras) parts.add(camera);
  parts.add(std::uint64_t{sizes.size()});
  for (const BakeSize& size : sizes) parts.add(std::uint64_t{size.width} << 32U | size.height);
  parts.add(std::uint64_t{layers.size()});
  for (const BakeLayer layer : layers) parts.add(static_cast<std::uint64_t>(layer));
  add_environment(parts, environment);
  parts.add(root.empty() ? root : (fs::path(cache.folder()) / root).lexically_normal().native());
  parts.add(schemas ? schemas->sources() : Hash128());
  return parts.finish();
}

std::optional<Hash128> PictureKey::of(const BakeOptions& options) {
  if (!can_be_kept(options)) return std::nullopt;
  std::call_once(once_, [&] { common_ = picture_key(options, *options.cache); });
  HashParts parts;
  parts.add(common_);
  parts.add(ending_of(options.output));
  return parts.finish();
}

std::optional<std::string> pack_pictures(const BakeReport& report, const BakeOptions& options) {
  const auto format = output_format(options);
  if (report.problem != BakeProblem::none || !format) return std::nullopt;
  std::string kept;
  append_text(kept, report::pack(report.validation));
  append_value(kept, std::uint64_t{report.notes.size()});
  for (const std::string& note : report.notes) append_text(kept, note);
  std::string png;
  if (!holds_exactly(*format, options)) {
    const BakedPixels& pixels = report.pixels;
    auto encoded = encode_png({pixels.width, pixels.height, pixels.channels, pixels.bytes, {}});
    if (!encoded) return std::nullopt;
    png = *std::move(encoded);
  }
  append_text(kept, png);
  for (const std::string& path : report.written) {
    const auto file = container::open_file(path);
    if (!file) return std::nullopt;
    append_text(kept, suffix_of(path, options.output));
    append_value(kept, hash_bytes(file->bytes.text()));
  }
  return kept;
}

std::optional<BakeReport> recall_pictures(std::string_view kept, const std::string& path,
                                          const BakeOptions& options) {
  const auto format = output_format(options);
  ByteCursor cursor(kept);
  auto begun = report_without_pictures(cursor, path);
  std::string_view png;
  if (!format || !begun || !cursor.take_text(png)) return std::nullopt;
  BakeReport& report = *begun;
  std::optional<BakedPixels> pixels;
  if (!png.empty()) pixels = decoded(std::as_bytes(std::span(png)), codec::ImageFormat::png);
  while (!cursor.empty()) {
    std::string_view suffix;
    Hash128 hash;
    if (!cursor.take_text(suffix) || !cursor.take(hash)) return std::nullopt;
    report.written.push_back(with_suffix(options.output, suffix));
    const auto file = container::open_file(report.written.back());
    if (!file || !(hash_bytes(file->bytes.text()) == hash)) return std::nullopt;
    if (pixels) continue;
    pixels = decoded(file->bytes.view(), *format == EncodedFormat::webp ? codec::ImageFormat::webp
                                                                        : codec::ImageFormat::png);
    if (!pixels) return std::nullopt;
  }
  if (!pixels) return std::nullopt;
  report.pixels = *std::move(pixels);
  return begun;
}

}  // namespace gltfx
