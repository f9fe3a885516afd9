// SPDX-License-Identifier: Apache-2.0
#include "pipeline/outline.hpp"

#include <algorithm>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/stable_hashes.hpp"
#include "base/text.hpp"
#include "model/asset.hpp"
#include "pipeline/open_asset.hpp"
#include "prove/changes.hpp"
#include "prove/hash_sum.hpp"
#include "prove/leaf_reader.hpp"
#include "prove/node_tree.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using prove::add_to_sum;
using prove::Content;
using prove::hash_content;
using prove::hash_json;
using prove::hash_of_all;
using prove::Item;
using prove::ItemId;
using prove::ItemList;
using prove::kNoItem;
using prove::Leaf;
using prove::LeafKind;
using prove::NodeTree;
using prove::Side;
using prove::subject_of;
using prove::Surface;

constexpr std::size_t kLongestName = 60;

std::string counted_as(std::uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string digits_of(const Hash128& hash) { return fmt::format("{:010x}", hash.high >> 24U); }

std::string name_in(const json::Document& document, json::NodeId object) {
  const json::NodeId name =
      document.is_object(object) ? document.find(object, "name") : json::kNoNode;
  if (name == json::kNoNode || !document.is_string(name)) return {};
  return std::string(document.string(name));
}

/// Writes the lines.
class Outline {
 public:
  explicit Outline(const Content& content)
      : content_(content),
        document_(content.side().document()),
        nodes_(content),
        node_list_(content.list("/nodes")),
        texture_list_(content.list("/textures")) {}

  std::string write() {
    name_nodes();
    read_data_elsewhere();
    sum_up();
    add_asset();
    add_extensions("extensionsUsed", "extension");
    add_extensions("extensionsRequired", "extension-required");
    for (std::uint32_t list = 0; list < content_.lists().size(); ++list) {
      if (list == texture_list_) continue;  // shown by what uses them
      for (std::uint32_t i = 0; i < content_.lists()[list].items.size(); ++i) add_item({list, i});
    }
    std::sort(lines_.begin(), lines_.end());
    std::string text;
    for (const std::string& line : lines_) text.append(line).append(1, '\n');
    return text;
  }

 private:
  // Hashes of the names from the root.
  void name_nodes() {
    ways_.resize(nodes_.size());
    for (const std::uint32_t node : nodes_.order()) {
      const model::NodeIndex above = nodes_.parent(node);
      const Hash128 start = above == model::kNoNodeIndex ? Hash128{} : ways_[above];
      ways_[node] = hash_of_all(start, content_.item({node_list_, node}).label);
    }
  }

  std::string way_of(std::uint32_t node) const {
    constexpr std::size_t kMostNames = 8;
    std::vector<std::string> names;
    model::NodeIndex at = node;
    for (; at != model::kNoNodeIndex && names.size() < kMostNames; at = nodes_.parent(at)) {
      const std::string name = name_in(document_, content_.item({node_list_, at}).node);
      names.push_back(name.empty() ? "*" : quoted(name, kLongestName));
    }
    if (at != model::kNoNodeIndex) names.emplace_back("...");
    std::reverse(names.begin(), names.end());
    return fmt::format("{}", fmt::join(names, "/"));
  }

  // The values of an accessor as its object describes them.
  Hash128 described(std::uint32_t accessor) const {
    Hash128 sum;
    const json::NodeId object = content_.side().views().accessors[accessor].node;
    if (object == json::kNoNode) return sum;
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (name == "bufferView" || name == "byteOffset" || name == "name") continue;
      add_to_sum(sum, hash_of_all(hash_content(name), hash_json(document_, member.value)));
    }
    return sum;
  }

  // The nodes of scenes; and of data that is not in the file what the text says about it.
  void read_data_elsewhere() {
    const Side& side = content_.side();
    elsewhere_.resize(content_.lists().size());
    for (std::size_t i = 0; i < elsewhere_.size(); ++i) {
      elsewhere_[i].resize(content_.lists()[i].items.size());
    }
    const auto& meshes = side.views().meshes;
    for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh) {
      for (std::size_t i = 0; i < meshes[mesh].primitives.size(); ++i) {
        if (content_.surfaces(mesh)[i].readable) continue;
        for (const model::Attribute& each : meshes[mesh].primitives[i].attributes) {
          if (!each.accessor) continue;
          add_to_sum(elsewhere_[content_.list("/meshes")][mesh],
                     hash_of_all(hash_content(each.name), described(*each.accessor)));
        }
      }
    }
    const auto& animations = side.views().animations;
    for (std::uint32_t animation = 0; animation < animations.size(); ++animation) {
      for (const model::AnimationSampler& sampler : animations[animation].samplers) {
        for (const auto& accessor : {sampler.input, sampler.output}) {
          bool readable = false;
          if (!accessor || (content_.elements(*accessor, readable), readable)) continue;
          add_to_sum(elsewhere_[content_.list("/animations")][animation], described(*accessor));
        }
      }
    }
    const std::uint32_t scenes = content_.list("/scenes");
    for (std::uint32_t i = 0; scenes != kNoItem && i < elsewhere_[scenes].size(); ++i) {
      for (const std::uint32_t node : roots_of({scenes, i})) {
        add_to_sum(elsewhere_[scenes][i], ways_[node]);
      }
    }
    const auto& images = side.resources().images;
    for (std::uint32_t image = 0; image < images.size(); ++image) {
      const std::string uri = images[image].bytes ? std::string() : uri_of(image);
      if (!uri.empty()) elsewhere_[content_.list("/images")][image] = hash_content(uri);
    }
  }

  std::string uri_of(std::uint32_t image) const {
    const json::NodeId object = content_.item({content_.list("/images"), image}).node;
    const json::NodeId uri =
        document_.is_object(object) ? document_.find(object, "uri") : json::kNoNode;
    if (uri == json::kNoNode || !document_.is_string(uri)) return {};
    return std::string(document_.string(uri));
  }

  // What stands for an object in those that refer to it.
  Hash128 identity(ItemId item) const {
    if (item.list == node_list_) return ways_[item.index];
    const Hash128& label = content_.item(item).label;
    return item.list == texture_list_ || label == Hash128{} ? shown_[item.list][item.index] : label;
  }

  void sum_up() {
    constexpr int kRounds = 5;  // node, mesh, material, texture, image
    const auto& lists = content_.lists();
    for (const ItemList& list : lists) shown_.emplace_back(list.items.size());
    for (int round = 0; round < kRounds; ++round) {
      auto next = shown_;
      for (std::size_t k = 0; k < lists.size(); ++k) {
        for (std::size_t i = 0; i < lists[k].items.size(); ++i) {
          Hash128 sum = elsewhere_[k][i];
          const Item& item = lists[k].items[i];
          for (std::uint32_t at = item.first; at < item.last; ++at) {
            const Leaf& leaf = content_.leaves()[at];
            if (leaf.kind == LeafKind::name) continue;
            const Hash128 target = leaf.target ? identity(leaf.target) : Hash128{};
            add_to_sum(sum, hash_of_all(leaf.path, leaf.value, target));
          }
          next[k][i] = hash_of_all(sum, item.label);
        }
      }
      shown_ = std::move(next);
    }
  }

  void add_asset() {
    const json::NodeId asset = document_.find(document_.root(), "asset");
    const auto text = [&](std::string_view name) {
      const json::NodeId value =
          document_.is_object(asset) ? document_.find(asset, name) : json::kNoNode;
      return value != json::kNoNode && document_.is_string(value)
                 ? std::string(document_.string(value))
                 : std::string();
    };
    const Hash128 generator =
        hash_of_all(hash_of_all(Hash128{}, hash_content("asset")), hash_content("generator"));
    Hash128 sum;
    for (std::uint32_t at = content_.root().first; at < content_.root().last; ++at) {
      const Leaf& leaf = content_.leaves()[at];
      if (leaf.path == generator) continue;
      const Hash128 target = leaf.target ? identity(leaf.target) : Hash128{};
      add_to_sum(sum, hash_of_all(leaf.path, leaf.value, target));
    }
    lines_.push_back(fmt::format("asset  glTF {}  {}", printable(text("version")), digits_of(sum)));
    if (const std::string name = text("generator"); !name.empty()) {
      lines_.push_back(fmt::format("asset  generator {}", quoted(name, 2 * kLongestName)));
    }
  }

  void add_extensions(std::string_view member, std::string_view word) {
    const json::NodeId list = document_.find(document_.root(), member);
    if (list == json::kNoNode || !document_.is_array(list)) return;
    for (const json::NodeId each : document_.elements(list)) {
      if (!document_.is_string(each)) continue;
      lines_.push_back(fmt::format("{} {}", word, quoted(document_.string(each), kLongestName)));
    }
  }

  void add_item(ItemId id) {
    const ItemList& list = content_.lists()[id.list];
    const std::string subject =
        id.list == node_list_ ? "node" : std::string(subject_of(list.pointer));
    const std::string kind = subject == "object" ? list.pointer.substr(1) : subject;
    const std::string name = name_in(document_, list.items[id.index].node);
    std::string line = kind + ' ';
    if (id.list == node_list_) {
      line += way_of(id.index);
    } else {
      line += name.empty() ? "*" : quoted(name, kLongestName);
    }
    const std::string counts = counts_of(list.pointer, id);
    if (!counts.empty()) line.append("  ").append(counts);
    lines_.push_back(fmt::format("{}  {}", printable(line), digits_of(shown_[id.list][id.index])));
  }

  std::string counts_of(std::string_view pointer, ItemId id) const {
    if (pointer == "/nodes") return parts_of(id);
    if (pointer == "/meshes") {
      std::uint64_t elements = 0;
      bool elsewhere = false;
      for (const Surface& surface : content_.surfaces(id.index)) {
        elements += surface.elements;
        elsewhere = elsewhere || !surface.readable;
      }
      return elsewhere ? "not in this file" : counted_as(elements, "element", "elements");
    }
    if (pointer == "/images") return picture_of(id.index);
    std::uint64_t count = 0;
    const Item& item = content_.item(id);
    for (std::uint32_t at = item.first; at < item.last; ++at) {
      const LeafKind kind = content_.leaves()[at].kind;
      count += kind == LeafKind::joint || kind == LeafKind::channel ? 1U : 0U;
    }
    if (pointer == "/skins") return counted_as(count, "joint", "joints");
    if (pointer == "/animations") return counted_as(count, "channel", "channels");
    if (pointer == "/scenes") return counted_as(roots_of(id).size(), "root node", "root nodes");
    return {};
  }

  std::vector<std::uint32_t> roots_of(ItemId scene) const {
    std::vector<std::uint32_t> roots;
    const json::NodeId object = content_.item(scene).node;
    if (!document_.is_object(object)) return roots;
    model::for_each_index(content_.side().asset(), document_.find(object, "nodes"),
                          model::RootArray::nodes,
                          [&](std::uint64_t, const std::optional<std::uint32_t>& index, Span) {
                            if (index) roots.push_back(*index);
                          });
    return roots;
  }

  // What hangs on a node.
  std::string parts_of(ItemId node) const {
    std::vector<std::string> parts;
    const Item& item = content_.item(node);
    for (std::uint32_t at = item.first; at < item.last; ++at) {
      const ItemId target = content_.leaves()[at].target;
      if (!target || target.list == node_list_) continue;
      const std::string& pointer = content_.lists()[target.list].pointer;
      const std::string_view subject = subject_of(pointer);
      const std::string name = name_in(document_, content_.item(target).node);
      parts.push_back(
          fmt::format("{}{}", subject == "object" ? std::string_view(pointer).substr(1) : subject,
                      name.empty() ? std::string() : ' ' + quoted(name, kLongestName)));
    }
    std::sort(parts.begin(), parts.end());
    if (const std::size_t children = nodes_.children(node.index).size(); children > 0) {
      parts.push_back(counted_as(children, "child", "children"));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  std::string picture_of(std::uint32_t image) const {
    const model::ImageData& data = content_.side().resources().images[image];
    if (!data.bytes) {
      const std::string uri = uri_of(image);
      return uri.empty() ? "not in this file" : "in " + quoted(uri, 2 * kLongestName);
    }
    std::string text;
    if (data.header) text = fmt::format("{} x {}, ", data.header->width, data.header->height);
    return text + counted_as(data.bytes->size(), "byte", "bytes");
  }

  const Content& content_;
  const json::Document& document_;
  const NodeTree nodes_;
  const std::uint32_t node_list_, texture_list_;
  std::vector<Hash128> ways_;  ///< by node
  /// By list and index.
  std::vector<std::vector<Hash128>> elsewhere_, shown_;
  std::vector<std::string> lines_;
};

Result<std::string> make_outline(const std::string& path, const InspectOptions& options) {
  const auto file = open_asset_file(path, AssetBounds::of(options));
  if (!file) return file.error();
  auto container = container::open_file(*file, path);
  if (!container) return container.error();
  const model::OpenedAsset asset(path, *std::move(container), container::Resolver());
  if (auto obstacle = find_obstacle(asset)) return *std::move(obstacle);
  const json::Document& document = asset.document();
  if (!document.is_object(document.root())) return Error{"it is not a glTF asset"};
  if (model::is_gltf_1(document)) return Error{"it is glTF 1.0"};
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  const StableHashes stable;
  const Side side(asset, *schemas, prove::Scope::all, 1);
  const Content content(side);
  return Outline(content).write();
}

}  // namespace

std::string outline_file(const std::string& path, const InspectOptions& options) {
  try {
    const auto outline = make_outline(path, options);
    if (outline) return *outline;
    return fmt::format("no outline: {}\n", printable(outline.error().message));
  } catch (const std::bad_alloc&) {
    return "no outline: there is not enough memory\n";
  }
}

}  // namespace gltfx
