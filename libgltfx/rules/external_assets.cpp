// SPDX-License-Identifier: Apache-2.0
#include "rules/external_assets.hpp"

#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/fields.hpp"
#include "schema/version.hpp"

namespace gltfx::validate {
namespace {

using model::AssetInTree;

constexpr std::size_t kNamesAtEachEnd = 4;  // of a cycle, in messages
constexpr std::size_t kLongestInCircle = 100;

using Uris = std::set<std::string, std::less<>>;

bool is_of_gltf(const json::Document& document, json::NodeId file) {
  const std::string type = model::string_member(document, file, "mimeType");
  return type == "model/gltf+json" || type == "model/gltf-binary";
}

// The texts by which a document refers to files, as they are written. Data is no name.
Uris uris_of(const json::Document& document) {
  Uris uris;
  std::string unescaped;
  for (json::NodeId id = 0; id + 1 < document.node_count(); ++id) {
    const json::Node& node = document.node(id);
    if (node.kind != json::Kind::key || !document.is_string(id + 1)) continue;
    const std::string_view name = document.key(node.next);
    if (name != "uri" && !name.ends_with("Uri")) continue;
    const std::string_view uri = document.string(id + 1, unescaped);
    if (!uri.starts_with("data:")) uris.emplace(uri);
  }
  return uris;
}

// The elements of `aliases` of a file; empty where there are none.
std::vector<json::NodeId> aliases_of(const json::Document& document, json::NodeId file) {
  const json::NodeId list = document.find(file, "aliases");
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return {};
  std::vector<json::NodeId> aliases;
  for (const json::NodeId alias : document.elements(list)) aliases.push_back(alias);
  return aliases;
}

}  // namespace

ExternalTree::ExternalTree(const model::OpenedAsset& named, Validate validate)
    : assets_(named), validate_(std::move(validate)) {
  enter(assets_.root());
  while (!path_.empty()) {
    Node& node = *path_.back();
    if (node.next < node.links.links.size()) {
      follow(node);
    } else {
      leave();
    }
  }
}

std::vector<FileReport> ExternalTree::take_reports() {
  std::vector<FileReport> reports;
  for (Node* const node : met_) {
    if (node->asset != &assets_.root()) reports.push_back(std::move(node->report));
  }
  return reports;
}

// An asset of version 2.0 has no external assets, whatever members it has.
void ExternalTree::enter(AssetInTree& asset) {
  Node& node = nodes_[&asset];
  node.asset = &asset;
  met_.push_back(&node);
  places_.emplace(asset.identity(), path_.size());
  path_.push_back(&node);
  const json::Document& document = asset.asset().document();
  if (document.empty() || schema::stated_version(document) <= schema::kVersion2) return;
  for (std::uint32_t i = 0; i < asset.external_assets().size(); ++i) {
    const auto file = asset.file_of(i);
    if (!file || !is_of_gltf(document, asset.files()[*file])) continue;
    node.links.links.push_back({i, *file, {}, 0, {}, {}});
  }
  node.leads_to.resize(node.links.links.size());
}

void ExternalTree::follow(Node& node) {
  const std::size_t place = node.next++;
  ExternalLink& link = node.links.links[place];
  const auto& opened = assets_.asset(*node.asset, link.file);
  if (!opened) {
    // A file that cannot be read is reported where it is named.
    if (assets_.file(*node.asset, link.file)) link.not_opened = opened.error().message;
    return;
  }
  AssetInTree& child = **opened;
  link.name = name_of(child);
  const auto above = places_.find(child.identity());
  if (above != places_.end()) {
    link.closed_circle = circle_from(above->second);
    return;
  }
  Node& target = nodes_[&child];
  node.leads_to[place] = &target;
  if (!target.done) enter(child);
}

// All below the last asset of the path is known.
void ExternalTree::leave() {
  Node& node = *path_.back();
  for (std::size_t i = 0; i < node.leads_to.size(); ++i) {
    ExternalLink& link = node.links.links[i];
    if (const Node* const target = node.leads_to[i]) {
      link.errors = target->report.counts.errors;
      link.closed_circle = target->circle;
    }
    if (node.circle.empty()) node.circle = link.closed_circle;
  }
  find_unused_aliases(node);
  path_.pop_back();
  places_.erase(node.asset->identity());
  node.done = true;
  if (path_.empty()) return;
  node.report = validate_(*node.asset, node.links);
  node.links = {};
  node.leads_to = {};
}

void ExternalTree::find_unused_aliases(Node& node) {
  const json::Document& document = node.asset->asset().document();
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < node.leads_to.size(); ++i) {
    const std::uint32_t file = node.links.links[i].file;
    Node* const target = node.leads_to[i];
    if (target == nullptr || !seen.insert(file).second) continue;
    const auto aliases = aliases_of(document, node.asset->files()[file]);
    if (!aliases.empty() && !target->uris) {
      target->uris = std::make_shared<const Uris>(uris_of(target->asset->asset().document()));
    }
    for (std::uint32_t k = 0; k < aliases.size(); ++k) {
      if (!document.is_object(aliases[k])) continue;
      const json::NodeId alias = document.find(aliases[k], "alias");
      if (alias == json::kNoNode || !document.is_string(alias)) continue;
      if (target->uris->count(document.string(alias)) > 0) continue;
      node.links.unused_aliases.emplace_back(file, k);
    }
  }
}

std::string ExternalTree::name_of(const AssetInTree& asset) const {
  const std::string& first = assets_.root().asset().name();
  return asset.asset().name().substr(first.rfind('/') + 1);
}

// "a > b > a": the names of the path from a place on, and the first one again.
std::string ExternalTree::circle_from(std::size_t place) const {
  std::string circle;
  for (std::size_t i = place; i < path_.size(); ++i) {
    if (i == place + kNamesAtEachEnd && i + kNamesAtEachEnd < path_.size()) {
      const std::size_t left_out = path_.size() - kNamesAtEachEnd - i;
      circle += fmt::format("({} more) > ", left_out);
      i += left_out;
    }
    circle += gltfx::quoted(name_of(*path_[i]->asset), kLongestInCircle) + " > ";
  }
  return circle + gltfx::quoted(name_of(*path_[place]->asset), kLongestInCircle);
}

}  // namespace gltfx::validate
