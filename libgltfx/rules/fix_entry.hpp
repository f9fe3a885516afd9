// SPDX-License-Identifier: Apache-2.0
/// Which rules have a fix. A fix is registered where its rule is (RuleGroup::fixes): it gets the
/// place that a finding marks and adds to the changes of one asset (rules/fix.hpp).
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstdint>
#include <vector>

#include "base/code.hpp"
#include "base/span.hpp"

namespace gltfx::validate {

/// What a finding of a rule that has a fix marks in the text; empty: nothing.
struct Site {
  Code code;
  Severity severity;
  Span span;
};
using Sites = std::vector<Site>;

/// Fixes of an earlier stage are made, and the asset validated again, before those of a later one.
enum class FixStage : std::uint8_t {
  container,  ///< of the file, whatever its text is
  syntax,     ///< of the text: there may be no document
  files,      ///< of references to files: what these hold is checked from then on
  document,
  deletion,  ///< of objects: what refers to others is counted anew
};

class Fixing;
/// Adds what fixes the finding that marks `place`. False: this one stays, and nothing was added.
using FixFunction = bool (*)(Fixing& fixing, Span place);

struct FixEntry {
  Code code;
  FixFunction fix;
  FixStage stage = FixStage::document;
  /// What is done besides where unsafe fixes are allowed and this rule is named; null: nothing.
  FixFunction unsafe = nullptr;
};

/// The fix of a rule, or null.
const FixEntry* find_fix(Code code);

}  // namespace gltfx::validate
