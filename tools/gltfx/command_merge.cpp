// SPDX-License-Identifier: Apache-2.0
#include <gltfx/validate.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "read_input.hpp"
#include "report/read_line.hpp"
#include "report_targets.hpp"
#include "validation_options.hpp"

namespace gltfx::tool {
namespace {

// The lines of one report, of which one is held at a time.
class ReportFile {
 public:
  static Result<ReportFile> open(const std::string& path) {
    auto lines = LineReader::open(path);
    if (!lines) return lines.error();
    ReportFile file(path, *std::move(lines));
    auto line = file.read();
    if (!line) return line.error();
    auto* head = std::get_if<report::RunHead>(&*line);
    if (head == nullptr) return file.wrong("its first line is not that of a report");
    file.head_ = std::move(*head);
    return file;
  }

  const report::RunHead& head() const { return head_; }
  const std::string& path() const { return path_; }
  /// The report on the next file; nothing after the last one.
  const std::optional<FileReport>& next() const { return next_; }
  std::optional<FileReport> take() { return std::exchange(next_, std::nullopt); }
  std::optional<Error> advance() {
    auto line = read();
    if (!line) return line.error();
    next_.reset();
    if (auto* report = std::get_if<FileReport>(&*line)) next_ = std::move(*report);
    if (std::holds_alternative<report::RunHead>(*line)) {
      return wrong("a second report begins there; give each its own file");
    }
    return std::nullopt;
  }

 private:
  ReportFile(const std::string& path, LineReader lines) : path_(path), lines_(std::move(lines)) {}

  Error wrong(std::string_view why) const {
    return {fmt::format("{}, line {}: {}", printable(path_), line_, why)};
  }

  Result<report::ReportLine> read() {
    ++line_;
    const auto text = lines_.next();
    if (!text) return wrong(text.error().message);
    // A last line without a line break is truncated as well.
    if (!*text) {
      return wrong("the report ends before its last line: the run was cut off; run it again");
    }
    auto line = report::read_line(**text, rules());
    if (!line) return wrong(line.error().message);
    return line;
  }

  std::string path_;
  LineReader lines_;
  std::uint64_t line_ = 0;
  report::RunHead head_;
  std::optional<FileReport> next_;
};

Result<std::vector<ReportFile>> open_all(const std::vector<std::string>& paths) {
  std::vector<ReportFile> files;
  for (const std::string& path : paths) {
    auto file = ReportFile::open(path);
    if (!file) return file.error();
    files.push_back(*std::move(file));
  }
  return files;
}

// Why reports do not belong together, or nothing: parts that are missing, other options.
std::optional<Error> check_parts(const std::vector<ReportFile>& files) {
  const report::RunHead& first = files.front().head();
  // If there are more parts than files, a part is missing.
  std::vector<bool> there(std::min<std::uint64_t>(first.shard.count, files.size() + 1));
  for (const ReportFile& file : files) {
    const report::RunHead& head = file.head();
    const bool alike = head.profile == first.profile && head.pixel_level == first.pixel_level &&
                       head.fail_on == first.fail_on && head.timings == first.timings &&
                       head.shard.count == first.shard.count;
    if (!alike) {
      return Error{
          fmt::format("{} was made with another profile, --pixels, --fail-on, --timings or number "
                      "of shards than {}",
                      quoted(file.path(), 200), quoted(files.front().path(), 200))};
    }
    if (head.shard.index <= there.size()) there[head.shard.index - 1] = true;
  }
  const auto missing = std::find(there.begin(), there.end(), false);
  if (missing == there.end()) return std::nullopt;
  return Error{fmt::format("the report of shard {}/{} is missing", missing - there.begin() + 1,
                           first.shard.count)};
}

// Writes the reports in the order of one run over everything.
class Merge {
 public:
  Merge(const MergeRequest& request, std::vector<ReportFile> files)
      : request_(request),
        files_(std::move(files)),
        targets_(request, {files_.front().head().profile, files_.front().head().pixel_level, {}}) {}

  ExitCode execute() {
    targets_.begin();
    for (ReportFile& file : files_) {
      if (auto trouble = file.advance()) return refuse(*trouble);
    }
    for (ReportFile* first = find_first(); first != nullptr; first = find_first()) {
      take(*first->take());
      if (auto trouble = first->advance()) return refuse(*trouble);
    }
    const ExitCode verdict = verdict_on(summary_, request_);
    summary_.exit_code = static_cast<int>(verdict);
    targets_.finish(summary_);
    if (const std::string problems = targets_.problems(); !problems.empty()) {
      complain(problems);
      return ExitCode::internal;
    }
    return verdict;
  }

 private:
  static ExitCode refuse(const Error& error) {
    complain(error.message);
    return ExitCode::unreadable;
  }

  // External assets come after all inputs, sorted by path.
  static std::pair<std::uint64_t, std::string_view> key_of(const FileReport& report) {
    return {report.position, report.path};
  }

  ReportFile* find_first() {
    ReportFile* first = nullptr;
    for (ReportFile& file : files_) {
      if (!file.next()) continue;
      if (first == nullptr || key_of(*file.next()) < key_of(*first->next())) first = &file;
    }
    return first;
  }

  // A shard that was run twice has every report twice. Shards have external assets in common.
  void take(FileReport report) {
    if (last_ && last_->first == report.position && last_->second == report.path) return;
    last_.emplace(report.position, report.path);
    summary_.add(report);
    targets_.file(report);
  }

  const MergeRequest& request_;
  std::vector<ReportFile> files_;
  ReportTargets targets_;
  RunSummary summary_;
  std::optional<std::pair<std::uint64_t, std::string>> last_;
};

}  // namespace

ExitCode run(const MergeRequest& request) {
  if (!request.page.empty()) return merge_pages(request);
  auto files = open_all(request.files);
  if (!files) {
    complain(files.error().message);
    return ExitCode::unreadable;
  }
  if (const auto problem = check_parts(*files)) {
    complain(problem->message);
    return ExitCode::unreadable;
  }
  MergeRequest loud = request;
  loud.timings = files->front().head().timings;
  if (request.as_loud_as_runs) loud.fail_on = files->front().head().fail_on;
  return Merge(loud, *std::move(files)).execute();
}

}  // namespace gltfx::tool
