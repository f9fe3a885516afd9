// SPDX-License-Identifier: Apache-2.0
#include "git_driver.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "compare_page.hpp"
#include "compare_print.hpp"
#include "container/container.hpp"
#include "folder_walk.hpp"
#include "git_tree.hpp"
#include "output.hpp"
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
  GitDriver(DriverSide before, DriverSide after, const CompareOptions& options)
      : options_(options),
        before_(std::move(before)),
        after_(std::move(after)),
        old_files_(before_.name, before_.object),
        new_files_(after_.name, after_.object) {}

  CompareReport report() {
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
    return report;
  }

  /// Of a file that was added or removed the only one, with its pictures.
  CompareReport report_with_pictures() {
    if (!before_.is_missing() && !after_.is_missing()) return report();
    const bool removed = after_.is_missing();
    const auto none = OpenCompared();
    return compare_opened(
        removed ? "a/" + before_.name : std::string(), removed ? std::string() : "b/" + after_.name,
        options_, removed ? OpenCompared([this] { return open(before_, old_files_); }) : none,
        removed ? none : OpenCompared([this] { return open(after_, new_files_); }));
  }

  std::string text(bool all, const Style& style) {
    constexpr std::size_t kMostLines = 40;
    const CompareReport report = this->report();
    std::string text = compare_text(report, all ? 0 : kMostLines, style);
    if (!report.error.empty()) text += wrapped("not compared: " + report::safe(report.error), 2);
    const bool mode = !before_.is_missing() && !after_.is_missing() && before_.mode != after_.mode;
    if (mode) {
      text +=
          fmt::format("  mode {} -> {}\n", report::safe(before_.mode), report::safe(after_.mode));
    }
    for (const std::string& note : notes()) text += wrapped("note: " + note, 2);
    return text;
  }

  /// Sentences for the user; after the report.
  std::vector<std::string> notes() const {
    std::vector<std::string> all;
    for (const FilesOfCommit* files : {&old_files_, &new_files_}) {
      for (std::string& note : files->notes()) all.push_back(std::move(note));
    }
    return all;
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

// The side of a difftool, for which git tells no object: that of the same bytes.
DriverSide side_of_difftool(const std::string& name, const std::string& file) {
  DriverSide side{name, file, {}, {}};
  if (side.is_missing() || side.is_in_place()) return side;
  const auto hash = Git(".").run({"hash-object", "--path=" + name, "--", file});
  if (hash && hash->code == 0) side.object = hash->out.substr(0, hash->out.find('\n'));
  return side;
}

// In a new folder for temporary files, where it stays for the browser.
Result<std::string> write_page_of(CompareReport& report) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  std::string place = (folder / "gltfx-XXXXXX").native();
  if (error || mkdtemp(place.data()) == nullptr) {
    return Error{"there is no folder for temporary files"};
  }
  place += "/compare.html";
  std::string text;
  ComparePageWriter::begin(report.new_path.empty() ? report.old_path : report.new_path, text);
  ComparePageWriter().pair(report, text);
  CompareSummary summary;
  summary.add(report, CompareLevel::differs);
  ComparePageWriter::end(summary, text);
  Output output(place, true);
  output.write(text);
  output.finish();
  if (!output.problem().empty()) return Error{output.problem()};
  return place;
}

ExitCode show_for_difftool(const CompareRequest& request, CompareOptions options) {
  const std::string& name = request.paths[0];
  if (!is_asset_name(name)) {
    complain(fmt::format("{} is no asset", printable(name)));
    return ExitCode::unreadable;
  }
  if (options.picture_size == 0) options.picture_size = 256;
  GitDriver driver(side_of_difftool(name, request.paths[1]),
                   side_of_difftool(name, request.paths[2]), options);
  CompareReport report = driver.report_with_pictures();
  for (const std::string& note : driver.notes()) complain(note);
  const auto page = write_page_of(report);
  if (!page) {
    complain(page.error().message);
    return ExitCode::internal;
  }
  print(*page + "\n");
  return ExitCode::ok;
}

// `git difftool` asks for its helper, in whose place git runs the driver of the attributes. The
// helper runs the tool that the user has chosen. Returns if it cannot be run.
void hand_over_to_difftool(std::vector<std::string> words) {
  constexpr const char* kHelper = "git-difftool--helper";
  const char* wanted = std::getenv("GIT_EXTERNAL_DIFF");
  if (wanted == nullptr || std::string_view(wanted) != kHelper) return;
  words.insert(words.begin(), kHelper);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(kHelper, arguments.data());
}

}  // namespace

ExitCode print_for_git(const CompareRequest& request, const CompareOptions& options) {
  const std::vector<std::string>& words = request.paths;
  if (words.size() == 3) return show_for_difftool(request, options);
  hand_over_to_difftool(words);
  const Style style(colors_on_stdout(request.common.color));
  if (words.size() == 1) {
    print(fmt::format("{}: unmerged\n", style.bold(report::safe(words[0]))));
    return ExitCode::ok;
  }
  GitDriver driver({words[0], words[1], words[2], words[3]},
                   {words.size() > 7 ? words[7] : words[0], words[4], words[5], words[6]}, options);
  print(driver.text(request.all, style));
  return ExitCode::ok;
}

}  // namespace gltfx::tool
