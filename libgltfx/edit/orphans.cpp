// SPDX-License-Identifier: Apache-2.0
#include "edit/orphans.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace gltfx::edit {
namespace {

using Indices = std::set<std::uint64_t>;

// Where the elements of a root array that are in `which` stand, in order.
std::vector<Span> places(const json::Document& document, const std::string& array,
                         const Indices& which) {
  std::vector<Span> spans;
  const json::NodeId list = document.find(document.root(), array);
  if (which.empty() || list == json::kNoNode || document.kind(list) != json::Kind::array) {
    return spans;
  }
  std::uint64_t index = 0;
  for (const json::NodeId element : document.elements(list)) {
    if (which.count(index++) != 0) spans.push_back(document.span(element));
  }
  return spans;
}

bool lies_in(Span place, const std::vector<Span>& spans) {
  const auto after =
      std::upper_bound(spans.begin(), spans.end(), place.begin,
                       [](std::uint32_t begin, const Span& span) { return begin < span.begin; });
  return after != spans.begin() && place.end <= std::prev(after)->end;
}

// What was referred to, and now is not but from those places.
Indices left_behind(Indices orphans, const std::vector<Reference>& now,
                    const std::vector<Span>& gone) {
  for (const Reference& reference : now) {
    if (!lies_in(reference.span, gone)) orphans.erase(reference.index);
  }
  return orphans;
}

constexpr std::array kArrays{"textures", "images", "bufferViews"};

}  // namespace

Orphans referred_elements(const json::Document& document, const References& references,
                          const std::vector<std::uint64_t>& released) {
  Orphans referred;
  referred["textures"].insert(released.begin(), released.end());
  for (const char* array : kArrays) {
    Indices& indices = referred[array];
    for (const Reference& reference : references.to(array)) indices.insert(reference.index);
    const json::NodeId list = document.find(document.root(), array);
    const bool there = list != json::kNoNode && document.is_array(list);
    indices.erase(indices.lower_bound(there ? document.array_size(list) : 0), indices.end());
  }
  return referred;
}

Orphans find_orphans(Orphans referred, const json::Document& now,
                     const References& now_references) {
  std::vector<Span> gone;  // elements of the array before
  for (const char* array : kArrays) {
    Indices& orphans = referred[array];
    orphans = left_behind(std::move(orphans), now_references.to(array), gone);
    gone = places(now, array, orphans);
  }
  return referred;
}

}  // namespace gltfx::edit
