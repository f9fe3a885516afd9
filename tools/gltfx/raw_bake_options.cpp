// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "options.hpp"
#include "raw_options.hpp"
#include "reading.hpp"
#include "value_words.hpp"

namespace gltfx::tool {
namespace {

constexpr std::uint64_t kMostPixels = 16384;  // along a side
constexpr std::uint64_t kMost32 = 0xFFFFFFFFU;

std::vector<std::string_view> comma_parts(const std::vector<std::string>& texts) {
  std::vector<std::string_view> parts;
  for (const std::string& text : texts) {
    std::string_view rest = text;
    while (true) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      parts.push_back(rest.substr(0, comma));
      if (comma == rest.size()) break;
      rest.remove_prefix(comma + 1);
    }
  }
  return parts;
}

Result<std::uint32_t> parse_picture_size(std::string_view text, std::string_view whole) {
  const auto number = parse_number("--size", text, 1);
  if (number && *number <= kMostPixels) return static_cast<std::uint32_t>(*number);
  return Error{fmt::format("--size: {} is neither N nor WxH, each from 1 to {}.", quoted(whole),
                           kMostPixels)};
}

Result<BakeSize> parse_size(std::string_view text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = parse_picture_size(text.substr(0, cross), text);
  if (!width) return width.error();
  if (cross == text.size()) return BakeSize{*width, *width};
  const auto height = parse_picture_size(text.substr(cross + 1), text);
  if (!height) return height.error();
  return BakeSize{*width, *height};
}

Result<std::uint32_t> parse_count(std::string_view option, std::string_view text,
                                  std::uint64_t minimum, std::uint64_t maximum) {
  const auto number = parse_number(option, text, minimum);
  if (number && *number <= maximum) return static_cast<std::uint32_t>(*number);
  return Error{fmt::format("{}: {} is not a whole number from {} to {}.", option, quoted(text),
                           minimum, maximum)};
}

struct CountWord {
  std::string_view option, text;
  std::uint64_t minimum, maximum;
};

// Nothing where there is no text.
void read_count(Reading& reading, std::optional<std::uint32_t>& value, const CountWord& word) {
  if (word.text.empty()) return;
  std::uint32_t count = 0;
  reading.set(count, parse_count(word.option, word.text, word.minimum, word.maximum));
  value = count;
}

Result<std::string> parse_format(const std::string& text) {
  const auto known = std::find(kPictureFormats.begin(), kPictureFormats.end(), text);
  if (known != kPictureFormats.end()) return text;
  return unknown_word("--format", text, kPictureFormats);
}

void read_quality(Reading& reading, const RawBakeOptions& words, BakeOptions& bake) {
  if (!words.quality.empty()) reading.set(bake.quality, parse_quality(words.quality));
  read_count(reading, bake.samples, {"--samples", words.samples, 1, kMostBakeSamples});
  read_count(reading, bake.bounces, {"--bounces", words.bounces, 0, 1000});
  reading.set(bake.seed, parse_count("--seed", words.seed, 0, kMost32));
  reading.set(bake.denoise, parse_word<bool>("--denoise", words.denoise, kDenoiseWords));
  reading.set(bake.noise, parse_decimal("--noise", words.noise, 0, 1));
  reading.set(bake.seconds, parse_decimal("--time-budget", words.time_budget, 0, 1e6));
  reading.set(bake.literal_shader, parse_word<bool>("--shader", words.shader, kShaderWords));
}

void read_scene(Reading& reading, const RawBakeOptions& words, BakeOptions& bake) {
  reading.set(bake.lights, parse_lights(words.lights));
  reading.set(bake.exposure, parse_decimal("--exposure", words.exposure, -64, 64));
  reading.set(bake.time, parse_decimal("--time", words.time, -1e9, 1e9));
  bake.environment = words.environment;
  bake.camera = words.camera;
  if (!words.projection.empty()) {
    reading.set(bake.projection,
                parse_word<BakeProjection>("--projection", words.projection, kProjectionWords));
  }
  bake.frame = words.frame;
  if (!words.interior.empty()) {
    reading.set(bake.interior,
                parse_word<BakeInterior>("--interior", words.interior, kInteriorWords));
  }
  bake.scene = words.scene;
  bake.animation = words.animation;
  bake.variant = words.variant;
  bake.transparent = words.transparent;
  bake.strict = words.strict;
  bake.root = words.root;
}

void check(Reading& reading, const RawBakeOptions& words) {
  const bool compares = !words.compare.empty();
  require_files(reading, words.inputs.paths, "bake");
  reading.require(!words.output.empty() || words.embed || compares,
                  "bake: say where the picture goes with --output, or --embed it.");
  reading.require(!compares || words.inputs.paths.size() == 1,
                  "bake: --compare goes with one other file.");
  reading.require(!compares || !words.embed, "bake: --compare and --embed are mutually exclusive.");
  reading.require(
      !words.embed || words.time_budget == "0",
      "bake: --embed and --time-budget are mutually exclusive: what is in a file should "
      "not depend on the machine.");
  reading.require(words.cache.empty() || (!words.embed && !compares && words.time_budget == "0"),
                  "bake: --cache knows files that the same asset always gives; leave out --embed, "
                  "--compare and --time-budget.");
  reading.require(words.sheet.empty() || words.inputs.shard.empty(),
                  "bake: --shard draws some of the pictures, --sheet needs all; draw it in a run "
                  "without --shard, for which --cache saves the work of the others.");
  reading.require(words.sheet.empty() || !compares, "bake: --compare draws no --sheet.");
  reading.require(!compares || (words.turntable == "0" && words.layers.empty()),
                  "bake: --compare draws one picture, without --turntable and --layer.");
  reading.require(!words.output.empty() || words.layers.empty() || compares,
                  "bake: say where --layer goes with --output.");
  reading.require(words.time == "0" || !words.animation.empty(),
                  "bake: --time is that of an --animation; name one.");
}

}  // namespace

