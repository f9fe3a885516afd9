// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <utility>

#include "base/fork.hpp"
#include "change/rewrite.hpp"
#include "container/base64.hpp"
#include "container/container.hpp"
#include "pipeline/example_limit.hpp"
#include "pipeline/fix_rounds.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/own_example.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

// Some rules only speak up for a user's own schema file: their examples use this one.
constexpr std::string_view kLeafSchema = R"({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "gltfx:ext/ACME_leaf", "title": "ACME_leaf", "description": "A leaf of a tree.",
  "type": "object", "required": ["age"],
  "properties": {
    "age": {"type": "integer", "minimum": 1, "maximum": 9},
    "width": {"type": "number", "multipleOf": 0.5, "x-gltfx": {"aliases": ["breadth"], "unit": "cm"}},
    "species": {"type": "string", "minLength": 1},
    "names": {"type": "object", "additionalProperties": {"type": "string"}, "maxProperties": 1},
    "colour": {"type": "array", "x-gltfx": {"deprecated": "use baseColorFactor of the material"}},
    "evergreen": {"type": "boolean"},
    "fallsIn": {"type": "string"}
  },
  "if": {"properties": {"evergreen": {"const": true}}, "required": ["evergreen"]},
  "then": {"not": {"required": ["fallsIn"]}},
  "x-gltfx": {"extension": "ACME_leaf", "on": ["material"], "status": "vendor"}
})";

// A file that an example refers to.
constexpr std::string_view kPicture =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg==";

std::shared_ptr<const schema::Set> leaf_schemas() {
  static constinit MadeOnce<schema::Compiled> compiled;
  return compiled
      .get([] {
        return schema::compile_with({{"ACME_leaf.schema.json", std::string(kLeafSchema), true}});
      })
      .set;
}

// The ending of the name decides what some errors are.
std::string name_for(std::string_view code, std::string_view bytes) {
  const bool wrong_name = code == "FILE_EXTENSION_MISMATCH";
  const bool glb = code.substr(0, 4) == "GLB_" || bytes.substr(0, 4) == "glTF";
  return glb && !wrong_name ? "example.glb" : "example.gltf";
}

// An engine that shows what the rules about targets report, whatever engines do today.
std::vector<TargetChoice> example_targets() {
  const auto all = [](TargetOutcome outcome) { return std::vector<TargetRange>{{0, 0, outcome}}; };
  Target target;
  target.name = "example";
  target.title = "Example";
  target.versions = {{"1.0", ""}};
  target.features["KHR_node_visibility"] = {
      all(TargetOutcome::ignored), all(TargetOutcome::refused), {}};
  target.features["morph.targets-over-4"] = {all(TargetOutcome::ignored), {}, {}};
  return {{std::make_shared<const Target>(std::move(target)), 0}};
}

ValidateOptions options_for(const RuleDescription& rule, std::string_view example) {
  ValidateOptions options;
  options.profile = Profile::strict;
  // What only the Khronos profile says is only said there.
  if (rule.code == "INCOMPLETE_EXTENSION_SUPPORT") options.profile = Profile::khronos;
  // Wishes of the asset count where they are asked for.
  options.inline_suppressions = rule.code.substr(0, 12) == "SUPPRESSION_";
  // Files are looked for where the program runs, but for the rule about not looking for them.
  if (rule.code != "RESOURCE_NOT_CHECKED") options.root = ".";
  if (rule.code.starts_with("TARGET_")) options.targets = example_targets();
  if (example.find("ACME_leaf") != std::string_view::npos) options.schemas = leaf_schemas();
  return options;
}

}  // namespace

FileReport validate_example(const RuleDescription& rule, Example which,
                            const std::shared_ptr<const OwnRules>& own) {
  const std::string_view example = which == Example::bad    ? rule.bad
                                   : which == Example::good ? rule.good
                                                            : rule.fixed;
  if (rule.own) return validate_own_example(rule.code, example, own);
  ValidateOptions options = options_for(rule, example);
  options.limits = example_limits(rule, which == Example::bad);
  // An example that has a value need not be perfect.
  if (!options.limits.empty()) options.select.emplace(rule.code);
  std::string bytes = example_bytes(example);
  MemoryAsset asset{std::move(bytes), {}};
  asset.name = name_for(rule.code, asset.bytes);
  // What the fix leads to.
  if (rule.code == "IO_ERROR") asset.files["leaf/map.png"] = *container::decode_base64(kPicture);
  return validate_bytes(std::move(asset), options);
}

std::string fix_example(const RuleDescription& rule, std::string_view example) {
  std::string bytes = example_bytes(example);
  const std::string name = name_for(rule.code, bytes);
  container::Container container =
      container::open_bytes(container::Bytes::from_string(std::move(bytes)), name);
  FixOptions options;
  options.only.emplace(rule.code);
  options.unsafe = true;
  const auto known = options_for(rule, example).schemas;
  const auto schemas = known ? known : schema::builtin_set();
  container::Resolver resolver = resolver_for(".", {});
  resolver.add("leaf/map.png", container::Bytes::from_string(*container::decode_base64(kPicture)));
  model::OpenedAsset asset(name, std::move(container), std::move(resolver));
  const FixedAsset fixed =
      fix_in_rounds({std::move(asset), fix_validation(schemas, {})}, options, schemas);
  const container::Container& after = fixed.after.asset().container();
  if (!fixed.changes) return std::string(after.bytes.text());
  const auto pieces = change::rewrite(after);
  return pieces ? container::join(*pieces) : std::string();
}

}  // namespace gltfx
