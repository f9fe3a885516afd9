// SPDX-License-Identifier: Apache-2.0
// The lists of extensions, and what cannot be known of extensions without a schema.
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/unknown_indices.hpp"
#include "prove/compare_values.hpp"

namespace gltfx::prove {
namespace {

std::set<std::string> declared(const Side& side, std::string_view list,
                               const std::set<std::string, std::less<>>& storage) {
  std::set<std::string> names;
  const json::Document& document = side.document();
  const json::NodeId array = document.find(document.root(), list);
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return names;
  for (const json::NodeId element : document.elements(array)) {
    if (!document.is_string(element)) continue;
    std::string name = document.string(element);
    if (!storage.contains(name)) names.insert(std::move(name));
  }
  return names;
}

// An extension that only one of both assets has is no change of the list.
void compare_lists_of_extensions(const Comparison& all) {
  const Side& here = all.ours.side();
  const Side& there = all.theirs.side();
  const auto& storage = all.ours.storage();
  const auto seen = [](const Side& side) {
    const auto& names = side.graph().checked().extensions_seen;
    return std::set<std::string>(names.begin(), names.end());
  };
  const auto seen_here = seen(here);
  const auto seen_there = seen(there);
  for (const std::string_view list : {"extensionsUsed", "extensionsRequired"}) {
    const auto ours = declared(here, list, storage);
    const auto theirs = declared(there, list, storage);
    const auto tell = [&](const std::string& name, bool removed) {
      if (seen_here.contains(name) != seen_there.contains(name)) return;
      Change change;
      change.kind = "extension.list";
      (removed ? change.old_pointer : change.new_pointer) = fmt::format("/{}", list);
      change.what = fmt::format("{} {} {}", list, removed ? "no longer has" : "has a new",
                                gltfx::quoted(name));
      all.log.add(std::move(change));
    };
    for (const std::string& name : ours) {
      if (!theirs.contains(name)) tell(name, true);
    }
    for (const std::string& name : theirs) {
      if (!ours.contains(name)) tell(name, false);
    }
  }
}

// Integers of unknown extensions may be indices: where objects have other numbers, nobody knows.
void find_unknown_indices(const Comparison& all) {
  if (!all.match.is_renumbered() || all.options.drawn) return;
  const Side& side = all.ours.side();
  for (const json::NodeId object : side.graph().unknown_extensions()) {
    if (!graph::may_hold_index(side.document(), object)) continue;
    all.log.leave_out(fmt::format(
        "{} has integers, which may be indices, and objects have other numbers; give its schema "
        "with --schema.",
        side.pointer(object)));
  }
}

}  // namespace

void compare_extensions(const Comparison& comparison) {
  compare_lists_of_extensions(comparison);
  find_unknown_indices(comparison);
}

}  // namespace gltfx::prove
