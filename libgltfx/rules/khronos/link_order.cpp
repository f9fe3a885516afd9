// SPDX-License-Identifier: Apache-2.0
#include "rules/khronos/link_order.hpp"

#include <algorithm>

namespace gltfx::validate {

void LinkOrder::HoldingSink::report(const Path& path, Finding finding) {
  all.push_back({PathCopy(path), std::move(finding)});
}

void LinkOrder::sort() {
  for (std::size_t i = by_place_.size(); i < held_.all.size(); ++i) by_place_.push_back(i);
  std::stable_sort(by_place_.begin(), by_place_.end(), [&](std::size_t a, std::size_t b) {
    return held_.all[a].finding.span.begin < held_.all[b].finding.span.begin;
  });
}

void LinkOrder::release(Span place) {
  if (by_place_.size() != held_.all.size()) sort();
  const auto first = std::lower_bound(by_place_.begin(), by_place_.end(), place.begin,
                                      [&](std::size_t at, std::uint32_t begin) {
                                        return held_.all[at].finding.span.begin < begin;
                                      });
  std::vector<std::size_t> inside;
  for (auto at = first; at != by_place_.end(); ++at) {
    if (held_.all[*at].finding.span.begin >= place.end) break;
    if (!std::exchange(held_.all[*at].released, true)) inside.push_back(*at);
  }
  std::sort(inside.begin(), inside.end());
  for (const std::size_t at : inside) report(held_.all[at].path.path(), held_.all[at].finding);
}

void LinkOrder::report(const Path& path, Finding finding) {
  if (!below_) return reported_.report(path, std::move(finding));
  const PathCopy moved(path, &below_->path());
  reported_.report(moved.path(), std::move(finding));
}

}  // namespace gltfx::validate
