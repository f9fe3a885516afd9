// SPDX-License-Identifier: Apache-2.0
// Pages to start with, one for each kind of object. A page passes its own test as it is.
#include <gltfx/own_rules.hpp>
#include <gltfx/validate.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/code.hpp"

namespace gltfx {
namespace {

/// `asset` holds '@' in place of the member that the rule requires.
struct Start {
  std::string_view on;
  std::string_view member;  ///< that the rule requires
  std::string_view schema;  ///< of the member
  std::string_view value;   ///< of the member in the good example
  std::string_view asset;   ///< behind the member "asset"
};

constexpr std::string_view kName = R"({"type": "string", "pattern": "^[A-Z][A-Za-z0-9_]*$"})";
constexpr std::string_view kNamed = R"("Hall")";

constexpr std::array kStarts{
    Start{"glTF", "scenes", R"({"type": "array", "minItems": 1})", "[{}]", ""},
    Start{"asset", "generator", R"({"type": "string", "minLength": 1})", R"("ACME exporter")", ""},
    Start{"scene", "name", kName, kNamed, R"("scenes": [{@}])"},
    Start{"node", "name", kName, kNamed, R"("nodes": [{@}])"},
    Start{
        "mesh", "name", kName, kNamed,
        R"("accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]@}])"},
    Start{
        "primitive", "material", R"({"type": "integer"})", "0",
        R"("accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "materials": [{}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}@}]}])"},
    Start{"material", "name", kName, kNamed, R"("materials": [{@}])"},
    Start{"texture", "name", kName, kNamed, R"("textures": [{@}])"},
    Start{"image", "name", kName, kNamed, R"("images": [{"uri": "wood.png"@}])"},
    Start{"sampler", "name", kName, kNamed, R"("samplers": [{@}])"},
    Start{"skin", "name", kName, kNamed, R"("nodes": [{}],
 "skins": [{"joints": [0]@}])"},
    Start{
        "animation", "name", kName, kNamed,
        R"("accessors": [{"componentType": 5126, "count": 1, "type": "SCALAR", "min": [0], "max": [0]},
  {"componentType": 5126, "count": 1, "type": "VEC3"}],
 "nodes": [{}],
 "animations": [{"samplers": [{"input": 0, "output": 1}],
  "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]@}])"},
    Start{"camera", "name", kName, kNamed,
          R"("cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}@}])"},
    Start{"accessor", "name", kName, kNamed,
          R"("accessors": [{"componentType": 5126, "count": 1, "type": "SCALAR"@}])"},
    Start{"bufferView", "name", kName, kNamed, R"("buffers": [{"byteLength": 4, "uri": "hall.bin"}],
 "bufferViews": [{"buffer": 0, "byteLength": 4@}])"},
    Start{"buffer", "name", kName, kNamed, R"("buffers": [{"byteLength": 4, "uri": "hall.bin"@}])"},
};

// The example with or without the member.
std::string example(const Start& start, bool good) {
  const std::string member =
      good ? fmt::format("\"{}\": {}", start.member, start.value) : std::string();
  const bool in_asset = start.on == "asset";
  std::string text = R"({"asset": {"version": "2.0")";
  if (in_asset && good) text += ", " + member;
  text += '}';
  std::string rest(start.asset);
  if (start.on == "glTF") rest = member;
  if (const std::size_t at = rest.find('@'); at != std::string::npos) {
    const bool first = rest[at - 1] == '{';
    rest.replace(at, 1, member.empty() || first ? member : ", " + member);
  }
  if (!rest.empty()) text += ",\n " + rest;
  return text + '}';
}

}  // namespace

std::string own_rule_template(std::string_view code, std::string_view on) {
  const auto start =
      std::find_if(kStarts.begin(), kStarts.end(), [&](const Start& one) { return one.on == on; });
  if (start == kStarts.end() || !has_code_form(code)) return {};
  return fmt::format(R"(---
severity: error
on: {on}
message: The '{member}' of the {on} is missing or has another form.
help: add or correct '{member}'
---

# {code}

Missing '{member}'.

## Why it matters

Say who needs it, and what goes wrong without it.

## How to fix it

Say what to do, and in which program.

## Schema

```json
{{
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "required": ["{member}"],
  "properties": {{
    "{member}": {schema}
  }}
}}
```

## Bad

```json
{bad}
```

## Good

```json
{good}
```
)",
                     fmt::arg("on", on), fmt::arg("code", code), fmt::arg("member", start->member),
                     fmt::arg("schema", start->schema), fmt::arg("bad", example(*start, false)),
                     fmt::arg("good", example(*start, true)));
}

}  // namespace gltfx
