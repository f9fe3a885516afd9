// SPDX-License-Identifier: Apache-2.0
/// `gltfx merge -o FILE`: the pages of several runs of `gltfx report --shard` become the page of
/// one run over everything, byte for byte.
#include <gltfx/page.hpp>
#include <gltfx/validate.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "output.hpp"
#include "read_input.hpp"
#include "report/page_parts.hpp"
#include "validation_options.hpp"

namespace gltfx::tool {
namespace {

using Trouble = std::optional<Error>;

// A page of which one line is held at a time.
class PageFile {
 public:
  static Result<PageFile> open(const std::string& path) {
    auto lines = LineReader::open(path);
    if (!lines) return lines.error();
    PageFile file(path, *std::move(lines));
    std::string text;
    for (bool first = true; text.size() < report::least_page_head(); first = false) {
      const auto line = file.read();
      if (!line) return line.error();
      text += (first ? "" : "\n") + *line;
    }
    auto head = report::read_page_head(text);
    if (!head) return file.wrong(head.error().message);
    file.head_ = *std::move(head);
    if (auto trouble = file.advance()) return *std::move(trouble);
    return file;
  }

  const std::string& path() const { return path_; }
  const report::PageHead& head() const { return head_; }
  /// The next asset; nothing after the last one, when end() is known.
  const std::optional<report::PageLine>& next() const { return next_; }
  const report::PageEnd& end() const { return end_; }

  Trouble advance() {
    next_.reset();
    const auto line = read();
    if (!line) return line.error();
    if (!report::is_page_end(*line)) return keep(report::read_page_line(*line), next_);
    std::string rest;
    for (auto more = lines_.next(); !more || *more; more = lines_.next()) {
      if (!more) return wrong(more.error().message);
      rest.append(**more).append(1, '\n');
    }
    return keep(report::read_page_end(rest), end_);
  }

 private:
  PageFile(const std::string& path, LineReader lines) : path_(path), lines_(std::move(lines)) {}

  Error wrong(std::string_view why) const {
    return {fmt::format("{}: {}", quoted(path_, 200), why)};
  }
  Result<std::string> read() {
    auto line = lines_.next();
    if (!line) return wrong(line.error().message);
    if (!*line) return wrong("the page ends too early: the run was cut off; run it again");
    return **std::move(line);
  }
  template <class T, class To>
  Trouble keep(Result<T> read, To& to) const {
    if (!read) return wrong(read.error().message);
    to = *std::move(read);
    return std::nullopt;
  }

  std::string path_;
  LineReader lines_;
  report::PageHead head_;
  std::optional<report::PageLine> next_;
  report::PageEnd end_;
};

Result<std::vector<PageFile>> open_pages(const std::vector<std::string>& paths) {
  std::vector<PageFile> files;
  for (const std::string& path : paths) {
    auto file = PageFile::open(path);
    if (!file) return file.error();
    files.push_back(*std::move(file));
  }
  return files;
}

// Why pages do not belong together, or nothing.
Trouble check_pages(const std::vector<PageFile>& files) {
  const report::PageHead& first = files.front().head();
  std::set<std::uint32_t> there;
  for (const PageFile& file : files) {
    const report::PageHead& head = file.head();
    const bool alike = head.title == first.title && head.profile == first.profile &&
                       head.pixel_level == first.pixel_level && head.fail_on == first.fail_on &&
                       head.shard.count == first.shard.count;
    if (!alike) {
      return Error{
          fmt::format("{} was made with another title, profile, --pixels, --fail-on or number of "
                      "shards than {}",
                      quoted(file.path(), 200), quoted(files.front().path(), 200))};
    }
    if (!there.insert(head.shard.index).second) {
      return Error{fmt::format("{} is shard {}/{} once more", quoted(file.path(), 200),
                               head.shard.index, head.shard.count)};
    }
  }
  for (std::uint32_t index = 1; index <= first.shard.count; ++index) {
    if (there.count(index) > 0) continue;
    return Error{fmt::format("the page of shard {}/{} is missing", index, first.shard.count)};
  }
  return std::nullopt;
}

void add_counts(RunSummary& sum, const RunSummary& part) {
  sum.files += part.files;
  sum.files_with_errors += part.files_with_errors;
  sum.unreadable += part.unreadable;
  sum.counts.errors += part.counts.errors;
  sum.counts.warnings += part.counts.warnings;
  sum.counts.infos += part.counts.infos;
  sum.counts.hints += part.counts.hints;
}

PageFile* first_page(std::vector<PageFile>& files) {
  PageFile* first = nullptr;
  for (PageFile& file : files) {
    if (!file.next()) continue;
    if (first == nullptr || file.next()->position < first->next()->position) first = &file;
  }
  return first;
}

PageOptions page_options_of(const report::PageHead& head, const OwnRules* own) {
  PageOptions options;
  options.title = head.title;
  options.profile = head.profile;
  options.pixel_level = head.pixel_level;
  options.rules = rules(own);
  return options;
}

// Returns the problem with a part, or nothing; sums the counts of the parts.
Trouble write_page(std::vector<PageFile>& files, const OwnRules* own, Output& output,
                   RunSummary& sum) {
  std::string text;
  PageWriter(page_options_of(files.front().head(), own)).begin(text);
  std::set<std::string_view> codes;
  std::set<std::string> targets;
  std::string_view between = "\n";
  for (PageFile* file = first_page(files); file != nullptr; file = first_page(files)) {
    for (const std::string& code : file->next()->codes) {
      if (const RuleDescription* rule = find_rule(code, own)) codes.insert(rule->code);
    }
    text.append(between).append(file->next()->json);
    between = ",\n";
    if (auto trouble = file->advance()) return trouble;
    if (text.size() < kOutputBuffer) continue;
    output.write(text);
    text.clear();
  }
  for (const PageFile& file : files) {
    add_counts(sum, file.end().summary);
    targets.insert(file.end().targets.begin(), file.end().targets.end());
  }
  output.write(text + report::page_tail(codes, targets, rules(own), sum));
  output.finish();
  return std::nullopt;
}

}  // namespace

ExitCode merge_pages(const MergeRequest& request) {
  auto files = open_pages(request.files);
  Trouble trouble = files ? check_pages(*files) : Trouble(files.error());
  RunSummary sum;
  Output output(request.page == "-" ? std::string() : request.page);
  if (!trouble && output.problem().empty())
    trouble = write_page(*files, request.own_rules.get(), output, sum);
  if (trouble) {
    complain(trouble->message);
    return ExitCode::unreadable;
  }
  if (!output.problem().empty()) {
    complain(output.problem());
    return ExitCode::internal;
  }
  MergeRequest loud = request;
  if (request.as_loud_as_runs) loud.fail_on = files->front().head().fail_on;
  return verdict_on(sum, loud);
}

}  // namespace gltfx::tool
