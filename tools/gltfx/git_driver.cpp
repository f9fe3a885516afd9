// SPDX-License-Identifier: Apache-2.0
#include "git_driver.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "compare_print.hpp"
#include "container/container.hpp"
#include "git_tree.hpp"
#include "pipeline/compare_opened.hpp"
#include "pipeline/open_asset.hpp"
#include "report/safe_text.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

/// One of the two files.
struct DriverSide {
  std::string name;  ///< in the repository
  std::string file;  ///< a temporary file, or the file of the working tree
  std::string object, mode;

  bool is_missing() const { return file == "/dev/null"; }
  /// Git gives the file itself unless it is that of a commit, or must be converted.
  bool is_in_place() const {
    return file == name || object.find_first_not_of('0') == std::string::npos;
  }
};

/// The files beside an asset that git has in a temporary file. Their commit is found when the first
/// one is needed.
class FilesOfCommit {
 public:
  FilesOfCommit(std::string name, std::string object)
      : name_(std::move(name)), object_(std::move(object)) {}

  container::Resolver resolver() {
    const container::Resolver from_top(
        [this](const std::string& path) -> std::optional<container::Bytes> {
          GitTree* tree = found_tree();
          return tree == nullptr ? std::nullopt : tree->read(path);
        },
        container::ReadNames::paths);
    return from_top.in_folder_of(name_);
  }

  /// Sentences for the user.
  std::vector<std::string> notes() const {
    std::vector<std::string> all = notes_;
    if (!tree_) return all;
    for (std::string& problem : tree_->take_problems()) all.push_back(std::move(problem));
    return all;
  }

 private:
  GitTree* found_tree() {
    const std::lock_guard lock(finding_);
    if (!searched_) find();
    searched_ = true;
    return tree_.get();
  }

  bool take(Result<GitIndex> index, const std::string& label, bool whatever) {
    if (!index) return false;
    const IndexEntry* entry = index->file(name_);
    if (!whatever && (entry == nullptr || entry->object != object_)) return false;
    tree_ = std::make_unique<GitTree>(*std::move(index), label);
    return true;
  }

  // The last commit with this version of the asset.
  void find() {
    if (take(GitIndex::at("HEAD"), "HEAD", false)) return;
    if (take(GitIndex::open(), "the index", false)) return;
    const auto log =
        Git(".").run({"log", "-1", "--format=%H", "--no-show-signature", "--find-object=" + object_,
                      "HEAD", "--", ":(top,literal)" + name_});
    if (log && log->code == 0 && log->out.size() > 1) {
      const std::string commit = log->out.substr(0, log->out.find('\n'));
      for (const std::string& each : {commit, commit + "^"}) {
        if (take(GitIndex::at(each), each, false)) return;
      }
    }
    if (take(GitIndex::at("HEAD"), "HEAD", true)) {
      notes_.push_back(fmt::format(
          "the files beside {} are those at HEAD: the commit of this version is not known",
          printable(name_)));
    } else {
      notes_.push_back(
          fmt::format("the files beside {} cannot be read: git gives no commit", printable(name_)));
    }
  }

  const std::string name_, object_;
  std::mutex finding_;
  bool searched_ = false;
  std::unique_ptr<GitTree> tree_;
  std::vector<std::string> notes_;
};

/// Compares one file.
class GitDriver {
 public:
  GitDriver(const std::vector<std::string>& words, const CompareOptions& options)
      : options_(options),
        before_{words[0], words[1], words[2], words[3]},
        after_{words.size() > 7 ? words[7] : words[0], words[4], words[5], words[6]},
        old_files_(before_.name, before_.object),
        new_files_(after_.name, after_.object) {}

  std::string text(bool all, const Style& style) {
    constexpr std::size_t kMostLines = 40;
    CompareReport report;
    if (!before_.is_missing()) report.old_path = "a/" + before_.name;
    if (!after_.is_missing()) report.new_path = "b/" + after_.name;
    report.level = CompareLevel::differs;
    const bool link = before_.mode == kSymbolicLink || after_.mode == kSymbolicLink;
    if (link) {
      report.error = "a symbolic link is not compared";
    } else if (!before_.is_missing() && !after_.is_missing()) {
      report = compare_opened(
          report.old_path, report.new_path, options_, [this] { return open(before_, old_files_); },
          [this] { return open(after_, new_files_); });
    }
    std::string text = compare_text(report, all ? 0 : kMostLines, style);
    if (!report.error.empty()) text += wrapped("not compared: " + report::safe(report.error), 2);
    const bool mode = !before_.is_missing() && !after_.is_missing() && before_.mode != after_.mode;
    if (mode) {
      text +=
          fmt::format("  mode {} -> {}\n", report::safe(before_.mode), report::safe(after_.mode));
    }
    for (const FilesOfCommit* files : {&old_files_, &new_files_}) {
      for (const std::string& note : files->notes()) text += wrapped("note: " + note, 2);
    }
    return text;
  }

 private:
  static Result<model::OpenedAsset> open(const DriverSide& side, FilesOfCommit& files) {
    if (side.is_in_place()) return open_asset(side.file, AssetBounds{root_of(side.file), nullptr});
    auto opened = container::open_file(side.file);
    if (!opened) return opened.error();
    return model::OpenedAsset(side.name, *std::move(opened), files.resolver());
  }

  // The working tree that a file is in; empty: it is in none, so that its folder is the root.
  static std::string root_of(const std::string& file) {
    const auto top = Git(".").run({"rev-parse", "--show-toplevel"});
    if (!top || top->code != 0 || top->out.size() < 2) return {};
    std::string root = top->out.substr(0, top->out.size() - 1);
    std::error_code error;
    const std::string place =
        std::filesystem::absolute(file, error).lexically_relative(root).native();
    const bool outside = error || place.empty() || place == ".." || place.starts_with("../");
    return outside ? std::string() : root;
  }

  const CompareOptions& options_;
  const DriverSide before_, after_;
  FilesOfCommit old_files_, new_files_;
};

}  // namespace

void print_for_git(const CompareRequest& request, const CompareOptions& options) {
  const Style style(colors_on_stdout(request.common.color));
  if (request.paths.size() == 1) {
    print(fmt::format("{}: unmerged\n", style.bold(report::safe(request.paths[0]))));
    return;
  }
  print(GitDriver(request.paths, options).text(request.all, style));
}

}  // namespace gltfx::tool
