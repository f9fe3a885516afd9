// SPDX-License-Identifier: Apache-2.0
/// Pages of schema/rules/ as data.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace gltfx::schema {

/// What a page says. Texts are paragraphs without line breaks.
struct RulePage {
  std::string code;  ///< name of the file without `.md`
  Severity severity = Severity::error;
  bool khronos = false;
  /// That of the Khronos validator; nothing: the same.
  std::optional<Severity> khronos_severity;
  /// In the profile `strict`; nothing: the same.
  std::optional<Severity> strict_severity;
  bool pixels = false;
  bool picture = true;  ///< an asset with this error is drawn
  Fix fix = Fix::none;
  std::string section, link;  ///< both empty: the rule is ours alone
  std::string summary;        ///< one sentence, no full stop
  std::string why, help;
  std::string bad, good;
  /// Of a rule that `gltfx fix` knows: what it changes, and what it makes of `bad`.
  std::string fix_does, fixed;
};

/// Reads a page. `mistake`: empty, or "line: what is wrong" with what is expected.
RulePage read_rule_page(std::string code, std::string_view text, std::string& mistake);

}  // namespace gltfx::schema
