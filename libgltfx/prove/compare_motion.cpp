// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prove/column.hpp"
#include "prove/curves.hpp"
#include "prove/drawn_items.hpp"
#include "prove/hash_sum.hpp"
#include "prove/leaf_reader.hpp"

namespace gltfx::prove {
namespace {

using model::AnimationPath;

/// A channel with a key that is equal for the property that partners move.
struct KeyedChannel {
  Hash128 key;
  json::NodeId channel = json::kNoNode;
  ItemId target;
};

class MotionComparison {
 public:
  MotionComparison(const Comparison& all, const Helpers& helpers) : all_(all), helpers_(helpers) {}

  void run() {
    all_.for_each_pair("/animations",
                       [this](ItemId ours, ItemId theirs) { compare(ours, theirs); });
  }

 private:
  std::vector<KeyedChannel> channels(const Content& content, ItemId animation, bool ours) const {
    const Side& side = content.side();
    std::vector<KeyedChannel> all;
    for (const model::AnimationChannel& channel :
         side.views().animations[animation.index].channels) {
      const DrawnItems* drawn = ours ? all_.our_drawn : all_.their_drawn;
      if (drawn != nullptr && channel.node && !drawn->shows(*channel.node)) continue;
      KeyedChannel keyed;
      keyed.channel = channel.object;
      std::vector<Leaf> leaves;
      if (channel.target != json::kNoNode) {
        LeafReader(content, leaves).read_part(channel.target);
      }
      for (Leaf& leaf : leaves) {
        if (leaf.kind == LeafKind::extras || leaf.kind == LeafKind::name) continue;
        std::uint64_t target = 0;
        const bool weights = channel.path == AnimationPath::weights;
        if (weights && leaf.target) leaf.target = owner(leaf.target, ours);
        if (leaf.target) {
          if (!keyed.target) keyed.target = leaf.target;
          const ItemId partner = ours ? leaf.target : all_.match.ours(leaf.target);
          target = partner ? 1 + partner.index : UINT64_MAX - leaf.target.index;
        }
        add_to_sum(keyed.key, hash_of_all(leaf.path, leaf.value, target));
      }
      all.push_back(keyed);
    }
    return all;
  }

  // Of a node that only carries the mesh of the one above it, that one.
  ItemId owner(ItemId node, bool ours) const {
    const auto& carriers = ours ? helpers_.our_nodes : helpers_.their_nodes;
    if (!carriers.contains(node.index)) return node;
    return {node.list, (ours ? all_.our_nodes : all_.their_nodes).parent(node.index)};
  }

  // Whether what it moves is gone; with `drawn`, also if nothing of it shows any more.
  bool is_lost(const KeyedChannel& channel, bool ours) const {
    if (!channel.target) return false;
    const ItemId partner =
        ours ? all_.match.theirs(channel.target) : all_.match.ours(channel.target);
    if (!partner) return true;
    const DrawnItems* drawn = ours ? all_.their_drawn : all_.our_drawn;
    const Content& there = ours ? all_.theirs : all_.ours;
    return drawn != nullptr && partner.list == there.list("/nodes") && !drawn->shows(partner.index);
  }

  // Whether it is not drawn because it moves nothing.
  bool is_still(const KeyedChannel& channel, bool ours) const {
    const DrawnItems* drawn = ours ? all_.our_drawn : all_.their_drawn;
    const auto found = find_sampled((ours ? all_.ours : all_.theirs).side(), channel.channel);
    return drawn != nullptr && found && !drawn->is_moved_by(*found->channel);
  }

