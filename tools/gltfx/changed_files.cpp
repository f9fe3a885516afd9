// SPDX-License-Identifier: Apache-2.0
#include "changed_files.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/uri.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// The 3 and the 4 of a line "@@ -1,2 +3,4 @@"; the 4 is 1 when it is omitted.
std::optional<LineRange> range_of(std::string_view header) {
  const std::size_t plus = header.find(" +");
  if (plus == std::string_view::npos) return std::nullopt;
  const char* at = header.data() + plus + 2;
  const char* end = header.data() + header.size();
  std::uint64_t first = 0;
  std::uint64_t count = 1;
  const auto read = std::from_chars(at, end, first);
  if (read.ec != std::errc()) return std::nullopt;
  if (read.ptr != end && *read.ptr == ',') std::from_chars(read.ptr + 1, end, count);
  if (count == 0) return LineRange{std::max<std::uint64_t>(first, 1), first + 1};
  return LineRange{first, first + count - 1};
}

std::set<RepositoryName> names_in(std::string_view text) {
  std::set<RepositoryName> names;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    names.emplace(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return names;
}

Result<std::string> ask(std::vector<std::string> arguments) {
  auto outcome = Git(".").run(arguments);
  if (!outcome) return outcome.error();
  if (outcome->code == 0) return std::move(outcome->out);
  return Error{fmt::format("git {} failed (exit code {})", arguments.front(), outcome->code)};
}

std::vector<std::string> diff_from(const std::string& commit, std::vector<std::string> more) {
  std::vector<std::string> words{
      "diff",         "--no-color",    "--no-ext-diff",          "--no-textconv",
      "--no-renames", "--no-relative", "--ignore-submodules=all"};
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {commit, "--"});
  return words;
}

bool is_binary(const std::string& path) {
  const std::string ending = fs::path(path).extension().native();
  return ending.size() == 4;  // ".glb" in any case of letters, and not ".gltf"
}

}  // namespace

std::optional<std::vector<LineRange>> lines_of_diff(std::string_view diff) {
  std::vector<LineRange> lines;
  while (!diff.empty()) {
    const std::size_t end = std::min(diff.find('\n'), diff.size());
    const std::string_view line = diff.substr(0, end);
    diff.remove_prefix(std::min(end + 1, diff.size()));
    if (line.starts_with("+oid sha256:") || line.starts_with("-oid sha256:")) return std::nullopt;
    if (!line.starts_with("@@ -")) continue;
    if (const auto range = range_of(line)) lines.push_back(*range);
  }
  return lines;
}

Result<ChangedFiles> ChangedFiles::since(const std::string& revision) {
  auto index = GitIndex::open();
  if (!index) return Error{"--diff-base: " + index.error().message};
  const auto commit =
      ask({"rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{commit}"});
  if (!commit || commit->size() < 2) {
    return Error{fmt::format("--diff-base: git knows no commit {}", gltfx::quoted(revision))};
  }
  ChangedFiles files(*std::move(index), commit->substr(0, commit->find('\n')));
  if (auto trouble = files.read()) return Error{"--diff-base: " + trouble->message};
  return files;
}

std::optional<Error> ChangedFiles::read() {
  const auto known = ask({"ls-tree", "-r", "-z", "--name-only", "--full-tree", commit_});
  if (!known) return known.error();
  known_ = names_in(*known);
  const auto changed = ask(diff_from(commit_, {"--name-only", "-z"}));
  if (!changed) return changed.error();
  changed_ = names_in(*changed);
  return std::nullopt;
}

ChangedFiles::State ChangedFiles::state_of(const std::string& path) const {
  const auto name = index_.name_of(path);
  if (!name || index_.leads_elsewhere(*name) || known_.count(*name) == 0) return State::unknown;
  return changed_.count(*name) > 0 ? State::changed : State::same;
}

std::optional<std::vector<LineRange>> ChangedFiles::lines(const std::string& path) const {
  const State state = state_of(path);
  if (state == State::same) return std::vector<LineRange>();
  if (state == State::unknown || is_binary(path)) return std::nullopt;
  std::vector<std::string> words = diff_from(commit_, {"--unified=0", "--text"});
  words.push_back(path);
  const auto diff = ask(std::move(words));
  return diff ? lines_of_diff(*diff) : std::nullopt;
}

bool ChangedFiles::companions_changed(const FileReport& report) const {
  if (!report.info) return false;
  const fs::path folder = fs::path(report.path).parent_path();
  const auto& all = report.info->resources;
  return std::any_of(all.begin(), all.end(), [&](const ResourceInfo& one) {
    const container::Uri uri = container::classify_uri(one.uri);
    return one.storage == "external" && !uri.path.empty() &&
           state_of((folder / uri.path).native()) != State::same;
  });
}

}  // namespace gltfx::tool
