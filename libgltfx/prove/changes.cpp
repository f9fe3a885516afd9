// SPDX-License-Identifier: Apache-2.0
#include "prove/changes.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

#include "base/fork.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

struct SpecialKind {
  std::string_view name, meaning;
  bool drawn;
};

constexpr SpecialKind kSpecialKinds[] = {
    {"animation.channel", "an animation moves another property, or no longer moves one", true},
    {"animation.curve", "an animated property has another value at some time", true},
    {"animation.duration", "an animation lasts longer or less long", true},
    {"animation.interpolation", "keyframes are interpolated in another way", true},
    {"animation.shifted", "all keyframes of a curve are earlier, later, closer or farther apart",
     true},
    {"asset.value", "a value of the asset as a whole is another one", false},
    {"extension.list", "an extension is no longer declared, or is declared now", false},
    {"extension.unknown", "a value of an extension without a schema is another one", false},
    {"external.asset", "an external asset, or one below it, differs", true},
    {"extras", "a value of extras is another one", false},
    {"generator", "the asset names another generator; counts on request only", false},
    {"geometry.attribute", "an attribute of vertices was added or removed", true},
    {"geometry.color", "colors of vertices are others", true},
    {"geometry.custom", "values of an attribute of an application or extension are others", true},
    {"geometry.elements",
     "triangles, lines or points were added or removed, or connect other vertices", true},
    {"geometry.material", "primitives use another material", true},
    {"geometry.morph", "values of a morph target are others", true},
    {"geometry.normal", "normals or tangents are others", true},
    {"geometry.position", "vertices are elsewhere", true},
    {"geometry.texcoord", "texture coordinates are others", true},
    {"geometry.weight", "vertices follow other joints, or with other weights", true},
    {"geometry.winding", "triangles face the other way", true},
    {"image.size", "an image has another size", true},
    {"image.texels", "texels of an image are others", true},
    {"node.moved", "a node is placed elsewhere", true},
    {"node.parent", "a node has another parent", false},
    {"order", "a list has another order; counts on request only", false},
    {"scene.nodes", "a scene has other roots", true},
    {"skin.bind", "an inverse bind matrix is another one", true},
    {"skin.joints", "a skin has other joints", true},
    {"stored.name", "a name or value of what only stores data is another one", false},
};

struct ListKind {
  std::string_view list, subject, noun;
};
constexpr ListKind kListKinds[] = {
    {"/animations", "animation", "an animation"},
    {"/cameras", "camera", "a camera"},
    {"/images", "image", "an image"},
    {"/materials", "material", "a material"},
    {"/meshes", "mesh", "a mesh"},
    {"/nodes", "node", "a node"},
    {"/scenes", "scene", "a scene"},
    {"/skins", "skin", "a skin"},
    {"/textures", "texture", "a texture"},
    {"", "object", "an object in a list of an extension"},
};

/// All kinds, with the texts that they name.
struct AllKinds {
  std::deque<std::string> texts;
  std::vector<ChangeKind> kinds;

  AllKinds() {
    for (const SpecialKind& kind : kSpecialKinds) kinds.push_back({kind.name, kind.meaning});
    for (const ListKind& list : kListKinds) {
      add(list.subject, "added", fmt::format("{} was added", list.noun));
      add(list.subject, "removed", fmt::format("{} was removed", list.noun));
      add(list.subject, "renamed", fmt::format("{} has another name", list.noun));
      add(list.subject, "value", fmt::format("a value of {} is another one", list.noun));
    }
    std::sort(kinds.begin(), kinds.end(),
              [](const ChangeKind& a, const ChangeKind& b) { return a.name < b.name; });
  }

  void add(std::string_view subject, std::string_view what, std::string meaning) {
    const std::string& name = texts.emplace_back(fmt::format("{}.{}", subject, what));
    kinds.push_back({name, texts.emplace_back(std::move(meaning))});
  }
};

const AllKinds& all_kinds() {
  static constinit MadeOnce<AllKinds> made;
  return made.get([] { return AllKinds(); });
}

}  // namespace

std::span<const ChangeKind> change_kinds() { return all_kinds().kinds; }

