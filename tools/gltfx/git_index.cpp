// SPDX-License-Identifier: Apache-2.0
#include "git_index.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSubmodule = "160000";

std::vector<std::string_view> split_at_zeros(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    parts.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

std::string joined_by_zeros(const std::set<RepositoryName>& names) {
  std::string text;
  for (const RepositoryName& name : names) text.append(name).append(1, '\0');
  return text;
}

/// Parses the output of `git cat-file --batch` piece by piece: a line "<object> blob <size>", the
/// bytes, a line break.
class Blobs {
 public:
  explicit Blobs(std::function<void(std::string&&)> visit) : visit_(std::move(visit)) {}

  void take(std::string_view piece) {
    while (!piece.empty()) {
      if (in_header_) {
        take_header(piece);
      } else {
        take_bytes(piece);
      }
    }
  }

 private:
  void take_header(std::string_view& piece) {
    const std::size_t end = std::min(piece.find('\n'), piece.size());
    header_ += piece.substr(0, end);
    if (end == piece.size()) return piece.remove_prefix(end);
    piece.remove_prefix(end + 1);
    const std::size_t size = header_.rfind(' ') + 1;
    left_ = 0;
    std::from_chars(header_.data() + size, header_.data() + header_.size(), left_);
    const bool missing = header_.ends_with(" missing");
    header_.clear();
    if (missing) return visit_({});
    wanted_ = left_;
    ++left_;  // the line break
    in_header_ = false;
  }

  void take_bytes(std::string_view& piece) {
    const auto taken = static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), left_));
    const std::uint64_t room = wanted_ - std::min<std::uint64_t>(wanted_, bytes_.size());
    bytes_ += piece.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(taken, room)));
    want_json_only();
    piece.remove_prefix(taken);
    left_ -= taken;
    if (left_ > 0) return;
    visit_(std::exchange(bytes_, {}));
    in_header_ = true;
  }

  // Keeps the header and the first chunk of a GLB.
  void want_json_only() {
    constexpr std::size_t kHeaders = 20;
    if (bytes_.size() < kHeaders || !bytes_.starts_with("glTF")) return;
    std::uint64_t length = 0;
    for (unsigned i = 0; i < 4; ++i) {
      length |= std::uint64_t{static_cast<unsigned char>(bytes_[12 + i])} << (8 * i);
    }
    wanted_ = std::min(wanted_, kHeaders + length);
    if (bytes_.size() > wanted_) bytes_.resize(static_cast<std::size_t>(wanted_));
  }

  std::function<void(std::string&&)> visit_;
  std::string header_, bytes_;
  std::uint64_t left_ = 0;    ///< bytes of this blob to come, the line break included
  std::uint64_t wanted_ = 0;  ///< bytes of it that are kept
  bool in_header_ = true;
};

Error failed(const std::string& verb, int code) {
  return {fmt::format("git {} failed (exit code {})", verb, code)};
}

}  // namespace

Result<std::string> GitIndex::ask(const std::vector<std::string>& arguments,
                                  std::string_view input) const {
  auto outcome = git_.run(arguments, input);
  if (!outcome) return outcome.error();
  if (outcome->code != 0) return failed(arguments.front(), outcome->code);
  return std::move(outcome->out);
}

Result<GitIndex> GitIndex::open() {
  auto top = Git(".").run({"rev-parse", "--show-toplevel"});
  if (!top) return top.error();
  if (top->code != 0 || top->out.size() < 2) {
    return Error{"the working directory is in no working tree of git"};
  }
  top->out.pop_back();  // the line break; one in the name itself is kept
  GitIndex index(std::move(top->out));
  auto trouble = index.read_entries({"ls-files", "-z", "--cached", "--stage", "--full-name"});
  if (trouble) return *std::move(trouble);
  return index;
}

Result<GitIndex> GitIndex::at(const std::string& commit) {
  auto bare = Git(".").run({"rev-parse", "--is-bare-repository"});
  if (!bare) return bare.error();
  const char* top_folder = bare->out == "true\n" ? "--absolute-git-dir" : "--show-toplevel";
  auto top = Git(".").run({"rev-parse", top_folder});
  if (!top) return top.error();
  if (top->code != 0 || top->out.size() < 2) return failed("rev-parse", top->code);
  top->out.pop_back();
  GitIndex index(std::move(top->out));
  auto trouble = index.read_entries({"ls-tree", "-r", "-z", "--full-tree", commit});
  if (trouble) return *std::move(trouble);
  return index;
}

