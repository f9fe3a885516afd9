// SPDX-License-Identifier: Apache-2.0
#include <gltfx/compare.hpp>
#include <gltfx/decoders.hpp>
#include <gltfx/version.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "compare_pairs.hpp"
#include "compare_print.hpp"
#include "git_driver.hpp"
#include "git_setup.hpp"
#include "input_paths.hpp"
#include "read_input.hpp"
#include "report/safe_text.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

bool is_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

// The assets of both folders by their paths below them.
Result<std::vector<ComparePair>> pair_folders(const std::vector<std::string>& folders,
                                              CompareOptions& options) {
  std::map<std::string, ComparePair> pairs;
  auto searched = std::make_shared<SearchedFolders>();
  for (std::size_t i = 0; i < 2; ++i) {
    NamedPaths named;
    named.words = {folders[i]};
    named.allow_empty = true;
    const auto inputs = expand_paths(named, true);
    if (!inputs) return inputs.error();
    if (inputs->searched) searched->insert(inputs->searched->begin(), inputs->searched->end());
    for (std::size_t k = 0; k < inputs->paths.size(); ++k) {
      ComparePair& pair = pairs[inputs->places[k]];
      (i == 0 ? pair.before : pair.after) = inputs->paths[k];
    }
  }
  options.searched = std::move(searched);
  std::vector<ComparePair> list;
  for (auto& [place, pair] : pairs) list.push_back(std::move(pair));
  return list;
}

/// A run over all pairs.
class CompareRun {
 public:
  CompareRun(const CompareRequest& request, CompareOptions options)
      : request_(request),
        options_(std::move(options)),
        allow_(request.allow.value_or(request.has_bounds ? CompareLevel::bounds
                                                         : CompareLevel::storage)),
        style_(colors_on_stdout(request.common.color)) {}

  ExitCode execute() {
    const auto pairs = find_pairs();
    if (!pairs) {
      complain(pairs.error().message);
      return ExitCode::usage;
    }
    json::Writer writer(text_, true);
    if (request_.format == CompareFormat::json) begin(writer);
    for (const ComparePair& pair : *pairs) take(compare(pair), writer);
    finish(writer);
    name_unread_files();
    say();
    return code_;
  }

 private:
  Result<std::vector<ComparePair>> find_pairs() {
    if (!request_.git.empty()) {
      auto found = find_git_pairs(request_.git, request_.paths);
      if (!found) return found.error();
      repository_ = *std::move(found);
      return std::exchange(repository_.pairs, {});
    }
    if (is_folder(request_.paths[0]) && is_folder(request_.paths[1])) {
      return pair_folders(request_.paths, options_);
    }
    return std::vector<ComparePair>{{request_.paths[0], request_.paths[1]}};
  }

  CompareReport compare(const ComparePair& pair) const {
    if (!pair.before.empty() && !pair.after.empty()) {
      if (!pair.open_before) return compare_files(pair.before, pair.after, options_);
      return compare_opened(pair.before, pair.after, options_, pair.open_before, pair.open_after);
    }
    CompareReport report;
    report.old_path = pair.before;
    report.new_path = pair.after;
    report.level = CompareLevel::differs;
    return report;
  }

  void take(const CompareReport& report, json::Writer& writer) {
    summary_.add(report, allow_);
    if (!report.is_within(allow_)) code_ = worse(code_, ExitCode::findings);
    if (!report.error.empty()) {
      complain(report.error);
      code_ = worse(code_, ExitCode::unreadable);
    }
    constexpr std::size_t kMostLines = 40;
    constexpr std::size_t kMostMarkdown = 60000;  // GitHub stops at 65,536 characters
    switch (request_.format) {
      case CompareFormat::json:
        write_compare_pair(writer, report);
        break;
      case CompareFormat::markdown:
        if (markdown_bytes_ + 2000 > kMostMarkdown) {
          ++left_out_;
          break;
        }
        text_ += compare_markdown(report, kMostMarkdown - markdown_bytes_ - 500);
        markdown_bytes_ += text_.size();
        break;
      case CompareFormat::text:
        if (report.error.empty()) {
          text_ += compare_text(report, request_.all ? 0 : kMostLines, style_);
        }
        break;
    }
    if (request_.format != CompareFormat::json) say();
  }

  static void begin(json::Writer& writer) {
    writer.begin_object();
    writer.member("gltfx", version());
    writer.member("format", std::uint64_t{1});
    writer.key("pairs");
    writer.begin_array();
  }

  void finish(json::Writer& writer) {
    if (request_.format == CompareFormat::json) {
      writer.end_array();
      writer.key("summary");
      write_compare_summary(writer, summary_);
      writer.end_object();
      text_ += '\n';
      report::defuse_json(text_, 0);
    } else if (summary_.pairs == 0) {
      text_ += "No asset changed.\n";
    } else if (left_out_ > 0) {
      text_ += fmt::format("{} more pairs are not listed.\n", left_out_);
    } else if (request_.format == CompareFormat::text && summary_.pairs > 1) {
      text_ += fmt::format("{} pairs: {} identical, {} storage, {} bounds, {} differ\n",
                           summary_.pairs, summary_.levels[0], summary_.levels[1],
                           summary_.levels[2], summary_.levels[3]);
    }
  }

  void name_unread_files() {
    for (const auto& tree : repository_.trees) {
      for (const std::string& problem : tree->take_problems()) {
        complain(problem);
        code_ = worse(code_, ExitCode::unreadable);
      }
    }
  }

  void say() {
    if (!text_.empty()) code_ = worse(code_, print(text_));
    text_.clear();
  }

  const CompareRequest& request_;
  CompareOptions options_;
  const CompareLevel allow_;
  const Style style_;
  GitPairs repository_;  ///< of --git
  CompareSummary summary_;
  std::string text_;
  std::size_t markdown_bytes_ = 0;
  std::uint64_t left_out_ = 0;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const CompareRequest& request) {
  if (request.setup_git) return set_up_git(request.global);
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  CompareOptions options = request.compare;
  auto problem = check_root(options.root);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!problem && !schemas) problem = schemas.error();
  if (problem) {
    complain(problem->message);
    if (!request.git_driver) return ExitCode::usage;
  }
  if (schemas) options.schemas = *std::move(schemas);
  options.jobs = request.common.jobs;
  if (request.git_driver) {
    print_for_git(request, options);
    return ExitCode::ok;
  }
  return CompareRun(request, std::move(options)).execute();
}

}  // namespace gltfx::tool
