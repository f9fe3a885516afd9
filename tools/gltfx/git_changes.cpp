// SPDX-License-Identifier: Apache-2.0
#include "git_changes.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

// Takes the text up to the next NUL.
std::string_view take_name(std::string_view& text) {
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::string_view name = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return name;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

Result<GitRange::Commit> find_commit(const std::string& name) {
  const std::string known = name.empty() ? "HEAD" : name;
  const auto id = Git(".").run({"rev-parse", "--verify", "--end-of-options", known + "^{commit}"});
  if (!id) return Error{"--git: " + id.error().message};
  if (id->code != 0) return Error{fmt::format("--git: no commit {}", gltfx::quoted(known))};
  return GitRange::Commit{known, first_line(id->out)};
}

bool is_file_mode(std::string_view mode) { return mode.starts_with("100") || mode == "120000"; }

}  // namespace

Result<GitRange> read_git_range(const std::string& text) {
  const std::size_t dots = text.find("..");
  const auto before = find_commit(text.substr(0, dots));
  if (!before) return before.error();
  if (dots == std::string::npos) {
    const auto inside = Git(".").run({"rev-parse", "--show-toplevel"});
    if (!inside) return Error{"--git: " + inside.error().message};
    if (inside->code != 0) return Error{"--git: there is no working tree; name two commits: A..B"};
    return GitRange{*before, {"the working tree", {}}};
  }
  const bool since_ancestor = text.compare(dots, 3, "...") == 0;
  const auto after = find_commit(text.substr(dots + (since_ancestor ? 3 : 2)));
  if (!after) return after.error();
  GitRange range{*before, *after};
  if (!since_ancestor) return range;
  const auto base = Git(".").run({"merge-base", before->id, after->id});
  if (!base) return Error{"--git: " + base.error().message};
  if (base->code != 0) {
    return Error{fmt::format("--git: {} and {} have no common ancestor here",
                             gltfx::quoted(before->name), gltfx::quoted(after->name))};
  }
  range.before.id = first_line(base->out);
  return range;
}

// ":100644 100644 <object> <object> M", a NUL, the name, a NUL; a rename has two names.
std::vector<GitChange> parse_git_changes(std::string_view text) {
  std::vector<GitChange> changes;
  while (!text.empty()) {
    const std::string_view head = take_name(text);
    const std::size_t letter = head.rfind(' ') + 1;
    constexpr std::size_t kModes = 14;  // ":100644 100644"
    if (!head.starts_with(':') || head.size() < kModes || letter >= head.size()) break;
    GitChange change;
    change.before = take_name(text);
    const bool renamed = head[letter] == 'R' || head[letter] == 'C';
    change.after = renamed ? std::string(take_name(text)) : change.before;
    change.file_before = is_file_mode(head.substr(1, 6));
    change.file_after = is_file_mode(head.substr(8, 6));
    if (head[letter] == 'U') continue;  // of a merge; the file is listed once more
    if (head[letter] == 'A') change.before.clear();
    if (head[letter] == 'D') change.after.clear();
    changes.push_back(std::move(change));
  }
  return changes;
}

Result<std::vector<GitChange>> read_git_changes(const std::string& top, const GitRange& range) {
  std::vector<std::string> words{"--no-optional-locks",
                                 "diff",
                                 "--raw",
                                 "-z",
                                 "-M",
                                 "--no-abbrev",
                                 "--no-color",
                                 "--no-ext-diff",
                                 "--no-textconv",
                                 "--no-relative",
                                 "--ignore-submodules=dirty",
                                 range.before.id};
  if (!range.after.id.empty()) words.push_back(range.after.id);
  words.emplace_back("--");
  const auto text = Git(top).run(words);
  if (!text) return text.error();
  if (text->code != 0) return Error{fmt::format("git diff failed (exit code {})", text->code)};
  return parse_git_changes(text->out);
}

}  // namespace gltfx::tool
