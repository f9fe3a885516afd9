// SPDX-License-Identifier: Apache-2.0
#include "report/sarif_parts.hpp"

#include <algorithm>
#include <utility>

namespace gltfx::report {

void SarifResults::add(Severity severity, const std::function<void(std::string&)>& write) {
  const auto own = static_cast<std::size_t>(severity);
  if (size_ == kMost) {
    std::size_t last = results_.size() - 1;
    while (results_[last].empty()) --last;
    left_out_.add(static_cast<Severity>(std::max(own, last)));
    if (own >= last) return;
    results_[last].pop_back();
    --size_;
  }
  Result result{met_++, {}};
  write(result.text);
  results_[own].push_back(std::move(result));
  ++size_;
}

void SarifResults::write(std::string& out) const {
  std::vector<const Result*> all;
  for (const std::vector<Result>& results : results_) {
    for (const Result& result : results) all.push_back(&result);
  }
  std::sort(all.begin(), all.end(),
            [](const Result* a, const Result* b) { return a->number < b->number; });
  std::string_view separator = "\n";
  for (const Result* result : all) {
    out.append(separator).append(result->text);
    separator = ",\n";
  }
}

}  // namespace gltfx::report
