// SPDX-License-Identifier: Apache-2.0
/// A vendor's extension as one would write it, the way users add their own.
#pragma once

#include <string>

#include "schema/compile.hpp"

namespace gltfx::test {

inline const char* const kLeaf =
    R"({"$schema":"https://json-schema.org/draft/2020-12/schema","$id":"gltfx:ext/ACME_leaf","title":"ACME_leaf","description":"A leaf.","type":"object","required":["age"],
 "properties":{"age":{"type":"integer","minimum":1,"maximum":9},
  "veins":{"$ref":"gltfx:core/textureInfo","x-gltfx":{"slot":{"channels":"a","colorSpace":"linear"}}},"extensions":{"type":"object"},"extras":{}},
 "x-gltfx":{"extension":"ACME_leaf","on":["material"],"status":"vendor","excludes":[{"extension":"KHR_materials_unlit","because":"A leaf is lit."}]}}
)";

/// The built-in files with one more.
inline std::shared_ptr<const schema::Set> set_with(std::string text) {
  return schema::compile_with({{"acme.json", std::move(text), false}}).set;
}

/// A schema file of ACME_x on materials, with these members and words of x-gltfx.
inline std::string acme(std::string_view members, std::string_view words = "",
                        std::string_view on = R"(["material"])") {
  std::string text =
      R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_x", "title": "x", "description": "x",
"x-gltfx": {"extension": "ACME_x", "status": "vendor", "on": )";
  text.append(on).append(words).append("}, ").append(members);
  return text + "}";
}

}  // namespace gltfx::test
