// SPDX-License-Identifier: Apache-2.0
// The counterpart of entry.cpp: members that it writes are read, unknown ones are left to later
// versions.
#include "report/read_line.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "json/parse.hpp"
#include "report/entry.hpp"
#include "report/rule_lookup.hpp"

namespace gltfx::report {
namespace {

using json::NodeId;

// Members of objects into values. What is missing leaves a value alone; what is of another type is
// remembered.
class Reader {
 public:
  Reader(const json::Document& document, std::span<const RuleDescription> rules)
      : document_(document), rules_(rules) {}

  const std::string& error() const { return error_; }

  RunHead head(NodeId line);
  FileReport file(NodeId entry);

 private:
  NodeId find(NodeId object, std::string_view name) const { return document_.find(object, name); }
  void blame(std::string_view name) {
    if (error_.empty()) error_ = fmt::format("'{}' is missing or not as it should be", name);
  }
  void text(NodeId object, std::string_view name, std::string& value);
  void bytes(NodeId object, std::string_view name, std::string& value);
  void flag(NodeId object, std::string_view name, bool& value);
  template <class Integer>
  void number(NodeId object, std::string_view name, Integer& value);
  template <class Read>
  void list(NodeId object, std::string_view name, const Read& read);
  void texts(NodeId object, std::string_view name, std::vector<std::string>& values);
  /// kNoNode when there is none; the error is noted when it is no object.
  NodeId object(NodeId parent, std::string_view name);

  Counts counts(NodeId node);
  Location location(NodeId node);
  Excerpt excerpt(NodeId node);
  std::shared_ptr<const ProposedFix> fix(NodeId node);
  Diagnostic finding(NodeId node);
  Repeat repeat(NodeId node);
  ResourceInfo resource(NodeId node);
  AssetInfo info(NodeId node);

