// SPDX-License-Identifier: Apache-2.0
#include <gltfx/compare.hpp>
#include <gltfx/decoders.hpp>
#include <gltfx/version.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "compare_markdown.hpp"
#include "compare_page.hpp"
#include "compare_pairs.hpp"
#include "compare_pictures.hpp"
#include "compare_print.hpp"
#include "git_driver.hpp"
#include "git_setup.hpp"
#include "input_paths.hpp"
#include "output.hpp"
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

bool is_page(const std::string& output) { return ending_of(output) == ".html"; }

/// Where the answer goes: a page, or text in a file or on standard output; pictures in a folder.
class CompareOutputs {
 public:
  explicit CompareOutputs(const CompareRequest& request)
      : files_(request.pictures),
        answer_(is_page(request.output) ? std::string() : request.output, true) {
    if (is_page(request.output)) page_file_.emplace(request.output, true);
    const bool slash = request.pictures.ends_with('/');
    url_ = link_prefix(request.picture_url.empty() ? request.pictures + (slash ? "" : "/")
                                                   : request.picture_url);
  }

  /// The prefix of links to pictures.
  const std::string& url() const { return url_; }

  /// Says why there is no room for what is to be written; empty: there is.
  std::string begin(const std::string& title) {
    if (!problem().empty()) return problem();
    if (const auto trouble = files_.prepare()) return "--pictures: " + trouble->message;
    if (page_file_) write_page([&](std::string& text) { ComparePageWriter::begin(title, text); });
    return {};
  }
  /// Writes the pictures of a pair, sets their names in the report, and adds it to the page.
  /// `place`: what the names are made of.
  std::optional<Error> add(CompareReport& report, const std::string& place) {
    auto trouble = files_.write(report, place);
    if (page_file_) write_page([&](std::string& text) { page_.pair(report, text); });
    return trouble;
  }
  void write(const std::string& text) { answer_.write(text); }
  /// What went wrong, or empty.
  std::string end(const CompareSummary& summary) {
    answer_.finish();
    if (page_file_) {
      write_page([&](std::string& text) { ComparePageWriter::end(summary, text); });
      page_file_->finish();
    }
    return problem();
  }

 private:
  template <class Fill>
  void write_page(const Fill& fill) {
    std::string text;
    fill(text);
    page_file_->write(text);
  }
  std::string problem() const {
    if (!answer_.problem().empty() || !page_file_) return answer_.problem();
    return page_file_->problem();
  }

  ComparePictureFiles files_;
  Output answer_;
  std::optional<Output> page_file_;
  ComparePageWriter page_;
  std::string url_;
};

/// A run over all pairs.
class CompareRun {
 public:
  CompareRun(const CompareRequest& request, CompareOptions options)
      : request_(request),
        options_(std::move(options)),
        allow_(request.allow.value_or(request.has_bounds ? CompareLevel::bounds
                                                         : CompareLevel::storage)),
        style_((request.output.empty() || is_page(request.output)) &&
               colors_on_stdout(request.common.color)),
        outputs_(request) {}

  ExitCode execute() {
    auto pairs = find_pairs();
    if (!pairs) {
      complain(pairs.error().message);
      return ExitCode::usage;
    }
    if (const std::string problem = outputs_.begin(title()); !problem.empty()) {
      complain(problem);
      return ExitCode::internal;
    }
    markdown_.emplace(outputs_.url(), pairs->size());
    json::Writer writer(text_, true);
    if (request_.format == CompareFormat::json) begin(writer);
    for (const ComparePair& pair : *pairs) {
      CompareReport report = compare(pair);
      report.external_asset_of = pair.external_asset_of;
      take(std::move(report), writer);
    }
    finish(writer);
    name_unread_files();
    say();
    if (const std::string problem = outputs_.end(summary_); !problem.empty()) fail(problem);
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
    folders_ = is_folder(request_.paths[0]) && is_folder(request_.paths[1]);
    if (folders_) return pair_folders(request_.paths, options_);
    return std::vector<ComparePair>{{request_.paths[0], request_.paths[1]}};
  }

  std::string title() const {
    if (!request_.git.empty()) return request_.git;
    return fmt::format("{} \u2192 {}", request_.paths[0], request_.paths[1]);
  }

  // Of two folders the path below them, of commits that in the repository, of two files the name of
  // the file.
  std::string place_of(const CompareReport& report) const {
    const bool removed = report.new_path.empty();
    const std::filesystem::path path = removed ? report.old_path : report.new_path;
    if (!request_.git.empty()) return path.native();
    if (!folders_) return path.filename().native();
    return path.lexically_relative(request_.paths[removed ? 0 : 1]).native();
  }

  void fail(const std::string& problem) {
    complain(problem);
    code_ = worse(code_, ExitCode::internal);
  }

  CompareReport compare(const ComparePair& pair) const {
    if (!pair.open_before && !pair.open_after) {
      return compare_files(pair.before, pair.after, options_);
    }
    return compare_opened(pair.before, pair.after, options_, pair.open_before, pair.open_after);
  }

  void take(CompareReport report, json::Writer& writer) {
    if (const auto trouble = outputs_.add(report, place_of(report))) fail(trouble->message);
    summary_.add(report, allow_);
    if (!report.is_within(allow_)) code_ = worse(code_, ExitCode::findings);
    if (!report.error.empty()) {
      complain(report.error);
      code_ = worse(code_, ExitCode::unreadable);
    }
    constexpr std::size_t kMostLines = 40;
    switch (request_.format) {
      case CompareFormat::json:
        write_compare_pair(writer, report);
        break;
      case CompareFormat::markdown:
        markdown_->add(report, folders_ ? place_of(report) : pair_name(report));
        break;
      case CompareFormat::text:
        if (report.error.empty()) {
          text_ += compare_text(report, request_.all ? 0 : kMostLines, style_);
        }
        break;
    }
    if (request_.format == CompareFormat::text) say();
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
    } else if (request_.format == CompareFormat::markdown) {
      text_ += markdown_->finish();
    } else if (summary_.pairs == 0) {
      text_ += "No asset changed.\n";
    } else if (summary_.pairs > 1) {
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
    outputs_.write(text_);
    text_.clear();
  }

  const CompareRequest& request_;
  CompareOptions options_;
  const CompareLevel allow_;
  const Style style_;
  GitPairs repository_;  ///< of --git
  CompareOutputs outputs_;
  bool folders_ = false;
  CompareSummary summary_;
  std::string text_;
  std::optional<CompareMarkdown> markdown_;
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
  if (request.git_driver) return print_for_git(request, options);
  return CompareRun(request, std::move(options)).execute();
}

}  // namespace gltfx::tool