const ChangeKind* find_change_kind(std::string_view name) {
  const auto& kinds = all_kinds().kinds;
  const auto found = std::lower_bound(
      kinds.begin(), kinds.end(), name,
      [](const ChangeKind& kind, std::string_view wanted) { return kind.name < wanted; });
  return found != kinds.end() && found->name == name ? &*found : nullptr;
}

std::string_view compare_level_name(CompareLevel level) {
  constexpr std::string_view kNames[] = {"identical", "storage", "bounds", "differs"};
  return kNames[static_cast<std::size_t>(level)];
}

namespace prove {
namespace {

constexpr std::size_t kMostAlso = 100;  // in Change::also

// Kinds that count only if the options name them.
bool counts_on_request(std::string_view kind) { return kind == "generator" || kind == "order"; }

// "geometry" of "geometry.normal".
std::string_view family_of(std::string_view kind) { return kind.substr(0, kind.find('.')); }

// What is told once.
std::string key_of(const Change& change) {
  std::string key = fmt::format("{}\n{}\n{}", change.kind, change.old_pointer.value_or("-"),
                                change.new_pointer.value_or("-"));
  if (change.kind == "external.asset") key += "\n" + change.what;  // several are below one
  return key;
}

auto order_of(const Change& change) {
  // In the order of the old asset; what was added comes last.
  return std::tuple(!change.old_pointer.has_value(),
                    change.old_pointer ? *change.old_pointer : *change.new_pointer, change.kind,
                    change.new_pointer.value_or(std::string()));
}

}  // namespace

double share_of_bound(const Change& change) {
  return change.measure && change.measure->bound > 0 ? change.measure->value / change.measure->bound
                                                     : 0;
}

bool is_drawn(std::string_view kind) {
  for (const SpecialKind& special : kSpecialKinds) {
    if (special.name == kind) return special.drawn;
  }
  // A camera is a view of the asset, and not drawn.
  return kind.ends_with(".value") && kind != "camera.value";
}

std::string_view subject_of(std::string_view list) {
  for (const ListKind& kind : kListKinds) {
    if (kind.list == list) return kind.subject;
  }
  return "object";
}

std::string_view kind_of(std::string_view list, std::string_view what) {
  const ChangeKind* kind = find_change_kind(fmt::format("{}.{}", subject_of(list), what));
  return kind == nullptr ? std::string_view("asset.value") : kind->name;
}

void ChangeLog::add(Change change, bool shows) {
  if (counts_on_request(change.kind) && !options_.count.contains(change.kind)) {
    const auto& place = change.old_pointer ? change.old_pointer : change.new_pointer;
    return note_storage(fmt::format("{} is another one", *place));
  }
  const bool counts = shows || is_drawn(change.kind) || options_.count.contains(change.kind);
  if (options_.drawn && !counts) return;
  if (options_.ignore.contains(change.kind)) return;
  if (!told_.insert(key_of(change)).second) return;
  changes_.push_back(std::move(change));
}

void ChangeLog::note_storage(std::string what) { stored_.insert(std::move(what)); }

void ChangeLog::note_equal(const std::string& pointer) { equal_.insert(pointer); }

void ChangeLog::leave_out(std::string what) { left_out_.insert(std::move(what)); }

void ChangeLog::forget(const std::function<bool(const Change&)>& gone) {
  std::erase_if(changes_, [&](const Change& change) {
    if (!gone(change)) return false;
    told_.erase(key_of(change));
    return true;
  });
}

void ChangeLog::merge(const std::function<std::string(Change&)>& cause_of) {
  std::unordered_map<std::string, std::size_t> places;
  std::vector<Change> kept;
  for (Change& change : changes_) {
    std::string cause = cause_of(change);
    const auto [at, is_new] = places.try_emplace(std::move(cause), kept.size());
    if (is_new || at->first.empty()) {
      kept.push_back(std::move(change));
      continue;
    }
    Change& first = kept[at->second];
    const auto& pointer = change.old_pointer ? change.old_pointer : change.new_pointer;
    if (pointer != first.old_pointer && first.also.size() < kMostAlso) {
      first.also.push_back(*pointer);
    }
    for (std::string& place : change.also) {
      if (first.also.size() < kMostAlso) first.also.push_back(std::move(place));
    }
    first.level = std::max(first.level, change.level);
    if (share_of_bound(change) <= share_of_bound(first)) continue;
    first.what = std::move(change.what);
    first.measure = change.measure;
    first.time = change.time;
  }
  changes_ = std::move(kept);
}

bool ChangeLog::differs() const {
  return std::any_of(changes_.begin(), changes_.end(),
                     [](const Change& change) { return change.level == CompareLevel::differs; });
}

// Loss within bounds has one cause, such as quantization: of each family, the change that is
// nearest to its bound stands for all.
void ChangeLog::merge_within_bounds() {
  std::map<std::string_view, std::size_t> worst;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    if (changes_[i].level != CompareLevel::bounds) continue;
    const auto [at, is_new] = worst.try_emplace(family_of(changes_[i].kind), i);
    if (!is_new && share_of_bound(changes_[i]) > share_of_bound(changes_[at->second]))
      at->second = i;
  }
  std::map<std::string_view, std::size_t> others;
  std::vector<Change> kept;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const Change& change = changes_[i];
    if (change.level != CompareLevel::bounds) continue;
    const std::size_t chosen = worst[family_of(change.kind)];
    if (chosen == i) continue;
    ++others[family_of(change.kind)];
    std::vector<std::string>& also = changes_[chosen].also;
    const auto& pointer = change.old_pointer ? change.old_pointer : change.new_pointer;
    if (pointer && also.size() < kMostAlso) also.push_back(*pointer);
  }
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    Change& change = changes_[i];
    if (change.level == CompareLevel::bounds) {
      const std::string_view family = family_of(change.kind);
      if (worst[family] != i) continue;
      if (const std::size_t more = others[family]; more > 0) {
        change.what += fmt::format("; {} more within bounds", more);
      }
    }
    kept.push_back(std::move(change));
  }
  changes_ = std::move(kept);
}

