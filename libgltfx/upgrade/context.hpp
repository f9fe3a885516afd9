// SPDX-License-Identifier: Apache-2.0
/// What the parts of a plan share.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "json/edit.hpp"
#include "model/asset.hpp"
#include "schema/holds.hpp"
#include "upgrade/plan.hpp"
#include "upgrade/pointers.hpp"

namespace gltfx::upgrade {

/// An object with extensions, one of which is legacy.
struct Carrier {
  std::string array;        ///< root array it stands in: "materials"
  std::uint64_t index = 0;  ///< there
  json::NodeId host = json::kNoNode;
  json::NodeId extensions = json::kNoNode;  ///< its member of that name
  json::NodeId object = json::kNoNode;      ///< the legacy extension's value there
};

/// State of one plan. Keeps references to all it is made of.
struct Context {
  Context(const json::Document& read, const schema::Set& known, const UpgradeOptions& wanted,
          Pictures* of_document)
      : document(read),
        asset(read),
        set(known),
        options(wanted),
        pictures(of_document),
        pointers(read),
        holds(read, known),
        editor(read) {
    plan.additions = Additions(read);
  }

  const json::Document& document;
  const model::Asset asset;
  const schema::Set& set;
  const UpgradeOptions& options;
  Pictures* const pictures;  ///< null: nobody can look at pixels
  const Pointers pointers;
  schema::Holds holds;
  json::Editor editor;
  Plan plan;
  /// Members to take out of objects of extensions, by the host; settled at the end, because an
  /// object that loses all of them goes itself.
  std::map<json::NodeId, std::vector<json::NodeId>> dropped;
  /// By attribute: materials of the primitives that have it.
  std::unordered_map<std::string, std::unordered_set<std::uint64_t>> attribute_users;

  /// Number of textures in the document.
  std::uint64_t texture_count() const { return asset.count(model::RootArray::textures); }
  /// Whether a primitive with that attribute uses the material, also by way of an extension.
  bool is_used_with(const std::string& attribute, std::uint64_t material);
};

}  // namespace gltfx::upgrade