  void compare(ItemId ours, ItemId theirs) {
    name_ = all_.our_name(ours);
    const std::vector<KeyedChannel> here = channels(all_.ours, ours, true);
    const std::vector<KeyedChannel> there = channels(all_.theirs, theirs, false);
    std::unordered_map<Hash128, std::vector<std::size_t>, HashHasher> waiting;
    for (std::size_t i = there.size(); i-- > 0;) waiting[there[i].key].push_back(i);
    std::vector<bool> taken(there.size());
    std::vector<const KeyedChannel*> left;
    for (const KeyedChannel& channel : here) {
      const auto found = waiting.find(channel.key);
      if (found == waiting.end() || found->second.empty()) {
        left.push_back(&channel);
        continue;
      }
      const std::size_t other = found->second.back();
      found->second.pop_back();
      taken[other] = true;
      compare_curve(channel.channel, there[other].channel);
    }
    std::vector<const KeyedChannel*> right;
    for (std::size_t i = 0; i < there.size(); ++i) {
      if (!taken[i]) right.push_back(&there[i]);
    }
    std::erase_if(left, [&](const KeyedChannel* each) { return is_lost(*each, true); });
    std::erase_if(right, [&](const KeyedChannel* each) { return is_lost(*each, false); });
    std::erase_if(left, [&](const KeyedChannel* each) { return is_still(*each, true); });
    std::erase_if(right, [&](const KeyedChannel* each) { return is_still(*each, false); });
    for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
      tell_channel(i < left.size() ? left[i] : nullptr, i < right.size() ? right[i] : nullptr);
    }
  }

  static std::string moved_by(const Content& content, const KeyedChannel& channel) {
    const Side& side = content.side();
    const json::NodeId target = side.document().find(channel.channel, "target");
    const json::NodeId path = side.document().find(target, "path");
    const std::string property = path != json::kNoNode && side.document().is_string(path)
                                     ? printable(side.document().string(path).substr(0, 80))
                                     : std::string("property");
    return fmt::format("{} of {}", property, Comparison::called(content, channel.target));
  }

  void tell_channel(const KeyedChannel* ours, const KeyedChannel* theirs) {
    Change change;
    change.kind = "animation.channel";
    change.name = name_;
    if (ours != nullptr) change.before = moved_by(all_.ours, *ours);
    if (theirs != nullptr) change.after = moved_by(all_.theirs, *theirs);
    if (ours != nullptr) change.old_pointer = all_.ours.side().pointer(ours->channel);
    if (theirs != nullptr) change.new_pointer = all_.theirs.side().pointer(theirs->channel);
    change.what = ours == nullptr ? fmt::format("moves the {}", change.after)
                  : theirs == nullptr
                      ? fmt::format("no longer moves the {}", change.before)
                      : fmt::format("moves the {}, not the {}", change.after, change.before);
    all_.log.add(std::move(change));
  }

  Hash128 data_of(const Content& content, const Sampled& sampled, bool& readable) const {
    const model::AnimationSampler& sampler = *sampled.sampler;
    readable = sampler.input && sampler.output;
    if (!readable) return {};
    bool input = false;
    bool output = false;
    const Hash128 hash = hash_of_all(static_cast<int>(sampler.interpolation),
                                     content.elements(*sampler.input, input),
                                     content.elements(*sampler.output, output));
    readable = input && output;
    return hash;
  }

  // What several curves use is told once, at its place.
  void place_at_unread(const Sampled& unread, bool is_theirs, Change& change) const {
    const Content& content = is_theirs ? all_.theirs : all_.ours;
    const auto is_unread = [&](const std::optional<std::uint32_t>& accessor) {
      bool readable = false;
      if (accessor) content.elements(*accessor, readable);
      return accessor && !readable;
    };
    const model::AnimationSampler& sampler = *unread.sampler;
    const bool input = is_unread(sampler.input);
    if (!input && !is_unread(sampler.output)) return;
    const Side& side = content.side();
    const std::uint32_t accessor = input ? *sampler.input : *sampler.output;
    auto& pointer = is_theirs ? change.new_pointer : change.old_pointer;
    change.also.push_back(*pointer);
    (is_theirs ? change.old_pointer : change.new_pointer).reset();
    pointer = side.pointer(side.asset().elements(model::RootArray::accessors)[accessor]);
  }

