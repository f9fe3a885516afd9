// SPDX-License-Identifier: Apache-2.0
#include "steps/flat_child.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "container/base64.hpp"
#include "container/near_files.hpp"
#include "graph/renumber.hpp"
#include "image/header.hpp"
#include "json/writer.hpp"
#include "model/asset_bytes.hpp"
#include "model/fields.hpp"
#include "steps/new_buffer.hpp"
#include "steps/references.hpp"

namespace gltfx::steps {
namespace {

using model::RootArray;
using model::Storage;

// Arrays of the root that are not copied: they belong to the asset itself.
constexpr std::array<std::string_view, 5> kOwnMembers{"scenes", "files", "externalAssets",
                                                      "extensionsUsed", "extensionsRequired"};

bool is_own_member(std::string_view name) {
  return std::find(kOwnMembers.begin(), kOwnMembers.end(), name) != kOwnMembers.end();
}

// Many aliases of one file could make a small asset endless bytes.
std::optional<Error> find_alias_excess(const container::Bytes& content, NewPaths& paths) {
  using model::ExternalAssets;
  if (paths.aliased.insert(content.view().data()).second) paths.aliased_bytes += content.size();
  paths.copied_bytes += content.size();
  const std::uint64_t most =
      ExternalAssets::kTimesOpened * paths.aliased_bytes + ExternalAssets::kBytesMore;
  if (paths.copied_bytes <= most) return std::nullopt;
  return Error{fmt::format("its aliases stand for more than {} times the bytes of their files",
                           ExternalAssets::kTimesOpened)};
}

}  // namespace

FlatChild::FlatChild(model::AssetInTree& tree, const schema::Set& set)
    : tree_(tree),
      document_(tree.asset().document()),
      elements_(document_),
      graph_(document_, set) {
  read_lists();
  mark_per_place();
  read_scene();
}

json::NodeId FlatChild::node(std::uint32_t index) const {
  return elements_.elements(RootArray::nodes)[index];
}

void FlatChild::add_list(std::string key, json::NodeId node) {
  if (document_.kind(node) != json::Kind::array) return;
  by_begin_.emplace(node, lists_.size());
  lists_.push_back({std::move(key), node, document_.array_size(node), false});
}

void FlatChild::read_lists() {
  for (const auto member : document_.members(document_.root())) {
    const std::string name(document_.key(member.key_id));
    if (!is_own_member(name)) add_list('/' + name, member.value);
  }
  const json::NodeId extensions = model::object_member(document_, document_.root(), "extensions");
  if (extensions == json::kNoNode) return;
  for (const auto extension : document_.members(extensions)) {
    if (!document_.is_object(extension.value)) continue;
    for (const auto member : document_.members(extension.value)) {
      std::string key = "/extensions";
      append_pointer_step(key, document_.key(extension.key_id));
      append_pointer_step(key, document_.key(member.key_id));
      add_list(std::move(key), member.value);
    }
  }
}

std::optional<std::size_t> FlatChild::list_around(json::NodeId value) const {
  const auto after = by_begin_.upper_bound(value);
  if (after == by_begin_.begin()) return std::nullopt;
  const auto& [begin, list] = *std::prev(after);
  if (value == begin || value >= document_.next(begin)) return std::nullopt;
  return list;
}

// Lists that lead to nodes do so for each place: skins, animations.
void FlatChild::mark_per_place() {
  std::set<std::pair<std::size_t, std::size_t>> links;  // from, to
  for (const graph::Use& use : graph_.uses()) {
    const auto from = list_around(use.at.node), to = list_around(use.target);
    if (from && to) links.emplace(*from, *to);
  }
  for (ChildList& list : lists_) list.per_place = list.key == "/nodes";
  for (bool more = true; more;) {
    more = false;
    for (const auto& [from, to] : links) {
      if (lists_[from].per_place || !lists_[to].per_place) continue;
      more = lists_[from].per_place = true;
    }
  }
}

void FlatChild::read_scene() {
  const auto& nodes = elements_.elements(RootArray::nodes);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const auto index = model::unsigned_member(document_, nodes[i], "externalAsset");
    if (index && *index <= UINT32_MAX) shown_.emplace_back(i, static_cast<std::uint32_t>(*index));
  }
  const auto& scenes = elements_.elements(RootArray::scenes);
  const std::uint64_t scene =
      model::unsigned_member(document_, document_.root(), "scene").value_or(0);
  if (scene >= scenes.size()) return;
  model::for_each_index(elements_, document_.find(scenes[scene], "nodes"), RootArray::nodes,
                        [this](std::uint64_t, std::optional<std::uint32_t> index, Span) {
                          if (index) roots_.push_back(*index);
                        });
}

std::optional<std::string> find_dangling_index(const graph::Graph& graph) {
  const graph::Tree& tree = graph.tree();
  for (const graph::IndexUse& use : graph.indices()) {
    if (use.list == json::kNoNode ? use.array.empty() : use.index < tree.size(use.list)) continue;
    return fmt::format("{} refers to an object that does not exist (see 'gltfx fix')",
                       printable(tree.pointer(use.at)));
  }
  return std::nullopt;
}

std::optional<std::string> FlatChild::find_obstacle() const {
  if (!asset().parsed().ok()) return "its JSON has errors";
  if (auto dangling = find_dangling_index(graph_)) return dangling;
  for (const ChildList& list : lists_) {
    if (auto doubt = find_index_doubt(graph_, list.node)) return doubt;
  }
  const auto unknown = find_unknown_index(graph_, [](json::NodeId) { return false; });
  if (!unknown) return std::nullopt;
  return fmt::format("{} {}", printable(unknown->pointer), unknown->reason);
}

