// SPDX-License-Identifier: Apache-2.0
#include "compare_markdown.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "compare_print.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"

namespace gltfx::tool {
namespace {

using report::counted;

constexpr std::size_t kMostMarkdown = 60'000;
constexpr std::size_t kForTotals = 1'000;   // the first line, and how much is not listed
constexpr std::size_t kForTable = 10'000;   // what changed in each asset
constexpr std::size_t kForStored = 5'000;   // assets that are only stored differently
constexpr std::size_t kForSection = 4'000;  // of one of many pairs, unless there is more room
constexpr std::size_t kOpenRows = 20;       // outside of a fold
constexpr std::string_view kNoBreak = "&#8203;";

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool ends_in(std::string_view text, std::string_view small_letters) {
  if (text.size() < small_letters.size()) return false;
  text.remove_prefix(text.size() - small_letters.size());
  return std::equal(text.begin(), text.end(), small_letters.begin(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

// Whether hosts may read what begins here as "@user", "#12", "!12", "GH-12", ":smile:",
// "https:", "www." or "a@b.c". They do so after the escapes of Markdown are gone.
bool begins_link(std::string_view text, std::size_t at) {
  const char next = at + 1 < text.size() ? text[at + 1] : ' ';
  const bool before_word = is_word(next) || next == '"';
  switch (text[at]) {
    case '@':
      return true;
    case ':':
      return before_word || next == '/' || next == '+' || next == '-';
    case '#':
    case '!':
    case '$':
    case '%':
    case '&':
    case '^':
    case '~':
      return before_word;
    case '-':
      return ends_in(text.substr(0, at), "gh");
    case '.':
      return ends_in(text.substr(0, at), "www");
    default:
      return false;
  }
}

// A text of which Markdown, HTML and the references of hosts read nothing.
std::string escaped(std::string_view text, std::size_t limit = 300) {
  constexpr std::string_view kSpecial = "\\`*_{}[]()#+-.!~:$^%";
  const std::string shown = report::safe_cut(text, limit);
  std::string out;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const char c = shown[i];
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '|') {
      out += "&#124;";
    } else {
      if (kSpecial.find(c) != std::string_view::npos) out += '\\';
      out += c;
    }
    if (begins_link(shown, i)) out += kNoBreak;
  }
  return out;
}

bool needs_section(const CompareReport& report) {
  return !report.error.empty() || !report.unproven.empty() || report.level >= CompareLevel::bounds;
}

// "differs", and of many changes their kinds.
std::string verdict_of(const CompareReport& report) {
  if (!report.error.empty()) return "cannot be compared";
  if (report.old_path.empty()) return "added";
  if (report.new_path.empty()) return "removed";
  std::string text(compare_level_name(report.level));
  if (report.changes.size() > 2) text += ": " + kinds_of(report);
  if (!report.unproven.empty()) text += fmt::format("; {} unproven", report.unproven.size());
  return text;
}

// Whether both assets are drawn, and no picture shows a change.
bool looks_the_same(const CompareReport& report) {
  const auto& pictures = report.pictures;
  return !pictures.empty() && pictures.front().has_both() &&
         std::none_of(pictures.begin(), pictures.end(),
                      [](const ComparePicture& each) { return each.changed(); });
}

// What changed, in few words: the only changes, or their kinds.
std::string summary_of(const CompareReport& report) {
  constexpr std::size_t kMost = 160;
  if (!report.error.empty()) return escaped(report.error, kMost);
  std::string text;
  if (report.changes.size() > 2) {
    text = kinds_of(report);
  } else {
    for (const Change& change : report.changes) {
      text += text.empty() ? "" : "; ";
      if (change.name.empty()) text += escaped(place_of(change), kMost) + " ";
      text += escaped(sentence_of(change), kMost);
    }
  }
  if (text.empty()) return verdict_of(report);
  if (report.level == CompareLevel::bounds) text += " (within bounds)";
  if (!report.unproven.empty()) text += fmt::format("; {} unproven", report.unproven.size());
  return looks_the_same(report) ? text + "; looks the same" : text;
}

// The greatest distance that a sentence does not tell anyway.
std::string measure_in_words(const Change& change) {
  if (!change.measure) return {};
  const bool within = change.level == CompareLevel::bounds;
  if (!within && change.measure->unit.empty()) return {};
  return escaped(measure_of(*change.measure, within));
}

// --- Pictures ---

bool is_written(const ComparePicture& picture) {
  return !picture.old_file.empty() || !picture.new_file.empty();
}

// A table with one view; the names of files are plain.
std::string picture_table(const ComparePicture& picture, const std::string& url) {
  std::string head = "|", line = "|", row = "|";
  const auto add = [&](std::string_view words, const std::string& file) {
    if (file.empty()) return;
    head += fmt::format(" {} |", words);
    line += "---|";
    row += fmt::format(" ![{}]({}{}) |", words, url, file);
  };
  add("old", picture.old_file);
  add("new", picture.new_file);
  add("difference", picture.difference_file);
  return fmt::format("{}\n{}\n{}\n\n", head, line, row);
}

// The view that shows most, then the others in a fold; or the sentence that none shows a change.
std::string pictures_of(const CompareReport& report, const std::string& url, bool brief) {
  std::vector<const ComparePicture*> shown;
  for (const ComparePicture& picture : report.pictures) {
    if (!is_written(picture) || (picture.has_both() && !picture.changed())) continue;
    shown.push_back(&picture);
  }
  if (looks_the_same(report)) return "The pictures show no change.\n\n";
  if (shown.empty()) return {};
  std::stable_sort(shown.begin(), shown.end(), [](const auto* one, const auto* two) {
    if ((one->view == "change") != (two->view == "change")) return one->view == "change";
    return one->distance > two->distance;
  });
  std::string text = picture_table(*shown.front(), url);
  if (brief || shown.size() == 1) return text;
  text += fmt::format("<details><summary>{}</summary>\n\n",
                      shown.size() == 2 ? "another view" : "other views");
  for (std::size_t i = 1; i < shown.size(); ++i) text += picture_table(*shown[i], url);
  return text + "</details>\n\n";
}

// --- Sections ---

std::string row_of(const Change& change, bool levels) {
  const std::string level =
      levels ? fmt::format(" {} |", compare_level_name(change.level)) : std::string();
  return fmt::format("| {}{} | {} | {} |{}\n", escaped(sentence_of(change)),
                     measure_in_words(change), escaped(place_of(change)), change.kind, level);
}

// "3 more changes are not listed."
std::string not_listed(std::size_t count, std::string_view noun) {
  return fmt::format("{} {} not listed.\n", counted(count, noun), count == 1 ? "is" : "are");
}

// A table whose later rows are folded. `all`: how many rows there would be.
std::string folded_table(std::string_view head, const std::vector<std::string>& rows,
                         std::size_t all, std::string_view noun) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == kOpenRows) {
      text += fmt::format("\n<details><summary>{}</summary>\n\n",
                          counted(rows.size() - kOpenRows, fmt::format("more {}", noun)));
    }
    if (i == 0 || i == kOpenRows) text += head;
    text += rows[i];
  }
  if (rows.size() > kOpenRows) text += "\n</details>\n";
  if (rows.size() < all) {
    text +=
        '\n' + not_listed(all - rows.size(), rows.empty() ? noun : fmt::format("more {}", noun));
  }
  return text;
}

