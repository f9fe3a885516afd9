// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/ambiguity.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "json/lines.hpp"
#include "model/asset.hpp"
#include "model/fields.hpp"

namespace gltfx::upgrade {
namespace {

// Members of the root that are not read by any plan.
constexpr std::array<std::string_view, 7> kApart{"asset", "cameras", "extras", "nodes",
                                                 "scene", "scenes",  "skins"};

/// The parts of a document that a plan affects.
class Touched {
 public:
  Touched(const json::Document& document, const Plan& plan) : document_(document), plan_(plan) {
    for (const UpgradeAction& action : plan.actions) {
      if (!action.done) continue;
      const std::size_t index = action.pointer.find('/', 1);
      hosts_.insert(action.pointer.substr(0, action.pointer.find('/', index + 1)));
    }
  }

  bool is_ambiguous(const json::ParseError& error) const {
    switch (error.error) {
      case json::SyntaxError::missing_comma:
        return place_of(error.span).in_host;
      case json::SyntaxError::lone_surrogate:
        return is_edited(error.span);
      case json::SyntaxError::duplicate_key:
        return is_doubtful_name(error);
      default:
        return false;
    }
  }

 private:
  struct Place {
    std::string root;      ///< member of the root
    bool is_root = false;  ///< at the name of that member
    bool in_host = false;  ///< inside an object that carries an upgraded extension
  };

  Place place_of(Span span) const {
    Place place;
    const json::NodeId root = document_.root();
    if (!document_.is_object(root)) return place;
    // Includes repeated names.
    for (json::NodeId name = root + 1; name < document_.next(root);
         name = document_.next(name + 1)) {
      const Span key = document_.span(name);
      if (span.begin < key.begin || span.begin >= document_.span(name + 1).end) continue;
      place.root = document_.key(document_.node(name).next);
      place.is_root = span.begin == key.begin;
      place.in_host = is_in_host(place.root, name + 1, span);
    }
    return place;
  }

  bool is_in_host(const std::string& array, json::NodeId list, Span span) const {
    if (document_.kind(list) != json::Kind::array) return false;
    std::size_t index = 0;
    for (const json::NodeId element : document_.elements(list)) {
      const Span whole = document_.span(element);
      if (span.begin >= whole.begin && span.begin < whole.end) {
        return hosts_.count(fmt::format("/{}/{}", array, index)) > 0;
      }
      ++index;
    }
    return false;
  }

  bool is_edited(Span span) const {
    return std::any_of(plan_.change.edits.begin(), plan_.change.edits.end(),
                       [&](const json::Edit& edit) {
                         return edit.span.begin <= span.begin && span.begin < edit.span.end;
                       });
  }

  // If a name is repeated, readers disagree about the value.
  bool is_doubtful_name(const json::ParseError& error) const {
    const Place place = place_of(error.span);
    const bool apart = std::find(kApart.begin(), kApart.end(), place.root) != kApart.end();
    const bool other_material = place.root == "materials" && !place.is_root;
    if (place.in_host || !(apart || other_material)) return true;
    return holds_edit(error.span) || holds_edit(error.other);
  }

  // Whether the value of that member contains an edited place.
  bool holds_edit(Span name) const {
    for (json::NodeId id = 0; id < document_.node_count(); ++id) {
      if (document_.kind(id) != json::Kind::key || document_.span(id).begin != name.begin) continue;
      const Span value = document_.span(id + 1);
      return std::any_of(plan_.change.edits.begin(), plan_.change.edits.end(),
                         [&](const json::Edit& edit) {
                           return name.begin <= edit.span.begin && edit.span.begin <= value.end;
                         });
    }
    return false;
  }

  const json::Document& document_;
  const Plan& plan_;
  std::set<std::string> hosts_;  ///< "/materials/3"
};

}  // namespace

UpgradeAction old_format(const UpgradeOptions& options, std::string pointer,
                         const std::string& version) {
  const bool limited = !options.only.empty() || !options.to.empty();
  UpgradeAction action;
  action.pointer = std::move(pointer);
  action.from = "glTF " + version;
  action.outcome = limited ? UpgradeOutcome::no_successor : UpgradeOutcome::impossible;
  action.notes.emplace_back("glTF 1.0 is not supported; convert it with gltf-pipeline:");
  action.notes.emplace_back("npx gltf-pipeline -i OLD -o NEW");
  return action;
}

std::optional<UpgradeAction> find_old_format(const json::Document& document,
                                             const UpgradeOptions& options) {
  if (!model::is_gltf_1(document)) return std::nullopt;
  const json::NodeId asset = document.find(document.root(), "asset");
  const json::NodeId version = document.find(asset, "version");
  if (version == json::kNoNode) return old_format(options);
  const std::string text = model::string_member(document, asset, "version");
  return old_format(options, "/asset/version", text.empty() ? "1.0" : text);
}

std::optional<std::string> find_ambiguity(const json::Parsed& parsed, const Plan& plan) {
  if (plan.change.edits.empty() || parsed.ok()) return std::nullopt;
  if (parsed.unrecorded_errors > 0) {
    return fmt::format("its JSON has {} errors; fix them first",
                       parsed.errors.size() + parsed.unrecorded_errors);
  }
  const Touched touched(parsed.document, plan);
  for (const json::ParseError& error : parsed.errors) {
    if (!touched.is_ambiguous(error)) continue;
    const Location at = json::LineIndex(parsed.document.text()).locate(error.span);
    return fmt::format("its JSON is ambiguous at line {}, column {}: {}; fix that first", at.line,
                       at.column, error.detail);
  }
  return std::nullopt;
}

}  // namespace gltfx::upgrade
