// SPDX-License-Identifier: Apache-2.0
#include "pipeline/own_example.hpp"

#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "rules/own/own_rules.hpp"

namespace gltfx {
namespace {

// Without the other pages, of which each is tested by itself.
FileReport report_on(const validate::OwnPage& page, const validate::OwnExample& example,
                     const std::shared_ptr<const OwnRules>& own, bool with_builtin) {
  ValidateOptions options;
  options.own_rules = own;
  options.select.emplace(page.code);  // also if it is a hint
  if (with_builtin) {
    for (const RuleDescription& rule : rules()) options.select.emplace(rule.code);
  }
  MemoryAsset asset{example_bytes(example.text), {}};
  asset.name = example.file;
  return validate_bytes(std::move(asset), options);
}

/// The examples of one page.
class PageTest {
 public:
  PageTest(const validate::OwnPage& page, std::shared_ptr<const OwnRules> rules,
           OwnRuleTests& tests)
      : page_(page), rules_(std::move(rules)), tests_(tests) {}

  void run() {
    check(page_.bad, true);
    check(page_.good, false);
  }

 private:
  void add(std::vector<std::string>& list, const validate::OwnExample& example, bool bad,
           std::string_view what) const {
    list.push_back(fmt::format("{}:{}: {} example: {}", printable(page_.file), example.line,
                               bad ? "bad" : "good", what));
  }

  void check(const validate::OwnExample& example, bool bad) {
    ++tests_.examples;
    const FileReport report = report_on(page_, example, rules_, true);
    const Diagnostic* found = nullptr;
    const Diagnostic* other = nullptr;
    for (const Diagnostic& one : report.diagnostics) {
      if (one.code == page_.code) {
        if (found == nullptr) found = &one;
      } else if (one.severity == Severity::error && other == nullptr) {
        other = &one;
      }
    }
    if (!report.info) {
      return add(tests_.failures, example, bad,
                 fmt::format("it is not an asset that can be checked{}{}",
                             other == nullptr ? "" : ": ", other == nullptr ? "" : other->message));
    }
    if (bad && found == nullptr) {
      add(tests_.failures, example, bad, fmt::format("{} does not report it", page_.code));
    } else if (!bad && found != nullptr) {
      add(tests_.failures, example, bad,
          fmt::format("{} reports it: {} {}", page_.code, found->message, found->help));
    }
    if (other != nullptr) {
      add(tests_.notes, example, bad,
          fmt::format("{} at {}: {}", other->code,
                      other->pointer.empty() ? "the root" : other->pointer, other->message));
    }
  }

  const validate::OwnPage& page_;
  std::shared_ptr<const OwnRules> rules_;
  OwnRuleTests& tests_;
};

}  // namespace

FileReport validate_own_example(std::string_view code, std::string_view example,
                                const std::shared_ptr<const OwnRules>& own) {
  for (const auto& page : own->pages()) {
    if (page->code != code) continue;
    return report_on(*page, example == page->good.text ? page->good : page->bad, own, false);
  }
  return {};
}

OwnRuleTests test_own_rules(const std::shared_ptr<const OwnRules>& rules) {
  OwnRuleTests tests;
  if (!rules) return tests;
  for (const auto& page : rules->pages()) PageTest(*page, rules, tests).run();
  return tests;
}

}  // namespace gltfx
