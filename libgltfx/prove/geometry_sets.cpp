// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "prove/geometry.hpp"

namespace gltfx::prove {
namespace {

bool less(const Hash128& a, const Hash128& b) {
  return std::tie(a.high, a.low) < std::tie(b.high, b.low);
}

/// A triangle, segment or point, as a hash of the values of its vertices.
struct ShownElement {
  Hash128 hash;
  std::size_t at = 0;  ///< position in its list
};

/// The vertices of one side as hashes of their values.
class Vertices {
 public:
  Vertices(const PrimitivePair& pair, Column Stream::*column) : pair_(pair), column_(column) {}

  Hash128 hash(std::uint32_t vertex) {
    values_.clear();
    for (const Stream& stream : pair_.streams) {
      const Element element = (stream.*column_).at(vertex);
      for (unsigned i = 0; i < stream.components(); ++i) values_.push_back(plain(element[i]));
    }
    return hash_bytes(std::string_view(reinterpret_cast<const char*>(values_.data()),
                                       values_.size() * sizeof(double)));
  }

 private:
  // The same representation for equal values: for both zeros, and for all NaNs.
  static double plain(double value) {
    if (std::isnan(value)) return std::numeric_limits<double>::quiet_NaN();
    return value == 0 ? 0 : value;
  }

  const PrimitivePair& pair_;
  Column Stream::*column_;
  std::vector<double> values_;
};

// A triangle may begin at any of its corners, but its winding counts; a segment has no direction.
// Two corners of a triangle may be equal, so the least of all turns counts.
Hash128 hash_of(Hash128* corners, std::size_t arity) {
  std::array<Hash128, 3> least{};
  std::copy_n(corners, arity, least.begin());
  for (std::size_t turn = 1; turn < arity; ++turn) {
    std::rotate(corners, corners + 1, corners + arity);
    if (std::lexicographical_compare(corners, corners + arity, least.begin(),
                                     least.begin() + static_cast<std::ptrdiff_t>(arity), less)) {
      std::copy_n(corners, arity, least.begin());
    }
  }
  return hash_bytes(
      std::string_view(reinterpret_cast<const char*>(least.data()), arity * sizeof(Hash128)));
}

// Such a triangle or segment shows nothing, whether its equal corners are one vertex or several.
bool has_repeat(const Hash128* corners, std::size_t arity) {
  return (arity > 1 && corners[0] == corners[1]) ||
         (arity > 2 && (corners[1] == corners[2] || corners[0] == corners[2]));
}

std::vector<ShownElement> sorted(const PrimitivePair& pair, const Corners& corners,
                                 Column Stream::*column) {
  Vertices vertices(pair, column);
  const std::vector<std::uint32_t> list = corners.assembled();
  const std::size_t arity = corners.arity();
  // Each vertex is hashed at most once. Unused vertices are not hashed.
  std::vector<Hash128> known(
      std::min<std::size_t>(static_cast<std::size_t>(corners.vertices), list.size()));
  std::vector<bool> is_known(known.size());
  const auto vertex_hash = [&](std::uint32_t vertex) {
    if (vertex >= known.size()) return vertices.hash(vertex);
    if (!is_known[vertex]) {
      known[vertex] = vertices.hash(vertex);
      is_known[vertex] = true;
    }
    return known[vertex];
  };
  std::vector<ShownElement> shown;
  shown.reserve(list.size() / arity);
  for (std::size_t i = 0; i + arity <= list.size(); i += arity) {
    std::array<Hash128, 3> hashes{};
    for (std::size_t k = 0; k < arity; ++k) hashes[k] = vertex_hash(list[i + k]);
    if (has_repeat(hashes.data(), arity)) continue;
    shown.push_back({hash_of(hashes.data(), arity), i / arity});
  }
  std::sort(shown.begin(), shown.end(), [](const ShownElement& a, const ShownElement& b) {
    return a.hash == b.hash ? a.at < b.at : less(a.hash, b.hash);
  });
  return shown;
}

std::vector<std::size_t> without(const std::vector<ShownElement>& these,
                                 const std::vector<ShownElement>& those) {
  std::vector<ShownElement> only;
  std::set_difference(
      these.begin(), these.end(), those.begin(), those.end(), std::back_inserter(only),
      [](const ShownElement& a, const ShownElement& b) { return less(a.hash, b.hash); });
  std::vector<std::size_t> places;
  for (const ShownElement& each : only) places.push_back(each.at);
  std::sort(places.begin(), places.end());
  return places;
}

std::string_view noun(std::size_t arity) {
  constexpr std::string_view kNouns[] = {"point", "line", "triangle"};
  return kNouns[arity - 1];
}

}  // namespace

void compare_as_sets(const PrimitivePair& pair, const std::string& place, Differences& found) {
  const std::vector<ShownElement> ours = sorted(pair, pair.ours, &Stream::ours);
  const std::vector<ShownElement> theirs = sorted(pair, pair.theirs, &Stream::theirs);
  const std::string_view what = noun(pair.ours.arity());
  const auto tell = [&](const std::vector<std::size_t>& places, std::string_view which) {
    if (places.empty()) return;
    const std::string rest =
        places.size() > 1 ? fmt::format(", and {} more", places.size() - 1) : std::string();
    found.add(place, fmt::format("{} {} {}{}", what, places.front(), which, rest));
  };
  tell(without(ours, theirs), "is gone");
  tell(without(theirs, ours), "of the new one is new");
}

}  // namespace gltfx::prove
