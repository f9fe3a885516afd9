// SPDX-License-Identifier: Apache-2.0
#include "target/target_file.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/shared_text.hpp"
#include "base/text.hpp"
#include "json/document.hpp"
#include "json/lines.hpp"
#include "json/parse.hpp"

namespace gltfx::target {
namespace {

using json::Document;
using json::kNoNode;
using json::NodeId;

constexpr double kFormat = 1;

/// Reads members and records the first problem, with its line.
class Reader {
 public:
  explicit Reader(std::string_view text)
      : parsed_(json::parse(share_text(std::string(text)))), document_(parsed_.document) {
    if (!parsed_.ok()) {
      fail(parsed_.errors.front().span, "the JSON is invalid");
    } else if (!document_.is_object(document_.root())) {
      fail(document_.root(), "the root is no object");
    } else if (number(document_.root(), "format") != kFormat) {
      fail(document_.root(), "format must be 1");
    }
  }

  const Document& document() const { return document_; }
  const std::optional<Error>& error() const { return error_; }
  void fail(NodeId node, std::string_view problem) { fail(document_.span(node), problem); }

  /// Empty if absent; a value other than a string is a problem.
  std::string text(NodeId object, std::string_view name, bool needed = false) {
    const NodeId value = document_.find(object, name);
    if (value != kNoNode && document_.is_string(value)) return document_.string(value);
    if (value != kNoNode) fail(value, fmt::format("{} must be a string", name));
    if (value == kNoNode && needed) fail(object, fmt::format("{} is missing", name));
    return {};
  }

  /// The member as an object or array of objects; kNoNode, with a problem, if it is not one.
  NodeId container(NodeId object, std::string_view name, json::Kind kind) {
    const NodeId value = document_.find(object, name);
    if (value != kNoNode && document_.kind(value) == kind) return value;
    const std::string_view what = kind == json::Kind::object ? "an object" : "an array";
    fail(value == kNoNode ? object : value, fmt::format("{} must be {}", name, what));
    return kNoNode;
  }

 private:
  double number(NodeId object, std::string_view name) const {
    const NodeId value = document_.find(object, name);
    return value != kNoNode && document_.is_number(value) ? document_.number(value).value : 0;
  }

  void fail(Span span, std::string_view problem) {
    if (error_) return;
    const auto before = document_.text().substr(0, span.begin);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    error_ = Error{document_.text().empty() ? std::string(problem)
                                            : fmt::format("line {}: {}", line, problem)};
  }

  json::Parsed parsed_;
  const Document& document_;
  std::optional<Error> error_;
};

template <class Value, std::size_t N>
std::optional<Value> named(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return static_cast<Value>(at - names.begin());
}

constexpr std::array<std::string_view, 4> kOutcomes{"refused", "ignored", "read", "drawn"};
constexpr std::array<std::string_view, 3> kEffects{"picture", "data", "none"};

class TargetReader {
 public:
  explicit TargetReader(std::string_view text) : reader_(text), document_(reader_.document()) {}

  Result<Target> read() {
    if (reader_.error()) return *reader_.error();
    const NodeId root = document_.root();
    target_.name = reader_.text(root, "name", true);
    target_.title = reader_.text(root, "title", true);
    target_.source = reader_.text(root, "source", true);
    target_.set_up = reader_.text(root, "setUp");
    target_.method = reader_.text(root, "method");
    read_decoders(root);
    read_versions(root);
    if (!reader_.error()) read_features(root);
    if (reader_.error()) return *reader_.error();
    return std::move(target_);
  }

 private:
  void read_decoders(NodeId root) {
    if (!document_.holds(root, "decoders")) return;
    const NodeId list = reader_.container(root, "decoders", json::Kind::array);
    if (list == kNoNode) return;
    for (const NodeId each : document_.elements(list)) {
      if (document_.is_string(each)) {
        target_.decoders.push_back(document_.string(each));
      } else {
        reader_.fail(each, "a decoder must be a string");
      }
    }
  }

  void read_versions(NodeId root) {
    const NodeId list = reader_.container(root, "versions", json::Kind::array);
    if (list == kNoNode) return;
    for (const NodeId each : document_.elements(list)) {
      TargetVersion version{reader_.text(each, "version", true), reader_.text(each, "released")};
      positions_.emplace(version.version, target_.versions.size());
      target_.versions.push_back(std::move(version));
    }
    if (target_.versions.empty()) reader_.fail(list, "versions must not be empty");
  }