void ChangeLog::take(CompareReport& report) {
  merge_within_bounds();
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const Change& a, const Change& b) { return order_of(a) < order_of(b); });
  report.level = CompareLevel::storage;
  for (const Change& change : changes_) report.level = std::max(report.level, change.level);
  report.changes = std::move(changes_);
  if (!equal_.empty()) {
    const std::size_t more = equal_.size() - 1;
    note_storage(fmt::format("{}{} refers to another object, which is equal", *equal_.begin(),
                             more == 0 ? "" : fmt::format(" (and {} more)", more)));
  }
  report.storage.assign(stored_.begin(), stored_.end());
  report.unproven.assign(left_out_.begin(), left_out_.end());
}

std::string Comparison::name(const Content& content, ItemId item) {
  const json::Document& document = content.side().document();
  const json::NodeId node = content.item(item).node;
  const json::NodeId value = document.find(node, "name");
  return value != json::kNoNode && document.is_string(value) ? document.string(value)
                                                             : std::string();
}

std::string Comparison::called(const Content& content, ItemId item) {
  if (!item) return "none";
  const std::string name = Comparison::name(content, item);
  return name.empty() ? content.side().pointer(content.item(item).node) : gltfx::quoted(name);
}

namespace {

// JSON on one line, with a blank after commas and colons only.
std::string on_one_line(std::string_view json) {
  std::string out;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string && c == '\\' && i + 1 < json.size()) {
      out += c;
      out += json[++i];
      continue;
    }
    if (c == '"') in_string = !in_string;
    const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (in_string || !blank) out += c;
    if (!in_string && (c == ',' || c == ':')) out += ' ';
  }
  return out;
}

}  // namespace

std::string short_value(const json::Document& document, json::NodeId value) {
  constexpr std::size_t kMost = 60;
  const std::string raw = on_one_line(document.raw(value).substr(0, 20 * kMost));
  if (count_code_points(raw) <= kMost) return raw;
  return raw.substr(0, bytes_of_code_points(raw, kMost)) + "...";
}

}  // namespace prove
}  // namespace gltfx
