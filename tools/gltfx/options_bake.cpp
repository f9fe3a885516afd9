// SPDX-License-Identifier: Apache-2.0
// `gltfx bake`.
#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "base/hex.hpp"
#include "base/text.hpp"
#include "option_parts.hpp"
#include "option_values.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {
namespace {

constexpr std::uint32_t kMostPixels = 16384;  // along a side
constexpr std::uint32_t kMost32 = 0xFFFFFFFFU;

std::vector<std::string_view> comma_parts(const Words& texts) {
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

Result<std::uint32_t> parse_side(std::string_view option, std::string_view text,
                                 std::string_view whole) {
  const auto number = parse_number(option, text, 1);
  if (number && *number <= kMostPixels) return static_cast<std::uint32_t>(*number);
  return Error{fmt::format("{}: {} is neither N nor WxH, each from 1 to {}.", option, quoted(whole),
                           kMostPixels)};
}

Result<BakeSize> parse_size(std::string_view option, std::string_view text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = parse_side(option, text.substr(0, cross), text);
  if (!width) return width.error();
  if (cross == text.size()) return BakeSize{*width, *width};
  const auto height = parse_side(option, text.substr(cross + 1), text);
  if (!height) return height.error();
  return BakeSize{*width, *height};
}

// The parts of comma lists, each one once, by a function (option, part) that gives a Result.
template <class T, class Parse, class Same>
Binding comma_list(std::vector<T>& member, Parse parse, Same same,
                   std::function<Values()> values = nullptr) {
  const auto parse_all = [parse, same](std::string_view option,
                                       const Words& words) -> Result<std::vector<T>> {
    std::vector<T> all;
    for (const std::string_view part : comma_parts(words)) {
      const auto one = parse(option, part);
      if (!one) return one.error();
      if (std::none_of(all.begin(), all.end(), [&](const T& each) { return same(each, *one); })) {
        all.push_back(*one);
      }
    }
    return all;
  };
  return parsed_list(member, parse_all, std::move(values));
}

Binding each_once(Words& member) {
  return parsed_list(member, [](std::string_view, const Words& words) -> Result<Words> {
    Words all;
    for (const std::string& word : words) {
      if (std::find(all.begin(), all.end(), word) == all.end()) all.push_back(word);
    }
    return all;
  });
}

Binding sizes(std::vector<BakeSize>& member) {
  return comma_list(member, parse_size, [](const BakeSize& a, const BakeSize& b) {
    return a.width == b.width && a.height == b.height;
  });
}

Binding layers(std::vector<BakeLayer>& member) {
  const Choices<BakeLayer> names{{"albedo", BakeLayer::albedo},
                                 {"normal", BakeLayer::normal},
                                 {"depth", BakeLayer::depth},
                                 {"material", BakeLayer::material}};
  const auto parse = [names](std::string_view option, std::string_view part) {
    return choose(option, part, names);
  };
  return comma_list(member, parse, std::equal_to<>(), [offered = values_of(names)] {
    Values values = offered();
    values.commas = true;
    return values;
  });
}

// "#f80", "ff8800"; without '#', which begins a comment in a shell.
std::optional<std::array<std::uint8_t, 3>> parse_color(std::string_view text) {
  if (text == "black") return std::array<std::uint8_t, 3>{0, 0, 0};
  if (text == "white") return std::array<std::uint8_t, 3>{255, 255, 255};
  if (text.starts_with('#')) text.remove_prefix(1);
  if (text.size() != 3 && text.size() != 6) return std::nullopt;
  const std::size_t digits = text.size() / 3;
  std::array<std::uint8_t, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const int first = hex_value(text[c * digits]);
    const int last = hex_value(text[c * digits + digits - 1]);
    if (first < 0 || last < 0) return std::nullopt;
    color[c] = static_cast<std::uint8_t>(first * 16 + last);
  }
  return color;
}

Binding background(BakeBackground& member) {
  using Kind = BakeBackground::Kind;
  const Choices<Kind> names{{"studio", Kind::studio},
                            {"environment", Kind::environment},
                            {"transparent", Kind::transparent}};
  const auto parse = [names](std::string_view option,
                             std::string_view word) -> Result<BakeBackground> {
    if (const auto color = parse_color(word)) return BakeBackground{Kind::color, *color};
    for (const auto& [name, kind] : names) {
      if (name == word) return BakeBackground{kind};
    }
    return Error{
        fmt::format("{}: {} is not studio, environment, transparent or a color such as white, "
                    "black or #ff8800.",
                    option, quoted(word))};
  };
  return parsed(member, parse, [] {
    return values::choice({"studio", "environment", "transparent", "white", "black"});
  });
}

void declare_outputs(Options& options, BakeRequest& request) {
  BakeOptions& bake = request.bake;
  options.add("-o,--output", "FILE|DIR", "Output .png, .webp, .jpg or .exr file, or a folder",
              text(bake.output, values::pictures_or_folder));
  options.add(
      "-f,--format", "NAME", "Format: png (default in folders), webp, jpeg, exr",
      one_of(request.format,
             {{"png", "png"}, {"webp", "webp"}, {"jpeg", "jpeg"}, {"jpg", "jpg"}, {"exr", "exr"}}));
  options.add("--sheet", "FILE", "Contact sheet (default: DIR/contact-sheet.png)",
              text(request.sheet, values::pictures));
  options.add("--size", "N|WxH", "Size in pixels (default: 512; repeatable)", sizes(bake.sizes));
  options.add("--turntable", "N", "Number of frames of a full rotation",
              number(bake.turntable, 0, kMostBakeFrames));
  options.add("--clip", "NAME|N", "Draw this animation as it moves", text(bake.clip));
  options.add("--fps", "N", "Frames per second (default: 24; turntable 12)",
              decimal(bake.fps, 0, 1000));
  options.add("--layout", "NAME", "Frames: files, animation (default in .webp), sprites",
              one_of(bake.layout, {{"files", BakeLayout::files},
                                   {"animation", BakeLayout::animation},
                                   {"sprites", BakeLayout::sprites}}));
  options.add("--layer", "NAME", "Extra layer: albedo, normal, depth, material",
              layers(bake.layers));
  options.add("--overlay", "NAME", "Show wireframe, uv, clay, density or facing",
              one_of(bake.overlay, {{"wireframe", BakeOverlay::wireframe},
                                    {"uv", BakeOverlay::uv},
                                    {"clay", BakeOverlay::clay},
                                    {"density", BakeOverlay::density},
                                    {"facing", BakeOverlay::facing}}));
  options.add("--embed", "", "Embed the picture as the thumbnail of the asset", flag(bake.embed));
  options.add("--compare", "PATH", "Compare with PATH; write the difference to -o",
              text(request.compare, [] {
                return values::files({"gltf", "glb", "vrm"});
              }));
}

void declare_scene(Options& options, BakeOptions& bake) {
  options.add("--camera", "NAME|N|AZ,EL", "Asset camera, front, iso or 30,20; repeatable",
              each_once(bake.cameras));
  options.add("--projection", "NAME", "perspective (default) or orthographic",
              one_of(bake.projection, {{"perspective", BakeProjection::perspective},
                                       {"orthographic", BakeProjection::orthographic}}),
              {.name = "projection", .place = 170, .otherwise = "perspective"});
  options.add("--interior", "WHEN", "View from inside: auto (default), on, off",
              one_of(bake.interior, {{"auto", BakeInterior::automatic},
                                     {"on", BakeInterior::on},
                                     {"off", BakeInterior::off}}),
              {.name = "interior", .place = 190, .otherwise = "auto"});
  options.add("--frame", "NODE", "Frame this node: name, index or /nodes/N", text(bake.frame),
              {.name = "frame", .place = 180, .otherwise = "everything"});
  options.add("--lights", "WHICH", "Lights: asset, studio or both (default)",
              one_of(bake.lights, {{"asset", BakeLights::asset},
                                   {"studio", BakeLights::studio},
                                   {"both", BakeLights::both}}));
  options.add(
      "--environment", "FILE", "Equirectangular environment map (.hdr, .exr, ...)",
      text(bake.environment,
           [] {
             return values::files({"hdr", "exr"});
           }),
      {.name = "environment", .form = ConfigForm::path, .place = 150, .otherwise = "a studio"});
  options.add("--rotate-environment", "DEGREES", "Rotate the light around the asset (default: 0)",
              decimal(bake.environment_rotation, -3600, 3600));
  options.add("--background", "WHAT", "studio, environment, transparent or color (#ff8800)",
              background(bake.background),
              {.name = "background", .place = 152, .otherwise = "environment, else studio"});
  options.add("--exposure", "STOPS", "Exposure in stops (default: 0)",
              decimal(bake.exposure, -64, 64));
  options.add("--tone-map", "NAME", "Tone mapping: neutral (default), aces, agx or none",
              one_of(bake.tone_map, {{"neutral", BakeToneMap::neutral},
                                     {"aces", BakeToneMap::aces},
                                     {"agx", BakeToneMap::agx},
                                     {"none", BakeToneMap::none}}),
              {.name = "tone-map", .place = 153, .otherwise = "neutral"});
  options.add("--scene", "NAME|N", "Scene (default: that of the asset)", text(bake.scene));
  options.add("--animation", "NAME|N", "Pose by this animation or none (default: idle)",
              text(bake.animation));
  options.add("--time", "SECONDS", "Time in the animation (default: 0)",
              decimal(bake.time, -1e9, 1e9));
  options.add("--variant", "NAME|N", "Material variant", text(bake.variant));
  options.add("--if-present", "", "Ignore named animations, cameras, variants if absent",
              flag(bake.if_present));
  options.add("--strict", "", "Refuse assets with errors, or with parts left out",
              flag(bake.strict));
}

void declare_effort(Options& options, BakeOptions& bake) {
  add_quality(options, bake.quality, "Quality: draft, standard (default) or final",
              {.name = "quality", .place = 160, .otherwise = "standard"});
  options.add("--samples", "N", "Samples per pixel (4, up to 44 or 256 by --quality)",
              number(bake.samples, 1, kMostBakeSamples));
  options.add("--bounces", "N", "Maximum path depth (default: 6; final 12)",
              number(bake.bounces, 0, 1000));
  options.add("--seed", "N", "Random seed (default: 0)", number(bake.seed, 0, kMost32));
  options.add("--denoise", "on|off", "Denoise the picture (default: on)",
              one_of(bake.denoise, {{"on", true}, {"off", false}}));
  options.add("--noise", "TARGET", "Target error per pixel, 0 to 1 (default: 0, off)",
              decimal(bake.noise, 0, 1));
  options.add("--time-budget", "SECONDS", "Time limit per picture; not reproducible",
              decimal(bake.seconds, 0, 1e6));
  options.add("--shader", "NAME", "Shading: conserving (default) or spec",
              one_of(bake.literal_shader, {{"spec", true}, {"conserving", false}}));
}

BakeFormat format_named(std::string_view name) {
  if (name == "webp") return BakeFormat::webp;
  if (name == "exr") return BakeFormat::exr;
  return name == "png" ? BakeFormat::png : BakeFormat::jpeg;
}

void check_bake(Reading& reading) {
  const Options& options = reading.options();
  const auto given = [&](std::string_view option) { return options.given(option); };
  const auto is_zero = [&](std::string_view option) {
    return options.word(option).empty() || options.word(option) == "0";
  };
  const bool compares = given("--compare");
  reading.require(given("--output") || given("--embed") || compares,
                  "bake: say where the picture goes with --output, or --embed it.");
  reading.require(!compares || options.arguments().words.size() == 1,
                  "bake: --compare goes with one other file.");
  reading.require(!compares || !given("--embed"),
                  "bake: --compare and --embed are mutually exclusive.");
  reading.require(
      !given("--embed") || is_zero("--time-budget"),
      "bake: --embed and --time-budget are mutually exclusive: what is in a file should "
      "not depend on the machine.");
  reading.require(!given("--cache") || (!given("--embed") && !compares && is_zero("--time-budget")),
                  "bake: --cache is for files that depend on the asset alone; leave out --embed, "
                  "--compare and --time-budget.");
  reading.require(!given("--sheet") || !given("--shard"),
                  "bake: --shard draws some of the pictures, --sheet needs all; draw it in a run "
                  "without --shard, for which --cache saves the work of the others.");
  reading.require(!given("--sheet") || !compares, "bake: --compare draws no --sheet.");
  const bool frames = !is_zero("--turntable") || given("--clip");
  reading.require(
      !compares || (!frames && !given("--layer") && options.words("--camera").size() < 2),
      "bake: --compare draws one picture, without --turntable, --clip, --layer and "
      "a second --camera.");
  reading.require(is_zero("--turntable") || !given("--clip"),
                  "bake: --turntable and --clip are mutually exclusive.");
  reading.require(!given("--clip") || !given("--animation"),
                  "bake: --clip and --animation are mutually exclusive.");
  reading.require(frames || (!given("--fps") && !given("--layout")),
                  "bake: --fps and --layout are for the frames of a --turntable or --clip.");
  reading.require(given("--output") || !given("--layer") || compares,
                  "bake: say where --layer goes with --output.");
  reading.require(is_zero("--time") || given("--animation"),
                  "bake: --time is that of an --animation; name one.");
}

}  // namespace

void declare_bake(Options& options, BakeRequest& request) {
  add_asset_arguments(options, request.paths);
  declare_outputs(options, request);
  declare_scene(options, request.bake);
  declare_effort(options, request.bake);
  add_inputs(options, request.paths);
  add_cache(options, request.cache, "Skip pictures that are up to date, as noted in DIR");
  add_root(options, request.bake.root);
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_quiet(options, request.quiet, "Print errors only, no progress and no files");
  add_configuration(options);
  add_decoders(options, request.common);
  add_common(options, request.common);
}

void read_bake(Reading& reading, BakeRequest& request) {
  reading.require_inputs("bake");
  reading.require_files("bake");
  check_bake(reading);
  reading.require_companions();
  reading.read();
  request.bake.jobs = request.common.jobs;
  if (reading.options().given("--format")) request.bake.format = format_named(request.format);
}

}  // namespace gltfx::tool