std::string change_table(const std::vector<Change>& changes, std::size_t budget) {
  constexpr std::size_t kForEnds = 300;  // heads, the fold, and what is not listed
  const bool levels = std::any_of(changes.begin(), changes.end(), [&](const Change& each) {
    return each.level != changes.front().level;
  });
  std::vector<std::string> rows;
  std::size_t size = kForEnds;
  for (const Change& change : changes) {
    std::string row = row_of(change, levels);
    size += row.size();
    if (size > budget) break;
    rows.push_back(std::move(row));
  }
  return folded_table(levels ? "| change | place | kind | level |\n|---|---|---|---|\n"
                             : "| change | place | kind |\n|---|---|---|\n",
                      rows, changes.size(), "change");
}

std::string section_of(const CompareReport& report, const std::string& name, const std::string& url,
                       std::size_t budget, bool brief) {
  std::string text = fmt::format("### {}\n\n**{}**\n\n", escaped(name), verdict_of(report));
  if (!report.error.empty()) text += escaped(report.error) + "\n\n";
  if (!report.external_asset_of.empty()) text += escaped(parents_of(report)) + "\n\n";
  const std::string pictures = pictures_of(report, url, brief);
  constexpr std::size_t kForRows = 1000;  // pictures leave some room
  if (text.size() + pictures.size() + kForRows <= budget) text += pictures;
  text += change_table(report.changes, std::max(budget, text.size()) - text.size());
  const auto list = [&](std::string_view title, const std::vector<std::string>& rows) {
    for (const std::string& each : rows) {
      const std::string row = fmt::format("\n- {}: {}", title, escaped(each));
      if (text.size() + row.size() + 2 > budget) return;
      text += row;
    }
  };
  list("unproven", report.unproven);
  list("storage", storage_rows(report));
  if (!report.picture_problem.empty()) list("pictures", {report.picture_problem});
  while (text.ends_with('\n')) text.pop_back();
  return text + "\n\n";
}

