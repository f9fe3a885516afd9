// SPDX-License-Identifier: Apache-2.0
// The verbs that change assets.
#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/loss_bounds.hpp"
#include "base/text.hpp"
#include "configuration.hpp"
#include "option_parts.hpp"
#include "option_values.hpp"
#include "target_choice.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {
namespace {

void declare_destination(Options& options, EditRequest& request, EditOptions& edit) {
  add_asset_arguments(options, request.paths);
  add_table_format(options, request.format);
  options.add("--in-place", "", "Replace the files; each one is written atomically",
              flag(edit.in_place));
  options.add("-o,--output", "FILE|DIR", "Output file; a folder if it ends in / or exists",
              text(edit.output, values::assets));
  options.add("--backup", "", "With --in-place: keep the old file as NAME.bak", flag(edit.backup));
  options.add("--restore", "", "Restore the files that --backup kept", flag(request.restore));
  options.add("--check", "", "Write nothing; exit 1 if there is work to do", flag(request.check));
  options.add("--diff", "", "Print the changes as a unified diff", flag(edit.diff));
  options.add("--raw", "", "With --diff: print all characters as they are", flag(request.raw));
}

void declare_sources(Options& options, EditRequest& request, EditOptions& edit) {
  add_root(options, edit.root);
  add_inputs(options, request.paths);
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_quiet(options, request.quiet, "Print errors only, no plan and no summary");
  add_configuration(options);
  add_decoders(options, request.common);
  add_common(options, request.common);
}

void check_edit(Reading& reading, std::string_view verb) {
  const Options& options = reading.options();
  const auto given = [&](std::string_view option) { return options.given(option); };
  const auto require = [&](bool holds, std::string_view text) {
    reading.require(holds, fmt::format("{}: {}", verb, text));
  };
  reading.require_inputs(verb);
  reading.require_files(verb, "found or written");
  reading.require(!options.hook || !given("--output"),
                  "hook: the files of a commit stay where they are; leave out --output.");
  const bool writes = given("--in-place") || given("--output");
  require(!given("--in-place") || !given("--output"),
          "--in-place and --output are mutually exclusive.");
  require(!given("--check") || !writes,
          "--check writes nothing; leave out --in-place and --output.");
  require(
      !given("--restore") || !(writes || given("--check") || given("--diff") || given("--backup")),
      "--restore puts back backups; leave out other actions.");
  require(!given("--raw") || given("--diff"), "--raw goes with --diff.");
  require(!given("--backup") || given("--in-place"), "--backup goes with --in-place.");
}

// A lossy fix needs its name and --unsafe.
std::string find_unasked(const FixOptions& options, const OwnRules* own) {
  for (const std::string& code : options.only) {
    const Fix kind = find_rule(code, own)->fix;
    if (kind == Fix::unsafe && !options.unsafe) {
      return fmt::format("--only: the fix of {} is unsafe; add --unsafe.", code);
    }
    if (kind == Fix::upgrade) {
      return fmt::format("--only: 'gltfx upgrade' fixes {}.", code);
    }
    if (kind == Fix::none) return fmt::format("--only: {} has no fix.", code);
  }
  return options.unsafe && options.only.empty()
             ? "fix: --unsafe goes with --only, which names the fixes."
             : std::string();
}

Result<double> parse_ior(std::string_view, std::string_view word) {
  if (word == "0") return 0.0;
  if (word == "1000") return 1000.0;
  return Error{"upgrade: --ior is 0 or 1000."};
}

// The only version to which a verb can take an asset.
std::function<Result<std::string>(std::string_view, std::string_view)> parse_version(
    std::string_view version) {
  return [version](std::string_view option, std::string_view word) -> Result<std::string> {
    if (word == version) return std::string(version);
    return Error{fmt::format("{}: {} is not {}.", option, gltfx::quoted(word), version)};
  };
}

// "webp", "png:normal".
Result<std::vector<ImageConversion>> parse_images(std::string_view option, const Words& words) {
  static const Choices<ImageTarget> kTargets{
      {"webp", ImageTarget::webp}, {"png", ImageTarget::png},   {"jpeg", ImageTarget::jpeg},
      {"ktx2", ImageTarget::ktx2}, {"avif", ImageTarget::avif}, {"legal", ImageTarget::legal}};
  static const Choices<ImageClass> kClasses{
      {"color", ImageClass::color}, {"normal", ImageClass::normal}, {"data", ImageClass::data}};
  std::vector<ImageConversion> conversions;
  for (const std::string_view word : words) {
    const std::size_t colon = std::min(word.find(':'), word.size());
    const auto target = choose(option, word.substr(0, colon), kTargets);
    if (!target) return target.error();
    ImageConversion& conversion = conversions.emplace_back(ImageConversion{*target, std::nullopt});
    if (colon == word.size()) continue;
    const auto only = choose(option, word.substr(colon + 1), kClasses);
    if (!only) return only.error();
    conversion.only = *only;
  }
  return conversions;
}

// A factor, or the unit of the input: the result is in meters.
Result<double> parse_scale(std::string_view option, std::string_view word) {
  for (const auto& [unit, meters] :
       Choices<double>{{"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}) {
    if (word == unit) return meters;
  }
  const auto factor = parse_decimal(option, word, 1e-9, 1e9);
  if (factor) return *factor;
  return Error{
      fmt::format("{}: {} is neither a factor from 1e-9 to 1e9, nor one of cm, mm, in, ft.", option,
                  gltfx::quoted(word))};
}

// "0.1%", "triangles=50000".
Result<Simplification> parse_simplification(std::string_view option, std::string_view word) {
  constexpr std::string_view kTriangles = "triangles=";
  if (word.starts_with(kTriangles)) {
    const auto count = parse_number(option, word.substr(kTriangles.size()), 1);
    if (!count) return count.error();
    return Simplification{0, *count};
  }
  if (word.ends_with('%')) {
    const auto percent = parse_decimal(option, word.substr(0, word.size() - 1), 1e-6, 50);
    if (!percent) return percent.error();
    return Simplification{*percent / 100, 0};
  }
  return Error{fmt::format("{}: {} is neither an error such as 0.1%, nor triangles=N.", option,
                           gltfx::quoted(word))};
}

// Without a list, all bounds have their defaults.
Result<LossBounds> parse_bounds(std::string_view option, std::string_view word) {
  if (word == kNoValue) return LossBounds();
  auto bounds = parse_loss_bounds(word);
  if (!bounds) return mistake_in(option, bounds.error());
  return *std::move(bounds);
}

}  // namespace

void declare_upgrade(Options& options, UpgradeRequest& request) {
  UpgradeOptions& upgrade = request.upgrade;
  declare_destination(options, request, upgrade);
  options.add("--verify", "", "Refuse upgrades that change the rendered picture",
              flag(upgrade.verify));
  options.add("--unsafe", "", "Allow lossy upgrades", flag(upgrade.unsafe));
  options.add("--strict", "", "Skip files that cannot be upgraded without loss",
              flag(upgrade.strict));
  options.add("--only", "NAME", "Upgrade only this extension (repeatable)",
              list(upgrade.only, values::legacy_choice));
  options.add("--to", "NAME", "Upgrade only to this extension (repeatable)",
              list(upgrade.to, values::successor_choice));
  options.add("--ior", "N", "ior for specular-glossiness: 0 (default) or 1000",
              parsed(upgrade.ior, parse_ior, [] {
                return values::choice({"0", "1000"});
              }));
  options.add("--pack", "", "Pack color and factor into one image if exact", flag(upgrade.pack));
  options.add("--prune", "", "Remove textures and images left unused", flag(upgrade.prune));
  options.add("--generation", "NAME", "Draft of legacy objects: auto (default), v1, v2, v3",
              text(upgrade.generation, values::generation_choice));
  options.add("--gltf", "VERSION", "Raise the version of glTF instead: 2.1 (draft)",
              parsed(upgrade.gltf, parse_version("2.1"), [] { return values::choice({"2.1"}); }));
  add_targets(options, upgrade.targets);
  declare_sources(options, request, upgrade);
}

void read_upgrade(Reading& reading, UpgradeRequest&) {
  check_edit(reading, "upgrade");
  const Options& options = reading.options();
  for (const std::string_view other : {"--only", "--to"}) {
    reading.require(!options.given("--gltf") || !options.given(other),
                    fmt::format("upgrade: --gltf leaves extensions alone; leave out {}.", other));
  }
  reading.read();
}

void declare_fix(Options& options, FixRequest& request) {
  declare_destination(options, request, request.fix);
  options.add("--only", "CODES", "Fix only these codes (comma-separated, repeatable)",
              codes(options, request.fix.only));
  options.add("--skip", "CODES", "Leave these codes alone (comma-separated, repeatable)",
              codes(options, request.fix.skip));
  options.add("--unsafe", "", "With --only: allow fixes that lose something",
              flag(request.fix.unsafe));
  add_selection(options, request.validation);
  add_fail_on(options, request.fail_on,
              "With --check: exit 1 at error, warning, info or never (default: any fix)",
              fail_on_key());
  declare_sources(options, request, request.fix);
  options.begin_file_only();
  add_checks(options, request.validation);
}

void read_fix(Reading& reading, FixRequest& request) {
  check_edit(reading, "fix");
  reading.read();
  const std::string unasked = find_unasked(request.fix, reading.options().own_rules().get());
  reading.require(unasked.empty(), unasked);
  request.fix.validation = [common = request.validation,
                            by_path = reading.options().by_path](const std::string& path) {
    ValidateOptions options = common;
    if (by_path) by_path->apply(by_path->kind_of(path), options);
    return options;
  };
}

void declare_convert(Options& options, ConvertRequest& request) {
  options.add(
      "--to", "FORM", "Store as glb, gltf (files) or embedded (data URIs)",
      one_of(request.convert.to,
             {{"glb", StoredAs::glb}, {"gltf", StoredAs::gltf}, {"embedded", StoredAs::embedded}}));
  ConvertOptions& convert = request.convert;
  options.add(
      "--glb", "VERSION", "Write GLBs of version 2 (default) or 3",
      one_of(convert.later.glb_version, {{"2", GlbVersion::two}, {"3", GlbVersion::three}}));
  options.add("--compress", "CODEC", "Store geometry as meshopt, draco or none (plain)",
              one_of(convert.compress, {{"none", Compression::none},
                                        {"meshopt", Compression::meshopt},
                                        {"draco", Compression::draco}}));
  options.add("--quantize", "[BOUNDS]", "Store vertices as integers, within bounds of loss",
              parsed(convert.quantize, parse_bounds));
  options.add("--images", "FORMAT", "webp, png, jpeg, ktx2, avif, legal; or webp:normal",
              parsed_list(convert.images, parse_images, [] {
                return values::choice({"webp", "png", "jpeg", "ktx2", "avif", "legal"});
              }));
  options.add("--quality", "N", "Quality: jpeg (default: 90), avif (80), lossy webp",
              number(convert.quality, 1, 100));
  options.add("--texture-size", "N", "Make no side of an image longer than N texels",
              number(convert.texture_size, 1, 65536));
  options.add("--dedup", "", "Store equal data and objects once", flag(convert.dedup));
  options.add("--prune", "", "Remove unused objects and vertices", flag(convert.prune));
  options.add("--weld", "", "Merge vertices that are equal in all bits", flag(convert.weld));
  options.add("--reorder", "", "Order triangles and vertices for a GPU", flag(convert.reorder));
  options.add("--resample", "", "Remove keyframes that interpolation reproduces",
              flag(convert.resample));
  options.add("--shrink", "", "The five above, PNG again, JSON without spaces",
              flag(convert.shrink));
  options.add("--simplify", "ERROR", "Remove triangles: 0.1% of the size, or triangles=N",
              parsed(convert.simplify, parse_simplification));
  options.add(
      "--center", "POINT", "Move bottom or center (origin) of its box to 0 0 0",
      one_of(convert.placement.center, {{"bottom", Pivot::bottom}, {"origin", Pivot::origin}}));
  options.add("--scale", "FACTOR", "Multiply lengths; of cm, mm, in or ft make meters",
              parsed(convert.placement.scale, parse_scale, [] {
                return values::choice({"cm", "mm", "in", "ft"});
              }));
  options.add("--rebase", "", "Move large offsets of vertices into nodes",
              flag(convert.placement.rebase));
  options.add("--target", "NAME[@VERSION]", "Replace what an engine does not read (repeatable)",
              parsed_list(
                  convert.targets,
                  [&options](std::string_view, const Words& words) {
                    return read_targets(words, options.words("--target-file"));
                  },
                  values::target_list));
  add_target_files(options);
  options.add(
      "--gltf", "VERSION", "Make an asset of glTF 2.1 one of glTF 2.0",
      parsed(convert.later.gltf, parse_version("2.0"), [] { return values::choice({"2.0"}); }));
  options.add("--flatten", "", "Copy external assets into the asset", flag(convert.later.flatten));
  options.add("--verify", "", "Refuse a result whose rendered picture differs",
              flag(convert.verify));
  options.add("--partial", "", "Write even if something was refused", flag(convert.partial));
  declare_destination(options, request, request.convert);
  declare_sources(options, request, request.convert);
}

void read_convert(Reading& reading, ConvertRequest& request) {
  check_edit(reading, "convert");
  const Options& options = reading.options();
  reading.require(!options.given("--in-place") || !options.given("--to"),
                  "convert: --in-place keeps the container; leave out --to, or use --output.");
  reading.require(
      !options.given("--quality") || options.given("--images") || options.given("--texture-size"),
      "convert: --quality requires --images or --texture-size.");
  reading.read();
  const std::string ending = ending_of(request.convert.output);
  const bool binary = has_glb_ending(request.convert.output);
  const bool contradicts = request.convert.to && (binary || ending == ".gltf") &&
                           !request.convert.output.ends_with('/') &&
                           binary != (request.convert.to == StoredAs::glb);
  const bool is_text = request.convert.to ? request.convert.to != StoredAs::glb : ending == ".gltf";
  reading.require(!options.given("--glb") || !is_text,
                  "convert: --glb is for GLBs, but the output is a .gltf.");
  reading.require(!contradicts,
                  fmt::format("convert: --to {} contradicts the ending {} of --output.",
                              options.word("--to"), ending));
}

void declare_edit(Options& options, DeleteRequest& request) {
  options.add("--delete", "POINTER", "Delete what a JSON pointer names (repeatable)",
              list(request.deletion.pointers));
  options.add("--cascade", "", "Delete what refers to it, too", flag(request.deletion.cascade));
  declare_destination(options, request, request.deletion);
  declare_sources(options, request, request.deletion);
}

void read_edit(Reading& reading, DeleteRequest&) {
  check_edit(reading, "edit");
  reading.require(reading.options().given("--restore") || reading.options().given("--delete"),
                  "edit: name what is to go: --delete POINTER.");
  reading.read();
}

}  // namespace gltfx::tool
