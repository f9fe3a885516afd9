// SPDX-License-Identifier: Apache-2.0
#include "prove/soup_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prove/soup_surface.hpp"
#include "prove/stream_change.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;
using SoupStreamMap = std::map<std::string, SoupStream>;

// The streams of all, as wide as the widest one of a name.
SoupStreamMap streams_of(const std::vector<Soup>& soups) {
  SoupStreamMap streams;
  for (const Soup& soup : soups) {
    for (const SoupStream& stream : soup.streams) {
      const auto [at, is_new] = streams.try_emplace(stream.name, stream);
      if (!is_new) at->second.width = std::max(at->second.width, stream.width);
    }
  }
  return streams;
}

// Takes the soups, so that large ones are not held twice.
Soup joined(std::vector<Soup>&& soups, const std::vector<SoupStream>& streams) {
  Soup all;
  all.arity = soups.front().arity;
  for (SoupStream stream : streams) {
    stream.offset = all.width;
    all.width += stream.width;
    all.streams.push_back(std::move(stream));
  }
  const auto is_equal = [](const SoupStream& a, const SoupStream& b) {
    return a.name == b.name && a.width == b.width && a.offset == b.offset;
  };
  Soup& first = soups.front();
  if (soups.size() == 1 && first.width == all.width &&
      std::equal(all.streams.begin(), all.streams.end(), first.streams.begin(), first.streams.end(),
                 is_equal)) {
    std::swap(all.rows, first.rows);
    std::swap(all.corners, first.corners);
    return all;
  }
  for (Soup& soup : soups) {
    append_soup(all, soup);
    soup = Soup();
  }
  return all;
}

class SoupLists {
 public:
  SoupLists(const Comparison& all, const SoupGroup& group, std::vector<Change>& changes)
      : all_(all), group_(group), changes_(changes) {}

  void run(std::vector<Soup>&& ours, std::vector<Soup>&& theirs) {
    const bool drawn = all_.options.drawn;
    if (ours.empty() && theirs.empty()) return drawn ? void() : tell_unseen();
    if (ours.empty() || theirs.empty()) return tell_elements(ours, theirs);
    const std::vector<SoupStream> common = common_streams(streams_of(ours), streams_of(theirs));
    if (common.empty()) return;
    const Soup a = joined(std::move(ours), common);
    const Soup b = joined(std::move(theirs), common);
    SoupScale scale;
    scale.texels = group_.use.texels;
    scale.position =
        all_.options.bounds.position * all_.diagonal / std::max(group_.pair.scale, 1e-30);
    scale.facing = all_.options.bounds.normal;
    for (const SoupStream& stream : a.streams) {
      scale.limits.push_back(limit_of(all_, stream, group_.pair.scale));
    }
    const std::size_t told = changes_.size();
    const SoupDifference found = compare_soups(a, b, scale);
    tell_difference(found, a, b, scale);
    const bool unseen = found.unseen && told == changes_.size() && !drawn;
    if (unseen && hash_soup(a) != hash_soup(b)) tell_unseen();
  }

 private:
  Change& add(std::string_view kind, std::string what) {
    return changes_.emplace_back(change_of(group_.pair, kind, std::move(what)));
  }

  // At the primitives, if there is one of each.
  Change& add_at_primitives(std::string_view kind, std::string what) {
    Change& change = add(kind, std::move(what));
    if (!group_.lone) return change;
    change.old_pointer = group_.ours->content->side().pointer(group_.ours->primitive);
    change.new_pointer = group_.theirs->content->side().pointer(group_.theirs->primitive);
    return change;
  }

  // Nothing of it is drawn, so that only the difference is told.
  void tell_unseen() {
    if (group_.ours == nullptr || group_.theirs == nullptr) return;
    add_at_primitives("geometry.elements", "vertices that show nothing are others");
  }

  void tell_elements(const std::vector<Soup>& ours, const std::vector<Soup>& theirs) {
    const bool lost = theirs.empty();
    const std::vector<Soup>& soups = lost ? ours : theirs;
    std::uint64_t count = 0;
    for (const Soup& soup : soups) count += soup.elements();
    Change& change =
        add("geometry.elements", fmt::format("{} {}", counted_elements(count, soups.front().arity),
                                             lost ? "fewer" : "more"));
    const SurfacePiece* piece = lost ? group_.ours : group_.theirs;
    if (piece == nullptr) return;
    (lost ? change.old_pointer : change.new_pointer) =
        piece->content->side().pointer(piece->primitive);
  }

  // Attributes that are not drawn do not count.
  void drop_unread(SoupStreamMap& streams) const {
    std::erase_if(streams, [&](const auto& each) { return !group_.use.reads(each.second); });
    for (auto& [name, stream] : streams) stream.width = group_.use.read_width(stream);
  }

