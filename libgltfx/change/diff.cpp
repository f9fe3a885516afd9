// SPDX-License-Identifier: Apache-2.0
#include "change/diff.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include <fmt/format.h>

namespace gltfx::change {
namespace {

using Lines = std::vector<std::string_view>;

constexpr std::size_t kContext = 3;

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

/// Lines of the old text, [begin, end), and their replacement.
struct Block {
  std::size_t begin;
  std::size_t end;
  std::string text;
};

class Differ {
 public:
  Differ(std::string_view text, std::span<const json::Edit> edits)
      : text_(text), edits_(edits), lines_(lines_of(text)) {
    std::size_t at = 0;
    for (const std::string_view line : lines_) {
      starts_.push_back(at);
      at += line.size();
    }
  }

  std::string run() {
    const std::vector<Block> blocks = make_blocks();
    for (std::size_t first = 0; first < blocks.size();) {
      std::size_t last = first + 1;
      while (last < blocks.size() && blocks[last].begin - blocks[last - 1].end <= 2 * kContext) {
        ++last;
      }
      hunk(std::span(blocks).subspan(first, last - first));
      first = last;
    }
    return std::move(out_);
  }

 private:
  std::size_t line_at(std::size_t byte) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), byte);
    return static_cast<std::size_t>(after - starts_.begin()) - 1;
  }
  std::size_t end_of(std::size_t line) const { return starts_[line] + lines_[line].size(); }

  // Edits that share a line make one block.
  std::vector<Block> make_blocks() const {
    std::vector<Block> blocks;
    for (std::size_t first = 0; first < edits_.size();) {
      const std::size_t begin = line_at(edits_[first].span.begin);
      std::size_t end = line_at(edits_[first].span.end) + 1;
      std::size_t last = first + 1;
      while (last < edits_.size() && line_at(edits_[last].span.begin) < end) {
        end = line_at(edits_[last++].span.end) + 1;
      }
      blocks.push_back(trimmed(begin, end, edits_.subspan(first, last - first)));
      first = last;
    }
    return blocks;
  }

  // Removes lines at either end that are the same before and after.
  Block trimmed(std::size_t begin, std::size_t end, std::span<const json::Edit> edits) const {
    const auto from = static_cast<std::uint32_t>(starts_[begin]);
    std::vector<json::Edit> moved(edits.begin(), edits.end());
    for (json::Edit& edit : moved) {
      edit.span.begin -= from;
      edit.span.end -= from;
    }
    const std::string text = json::apply_edits(text_.substr(from, end_of(end - 1) - from), moved);
    Lines fresh = lines_of(text);
    while (begin < end && !fresh.empty() && fresh.back() == lines_[end - 1]) {
      fresh.pop_back();
      --end;
    }
    std::size_t same = 0;
    while (begin < end && same < fresh.size() && fresh[same] == lines_[begin]) {
      ++same;
      ++begin;
    }
    Block block{begin, end, {}};
    for (std::size_t i = same; i < fresh.size(); ++i) block.text += fresh[i];
    return block;
  }

  void line(char mark, std::string_view content) {
    out_ += mark;
    out_ += content;
    if (!content.ends_with('\n')) out_ += "\n\\ No newline at end of file\n";
  }

  void hunk(std::span<const Block> blocks) {
    const std::size_t begin = blocks.front().begin - std::min(blocks.front().begin, kContext);
    const std::size_t end = std::min(blocks.back().end + kContext, lines_.size());
    std::size_t removed = 0;
    std::size_t added = 0;
    for (const Block& block : blocks) {
      removed += block.end - block.begin;
      added += lines_of(block.text).size();
    }
    const std::size_t before = end - begin;
    const std::size_t after = before - removed + added;
    fmt::format_to(std::back_inserter(out_), "@@ -{},{} +{},{} @@\n", begin + (before > 0), before,
                   begin - shrunk_ + grown_ + (after > 0), after);
    std::size_t at = begin;
    for (const Block& block : blocks) {
      for (; at < block.begin; ++at) line(' ', lines_[at]);
      for (; at < block.end; ++at) line('-', lines_[at]);
      for (const std::string_view fresh : lines_of(block.text)) line('+', fresh);
    }
    for (; at < end; ++at) line(' ', lines_[at]);
    shrunk_ += removed;
    grown_ += added;
  }

  std::string_view text_;
  std::span<const json::Edit> edits_;
  Lines lines_;
  std::vector<std::size_t> starts_;
  std::size_t shrunk_ = 0;  // lines removed by the hunks before
  std::size_t grown_ = 0;   // lines added by them
  std::string out_;
};

// The escape of a byte of a name in a C string, as git writes it; empty when it needs none.
std::string escaped(char c) {
  constexpr std::string_view kBytes = "\a\b\t\n\v\f\r\"\\";
  constexpr std::string_view kLetters = "abtnvfr\"\\";
  const std::size_t known = kBytes.find(c);
  if (known != std::string_view::npos) return {'\\', kLetters[known]};
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x20 && byte < 0x7F ? std::string() : fmt::format("\\{:03o}", byte);
}

// A tab ends a name with blanks; otherwise the rest would not be read as a part of the name.
std::string header_name(std::string_view side, std::string_view name) {
  std::string text(side);
  bool quoted = false;
  for (const char c : name) {
    const std::string special = escaped(c);
    quoted = quoted || !special.empty();
    special.empty() ? text += c : text += special;
  }
  if (quoted) return fmt::format("\"{}\"", text);
  return name.find(' ') == std::string_view::npos ? text : text + '\t';
}

std::string marked(std::string_view text, std::string_view mark) {
  if (mark.empty()) return std::string(text);
  std::string out;
  for (const std::string_view line : lines_of(text)) out.append(mark).append(line);
  return out;
}

}  // namespace

std::string unified_diff(std::string_view text, std::span<const json::Edit> edits,
                         std::string_view name, std::string_view mark) {
  if (edits.empty()) return {};
  return marked(fmt::format("--- {}\n+++ {}\n{}", header_name("a/", name), header_name("b/", name),
                            Differ(text, edits).run()),
                mark);
}

}  // namespace gltfx::change