Result<double> parse_decimal(std::string_view option, std::string_view text, double least,
                             double greatest) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = read_double(text.data(), end, value);
  if (error != std::errc() || stop != end || !(value >= least) || !(value <= greatest)) {
    return Error{fmt::format("{}: {} is not a number from {} to {}.", option, quoted(text), least,
                             greatest)};
  }
  return value;
}

Result<BakeLights> parse_lights(std::string_view text) {
  return parse_word<BakeLights>("--lights", text, kLightWords);
}

Result<BakeQuality> parse_quality(std::string_view text) {
  return parse_word<BakeQuality>("--quality", text, kQualityWords);
}

Result<std::vector<BakeLayer>> parse_layers(const std::vector<std::string>& texts) {
  std::vector<BakeLayer> layers;
  for (const std::string_view name : comma_parts(texts)) {
    const auto layer = parse_word<BakeLayer>("--layer", name, kLayerWords);
    if (!layer) return layer.error();
    if (std::find(layers.begin(), layers.end(), *layer) == layers.end()) layers.push_back(*layer);
  }
  return layers;
}

Result<std::vector<BakeSize>> parse_sizes(const std::vector<std::string>& texts) {
  if (texts.empty()) return std::vector<BakeSize>{BakeSize{}};
  std::vector<BakeSize> sizes;
  for (const std::string_view text : comma_parts(texts)) {
    const auto size = parse_size(text);
    if (!size) return size.error();
    const auto same = [&](const BakeSize& each) {
      return each.width == size->width && each.height == size->height;
    };
    if (std::none_of(sizes.begin(), sizes.end(), same)) sizes.push_back(*size);
  }
  return sizes;
}

Result<BakeRequest> request_of(const RawBakeOptions& words) {
  Reading reading;
  BakeRequest request;
  read_common(reading, words.common, request.common);
  read_inputs(reading, words.inputs, "bake", request.paths);
  check(reading, words);
  reading.set(request.bake.sizes, parse_sizes(words.sizes));
  reading.set(request.bake.layers, parse_layers(words.layers));
  reading.set(request.bake.turntable, parse_count("--turntable", words.turntable, 0, 3600));
  read_quality(reading, words, request.bake);
  read_scene(reading, words, request.bake);
  reading.set(request.format, parse_format(words.format));
  request.bake.output = words.output;
  request.bake.embed = words.embed;
  request.bake.jobs = request.common.jobs;
  request.sheet = words.sheet;
  request.compare = words.compare;
  request.cache = {words.cache, words.cache_key};
  reading.require(words.cache_key.empty() || !words.cache.empty(), kKeyWithoutCache);
  request.quiet = words.quiet;
  request.schema_files = words.schema_files;
  request.schema_folders = words.schema_folders;
  return reading.finish(request);
}

}  // namespace gltfx::tool