  // Whether a missing attribute is drawn as if it had values.
  bool has_default(const SoupStream& stream) const {
    if (!all_.options.drawn) return false;
    return stream.of_target || (stream.kind == SemanticKind::color && stream.set == 0);
  }

  // Those that both have; the others are told.
  std::vector<SoupStream> common_streams(SoupStreamMap here, SoupStreamMap there) {
    if (all_.options.drawn) {
      drop_unread(here);
      drop_unread(there);
    }
    std::vector<SoupStream> common;
    for (auto& [name, stream] : here) {
      const auto found = there.find(name);
      const bool is_there = found != there.end();
      values_[name] = {stream.value, is_there ? found->second.value : json::kNoNode};
      if (!is_there && has_default(stream)) {
        common.push_back(stream);
        continue;
      }
      // Weights are compared with their joints.
      if (is_there && (stream.joints == json::kNoNode) != (found->second.joints == json::kNoNode)) {
        tell_joints(stream, found->second);
        continue;
      }
      const bool fits =
          is_there && (found->second.width == stream.width ||
                       stream.kind == SemanticKind::weights || stream.kind == SemanticKind::color);
      if (!fits && is_there) {
        tell_width(stream, found->second);
        continue;
      }
      if (!is_there) {
        tell_attribute(stream, all_.ours.side(), true);
        continue;
      }
      stream.width = std::max(stream.width, found->second.width);
      common.push_back(stream);
    }
    for (const auto& [name, stream] : there) {
      const auto [at, is_new] = values_.try_emplace(name, json::kNoNode, stream.value);
      if (!is_new) continue;
      if (has_default(stream)) {
        common.push_back(stream);
      } else {
        tell_attribute(stream, all_.theirs.side(), false);
      }
    }
    return common;
  }

  void tell_attribute(const SoupStream& stream, const Side& side, bool lost) {
    const bool read = group_.use.reads(stream);
    Change& change = add("geometry.attribute", fmt::format("{}{} was {}", printable(stream.name),
                                                           read ? "" : ", which nothing reads,",
                                                           lost ? "removed" : "added"));
    (lost ? change.old_pointer : change.new_pointer) = side.pointer(stream.value);
  }

  void tell_width(const SoupStream& ours, const SoupStream& theirs) {
    Change& change =
        add("geometry.attribute", fmt::format("{} has {} numbers a vertex, not {}",
                                              printable(ours.name), theirs.width, ours.width));
    change.old_pointer = all_.ours.side().pointer(ours.value);
    change.new_pointer = all_.theirs.side().pointer(theirs.value);
  }

  void tell_joints(const SoupStream& ours, const SoupStream& theirs) {
    const bool lost = theirs.joints == json::kNoNode;
    const Side& side = (lost ? all_.ours : all_.theirs).side();
    Change& change = add("geometry.attribute",
                         fmt::format("joints of weights were {}", lost ? "removed" : "added"));
    (lost ? change.old_pointer : change.new_pointer) = side.pointer((lost ? ours : theirs).joints);
  }

  void tell_difference(const SoupDifference& found, const Soup& a, const Soup& b,
                       const SoupScale& scale) {
    if (found.reversed) {
      add_at_primitives("geometry.winding", "the winding of triangles is reversed");
    }
    if (a.arity == 3 && (!found.left.empty() || !found.their_left.empty())) {
      if (const auto near = match_surfaces(a, found.left, b, found.their_left, scale)) {
        tell_surface(found, a, *near);
        return tell_streams(found.near, a.arity);
      }
    }
    const bool same_vertices = a.rows == b.rows && a.width == b.width;
    if (found.fewer > 0 || found.more > 0) {
      std::vector<std::string> parts;
      if (found.fewer > 0) parts.push_back(counted_elements(found.fewer, a.arity) + " fewer");
      if (found.more > 0) parts.push_back(counted_elements(found.more, a.arity) + " more");
      Change& change =
          add_at_primitives("geometry.elements", fmt::format("{}", fmt::join(parts, ", ")));
      if (same_vertices) place_at_indices(change);
      tell_distance(found, a, b, change);
      // Pairs by place are no evidence of a change of values beside it.
      return;
    }
    if (same_vertices && !found.distances.empty()) return tell_connected(found.distances, a.arity);
    tell_streams(found.distances, a.arity);
  }

  void place_at_indices(Change& change) const {
    if (!group_.lone) return;
    const auto modes = [](const SurfacePiece& piece) {
      return model::read_primitive(piece.content->side().asset(), piece.primitive).mode;
    };
    const bool other_mode = modes(*group_.ours) != modes(*group_.theirs);
    const auto place = [&](const SurfacePiece& piece) {
      const Side& side = piece.content->side();
      const json::NodeId value =
          side.document().find(piece.primitive, other_mode ? "mode" : "indices");
      return side.pointer(value == json::kNoNode ? piece.primitive : value);
    };
    change.old_pointer = place(*group_.ours);
    change.new_pointer = place(*group_.theirs);
  }

