// SPDX-License-Identifier: Apache-2.0
#include "report/occurrences.hpp"

#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "report/wording.hpp"

namespace gltfx::report {
namespace {

Diagnostic repeat_of(const Diagnostic& finding, const Repeat& repeat) {
  Diagnostic one;
  one.code = finding.code;
  one.severity = finding.severity;
  one.message = repeat.message;
  one.help = repeat.help;
  one.pointer = repeat.pointer;
  one.object_name = repeat.object_name;
  one.location = repeat.location;
  one.count = repeat.count;
  one.requirement = repeat.requirement;
  if (one.count > 1) one.last_pointer = one.pointer;
  return one;
}

}  // namespace

void for_each_occurrence(const FileReport& report,
                         const std::function<void(const Diagnostic&)>& consume) {
  auto next = report.repeats.begin();
  for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
    const Diagnostic& finding = report.diagnostics[i];
    const auto first = next;
    std::uint64_t listed = 0;
    for (; next != report.repeats.end() && next->finding == i; ++next) listed += next->count;
    if (first == next) {
      consume(finding);
      continue;
    }
    Diagnostic own = finding;
    own.count = own.count > listed ? own.count - listed : 1;
    if (std::prev(next)->pointer == finding.last_pointer) own.last_pointer = own.pointer;
    consume(own);
    for (auto each = first; each != next; ++each) consume(repeat_of(finding, *each));
  }
}

std::string Identity::label() const {
  return number == 1 ? text : fmt::format("{} #{}", text, number);
}

Identity Identities::next(const Diagnostic& finding) {
  Diagnostic place;
  place.pointer = pointer_pattern(finding.pointer);
  place.object_name = finding.object_name;
  Identity identity{fmt::format("{}{}", finding.code, document_place(place)), 1};
  identity.number = ++met_[identity.text];
  return identity;
}

}  // namespace gltfx::report