// "<mode> <object> <stage>\t<name>" or "<mode> <type> <object>\t<name>"; stages other than 0 are
// those of an unfinished merge.
std::optional<Error> GitIndex::read_entries(const std::vector<std::string>& listing) {
  const auto text = ask(listing);
  if (!text) return text.error();
  constexpr std::size_t kLeastDigits = 40;
  for (const std::string_view line : split_at_zeros(*text)) {
    const std::size_t tab = line.find('\t');
    const std::size_t first = line.find(' ');
    const std::size_t second = line.find(' ', first + 1);
    if (tab == std::string_view::npos || second >= tab) continue;
    std::string_view object = line.substr(first + 1, second - first - 1);
    if (object.size() < kLeastDigits) object = line.substr(second + 1, tab - second - 1);
    entries_.insert_or_assign(std::string(line.substr(tab + 1)),
                              IndexEntry{std::string(line.substr(0, first)), std::string(object)});
  }
  return std::nullopt;
}

const IndexEntry* GitIndex::file(const RepositoryName& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return nullptr;
  const std::string& mode = found->second.mode;
  return mode == kSymbolicLink || mode == kSubmodule ? nullptr : &found->second;
}

bool GitIndex::leads_elsewhere(const RepositoryName& name) const {
  for (std::size_t slash = name.find('/'); slash != std::string::npos;
       slash = name.find('/', slash + 1)) {
    const auto found = entries_.find(name.substr(0, slash));
    if (found != entries_.end())
      return true;  // a file with files below it is a link or a submodule
  }
  return false;
}

std::optional<RepositoryName> GitIndex::name_of(const std::string& path) const {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  const RepositoryName name = whole.lexically_relative(git_.folder()).native();
  if (error || name.empty() || name == "." || name == ".." || name.starts_with("../")) {
    return std::nullopt;
  }
  return name;
}

std::string GitIndex::path_of(const RepositoryName& name) const {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path whole = fs::path(git_.folder()) / name;
  return (error ? whole : whole.lexically_relative(here)).native();
}

Result<std::map<RepositoryName, char>> GitIndex::staged() const {
  const auto text = ask({"diff", "--cached", "--name-status", "-z", "--no-renames", "--no-ext-diff",
                         "--no-relative", "--ignore-submodules=dirty", "--"});
  if (!text) return text.error();
  std::map<RepositoryName, char> names;
  const std::vector<std::string_view> parts = split_at_zeros(*text);
  for (std::size_t i = 0; i + 1 < parts.size(); i += 2) {
    names.emplace(parts[i + 1], parts[i].empty() ? 'M' : parts[i].front());
  }
  return names;
}

Result<std::set<RepositoryName>> GitIndex::unstaged() const {
  const auto text = ask({"diff", "--name-only", "-z", "--no-renames", "--no-ext-diff",
                         "--no-relative", "--ignore-submodules=all", "--"});
  if (!text) return text.error();
  const std::vector<std::string_view> parts = split_at_zeros(*text);
  return std::set<RepositoryName>(parts.begin(), parts.end());
}

// Names that begin with ':' would have a special meaning, hence the "./". It fails for invalid
// paths, such as one beyond a link: then nothing is ignored.
std::set<RepositoryName> GitIndex::ignored(const std::set<RepositoryName>& names) const {
  std::string input;
  for (const RepositoryName& name : names) input.append("./").append(name).append(1, '\0');
  if (names.empty()) return {};
  const auto text = ask({"check-ignore", "-z", "--stdin"}, input);
  if (!text) return {};
  std::set<RepositoryName> found;
  for (const std::string_view name : split_at_zeros(*text)) found.emplace(name.substr(2));
  return found;
}

// Each as its name, "filter" and the attribute's value.
Result<std::set<RepositoryName>> GitIndex::kept_by_lfs(
    const std::set<RepositoryName>& names) const {
  std::set<RepositoryName> kept;
  if (names.empty()) return kept;
  const auto text =
      ask({"check-attr", "--cached", "-z", "--stdin", "filter"}, joined_by_zeros(names));
  if (!text) return text.error();
  const std::vector<std::string_view> parts = split_at_zeros(*text);
  for (std::size_t i = 0; i + 2 < parts.size(); i += 3) {
    if (parts[i + 2] == "lfs") kept.emplace(parts[i]);
  }
  return kept;
}

std::optional<Error> GitIndex::read(
    const std::vector<RepositoryName>& names,
    const std::function<void(const RepositoryName&, std::string&&)>& visit) const {
  std::string objects;
  std::vector<const RepositoryName*> asked;
  for (const RepositoryName& name : names) {
    const IndexEntry* entry = file(name);
    if (entry == nullptr) continue;
    objects.append(entry->object).append(1, '\n');
    asked.push_back(&name);
  }
  if (asked.empty()) return std::nullopt;
  std::size_t next = 0;
  Blobs blobs([&](std::string&& bytes) {
    if (next < asked.size()) visit(*asked[next++], std::move(bytes));
  });
  const auto code = git_.stream({"cat-file", "--batch", "--buffer"}, objects,
                                [&](std::string_view piece) { blobs.take(piece); });
  if (!code) return code.error();
  if (*code != 0) return failed("cat-file", *code);
  return std::nullopt;
}

}  // namespace gltfx::tool