  void read_features(NodeId root) {
    const NodeId list = reader_.container(root, "features", json::Kind::object);
    if (list == kNoNode) return;
    for (const auto member : document_.members(list)) {
      TargetFeature feature;
      feature.used = outcomes(member.value, "used");
      feature.required = outcomes(member.value, "required");
      feature.required_with_fallback = outcomes(member.value, "requiredWithFallback");
      target_.features.emplace(document_.key(member.key_id), std::move(feature));
    }
  }

  std::vector<TargetRange> outcomes(NodeId feature, std::string_view name) {
    std::vector<TargetRange> ranges;
    const NodeId value = document_.find(feature, name);
    if (value == kNoNode) return ranges;
    if (document_.kind(value) != json::Kind::array) {
      ranges.push_back({0, target_.versions.size() - 1, outcome(value)});
      return ranges;
    }
    for (const NodeId each : document_.elements(value)) {
      const std::size_t first = position(each, "since");
      const std::size_t last = position(each, "until");
      const NodeId found = document_.find(each, "outcome");
      if (found == kNoNode || first > last || (!ranges.empty() && first <= ranges.back().last)) {
        reader_.fail(each, "a range must have since, until and outcome, in ascending order");
        break;
      }
      ranges.push_back({first, last, outcome(found)});
    }
    return ranges;
  }

  TargetOutcome outcome(NodeId value) {
    const auto found = document_.is_string(value)
                           ? named<TargetOutcome>(kOutcomes, document_.string(value))
                           : std::nullopt;
    if (!found) reader_.fail(value, "an outcome must be refused, ignored, read or drawn");
    return found.value_or(TargetOutcome::read);
  }

  std::size_t position(NodeId range, std::string_view name) {
    const auto at = positions_.find(reader_.text(range, name, true));
    if (at != positions_.end()) return at->second;
    reader_.fail(range, fmt::format("{} must be one of the versions", name));
    return 0;
  }

  Reader reader_;
  const Document& document_;
  Target target_;
  std::map<std::string, std::size_t, std::less<>> positions_;  // of versions
};

}  // namespace

Result<Target> read_target(std::string_view text) { return TargetReader(text).read(); }

Result<std::map<std::string, Feature, std::less<>>> read_features(std::string_view text) {
  Reader reader(text);
  if (reader.error()) return *reader.error();
  const Document& document = reader.document();
  std::map<std::string, Feature, std::less<>> features;
  const NodeId list = reader.container(document.root(), "features", json::Kind::object);
  if (list == kNoNode) return *reader.error();
  for (const auto member : document.members(list)) {
    Feature feature;
    feature.title = reader.text(member.value, "title", true);
    feature.lost = reader.text(member.value, "lost", true);
    feature.help = reader.text(member.value, "help");
    const auto effect = named<FeatureEffect>(kEffects, reader.text(member.value, "effect", true));
    if (!effect) reader.fail(member.value, "effect must be picture, data or none");
    feature.effect = effect.value_or(FeatureEffect::none);
    features.emplace(document.key(member.key_id), std::move(feature));
  }
  if (reader.error()) return *reader.error();
  return features;
}

Result<std::map<std::string, Repair, std::less<>>> read_repairs(std::string_view text) {
  Reader reader(text);
  if (reader.error()) return *reader.error();
  const Document& document = reader.document();
  std::map<std::string, Repair, std::less<>> repairs;
  const NodeId list = reader.container(document.root(), "features", json::Kind::object);
  if (list == kNoNode) return *reader.error();
  for (const auto member : document.members(list)) {
    const std::string name = reader.text(member.value, "repair");
    if (name.empty()) continue;
    const auto repair = named<Repair>(kRepairNames, name);
    if (repair) {
      repairs.emplace(document.key(member.key_id), *repair);
    } else {
      reader.fail(member.value, "repair must be one of those in target/repair.hpp");
    }
  }
  if (reader.error()) return *reader.error();
  return repairs;
}

}  // namespace gltfx::target

namespace gltfx {

std::string_view target_outcome_name(TargetOutcome outcome) {
  return target::kOutcomes[static_cast<std::size_t>(outcome)];
}

std::string TargetChoice::label() const {
  return target->title + " " + target->versions[version].version;
}

const TargetRange* outcome_of(const std::vector<TargetRange>& ranges, std::size_t version) {
  for (const TargetRange& range : ranges) {
    if (range.first <= version && version <= range.last) return &range;
  }
  return nullptr;
}

}  // namespace gltfx