  Change& begin(std::string_view kind, const Sampled& ours, const Sampled& theirs,
                std::string_view member) {
    change_ = {};
    change_.kind = kind;
    change_.name = name_;
    const auto at = [&](const Side& side, json::NodeId object) {
      const json::NodeId value = side.document().find(object, member);
      return side.pointer(value == json::kNoNode ? object : value);
    };
    change_.old_pointer = at(all_.ours.side(), ours.sampler->object);
    change_.new_pointer = at(all_.theirs.side(), theirs.sampler->object);
    if (ours.channel->sampler != theirs.channel->sampler) {
      change_.also.push_back(all_.ours.side().pointer(ours.channel->object) + "/sampler");
    }
    return change_;
  }

  void compare_curve(json::NodeId here, json::NodeId there) {
    const auto ours = find_sampled(all_.ours.side(), here);
    const auto theirs = find_sampled(all_.theirs.side(), there);
    if (!ours && !theirs) return;
    if (ours && theirs) {
      bool one = false;
      bool two = false;
      const Hash128 a = data_of(all_.ours, *ours, one);
      const Hash128 b = data_of(all_.theirs, *theirs, two);
      if (one && two && a == b) return;
    }
    const auto before = ours ? open_motion(all_.ours.side(), here) : std::nullopt;
    const auto after = theirs ? open_motion(all_.theirs.side(), there) : std::nullopt;
    if (!before && !after) {
      return all_.log.leave_out(
          fmt::format("{} has keyframes that cannot be read.", all_.ours.side().pointer(here)));
    }
    if (!before || !after || before->width != after->width ||
        before->curve.values.components() != after->curve.values.components()) {
      Change change;
      if (ours && theirs) {
        const bool same = ours->sampler->interpolation == theirs->sampler->interpolation;
        change = begin("animation.curve", *ours, *theirs,
                       !same                          ? "interpolation"
                       : shares_curve(*ours, *theirs) ? "output"
                                                      : "input");
        if (!before || !after) {
          place_at_unread(before ? *theirs : *ours, before.has_value(), change);
        }
      }
      change.kind = "animation.curve";
      change.name = name_;
      if (!ours || !theirs) {
        change.old_pointer = all_.ours.side().pointer(here);
        change.new_pointer = all_.theirs.side().pointer(there);
      }
      change.what = !before || !after ? "has keyframes that can be read in one asset only"
                                      : "moves another number of values";
      return all_.log.add(std::move(change));
    }
    compare_values_over_time(*ours, *before, *theirs, *after);
  }

  // Times of all keyframes of both, and moments between them.
  static std::vector<double> moments(const Motion& a, const Motion& b) {
    std::vector<double> times;
    for (const Motion* each : {&a, &b}) {
      for (std::uint64_t k = 0; k < each->curve.times.count(); ++k) times.push_back(each->time(k));
    }
    std::erase_if(times, [](double time) { return !std::isfinite(time); });
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::vector<double> all;
    for (std::size_t i = 0; i < times.size(); ++i) {
      all.push_back(times[i]);
      if (i + 1 == times.size()) break;
      for (const double part : {0.25, 0.5, 0.75}) {
        all.push_back(times[i] + part * (times[i + 1] - times[i]));
      }
    }
    return all;
  }

  // All times of one are those of the other times a factor, plus a shift.
  static bool find_shift(const Motion& a, const Motion& b, double& factor, double& shift) {
    const std::uint64_t count = a.curve.times.count();
    if (count != b.curve.times.count() || count < 2) return false;
    const double length = a.last() - a.time(0);
    if (!(length > 0)) return false;
    factor = (b.last() - b.time(0)) / length;
    if (!(factor > 0)) return false;
    if (std::fabs(factor - 1) < 1e-5) factor = 1;
    shift = b.time(0) - factor * a.time(0);
    const double tolerance = 1e-5 * std::max({1.0, std::fabs(b.last()), length});
    for (std::uint64_t k = 0; k < count; ++k) {
      if (!(std::fabs(factor * a.time(k) + shift - b.time(k)) <= tolerance)) return false;
    }
    return factor != 1 || std::fabs(shift) > tolerance;
  }

