// SPDX-License-Identifier: Apache-2.0
/// Formats allowed for vertex attributes: by the specification (section 3.7.2.1) and by declared
/// extensions.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/accessor.hpp"
#include "model/format_set.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Alternatives; empty allows nothing.
using FormatList = std::vector<model::FormatSet>;
/// The formats of each core semantic, in the order of model::SemanticKind.
using CoreFormats = std::array<FormatList, model::kCoreSemanticCount>;
bool allows(const FormatList& list, const model::Format& format);
/// "VEC2 of FLOAT or normalized UNSIGNED_BYTE".
std::string formats_text(const FormatList& list);

/// Made once for an asset.
class AttributeFormats {
 public:
  explicit AttributeFormats(const Context& context);

  /// The formats allowed for an attribute of a primitive or a morph target; null: any.
  const FormatList* find(const model::Attribute& attribute, bool target) const;

 private:
  struct Table {
    const CoreFormats* base = nullptr;    // of the specification, shared by all assets
    std::optional<CoreFormats> extended;  // with the formats of extensions
    std::vector<std::pair<std::string, FormatList>> others;  // sorted by name
    const CoreFormats& core() const { return extended ? *extended : *base; }
    void add(const schema::AttributeFormat& format);
    void sort();
  };
  Table vertex_, morph_;
};

/// The extension whose declaration would allow that format, or empty.
std::string_view extension_that_allows(const schema::Set& schemas,
                                       const model::Attribute& attribute, bool target,
                                       const model::Format& format);

}  // namespace gltfx::validate
