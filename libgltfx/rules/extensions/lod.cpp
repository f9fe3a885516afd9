// SPDX-License-Identifier: Apache-2.0
// MSFT_lod: levels of detail are other nodes or materials, and no object is a level of itself.
// Finding a cycle needs the whole graph; this file is about that one extension and names it.
#include <limits>
#include <unordered_set>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kLodExtension = "MSFT_lod";

class LodCheck {
 public:
  LodCheck(const Context& context, model::RootArray array)
      : context_(context), array_(array), levels_(context.asset.count(array)) {}

  void run() {
    for_each_extension(context_, array_, kLodExtension,
                       [&](const ExtensionPlace& place, const Path& path) {
                         read(place, path);
                         check_coverage(place, path);
                       });
    find_cycles();
    for_each_extension(
        context_, array_, kLodExtension, [&](const ExtensionPlace& place, const Path& path) {
          if (!on_cycle_[place.index]) return;
          report_member(context_.link_sink, context_, path, place.object, "ids", Code::LOD_CYCLE,
                        fmt::format("The levels of detail of {} form a cycle.",
                                    object_label(context_, array_, place.index)));
        });
  }

 private:
  void read(const ExtensionPlace& place, const Path& path) {
    const Path ids(path, "ids");
    std::unordered_set<std::uint32_t> known;
    model::for_each_index(
        context_.asset, context_.document.find(place.object, "ids"), array_,
        [&](std::uint64_t position, std::optional<std::uint32_t> level, Span span) {
          if (!level) return;
          levels_[place.index].push_back(*level);
          if (known.insert(*level).second) return;
          report_link(
              context_, Path(ids, position), span, Code::LOD_REPEATED,
              fmt::format("The list already contains {}.", object_label(context_, array_, *level)));
        });
  }

  // extras of the object with the levels: a convention of programs, not a part of the extension.
  void check_coverage(const ExtensionPlace& place, const Path& path) {
    constexpr std::string_view kMember = "MSFT_screencoverage";
    const json::Document& document = context_.document;
    const json::NodeId extras = model::object_member(document, place.host, "extras");
    const json::NodeId list = document.find(extras, kMember);
    if (list == json::kNoNode || document.kind(list) != json::Kind::number_array) return;
    std::size_t count = 0;
    bool falling = true;
    double last = std::numeric_limits<double>::infinity();
    for (json::NumberCursor at(document, list); at.valid(); at.advance(), ++count) {
      falling = falling && at.number().value < last;
      last = at.number().value;
    }
    const std::size_t levels = levels_[place.index].size() + 1;
    if (falling && count == levels) return;
    const Path at(*path.parent()->parent(), "extras");
    report_link(
        context_, Path(at, kMember), list, Code::LOD_COVERAGE_MISMATCH,
        count != levels
            ? fmt::format("MSFT_screencoverage has length {}; it must be {}, one value per level.",
                          count, levels)
            : std::string("The values of MSFT_screencoverage are not in decreasing order."));
  }

  // Repeatedly removes nodes that no remaining node refers to; then the same against the direction
  // of the references. The remaining ones are on cycles or between them.
  void find_cycles() {
    on_cycle_.assign(levels_.size(), true);
    std::vector<std::vector<std::uint32_t>> hosts(levels_.size());
    for (std::uint32_t i = 0; i < levels_.size(); ++i) {
      for (const std::uint32_t level : levels_[i]) hosts[level].push_back(i);
    }
    peel(levels_, hosts);
    peel(hosts, levels_);
  }

  void peel(const std::vector<std::vector<std::uint32_t>>& forward,
            const std::vector<std::vector<std::uint32_t>>& backward) {
    std::vector<std::size_t> left(forward.size(), 0);
    std::vector<std::uint32_t> free;
    for (std::uint32_t i = 0; i < forward.size(); ++i) {
      for (const std::uint32_t from : backward[i]) left[i] += on_cycle_[from] ? 1 : 0;
      if (left[i] == 0 && on_cycle_[i]) free.push_back(i);
    }
    while (!free.empty()) {
      const std::uint32_t at = free.back();
      free.pop_back();
      on_cycle_[at] = false;
      for (const std::uint32_t to : forward[at]) {
        if (on_cycle_[to] && --left[to] == 0) free.push_back(to);
      }
    }
  }

  const Context& context_;
  model::RootArray array_;
  std::vector<std::vector<std::uint32_t>> levels_;
  std::vector<bool> on_cycle_;
};

void check_levels(const Context& context) {
  if (!has_objects_of(context, kLodExtension)) return;
  LodCheck(context, model::RootArray::materials).run();
  LodCheck(context, model::RootArray::nodes).run();
}

bool remove_level_repeats(Fixing& fixing, const Subject& subject) {
  const json::NodeId list = subject.node();
  const bool numbers = fixing.document().kind(list) == json::Kind::number_array;
  return numbers && (fixing.is_claimed(list) ||
                     fixing.replace(list, without_repeats(fixing.document(), list)));
}

}  // namespace

const RuleGroup& lod_rules() {
  static constexpr LinkRule kLinkRules[] = {check_levels};
  static constexpr FixEntry kFixes[] = {{Code::LOD_REPEATED, remove_level_repeats}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
