// SPDX-License-Identifier: Apache-2.0
// gltfx.toml(5).
#include <algorithm>

#include <fmt/format.h>

#include "command_table.hpp"
#include "pages.hpp"
#include "roff.hpp"

namespace gltfx::tool {
namespace {

constexpr std::string_view kDescription =
    R"(A file of this name sets options for every run in a folder. gltfx reads the nearest one in the
working folder or above it, never one in the folder of the assets: an asset cannot disable its own
checks. `--config` names another file; `--isolated` ignores all of them.

The file is written in TOML 1.0. The command line overrides the file. Paths and patterns are
relative to the folder of the file. gltfx-config(1) shows which values apply to a path, and the line
of each.)";

constexpr std::string_view kOverrides =
    R"(Each table of the list `overrides` applies to some paths only. It has a member `paths`, a list of
globs, folders (with / at the end) and names, and any of the keys that are marked so above. A later
table overrides an earlier one; `ignore` lists add up, and `select` enables a code again.)";

constexpr std::string_view kLimits =
    R"(The table `budgets` limits measures of the asset, tables such as `budgets.mesh` those of each
element. A plain number is a maximum, in the unit of the measure or with its own ("64 MiB"). A
table has the operators `min`, `max` or `equal` for numbers, `equal` for flags, `match`,
`deny-match`, `unique`, `allow` and `deny` for texts, `allow` and `deny` for sets, also `severity`
and `note`, a text at the end of the findings; a list of tables has several limits. `false` lifts a
limit. gltfx-measures(1) lists measures.

`extends` is a list of presets, see gltfx-presets(1), and of other files (.toml). Their values come
before those of the file.)";

constexpr std::string_view kExample = R"(profile = "strict"
ignore = ["IMAGE_NPOT_DIMENSIONS"]
schemas = ["schemas", "ACME_leaf.schema.json"]

[severity]
UNUSED_OBJECT = "hint"

[budgets]
triangles = 80000
gpu-bytes = "64 MiB"

[budgets.mesh]
vertices = 65535

[[overrides]]
paths = ["props/**/*.glb", "old/", "*.draft.gltf"]
ignore = ["EXTENSION_LEGACY"]
budgets.triangles = 3000
)";

std::string_view form_of(ConfigForm form) {
  switch (form) {
    case ConfigForm::number:
      return "whole number";
    case ConfigForm::flag:
      return "true or false";
    case ConfigForm::path:
      return "path";
    case ConfigForm::codes:
      return "list of codes";
    case ConfigForm::names:
      return "list of names";
    case ConfigForm::patterns:
    case ConfigForm::files:
    case ConfigForm::paths:
      return "list of paths";
    case ConfigForm::levels:
      return "table of CODE = \"LEVEL\"";
    case ConfigForm::limits:
      return "table of MEASURE = LIMIT";
    default:
      return "string";
  }
}

// Without remarks in brackets about the command line, or about defaults.
std::string_view without_usage(std::string_view text) {
  while (text.ends_with(')')) {
    const std::size_t open = text.rfind(" (");
    const std::string_view inside = text.substr(std::min(open, text.size()));
    const bool usage = inside.starts_with(" (default:") || inside.ends_with("repeatable)");
    if (!usage) break;
    text.remove_suffix(inside.size());
  }
  return text;
}

std::string text_of(const KeyedOption& one) {
  const ConfigKey& key = one.option.key;
  std::string text =
      fmt::format("{}. As `{}` of gltfx-{}(1). Default: {}.", without_usage(one.option.text),
                  one.option.name, one.verb, key.otherwise);
  if (key.name == "schemas") text.append(" Folders are taken as by `--schema-dir`.");
  if (key.by_path) text.append(" Allowed in `overrides`.");
  return text;
}

}  // namespace

std::string config_page(const Edition& edition) {
  RoffPage page("gltfx.toml", 5, edition.date, edition.version);
  page.name("gltfx.toml", "configuration of gltfx");
  page.section("DESCRIPTION");
  page.prose(kDescription);
  page.section("KEYS");
  for (const KeyedOption& one : keyed_options()) {
    const ConfigKey& key = one.option.key;
    page.item(fmt::format("{} ({})", roff_bold(key.name), roff_literal(form_of(key.form))),
              text_of(one));
  }
  page.section("BUDGETS");
  page.prose(kLimits);
  page.section("OVERRIDES");
  page.prose(kOverrides);
  page.section("EXAMPLES");
  page.example(kExample);
  page.section("SEE ALSO");
  page.prose("gltfx(1), gltfx-config(1), gltfx-validate(1)");
  return page.text();
}

}  // namespace gltfx::tool
