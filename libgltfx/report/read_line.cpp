// SPDX-License-Identifier: Apache-2.0
#include "report/read_line.hpp"

#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/code.hpp"
#include "base/interned.hpp"
#include "json/parse.hpp"
#include "report/entry.hpp"
#include "report/fields.hpp"
#include "report/rule_lookup.hpp"

namespace gltfx::report {
namespace {

using json::NodeId;

/// Reads members of objects into values. A missing member does not change its value, members of
/// later versions are ignored, and a wrong type is recorded.
class JsonIn {
 public:
  static constexpr bool kIsJson = true;
  template <class Value>
  using Of = Value;

  JsonIn(const json::Document& document, std::span<const RuleDescription> rules)
      : document_(document), object_(document.root()), rules_(rules) {}

  const std::string& error() const { return error_; }
  void blame(std::string_view name) {
    if (error_.empty()) error_ = fmt::format("'{}' is missing or not as it should be", name);
  }

  bool is_full() const { return true; }
  bool is_readable() const { return true; }
  bool has_timings() const { return true; }

  void text(std::string_view name, std::string& value, bool /*when*/ = true) {
    const NodeId node = find(name);
    if (node == json::kNoNode) return;
    if (!document_.is_string(node)) return blame(name);
    value = document_.string(node);
  }
  void long_text(std::string_view name, std::string& value, bool /*when*/ = true) {
    text(name, value);
  }
  void bytes(std::string_view name, std::string& value);
  template <class Integer>
  void number(std::string_view name, Integer& value, bool /*when*/ = true) {
    const NodeId node = find(name);
    if (node == json::kNoNode) return;
    const auto given = document_.unsigned_integer(node);
    if (!given || *given > std::numeric_limits<Integer>::max()) return blame(name);
    value = static_cast<Integer>(*given);
  }
  void flag(std::string_view name, bool& value, bool /*when*/ = true) {
    const NodeId node = find(name);
    if (node == json::kNoNode) return;
    if (!document_.is_boolean(node)) return blame(name);
    value = document_.kind(node) == json::Kind::true_value;
  }
  void code(std::string_view name, std::string_view& value) {
    std::string word;
    text(name, word);
    const RuleDescription* rule = find_rule_in(rules_, word);
    // A rule of the user, whose page this run does not have.
    if (rule == nullptr && !has_code_form(word)) return blame(name);
    value = rule == nullptr ? interned(word) : rule->code;
  }
  void severity(std::string_view name, Severity& value) {
    std::string word;
    text(name, word);
    const auto known = severity_from_name(word);
    if (!known) return blame(name);
    value = *known;
  }
  void verdict(std::string_view name, Verdict& value) {
    std::string word;
    text(name, word);
    const auto known = verdict_from_name(word);
    if (!known) return blame(name);
    value = *known;
  }
  void value(std::string_view name, CheckedValue& value);
  void texts(std::string_view name, std::vector<std::string>& values) {
    each(name, [&](NodeId element) {
      if (!document_.is_string(element)) return blame(name);
      values.push_back(document_.string(element));
    });
  }
  void optional(std::string_view name, std::optional<std::uint64_t>& value) {
    if (find(name) != json::kNoNode) number(name, value.emplace());
  }
  void optional(std::string_view name, std::optional<std::string>& value) {
    if (find(name) != json::kNoNode) text(name, value.emplace());
  }
  template <class Value>
  void optional(std::string_view name, std::optional<Value>& value) {
    if (!is_object(name)) return;
    value = Value();  // clang 14 cannot emplace what lies in a class
    object(name, *value);
  }
  template <class Value>
  void optional(std::string_view name, std::shared_ptr<const Value>& value, bool /*when*/ = true) {
    if (!is_object(name)) return;
    const auto made = std::make_shared<Value>();
    object(name, *made);
    value = made;
  }
  template <class Value>
  void object(std::string_view name, Value& value, bool /*when*/ = true) {
    if (is_object(name)) inside(find(name), value);
  }
  template <class Value>
  void list(std::string_view name, std::vector<Value>& values, bool /*when*/ = true) {
    each(name, [&](NodeId element) { inside(element, values.emplace_back()); });
  }

 private:
  NodeId find(std::string_view name) const { return document_.find(object_, name); }
  bool is_object(std::string_view name) {
    const NodeId node = find(name);
    if (node == json::kNoNode || document_.is_object(node)) return node != json::kNoNode;
    blame(name);
    return false;
  }
  template <class Read>
  void each(std::string_view name, const Read& read) {
    const NodeId node = find(name);
    if (node == json::kNoNode) return;
    if (document_.kind(node) != json::Kind::array) return blame(name);
    for (const NodeId element : document_.elements(node)) read(element);
  }
  template <class Value>
  void inside(NodeId object, Value& value) {
    const NodeId outside = std::exchange(object_, object);
    fields(*this, value);
    object_ = outside;
  }

