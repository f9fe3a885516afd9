// SPDX-License-Identifier: Apache-2.0
/// The registration of fixes. A fix is registered with its rule (RuleGroup::fixes): it gets the
/// subject of a finding and adds to the changes of one asset (rules/fix.hpp).
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstdint>
#include <vector>

#include "base/code.hpp"
#include "base/span.hpp"

namespace gltfx::validate {

/// The span of text that a finding of a rule with a fix marks; empty: none.
struct Site {
  Code code;
  Severity severity;
  Span span;
};
using Sites = std::vector<Site>;

/// Fixes of an earlier stage are applied, and the asset is validated again, before those of a later
/// stage.
enum class FixStage : std::uint8_t {
  container,  ///< of the file, regardless of its text
  syntax,     ///< of the text: there may be no document
  files,      ///< of references to files: their content is checked afterwards
  document,
  images,    ///< conversions of images: made by the caller (Fixing::convert_image())
  deletion,  ///< of objects: references are counted again afterwards
};

class Fixing;
struct Subject;
/// Adds the changes that fix the finding about `subject`, which is in the document except in the
/// stages before it. False: the finding remains, and nothing was added.
using FixFunction = bool (*)(Fixing& fixing, const Subject& subject);

struct FixEntry {
  Code code;
  FixFunction fix;
  FixStage stage = FixStage::document;
  /// The fix in addition when unsafe fixes are allowed and this rule is named; null: none.
  FixFunction unsafe = nullptr;
};

/// The fix of a rule, or null.
const FixEntry* find_fix(Code code);

}  // namespace gltfx::validate