  const json::Document& document_;
  std::span<const RuleDescription> rules_;
  std::string error_;
};

void Reader::text(NodeId object, std::string_view name, std::string& value) {
  const NodeId node = find(object, name);
  if (node == json::kNoNode) return;
  if (!document_.is_string(node)) return blame(name);
  value = document_.string(node);
}

void Reader::bytes(NodeId object, std::string_view name, std::string& value) {
  text(object, name, value);
  std::string digits;
  text(object, fmt::format("{}Hex", name), digits);
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

void Reader::flag(NodeId object, std::string_view name, bool& value) {
  const NodeId node = find(object, name);
  if (node == json::kNoNode) return;
  if (!document_.is_boolean(node)) return blame(name);
  value = document_.kind(node) == json::Kind::true_value;
}

template <class Integer>
void Reader::number(NodeId object, std::string_view name, Integer& value) {
  const NodeId node = find(object, name);
  if (node == json::kNoNode) return;
  const auto given = document_.unsigned_integer(node);
  if (!given || *given > std::numeric_limits<Integer>::max()) return blame(name);
  value = static_cast<Integer>(*given);
}

template <class Read>
void Reader::list(NodeId object, std::string_view name, const Read& read) {
  const NodeId node = find(object, name);
  if (node == json::kNoNode) return;
  if (document_.kind(node) != json::Kind::array) return blame(name);
  for (const NodeId element : document_.elements(node)) read(element);
}

void Reader::texts(NodeId object, std::string_view name, std::vector<std::string>& values) {
  list(object, name, [&](NodeId element) {
    if (!document_.is_string(element)) return blame(name);
    values.push_back(document_.string(element));
  });
}

NodeId Reader::object(NodeId parent, std::string_view name) {
  const NodeId node = find(parent, name);
  if (node == json::kNoNode || document_.is_object(node)) return node;
  blame(name);
  return json::kNoNode;
}

Counts Reader::counts(NodeId node) {
  Counts counts;
  number(node, "errors", counts.errors);
  number(node, "warnings", counts.warnings);
  number(node, "infos", counts.infos);
  number(node, "hints", counts.hints);
  return counts;
}

Location Reader::location(NodeId node) {
  Location at;
  number(node, "line", at.line);
  number(node, "column", at.column);
  number(node, "endLine", at.end_line);
  number(node, "endColumn", at.end_column);
  number(node, "utf16Column", at.utf16_column);
  number(node, "utf16EndColumn", at.utf16_end_column);
  number(node, "byte", at.offset);
  number(node, "length", at.length);
  return at;
}

Excerpt Reader::excerpt(NodeId node) {
  Excerpt excerpt;
  bytes(node, "text", excerpt.text);
  number(node, "caret", excerpt.caret);
  number(node, "width", excerpt.width);
  flag(node, "cutLeft", excerpt.cut_left);
  flag(node, "cutRight", excerpt.cut_right);
  return excerpt;
}

std::shared_ptr<const ProposedFix> Reader::fix(NodeId node) {
  const auto fix = std::make_shared<ProposedFix>();
  text(node, "description", fix->description);
  list(node, "replacements", [&](NodeId element) {
    Replacement& replacement = fix->replacements.emplace_back();
    replacement.place = location(object(element, "location"));
    text(element, "text", replacement.text);
  });
  return fix;
}

Diagnostic Reader::finding(NodeId node) {
  Diagnostic finding;
  std::string word;
  text(node, "code", word);
  const RuleDescription* rule = find_rule_in(rules_, word);
  if (rule == nullptr) {
    blame("code");
    return finding;
  }
  finding.code = rule->code;
  text(node, "severity", word);
  const auto severity = severity_from_name(word);
  if (!severity) blame("severity");
  finding.severity = severity.value_or(Severity::error);
  text(node, "message", finding.message);
  text(node, "help", finding.help);
  flag(node, "fixable", finding.fixable);
  text(node, "pointer", finding.pointer);
  text(node, "object", finding.object_name);
  text(node, "lastPointer", finding.last_pointer);
  number(node, "count", finding.count);
  if (find(node, "offset") != json::kNoNode) number(node, "offset", finding.offset.emplace());
  if (const NodeId at = object(node, "location"); at != json::kNoNode) {
    finding.location = location(at);
  }
  if (const NodeId at = object(node, "excerpt"); at != json::kNoNode) {
    finding.excerpt = excerpt(at);
  }
  if (const NodeId at = object(node, "fix"); at != json::kNoNode) finding.fix = fix(at);
  return finding;
}

Repeat Reader::repeat(NodeId node) {
  Repeat repeat;
  number(node, "finding", repeat.finding);
  text(node, "message", repeat.message);
  text(node, "help", repeat.help);
  text(node, "pointer", repeat.pointer);
  text(node, "object", repeat.object_name);
  if (const NodeId at = object(node, "location"); at != json::kNoNode) {
    repeat.location = location(at);
  }
  number(node, "count", repeat.count);
  return repeat;
}

ResourceInfo Reader::resource(NodeId node) {
  ResourceInfo resource;
  text(node, "pointer", resource.pointer);
  text(node, "mimeType", resource.mime_type);
  text(node, "storage", resource.storage);
  text(node, "uri", resource.uri);
  if (find(node, "byteLength") != json::kNoNode) {
    number(node, "byteLength", resource.byte_length.emplace());
  }
  if (const NodeId at = object(node, "image"); at != json::kNoNode) {
    resource.image = ResourceInfo::Image();  // clang 14 cannot emplace what lies in a class
    ResourceInfo::Image& image = *resource.image;
    number(at, "width", image.width);
    number(at, "height", image.height);
    number(at, "bits", image.bits);
    text(at, "format", image.format);
    text(at, "primaries", image.primaries);
    text(at, "transfer", image.transfer);
  }
  return resource;
}

AssetInfo Reader::info(NodeId node) {
  AssetInfo info;
  text(node, "version", info.version);
  text(node, "minVersion", info.min_version);
  if (find(node, "generator") != json::kNoNode) text(node, "generator", info.generator.emplace());
  texts(node, "extensionsUsed", info.extensions_used);
  texts(node, "extensionsRequired", info.extensions_required);
  list(node, "resources", [&](NodeId element) { info.resources.push_back(resource(element)); });
  number(node, "animationCount", info.animation_count);
  number(node, "materialCount", info.material_count);
  flag(node, "hasMorphTargets", info.has_morph_targets);
  flag(node, "hasSkins", info.has_skins);
  flag(node, "hasTextures", info.has_textures);
  flag(node, "hasDefaultScene", info.has_default_scene);
  number(node, "drawCallCount", info.draw_call_count);
  number(node, "totalVertexCount", info.total_vertex_count);
  number(node, "totalTriangleCount", info.total_triangle_count);
  number(node, "maxUVs", info.max_uvs);
  number(node, "maxInfluences", info.max_influences);
  number(node, "maxAttributes", info.max_attributes);
  return info;
}

FileReport Reader::file(NodeId entry) {
  FileReport report;
  number(entry, "position", report.position);
  bytes(entry, "path", report.path);
  text(entry, "mimeType", report.mime_type);
  flag(entry, "readable", report.readable);
  report.counts = counts(object(entry, "counts"));
  flag(entry, "truncated", report.truncated);
  number(entry, "suppressed", report.suppressed);
  number(entry, "leftOut", report.left_out);
  number(entry, "unchanged", report.unchanged);
  number(entry, "microseconds", report.microseconds);
  number(entry, "fixable", report.fixable);
  number(entry, "unverified", report.unverified);
  number(entry, "imagesWanted", report.images_wanted);
  number(entry, "imagesDecoded", report.images_decoded);
  list(entry, "findings", [&](NodeId element) { report.diagnostics.push_back(finding(element)); });
  list(entry, "repeats", [&](NodeId element) { report.repeats.push_back(repeat(element)); });
  if (const NodeId at = object(entry, "info"); at != json::kNoNode) report.info = info(at);
  return report;
}

RunHead Reader::head(NodeId line) {
  RunHead head;
  std::uint64_t format = 0;
  text(line, "gltfx", head.version);
  number(line, "format", format);
  if (format != kJsonFormat) blame("format");
  text(line, "profile", head.profile);
  text(line, "pixels", head.pixel_level);
  std::string loudness(severity_name(Severity::error));
  text(line, "failOn", loudness);
  head.fail_on = severity_from_name(loudness);
  if (!head.fail_on && loudness != kNever) blame("failOn");
  flag(line, "timings", head.timings);
  if (const NodeId at = object(line, "shard"); at != json::kNoNode) {
    number(at, "index", head.shard.index);
    number(at, "count", head.shard.count);
  }
  const bool counted = head.shard.index >= 1 && head.shard.index <= head.shard.count;
  if (!counted) blame("shard");
  return head;
}

}  // namespace

Result<ReportLine> read_line(std::string_view line, std::span<const RuleDescription> rules) {
  const json::Parsed parsed = json::parse(line);
  if (!parsed.ok() || !parsed.document.is_object(parsed.document.root())) {
    return Error{"it is not a JSON object; was the run cut off?"};
  }
  const NodeId root = parsed.document.root();
  Reader reader(parsed.document, rules);
  ReportLine read;
  if (parsed.document.holds(root, "path")) {
    read = reader.file(root);
  } else if (parsed.document.holds(root, "gltfx")) {
    read = reader.head(root);
  } else if (parsed.document.holds(root, "summary")) {
    read = RunEnd();
  } else {
    return Error{"it is no line of a report that --format jsonl wrote"};
  }
  if (!reader.error().empty()) return Error{reader.error()};
  return read;
}

}  // namespace gltfx::report
