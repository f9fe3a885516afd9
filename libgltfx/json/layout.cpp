// SPDX-License-Identifier: Apache-2.0
#include "json/layout.hpp"

#include <algorithm>
#include <vector>

namespace gltfx::json {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view blank_from(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_blank(text[end])) ++end;
  return text.substr(at, end - at);
}

// Precondition: a character before `end` is not blank, such as an opening bracket.
std::string_view blank_before(std::string_view text, std::size_t end) {
  std::size_t begin = end;
  while (is_blank(text[begin - 1])) --begin;
  return text.substr(begin, end - begin);
}

bool has_line_end(std::string_view blank) { return blank.find('\n') != std::string_view::npos; }

// Text that is repeated on every added line must not be long: a file with a megabyte of blanks must
// not cause a thousand copies of them.
std::string_view unless_long(std::string_view found, std::string_view usual) {
  constexpr std::size_t kLongest = 16;
  return found.size() <= kLongest ? found : usual;
}

std::string_view last_line(std::string_view blank) { return blank.substr(blank.rfind('\n') + 1); }

/// Walks over the tokens of a valid value once.
class LayOut {
 public:
  LayOut(std::string_view json, const Layout& layout) : json_(json), layout_(layout) {}

  std::string run() {
    while (skip_blank()) step(json_[at_]);
    return std::move(out_);
  }

 private:
  bool skip_blank() {
    at_ += blank_from(json_, at_).size();
    return at_ < json_.size();
  }

  void step(char c) {
    switch (c) {
      case '{':
      case '[':
        return open(c);
      case '}':
      case ']':
        return close(c);
      case ',':
        ++at_;
        return comma();
      case ':':
        ++at_;
        out_ += layout_.colon;
        return;
      default:
        return scalar();
    }
  }

  void open(char bracket) {
    out_ += bracket;
    ++at_;
    skip_blank();
    const char next = json_[at_];
    if (next == '}' || next == ']') {
      out_ += next;
      ++at_;
      return;
    }
    tight_.push_back(layout_.line_end.empty() || (bracket == '[' && is_short_list()));
    if (!tight_.back()) return line_break(tight_.size());
    if (bracket == '{') out_ += layout_.padding;
  }

  void close(char bracket) {
    const bool tight = tight_.back();
    tight_.pop_back();
    if (!tight) line_break(tight_.size());
    if (tight && bracket == '}') out_ += layout_.padding;
    out_ += bracket;
    ++at_;
  }

  void comma() {
    skip_blank();
    if (json_[at_] == '}' || json_[at_] == ']') return;
    out_ += ',';
    if (tight_.back()) {
      out_ += layout_.gap;
    } else {
      line_break(tight_.size());
    }
  }

  // Numbers only, and the file writes those in one line.
  bool is_short_list() const {
    const std::size_t end = json_.find_first_of("]{[\"", at_);
    return layout_.numbers_on_one_line && json_[end] == ']';
  }

  void line_break(std::size_t depth) {
    out_ += layout_.line_end;
    out_ += layout_.indent;
    for (std::size_t i = 0; i < depth; ++i) out_ += layout_.unit;
  }

  void scalar() {
    std::size_t end = at_ + 1;
    if (json_[at_] == '"') {
      while (json_[end] != '"') end += json_[end] == '\\' ? 2 : 1;
      ++end;
    } else {
      end = std::min(json_.find_first_of(",:]} \t\r\n", at_), json_.size());
    }
    out_ += json_.substr(at_, end - at_);
    at_ = end;
  }

  std::string_view json_;
  const Layout& layout_;
  std::size_t at_ = 0;
  std::vector<bool> tight_;  // for each open container: its items are on one line
  std::string out_;
};

}  // namespace

std::string lay_out(std::string_view json, const Layout& layout) {
  return LayOut(json, layout).run();
}

LayoutFinder::LayoutFinder(const Document& document) : document_(document) {
  const std::string_view text = document_.text();
  bool seen_colon = false;
  for (NodeId id = 0; id < document_.node_count(); ++id) {
    const Node& node = document_.node(id);
    if (node.kind == Kind::key && !seen_colon) {
      common_.colon =
          unless_long(text.substr(node.end, document_.node(id + 1).begin - node.end), ": ");
      common_.gap = std::string(common_.colon.ends_with(' ') ? 1 : 0, ' ');
      seen_colon = true;
    }
    const std::size_t comma =
        node.kind == Kind::number_array ? document_.raw(id).find(',') : std::string_view::npos;
    if (comma == std::string_view::npos) continue;
    const std::string_view blank = blank_from(document_.raw(id), comma + 1);
    common_.numbers_on_one_line = !has_line_end(blank);
    if (common_.numbers_on_one_line) common_.gap = unless_long(blank, " ");
    break;
  }
  const std::string_view blank = before_first_item(document_.root());
  if (has_line_end(blank) && !last_line(blank).empty()) {
    common_.unit = unless_long(last_line(blank), "  ");
  }
}

Layout LayoutFinder::of(NodeId container) const {
  const std::string_view blank = before_first_item(container);
  const bool empty = document_.next(container) == container + 1;
  if (!empty) return of_items(container, blank);
  if (container == document_.root()) return common_;
  const NodeId parent = parent_of(container);
  Layout layout = of_items(parent, before_first_item(parent));
  if (!layout.line_end.empty()) layout.indent += layout.unit;
  return layout;
}

Layout LayoutFinder::of_items(NodeId container, std::string_view blank) const {
  Layout layout = common_;
  if (!has_line_end(blank)) {
    layout.padding = blank;
    return layout;
  }
  layout.line_end = blank.find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
  layout.indent = last_line(blank);
  const std::string_view closing =
      blank_before(document_.text(), document_.node(container).end - 1);
  const std::string_view outer = last_line(closing);
  if (has_line_end(closing) && layout.indent.size() > outer.size() &&
      std::string_view(layout.indent).substr(0, outer.size()) == outer) {
    layout.unit = unless_long(std::string_view(layout.indent).substr(outer.size()), common_.unit);
  }
  return layout;
}

std::string_view LayoutFinder::before_first_item(NodeId container) const {
  return blank_from(document_.text(), document_.node(container).begin + 1);
}

NodeId LayoutFinder::parent_of(NodeId node) const {
  if (parents_.empty()) find_parents();
  return parents_[node];
}

void LayoutFinder::find_parents() const {
  parents_.resize(document_.node_count());
  std::vector<NodeId> open;
  for (NodeId at = 0; at < document_.node_count(); ++at) {
    while (!open.empty() && document_.next(open.back()) <= at) open.pop_back();
    parents_[at] = open.empty() ? document_.root() : open.back();
    const Kind kind = document_.kind(at);
    if (kind == Kind::object || kind == Kind::array) open.push_back(at);
  }
}

}  // namespace gltfx::json