// A list of rows up to a number of bytes, then how many there are beside them.
std::string list_of(const std::vector<std::string>& rows, std::size_t all, std::size_t budget) {
  std::string text;
  std::size_t shown = 0;
  while (shown < rows.size() && text.size() + rows[shown].size() <= budget) text += rows[shown++];
  return shown < all ? text + fmt::format("- {} more\n", all - shown) : text;
}

}  // namespace

void CompareMarkdown::count(const CompareReport& report) {
  if (!report.error.empty()) {
    ++count_.unread;
  } else if (report.old_path.empty() || report.new_path.empty()) {
    ++(report.old_path.empty() ? count_.added : count_.removed);
  } else {
    ++count_.levels[static_cast<std::size_t>(report.level)];
  }
}

void CompareMarkdown::add(const CompareReport& report, const std::string& name) {
  count(report);
  const bool has_room = collected_ <= kMostMarkdown + kForTable;  // else pairs are only counted
  if (pairs_ > 1 && !needs_section(report)) {
    if (report.level != CompareLevel::storage || !has_room) return;
    std::string row = "- " + escaped(name);
    const auto& files = report.sizes.empty() ? CompareSize() : report.sizes.front();
    if (files.old_bytes != files.new_bytes) row += ": " + escaped(size_row(files));
    collected_ += row.size();
    stored_.push_back(row + '\n');
    return;
  }
  Section section;
  if (has_room) {
    const std::size_t most = kMostMarkdown - kForTotals - (pairs_ > 1 ? kForTable + kForStored : 0);
    section.summary = fmt::format("| {} | {} |\n", escaped(name, 100), summary_of(report));
    section.brief =
        section_of(report, name, picture_url_, pairs_ > 1 ? kForSection : most, pairs_ > 1);
    if (pairs_ > 1 && collected_in_full_ <= kMostMarkdown) {
      section.full = section_of(report, name, picture_url_, most, false);
    }
    collected_ += section.summary.size() + section.brief.size();
    collected_in_full_ += section.full.size();
  }
  changed_.push_back(std::move(section));
}

std::string CompareMarkdown::summary_table() const {
  if (pairs_ < 2 || changed_.empty()) return {};
  std::vector<std::string> rows;
  std::size_t size = 0;
  for (const Section& section : changed_) {
    size += section.summary.size();
    if (section.summary.empty() || size > kForTable) break;
    rows.push_back(section.summary);
  }
  return folded_table("| asset | what changed |\n|---|---|\n", rows, rows.size(), "asset") + '\n';
}

// All sections in brief, as many as there is room for; then the first ones in full.
std::string CompareMarkdown::sections(std::size_t budget) const {
  std::size_t shown = 0, size = 0;
  for (const Section& section : changed_) {
    if (section.brief.empty() || size + section.brief.size() > budget) break;
    size += section.brief.size();
    ++shown;
  }
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [summary, brief, full] = changed_[i];
    const bool fits = !full.empty() && size + full.size() <= budget + brief.size();
    if (fits) size = size + full.size() - brief.size();
    text += fits ? full : brief;
  }
  if (shown < changed_.size()) {
    text += not_listed(changed_.size() - shown, shown == 0 ? "pair" : "more pair") + '\n';
  }
  return text;
}

std::string CompareMarkdown::finish() const {
  std::vector<std::string> parts;
  const auto part = [&](std::uint64_t count, std::string_view words) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, words));
  };
  part(count_.levels[3], count_.levels[3] == 1 ? "differs" : "differ");
  part(count_.added, "added");
  part(count_.removed, "removed");
  part(count_.levels[2], "within bounds");
  part(count_.levels[1], "only stored differently");
  part(count_.levels[0], "identical");
  part(count_.unread, "cannot be compared");
  if (pairs_ == 0) return "No asset changed.\n";
  std::string text;
  if (pairs_ > 1) {
    text = fmt::format("**{}: {}**\n\n", counted(pairs_, "asset"), fmt::join(parts, ", "));
  }
  text += summary_table();
  std::string stored;
  if (!stored_.empty()) {
    stored = fmt::format(
        "<details><summary>{} only stored differently</summary>\n\n{}\n</details>\n",
        counted(count_.levels[1], "asset"), list_of(stored_, count_.levels[1], kForStored));
  }
  constexpr std::size_t kForRest = 100;  // how many are not listed
  text += sections(kMostMarkdown - kForRest - text.size() - stored.size());
  text += stored;
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace gltfx::tool
