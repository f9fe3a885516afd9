// SPDX-License-Identifier: Apache-2.0
#include "report/page_requirements.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "report/safe_text.hpp"
#include "report/value_json.hpp"

namespace gltfx::report {
namespace {

constexpr std::size_t kMostElements = 10;  // listed with a limit that does not hold

/// All elements that one limit was checked on.
struct CheckedElements {
  const Requirement* limit = nullptr;  ///< the first of them
  const Requirement* shown = nullptr;  ///< the worst one, whose value stands for all
  std::uint64_t count = 0, failed = 0, not_measured = 0;
  std::vector<const Requirement*> outside;     ///< the first that fail
  std::vector<const Requirement*> unmeasured;  ///< the first without a value
};

// What is measured, how it is taken and how it is compared, without the limit.
std::string subject_of(const Requirement& requirement) {
  return fmt::format("{} {} {} {}", requirement.on, requirement.measure, requirement.op,
                     requirement.parameters);
}

std::string limit_text(const CheckedValue& limit) {
  struct Text {
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const std::vector<std::string>& texts) const {
      return fmt::format("{}", fmt::join(texts, ","));
    }
  };
  return std::visit(Text(), limit);
}

// "mesh triangles max 20000": what the address of a page names. Two limits have the same if they
// differ only in the place where they are stated. The end of a long one is its hash.
std::string key_of_limit(const Requirement& requirement) {
  constexpr std::size_t kLongest = 200;  // code points
  std::string key = fmt::format("{} {} {} {}", requirement.on, requirement.measure, requirement.op,
                                limit_text(requirement.limit));
  if (!requirement.parameters.empty()) key += fmt::format(" ({})", requirement.parameters);
  if (requirement.severity != Severity::error) {
    key += fmt::format(" {}", severity_name(requirement.severity));
  }
  const std::size_t shown = bytes_of_code_points(key, kLongest);
  if (shown == key.size()) return key;
  const Hash128 hash = hash_bytes(key);
  return fmt::format("{}… {:016x}{:016x}", key.substr(0, shown), hash.high, hash.low);
}

// Whether the value of `a` is nearer to the limit than that of `b`, or further beyond it.
bool is_worse(const Requirement& a, const Requirement& b) {
  if ((a.verdict == Verdict::fail) != (b.verdict == Verdict::fail)) {
    return a.verdict == Verdict::fail;
  }
  const auto* mine = std::get_if<double>(&a.value);
  const auto* other = std::get_if<double>(&b.value);
  if (mine == nullptr || other == nullptr) return mine != nullptr;
  return (a.op == "max" && *mine > *other) || (a.op == "min" && *mine < *other);
}

/// The limits of one run on an asset, in the order in which they were checked.
class CheckedLimits {
 public:
  explicit CheckedLimits(const std::vector<Requirement>& requirements) {
    for (const Requirement& each : requirements) add(each);
  }

  const std::vector<CheckedElements>& all() const { return all_; }

  /// The entry with the same limit, else one with another limit on the same; null: none.
  const CheckedElements* find(const Requirement& requirement) const {
    auto found = by_limit_.find(key_of_limit(requirement));
    if (found == by_limit_.end()) {
      found = by_subject_.find(subject_of(requirement));
      if (found == by_subject_.end()) return nullptr;
    }
    return &all_[found->second];
  }

 private:
  void add(const Requirement& requirement) {
    const auto [entry, fresh] = by_limit_.emplace(key_of_limit(requirement), all_.size());
    if (fresh) {
      by_subject_.emplace(subject_of(requirement), all_.size());
      all_.emplace_back().limit = &requirement;
    }
    CheckedElements& elements = all_[entry->second];
    ++elements.count;
    if (requirement.verdict == Verdict::fail) {
      ++elements.failed;
      keep(elements.outside, requirement);
    } else if (requirement.verdict == Verdict::not_measured) {
      ++elements.not_measured;
      keep(elements.unmeasured, requirement);
    }
    if (elements.shown == nullptr || is_worse(requirement, *elements.shown)) {
      elements.shown = &requirement;
    }
  }

  static void keep(std::vector<const Requirement*>& list, const Requirement& requirement) {
    if (list.size() < kMostElements && !requirement.pointer.empty()) list.push_back(&requirement);
  }

  std::vector<CheckedElements> all_;
  std::map<std::string, std::size_t, std::less<>> by_limit_, by_subject_;
};

void write_outcome(json::Writer& writer, const CheckedElements& elements) {
  const bool one_value = elements.count == 1 || elements.failed > 0 ||
                         std::holds_alternative<double>(elements.shown->value);
  writer.key("value");
  write_value(writer, one_value ? elements.shown->value : CheckedValue());
  const Verdict verdict = elements.failed > 0         ? Verdict::fail
                          : elements.not_measured > 0 ? Verdict::not_measured
                                                      : elements.limit->verdict;
  writer.member("verdict", verdict_name(verdict));
  if (elements.failed > 0) writer.member("failed", elements.failed);
  if (elements.not_measured > 0) writer.member("notMeasured", elements.not_measured);
}

void write_element(json::Writer& writer, const Requirement& requirement) {
  writer.begin_object();
  writer.member("pointer", long_value(requirement.pointer));
  if (!requirement.object_name.empty()) {
    writer.member("object", long_value(requirement.object_name));
  }
  writer.key("value");
  write_value(writer, requirement.value);
  writer.end_object();
}

void write_elements(json::Writer& writer, const CheckedElements& elements) {
  if (elements.outside.empty() && elements.unmeasured.empty()) return;
  writer.key("elements");
  writer.begin_array();
  for (const auto* list : {&elements.outside, &elements.unmeasured}) {
    for (const Requirement* each : *list) write_element(writer, *each);
  }
  writer.end_array();
}

}  // namespace

void write_page_requirements(json::Writer& writer, const std::vector<Requirement>& requirements,
                             const std::vector<Requirement>& previous) {
  const CheckedLimits now(requirements);
  const CheckedLimits then(previous);
  writer.begin_array();
  for (const CheckedElements& elements : now.all()) {
    const Requirement& limit = *elements.limit;
    writer.begin_object();
    writer.member("key", key_of_limit(limit));
    writer.member("measure", limit.measure);
    writer.member("on", limit.on);
    writer.member("op", limit.op);
    writer.key("limit");
    write_value(writer, limit.limit);
    if (!limit.unit.empty()) writer.member("unit", limit.unit);
    writer.member("from", limit.from);
    if (!limit.parameters.empty()) writer.member("parameters", limit.parameters);
    writer.member("severity", severity_name(limit.severity));
    write_outcome(writer, elements);
    write_elements(writer, elements);
    if (const CheckedElements* before = then.find(limit)) {
      writer.key("before");
      writer.begin_object();
      write_outcome(writer, *before);
      writer.end_object();
    }
    writer.end_object();
  }
  writer.end_array();
}

}  // namespace gltfx::report
