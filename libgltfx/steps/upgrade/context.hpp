// SPDX-License-Identifier: Apache-2.0
/// Shared state of the parts of a plan.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "graph/graph.hpp"
#include "graph/pointers.hpp"
#include "json/edit.hpp"
#include "model/asset.hpp"
#include "schema/holds.hpp"
#include "steps/upgrade/plan.hpp"
#include "steps/upgrade/vertex_colors.hpp"

namespace gltfx::upgrade {

struct Context;

/// A copy of an element of the root's materials, after all edits of the plan.
struct MaterialSplit {
  json::NodeId material = json::kNoNode;
  std::vector<std::string> member;  ///< path of the member that differs in the copy
  std::string json;                 ///< its value in the copy
  std::vector<json::NodeId> users;  ///< numbers that refer to the copy after the upgrade
};

/// Plans a copy. Returns its index in the root's materials.
std::uint64_t split_material(Context& context, MaterialSplit split);
/// Adds the copies after all edits of the plan are made.
void resolve_splits(Context& context);

/// An object with extensions, one of which is legacy.
struct Host {
  /// Root member that contains it: "materials", "asset"; empty: root. A name of the schema Set.
  std::string_view array;
  std::uint64_t index = 0;              ///< its index in that member
  bool single = false;                  ///< it is that member itself, which is not an array
  schema::TypeId type = schema::kNone;  ///< type of the host
  json::NodeId node = json::kNoNode;
  json::NodeId extensions = json::kNoNode;  ///< the host's member `extensions`
  json::NodeId object = json::kNoNode;      ///< the value of the legacy extension in it

  std::string pointer() const;  ///< "/materials/3"
};

/// A legacy object whose values became members of its host.
struct Takeover {
  json::NodeId object = json::kNoNode;
  const schema::Extension* extension = nullptr;  ///< of the legacy object
  std::string_view generation;                   ///< the generation that it was read as
};

/// The source of a host's member in this run.
struct MemberSource {
  json::NodeId value = json::kNoNode;  ///< kNoNode: it is removed, so its default applies
  std::vector<std::string> path;       ///< from the host to the value
};

/// State of one plan. Keeps references to its arguments.
struct Context {
  Context(const json::Document& read, const schema::Set& known, const UpgradeOptions& wanted,
          Pictures* of_document, model::AssetBytes* bytes)
      : document(read),
        asset(read),
        set(known),
        options(wanted),
        pictures(of_document),
        values(asset, bytes),
        pointers(read, known),
        symbols(read, known),
        holds(read, known, symbols),
        editor(read) {
    plan.change.additions = change::Additions(read);
  }

  const json::Document& document;
  const model::Asset asset;
  const schema::Set& set;
  const UpgradeOptions& options;
  Pictures* const pictures;  ///< null: pixels are not available
  AccessorValues values;
  const graph::Pointers pointers;
  schema::DocumentNames symbols;
  schema::Holds holds;
  json::Editor editor;
  Plan plan;
  /// Members to remove from `extensions`, by host; removed at the end, because `extensions` is also
  /// removed if it loses all members.
  std::map<json::NodeId, std::vector<json::NodeId>> dropped;
  /// Values of legacy objects that are no longer extensions of their hosts.
  std::unordered_set<json::NodeId> gone;
  /// New extensions of hosts, by the host's object: the legacy object that became the extension, or
  /// kNoNode.
  std::map<std::pair<json::NodeId, std::string_view>, json::NodeId> given;
  /// Values that are no longer in the document, each with the legacy object that removed it. If a
  /// value is listed twice, the first entry counts.
  std::vector<std::pair<json::NodeId, json::NodeId>> taken_out;
  std::multimap<json::NodeId, Takeover> takeovers;  ///< by the host's object; the last one counts
  std::set<std::string, std::less<>> names;         ///< see interned()
  std::unordered_map<json::NodeId, std::uint64_t> sizes;  ///< of arrays that were requested
  std::optional<graph::Graph> graph;                      ///< made on demand
  std::vector<MaterialSplit> splits;
  std::map<std::string, std::uint64_t> new_textures;  ///< images and textures by their description
  // New objects for animated copies: accessors by the cut values, samplers by the old sampler and
  // the new accessor, and the number of new samplers of a list.
  std::map<std::string, std::uint64_t> cut_accessors;
  std::map<std::pair<json::NodeId, std::uint64_t>, std::uint64_t> cut_samplers;
  std::map<json::NodeId, std::uint64_t> added_samplers;

  /// Whether an animation or graph points to the value at `path` from a host, or below it.
  bool is_pointed_at(const Host& host, std::span<const std::string> path) const;
  /// Whether a host has an extension at this point of the run.
  bool has_beside(const Host& host, const std::string& extension) const;
  /// The value of a legacy object that became a member of a host.
  std::optional<MemberSource> find_taken_over(const Host& host, std::string_view path) const;
  /// The value of a member of a host ("pbrMetallicRoughness/baseColorFactor"), in the same way.
  MemberSource source_of(const Host& host, const std::string& path) const;
  /// The same text, valid as long as this object.
  std::string_view interned(std::string_view name) { return *names.emplace(name).first; }
  /// Number of elements of an array; counted only once.
  std::uint64_t size_of(json::NodeId array);
  /// A texture with a new image; equal ones are shared. Returns its index in the root's textures.
  std::uint64_t add_texture(const ImageJob& job, std::optional<std::uint64_t> sampler);
  /// Number of textures in the document.
  std::uint64_t texture_count() const { return asset.count(model::RootArray::textures); }
  /// The uses of a material.
  std::vector<MaterialUse> uses_of(std::uint64_t material);
  /// Whether a primitive with that attribute uses the material, also through an extension.
  bool is_used_with(const std::string& attribute, std::uint64_t material);
};

/// Whether a list of generations includes this one; an empty list includes all.
bool is_meant(const std::vector<std::string>& generations, std::string_view generation);
/// Splits "a/b/c" into its members.
std::vector<std::string> split_path(std::string_view path);
/// The value at `path` from an object, or kNoNode.
json::NodeId find_path(const json::Document& document, json::NodeId object,
                       std::span<const std::string> path);

}  // namespace gltfx::upgrade