  bool tell_shift(const Sampled& ours, const Motion& before, const Sampled& theirs,
                  const Motion& after) {
    double factor = 1;
    double shift = 0;
    bool readable = false;
    if (!find_shift(before, after, factor, shift)) return false;
    if (all_.ours.elements(*ours.sampler->output, readable) !=
        all_.theirs.elements(*theirs.sampler->output, readable)) {
      return false;
    }
    Change& change = begin("animation.shifted", ours, theirs, "input");
    change.what =
        factor == 1 ? fmt::format("{:.4g} s {}", std::fabs(shift), shift > 0 ? "later" : "earlier")
                    : fmt::format("{:.4g} times as {}", factor > 1 ? factor : 1 / factor,
                                  factor > 1 ? "slow" : "fast");
    change.time = (before.time(0) + before.last()) / 2;
    all_.log.add(std::move(change));
    return true;
  }

  void compare_values_over_time(const Sampled& ours, const Motion& before, const Sampled& theirs,
                                const Motion& after) {
    if (before.curve.interpolation == after.curve.interpolation &&
        tell_shift(ours, before, theirs, after)) {
      return;
    }
    double greatest = 0;
    double when = 0;
    const bool rotation = before.path == AnimationPath::rotation;
    for (const double moment : moments(before, after)) {
      const std::vector<float> a = before.at(moment);
      const std::vector<float> b = after.at(moment);
      if (a.size() != b.size()) continue;
      const double distance = value_distance(a, b, rotation);
      if (distance > greatest) {
        greatest = distance;
        when = moment;
      }
    }
    if (greatest > 0) return tell_curve(ours, before, theirs, after, greatest, when);
    if (before.last() != after.last() || before.time(0) != after.time(0)) {
      Change& change = begin("animation.duration", ours, theirs, "input");
      change.what = fmt::format("lasts from {:.6g} to {:.6g} s in place of {:.6g} to {:.6g} s",
                                after.time(0), after.last(), before.time(0), before.last());
      return all_.log.add(std::move(change));
    }
    all_.log.note_storage("keyframes that change nothing were added or removed");
  }

  bool shares_curve(const Sampled& ours, const Sampled& theirs) const {
    bool readable = false;
    return ours.sampler->input && theirs.sampler->input &&
           all_.ours.elements(*ours.sampler->input, readable) ==
               all_.theirs.elements(*theirs.sampler->input, readable);
  }

  void tell_curve(const Sampled& ours, const Motion& before, const Sampled& theirs,
                  const Motion& after, double greatest, double when) {
    const bool interpolation = before.curve.interpolation != after.curve.interpolation;
    Change& change =
        begin(interpolation ? "animation.interpolation" : "animation.curve", ours, theirs,
              interpolation                ? "interpolation"
              : shares_curve(ours, theirs) ? "output"
                                           : "input");
    change.what =
        fmt::format("{} at {:.4g} s differs by {:.4g}",
                    before.path == AnimationPath::other || before.path == AnimationPath::none
                        ? "the value"
                        : model::animation_path_name(before.path),
                    when, greatest);
    if (interpolation) {
      change.before = model::interpolation_name(before.curve.interpolation);
      change.after = model::interpolation_name(after.curve.interpolation);
      change.what = fmt::format("{} -> {}: {}", change.before, change.after, change.what);
    }
    change.time = when;
    const bool place = before.path == AnimationPath::translation;
    const double value = place && all_.diagonal > 0 ? greatest / all_.diagonal : greatest;
    const double bound = all_.options.bounds.animation;
    change.measure = CompareMeasure{"animation", value, "", bound};
    change.level = value <= bound ? CompareLevel::bounds : CompareLevel::differs;
    all_.log.add(std::move(change));
  }

  const Comparison& all_;
  const Helpers& helpers_;
  std::string name_;
  Change change_;
};

}  // namespace

void compare_motion(const Comparison& comparison, const Helpers& helpers) {
  MotionComparison(comparison, helpers).run();
}

}  // namespace gltfx::prove
