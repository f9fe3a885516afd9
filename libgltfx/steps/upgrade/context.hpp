// SPDX-License-Identifier: Apache-2.0
/// What the parts of a plan share.
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

/// A copy of an element of the root's materials as the plan leaves it.
struct MaterialSplit {
  json::NodeId material = json::kNoNode;
  std::vector<std::string> member;  ///< path of what is different in the copy
  std::string json;                 ///< its value there
  std::vector<json::NodeId> users;  ///< numbers that lead to the copy from now on
};

/// Plans a copy. Gives its index in the root's materials.
std::uint64_t split_material(Context& context, MaterialSplit split);
/// Adds the copies, when all edits of the plan are known.
void resolve_splits(Context& context);

/// An object with extensions, one of which is legacy.
struct Host {
  /// Member of the root it stands in: "materials", "asset"; empty: root. A name of the schema Set.
  std::string_view array;
  std::uint64_t index = 0;              ///< there
  bool single = false;                  ///< it is that member itself, which is no array
  schema::TypeId type = schema::kNone;  ///< of the host
  json::NodeId node = json::kNoNode;
  json::NodeId extensions = json::kNoNode;  ///< its member of that name
  json::NodeId object = json::kNoNode;      ///< the legacy extension's value there

  std::string pointer() const;  ///< "/materials/3"
};

/// A legacy object whose values became members of its host.
struct Takeover {
  json::NodeId object = json::kNoNode;
  const schema::Extension* extension = nullptr;  ///< of the legacy object
  std::string_view generation;                   ///< as which it was read
};

/// Where a member of a host comes from in this run.
struct MemberSource {
  json::NodeId value = json::kNoNode;  ///< kNoNode: it is gone, so that its default holds
  std::vector<std::string> path;       ///< of the value, from the host
};

/// State of one plan. Keeps references to all it is made of.
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
  Pictures* const pictures;  ///< null: nobody can look at pixels
  AccessorValues values;
  const graph::Pointers pointers;
  schema::DocumentNames symbols;
  schema::Holds holds;
  json::Editor editor;
  Plan plan;
  /// Members to take out of objects of extensions, by the host; settled at the end, because an
  /// object that loses all of them goes itself.
  std::map<json::NodeId, std::vector<json::NodeId>> dropped;
  /// Values of legacy objects that are extensions of their hosts no more.
  std::unordered_set<json::NodeId> gone;
  /// Extensions that hosts have got, by the host's object: of each the legacy object that
  /// became it, or kNoNode.
  std::map<std::pair<json::NodeId, std::string_view>, json::NodeId> given;
  /// Values that are in the document no more, each with the legacy object that took it out. Where
  /// one stands there twice, the first counts.
  std::vector<std::pair<json::NodeId, json::NodeId>> taken_out;
  std::multimap<json::NodeId, Takeover> takeovers;  ///< by the host's object, the last one counts
  std::set<std::string, std::less<>> names;         ///< see interned()
  std::unordered_map<json::NodeId, std::uint64_t> sizes;  ///< of arrays that somebody asked for
  std::optional<graph::Graph> graph;                      ///< made when it is needed
  std::vector<MaterialSplit> splits;
  std::map<std::string, std::uint64_t> new_textures;  ///< images and textures by what they are
  // What animated copies have got: accessors by what they are cut from, samplers by the old one and
  // the new accessor, and how many samplers a list has got.
  std::map<std::string, std::uint64_t> cut_accessors;
  std::map<std::pair<json::NodeId, std::uint64_t>, std::uint64_t> cut_samplers;
  std::map<json::NodeId, std::uint64_t> added_samplers;

  /// Whether an animation or graph points to what lies at `path` from a host, or below it.
  bool is_pointed_at(const Host& host, std::span<const std::string> path) const;
  /// Whether a host has an extension, as far as this run has come.
  bool has_beside(const Host& host, const std::string& extension) const;
  /// Where a member of a host has got its value from a legacy object: that value.
  std::optional<MemberSource> find_taken_over(const Host& host, std::string_view path) const;
  /// The value of a member of a host ("pbrMetallicRoughness/baseColorFactor"), likewise.
  MemberSource source_of(const Host& host, const std::string& path) const;
  /// The same text, which lives as long as this.
  std::string_view interned(std::string_view name) { return *names.emplace(name).first; }
  /// Number of elements of an array, which is counted once.
  std::uint64_t size_of(json::NodeId array);
  /// A texture of a new image; equal ones are one. Gives its index in the root's textures.
  std::uint64_t add_texture(const ImageJob& job, std::optional<std::uint64_t> sampler);
  /// Number of textures in the document.
  std::uint64_t texture_count() const { return asset.count(model::RootArray::textures); }
  /// Who uses a material.
  std::vector<MaterialUse> uses_of(std::uint64_t material);
  /// Whether a primitive with that attribute uses the material, also by way of an extension.
  bool is_used_with(const std::string& attribute, std::uint64_t material);
};

/// Whether what is said of some generations of an extension, or of all when the list is empty, is
/// said of this one.
bool is_meant(const std::vector<std::string>& generations, std::string_view generation);
/// "a/b/c" into its members.
std::vector<std::string> split_path(std::string_view path);
/// What `path` leads to from an object, or kNoNode.
json::NodeId find_path(const json::Document& document, json::NodeId object,
                       std::span<const std::string> path);

}  // namespace gltfx::upgrade
