// SPDX-License-Identifier: Apache-2.0
#include "prove/side.hpp"

#include <algorithm>
#include <tuple>

#include "codec/client.hpp"
#include "container/opened_files.hpp"

namespace gltfx::prove {
namespace {

bool before(const Link& a, const Link& b) {
  return std::tie(a.at, a.element) < std::tie(b.at, b.element);
}

std::vector<Link> read_links(const graph::Graph& graph) {
  std::vector<Link> links;
  links.reserve(graph.indices().size() + graph.pointers().size());
  for (const graph::IndexUse& use : graph.indices()) {
    const bool there = use.list != json::kNoNode && graph.tree().document().is_array(use.list);
    const json::NodeId target = there ? graph.tree().element(use.list, use.index) : json::kNoNode;
    links.push_back({use.at.node, use.at.element.value_or(0), target, nullptr});
  }
  for (const graph::PointerText& pointer : graph.pointers()) {
    links.push_back(
        {pointer.at, 0, pointer.way.empty() ? json::kNoNode : pointer.way.back(), &pointer});
  }
  std::stable_sort(links.begin(), links.end(), before);
  return links;
}

// The order of scenes and animations matters to people, even if there are references to them.
std::unordered_set<json::NodeId> find_tables(const graph::Graph& graph) {
  std::unordered_set<json::NodeId> tables;
  const schema::CheckResult& checked = graph.checked();
  for (const auto* arrays : {&checked.targets, &checked.local_targets}) {
    for (const schema::TargetArray& array : *arrays) {
      if (array.pointer != "/scenes" && array.pointer != "/animations") tables.insert(array.node);
    }
  }
  return tables;
}

model::LoadedResources load(const model::OpenedAsset& opened, const model::Asset& asset,
                            Scope scope, unsigned jobs) {
  container::OpenedFiles files(opened.resolver());
  const std::vector<bool> images(asset.count(model::RootArray::images), scope == Scope::all);
  auto loaded =
      model::load_resources(opened.container(), files, asset, opened.views(), jobs, &images);
  // Readers of the extension use a stream, not the plain copy for other readers.
  loaded.data.decoded_views.merge(loaded.data.unread_views);
  return loaded;
}

}  // namespace

Side::Side(const model::OpenedAsset& opened, const schema::Set& set, Scope scope, unsigned jobs)
    : opened_(opened),
      asset_(opened.document()),
      graph_(opened.document(), set, scope == Scope::all),
      loaded_(load(opened, asset_, scope, jobs)),
      source_{asset_, opened.views(), loaded_.data, draco_},
      links_(read_links(graph_)),
      tables_(find_tables(graph_)) {
  draco_.add_all(asset_, opened.views(), loaded_.data);
  draco_.decode(codec::Client::shared(), jobs);
}

const Link* Side::link(json::NodeId value, std::uint64_t element) const {
  const Link wanted{value, element, json::kNoNode, nullptr};
  const auto found = std::lower_bound(links_.begin(), links_.end(), wanted, before);
  const bool there = found != links_.end() && found->at == value && found->element == element;
  return there ? &*found : nullptr;
}

bool Side::affords_implied(std::uint64_t count) const {
  if (count > implied_left_) return false;
  implied_left_ -= count;
  return true;
}

std::optional<model::AccessorData> Side::open(std::uint32_t accessor) const {
  return model::AccessorData::open(asset_, views(), resources(), views().accessors[accessor],
                                   model::Malformed::unusable);
}

schema::TypeId Side::type(json::NodeId object) const {
  const schema::TypeId type = graph_.type(object);
  return type == schema::kNone ? type : graph_.set().type(type).origin;
}

}  // namespace gltfx::prove