std::optional<Error> FlatChild::move_files(NewPaths& paths, change::Change& change) {
  model::AssetBytes bytes(elements_, asset().container(), asset().resolver());
  if (auto trouble = move_buffers(bytes, paths, change)) return trouble;
  return move_uris(bytes, paths);
}

// The bytes of a chunk, or of an alias, become a file of their own.
std::optional<Error> FlatChild::move_buffers(model::AssetBytes& bytes, NewPaths& paths,
                                             change::Change& change) {
  const auto& buffers = elements_.elements(RootArray::buffers);
  for (std::uint32_t i = 0; i < buffers.size(); ++i) {
    if (buffers[i] == json::kNoNode) continue;
    const json::NodeId uri = document_.find(buffers[i], "uri");
    const bool aliased = uri != json::kNoNode && document_.is_string(uri) &&
                         asset().resolver().aliased(document_.string(uri)) != nullptr;
    if (!aliased && bytes.buffer_storage(i) != Storage::bin_chunk) continue;
    auto content = bytes.buffer(i);
    if (!content) return content.error();
    if (aliased) {
      if (auto excess = find_alias_excess(*content, paths)) return excess;
    }
    // The layout of new bytes would leave nothing of a buffer without a use.
    const bool is_used = !graph_.users(buffers[i]).empty();
    std::string path = is_used ? NewBuffer::own_path(paths.taken, paths.next++)
                               : container::data_uri("application/octet-stream", content->text());
    if (aliased) {
      texts_.push_back({uri, json::string_value(path)});
      moved_uris_.insert(uri);
    } else {
      uris_.emplace_back(buffers[i], json::string_value(path));
      const json::NodeId chunk = document_.find(buffers[i], "chunk");
      if (chunk != json::kNoNode) removed_.emplace_back(buffers[i], chunk);
    }
    if (is_used) change.files.push_back({std::move(path), {*std::move(content)}});
  }
  return std::nullopt;
}

// URIs begin at the folder of the first asset. Images of an alias are embedded.
std::optional<Error> FlatChild::move_uris(model::AssetBytes& bytes, NewPaths& paths) {
  const container::Resolver& resolver = asset().resolver();
  std::map<json::NodeId, std::uint32_t> images;  // by the value of their URI
  const auto& objects = elements_.elements(RootArray::images);
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const json::NodeId uri = document_.find(objects[i], "uri");
    if (uri != json::kNoNode) images.emplace(uri, i);
  }
  const json::NodeId files = document_.find(document_.root(), "files");
  for (const auto& [value, path] : change::referred_files(document_)) {
    const bool is_of_file =
        files != json::kNoNode && value > files && value < document_.next(files);
    if (is_of_file || moved_uris_.contains(value)) continue;
    if (NewBuffer::is_own(path)) return Error{fmt::format("it refers to {}", printable(path))};
    if (resolver.aliased(document_.string(value)) == nullptr) {
      const std::string moved = resolver.place_of(path);
      if (moved == path) continue;
      texts_.push_back({value, json::string_value(container::uri_of_path(moved))});
      continue;
    }
    const auto image = images.find(value);
    if (image == images.end()) {
      return Error{fmt::format("{} is an alias, which only buffers and images can lose",
                               printable(graph_.tree().pointer(value)))};
    }
    const auto content = bytes.image(image->second);
    if (!content) return content.error();
    if (auto excess = find_alias_excess(*content, paths)) return excess;
    const image::Sniffed sniffed = image::sniff(content->view());
    if (!sniffed.known) return Error{"the image of an alias has an unknown format"};
    texts_.push_back({value, json::string_value(container::data_uri(
                                 image::media_type(sniffed.format), content->text()))});
  }
  return std::nullopt;
}

void FlatChild::list_losses(std::vector<ConvertLoss>& losses) const {
  const auto lose = [&](json::NodeId object, std::string_view of) {
    for (const char* member : {"extensions", "extras"}) {
      if (document_.find(object, member) == json::kNoNode) continue;
      losses.push_back(
          {fmt::format("the {} of {} in {}", member, of, printable(asset().name())), 0, 0, {}});
    }
  };
  const json::NodeId root = document_.root();
  lose(document_.find(root, "asset"), "asset");
  const auto& scenes = elements_.elements(RootArray::scenes);
  for (const json::NodeId scene : scenes) lose(scene, "a scene");
  if (document_.find(root, "extras") != json::kNoNode) {
    losses.push_back({fmt::format("the extras of {}", printable(asset().name())), 0, 0, {}});
  }
  if (scenes.size() > 1) {
    losses.push_back({fmt::format("the other scenes of {}", printable(asset().name())), 0, 0, {}});
  }
}

void FlatChild::move_indices(const ListBases& bases, json::Editor& editor) const {
  std::map<json::NodeId, std::uint64_t> moves;
  for (std::size_t i = 0; i < lists_.size(); ++i) moves.emplace(lists_[i].node, bases[i]);
  auto edits = graph::renumber(
      graph_,
      [&](json::NodeId list, std::uint64_t position) {
        const auto found = moves.find(list);
        return found == moves.end() ? position : found->second + position;
      },
      [](graph::Place) { return false; });
  for (json::Edit& edit : edits) editor.replace_text(edit.span, std::move(edit.text));
  for (const NewText& text : texts_) editor.replace_scalar(text.value, text.json);
  for (const auto& [buffer, uri] : uris_) editor.append_member(buffer, "uri", uri);
  for (const auto& [object, value] : removed_) editor.remove(object, value - 1);
}

}  // namespace gltfx::steps