  // The vertices are the same, so that all streams differ because of the indices.
  void tell_connected(const std::vector<StreamDistance>& distances, unsigned arity) {
    std::optional<Change> worst;
    std::uint64_t elements = 0;
    CompareLevel level = CompareLevel::bounds;
    for (const StreamDistance& distance : distances) {
      Change change = describe_stream(all_, distance, arity, group_.pair.scale);
      elements = std::max(elements, distance.elements);
      level = std::max(level, change.level);
      if (!worst || share_of_bound(change) > share_of_bound(*worst)) worst = std::move(change);
    }
    Change& change =
        add_at_primitives("geometry.elements",
                          fmt::format("{} {} other vertices: {}", counted_elements(elements, arity),
                                      elements == 1 ? "connects" : "connect", worst->what));
    change.measure = worst->measure;
    change.level = level;
    place_at_indices(change);
  }

  static std::string place_text(const model::Vector3& at) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", at[0], at[1], at[2]);
  }

  // Other triangles of the same surface.
  void tell_surface(const SoupDifference& found, const Soup& a, const SurfaceCloseness& near) {
    std::optional<Change> worst;
    double most = -1;
    for (std::size_t i = 0; i < a.streams.size(); ++i) {
      const StreamDistance distance{&a.streams[i], near.greatest[i], found.left.size(), 0, false};
      Change change = describe_stream(all_, distance, a.arity, group_.pair.scale);
      if (share_of_bound(change) <= most) continue;
      most = share_of_bound(change);
      worst = std::move(change);
    }
    Change& change = add_at_primitives(
        "geometry.elements",
        fmt::format("{} instead of {} show the same surface, which differs most at {}",
                    counted_elements(found.their_left.size(), a.arity), found.left.size(),
                    place_text(near.at)));
    change.level = CompareLevel::bounds;
    if (worst) change.measure = worst->measure;
  }

  // How far the surfaces that are left over are apart.
  void tell_distance(const SoupDifference& found, const Soup& a, const Soup& b, Change& change) {
    if (a.arity != 3) return;
    const auto apart = surface_distance_of(a, found.left, b, found.their_left);
    if (!apart || !(all_.diagonal > 0)) return;
    const double distance = apart->distance * group_.pair.scale;
    const double bound = 100 * all_.options.bounds.position;
    const double part = 100 * distance / all_.diagonal;
    if (!(part > bound) || !std::isfinite(part)) return;
    change.what +=
        fmt::format("; the surface is up to {:.4g} away, at {}", distance, place_text(apart->at));
    change.measure = CompareMeasure{"position", part, "%", bound};
  }

  void tell_streams(const std::vector<StreamDistance>& distances, unsigned arity) {
    for (const StreamDistance& distance : distances) {
      const SoupStream& stream = *distance.stream;
      Change change = describe_stream(all_, distance, arity, group_.pair.scale);
      const auto& [here, there] = values_.at(stream.name);
      if (here == json::kNoNode || there == json::kNoNode) {
        const bool lost = there == json::kNoNode;
        SoupStream told = stream;
        told.value = lost ? here : there;
        tell_attribute(told, (lost ? all_.ours : all_.theirs).side(), lost);
        changes_.back().measure = change.measure;
        changes_.back().level = change.level;
        continue;
      }
      Change& added = add(change.kind, std::move(change.what));
      added.measure = change.measure;
      added.level = change.level;
      if (!group_.lone) continue;
      added.old_pointer = all_.ours.side().pointer(here);
      added.new_pointer = all_.theirs.side().pointer(there);
      if (stream.joints != json::kNoNode) {
        added.also.push_back(all_.ours.side().pointer(stream.joints));
      }
    }
  }

  const Comparison& all_;
  const SoupGroup& group_;
  std::vector<Change>& changes_;
  /// Of streams, in both texts.
  std::map<std::string, std::pair<json::NodeId, json::NodeId>> values_;
};

}  // namespace

Change change_of(const SurfacePair& pair, std::string_view kind, std::string what) {
  Change change;
  change.kind = kind;
  change.old_pointer = pair.our_place;
  change.new_pointer = pair.their_place;
  change.name = pair.name;
  change.what = std::move(what);
  return change;
}

void compare_soup_lists(const Comparison& comparison, const SoupGroup& group,
                        std::vector<Soup>&& ours, std::vector<Soup>&& theirs,
                        std::vector<Change>& changes) {
  SoupLists(comparison, group, changes).run(std::move(ours), std::move(theirs));
}

}  // namespace gltfx::prove
