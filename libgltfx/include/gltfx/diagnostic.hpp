// SPDX-License-Identifier: Apache-2.0
/// @file
/// Severities, rules and diagnostics. Plain data, no behaviour.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gltfx {

/// The severity of a finding. The numbers are those of the Khronos validator's report.
enum class Severity : std::uint8_t { error = 0, warning = 1, info = 2, hint = 3 };

/// Lower-case English name: "error", "warning", "info", "hint".
std::string_view severity_name(Severity severity);

/// The severity with that name, or nothing.
std::optional<Severity> severity_from_name(std::string_view name);

/// How a program can fix a finding. `safe`: with `gltfx fix`; picture, animation and names stay.
/// `unsafe`: with `gltfx fix`, if requested by name. `upgrade`: with `gltfx upgrade`.
enum class Fix : std::uint8_t { none, safe, unsafe, upgrade };

/// Lower-case English name: "none", "safe", "unsafe", "upgrade".
std::string_view fix_name(Fix fix);

/// One rule: the single source of `explain`, `rules` and every format that links a finding to its
/// explanation. All text has static storage duration; that of an own rule, except its code, lives
/// as long as the OwnRules.
struct RuleDescription {
  std::string_view code;     ///< SCREAMING_SNAKE, stable once released
  Severity severity;         ///< default severity
  std::string_view summary;  ///< one sentence, no full stop
  std::string_view why;      ///< one paragraph: what goes wrong in practice
  std::string_view help;     ///< how to fix it, one or two sentences
  std::string_view section;  ///< of the specification or an extension; empty: a rule of gltfx alone
  std::string_view link;     ///< URL of the section; empty: none
  std::string_view bad;      ///< smallest asset that raises the rule, as `example_bytes` reads it
  std::string_view good;     ///< the same asset, fixed: raises nothing
  std::string_view fix_does;  ///< what the fix changes, one paragraph; empty: there is none
  std::string_view fixed;     ///< `bad` after the fix; empty: there is none
  Fix fix = Fix::none;        ///< how a program can fix it
  bool khronos = false;       ///< the Khronos validator has a code of this name and meaning
  bool pixels = false;        ///< needs decoded pixels: see PixelLevel
  bool picture = true;        ///< `gltfx bake` draws an asset with this error
  Severity khronos_severity = Severity::error;  ///< that validator's, where it has the code
  bool own = false;                             ///< a page of the user (<gltfx/own_rules.hpp>)
  std::string_view group;                       ///< of several rules: "shows"; empty: none
};

/// A place in a JSON text. Lines and columns count from 1, columns in UTF-8 characters (code
/// points) and in UTF-16 code units. In a GLB they count inside the JSON chunk; `offset` is the
/// byte in the file.
struct Location {
  std::uint32_t line = 0;                                ///< 0: no place in the text
  std::uint32_t column = 0;                              ///< 1-based, in code points
  std::uint32_t end_line = 0;                            ///< of the last character
  std::uint32_t end_column = 0;                          ///< one past the last character
  std::uint32_t utf16_column = 0, utf16_end_column = 0;  ///< the same in UTF-16 code units
  std::uint64_t offset = 0;                              ///< byte in the file
  std::uint64_t length = 0;                              ///< bytes
};

/// The source line a finding points at, cut to a window that fits a terminal.
struct Excerpt {
  std::string text;         ///< raw asset text: formatters neutralise it before printing
  std::uint32_t caret = 0;  ///< first marked code point of `text`, 0-based
  std::uint32_t width = 0;  ///< marked code points, at least 1 where there is an excerpt
  bool cut_left = false, cut_right = false;  ///< text was cut on that side
};

/// New text for a stretch of the old one; an empty stretch inserts.
struct Replacement {
  Location place;    ///< the old text
  std::string text;  ///< the new text
};

/// A change of a text file that fixes a finding: all replacements, which are sorted and do not
/// overlap, or none.
struct ProposedFix {
  std::string description;                ///< one sentence
  std::vector<Replacement> replacements;  ///< in the order of the text
};

/// What a measure counts: a number, a flag, a text or a set of texts, sorted. Nothing: it
/// could not be taken, or does not apply.
using CheckedValue =
    std::variant<std::monostate, double, bool, std::string, std::vector<std::string>>;

/// A limit on a measure, and the value that was measured.
struct CheckedLimit {
  std::string measure;  ///< its name: "triangles"
  std::string on;       ///< what it was taken of: "asset", "scene", "node", "mesh" and so on
  CheckedValue value;   ///< in `unit`
  /// How the value is compared: "min", "max", "equal", "match", "deny-match", "unique", "allow",
  /// "deny".
  std::string op;
  CheckedValue limit;  ///< in `unit`; a pattern for "match" and "deny-match"
  std::string unit;    ///< "B", "m", "%" and so on; empty: none
  /// Where the limit is stated: "gltfx.toml:8", or a preset with its dates.
  std::string from;
  /// How the measure was taken: "weld 0.001 m, angle 30 deg"; empty: by default.
  std::string parameters = {};
};

/// One finding. Owns its text, so it outlives the asset.
struct Diagnostic {
  std::string_view code;                ///< static storage: the code of a rule
  Severity severity = Severity::error;  ///< as configured
  std::string message;                  ///< one sentence
  std::string pointer;                  ///< RFC 6901 pointer to the member or its object
  std::optional<std::uint64_t> offset;  ///< set for findings on the GLB container: byte in file
  std::string help;                     ///< help for this case; may be empty
  std::string object_name;              ///< `name` of the nearest named object, may be empty
  Location location;                    ///< place in the text
  Excerpt excerpt;                      ///< that line, for people
  /// Repeats of this code at places that differ only in array indices are folded into the first.
  std::uint64_t count = 1;
  std::string last_pointer;                ///< pointer of the last repeat when count > 1
  std::shared_ptr<const ProposedFix> fix;  ///< null: none, or not requested
  bool fixable = false;  ///< it has a safe fix: `gltfx fix` makes it or reports why not
  std::shared_ptr<const CheckedLimit> requirement;  ///< that is not met; null: of no limit
};

}  // namespace gltfx