  const json::Document& document_;
  NodeId object_;
  std::span<const RuleDescription> rules_;
  std::string error_;
};

void JsonIn::bytes(std::string_view name, std::string& value) {
  text(name, value);
  std::string digits;
  text(fmt::format("{}Hex", name), digits);
  if (digits.empty()) return;
  value.clear();
  const auto digit = [&](char c) {
    const std::size_t at = std::string_view("0123456789abcdef").find(c);
    if (at == std::string_view::npos) blame(name);
    return static_cast<unsigned>(at & 15U);
  };
  for (std::size_t at = 0; at + 1 < digits.size(); at += 2) {
    value += static_cast<char>(digit(digits[at]) << 4U | digit(digits[at + 1]));
  }
}

void JsonIn::value(std::string_view name, CheckedValue& value) {
  const NodeId node = find(name);
  if (node == json::kNoNode || document_.kind(node) == json::Kind::null) return;
  if (document_.is_string(node)) {
    value = document_.string(node);
  } else if (document_.is_boolean(node)) {
    value = document_.kind(node) == json::Kind::true_value;
  } else if (document_.is_number(node)) {
    value = document_.number(node).value;
  } else {
    texts(name, value.emplace<std::vector<std::string>>());
  }
}

template <class Form>
void fields(Form& form, typename Form::template Of<Shard>& shard) {
  form.number("index", shard.index);
  form.number("count", shard.count);
}

/// What is read of a file and of a whole report.
struct CheckedFile {
  std::string path;
  std::vector<Requirement> requirements;
};

struct CheckedFiles {
  std::uint64_t format = 0;
  std::vector<CheckedFile> files;
};

template <class Form>
void fields(Form& form, typename Form::template Of<CheckedFile>& file) {
  form.bytes("path", file.path);
  form.list("requirements", file.requirements);
}

template <class Form>
void fields(Form& form, typename Form::template Of<CheckedFiles>& report) {
  form.number("format", report.format);
  form.list("files", report.files);
}

RunHead read_head(JsonIn& in) {
  RunHead head;
  std::uint64_t format = 0;
  in.text("gltfx", head.version);
  in.number("format", format);
  if (format != kJsonFormat) in.blame("format");
  in.text("profile", head.profile);
  in.text("pixels", head.pixel_level);
  std::string loudness(severity_name(Severity::error));
  in.text("failOn", loudness);
  head.fail_on = severity_from_name(loudness);
  if (!head.fail_on && loudness != kNever) in.blame("failOn");
  in.flag("timings", head.timings);
  in.object("shard", head.shard);
  if (head.shard.index < 1 || head.shard.index > head.shard.count) in.blame("shard");
  return head;
}

}  // namespace

Result<ReportLine> read_line(std::string_view line, std::span<const RuleDescription> rules) {
  const json::Parsed parsed = json::parse(line);
  if (!parsed.ok() || !parsed.document.is_object(parsed.document.root())) {
    return Error{"it is not a JSON object; was the run cut off?"};
  }
  const NodeId root = parsed.document.root();
  JsonIn in(parsed.document, rules);
  ReportLine read;
  if (parsed.document.holds(root, "path")) {
    fields(in, read.emplace<FileReport>());
  } else if (parsed.document.holds(root, "gltfx")) {
    read = read_head(in);
  } else if (parsed.document.holds(root, "summary")) {
    read = RunEnd();
  } else {
    return Error{"it is no line of a report that --format jsonl wrote"};
  }
  if (!in.error().empty()) return Error{in.error()};
  return read;
}

Result<RequirementsByPath> read_requirements(std::string_view text) {
  const json::Parsed parsed = json::parse(text);
  if (!parsed.ok() || !parsed.document.is_object(parsed.document.root())) {
    return Error{"it is not a JSON object"};
  }
  JsonIn in(parsed.document, {});
  CheckedFiles report;
  fields(in, report);
  if (report.format != kJsonFormat || !parsed.document.holds(parsed.document.root(), "files")) {
    return Error{"it is no report that --format json wrote"};
  }
  if (!in.error().empty()) return Error{in.error()};
  RequirementsByPath by_path;
  for (CheckedFile& file : report.files) {
    by_path.emplace(std::move(file.path), std::move(file.requirements));
  }
  return by_path;
}

}  // namespace gltfx::report
