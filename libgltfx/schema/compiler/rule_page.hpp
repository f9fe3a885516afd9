// SPDX-License-Identifier: Apache-2.0
/// Pages of schema/rules/ as data.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace gltfx::schema {

/// The content of a page. Texts are paragraphs without line breaks.
struct RulePage {
  std::string code;  ///< name of the file without `.md`
  Severity severity = Severity::error;
  bool khronos = false;
  /// Severity in the Khronos validator; nothing: the same.
  std::optional<Severity> khronos_severity;
  /// Severity in the profile `strict`; nothing: the same.
  std::optional<Severity> strict_severity;
  /// "2.1" and the severity from that version of glTF on; "none": the rule does not apply.
  std::string later_version, later_severity;
  bool pixels = false;
  bool picture = true;  ///< an asset with this error is drawn
  Fix fix = Fix::none;
  std::string group;          ///< name for options; empty: none
  std::string section, link;  ///< both empty: a rule of gltfx only
  std::string summary;        ///< one sentence, no full stop
  std::string why, help;
  std::string bad, good;
  /// For a rule with a fix in `gltfx fix`: what it changes, and `bad` after the fix.
  std::string fix_does, fixed;
};

/// Reads a page. `mistake`: empty, or "line: mistake" with the expectation.
RulePage read_rule_page(std::string code, std::string_view text, std::string& mistake);

}  // namespace gltfx::schema
