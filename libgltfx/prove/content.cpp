// SPDX-License-Identifier: Apache-2.0
#include "prove/content.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/material.hpp"
#include "model/pose.hpp"
#include "model/skin.hpp"
#include "prove/column.hpp"
#include "prove/hash_sum.hpp"
#include "prove/leaf_reader.hpp"
#include "prove/soup.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

constexpr std::string_view kLists[] = {"/animations", "/cameras", "/images",
                                       "/materials",  "/meshes",  "/nodes",
                                       "/scenes",     "/skins",   "/textures"};
// Compared with what they are used for.
constexpr std::string_view kNoLists[] = {"/accessors", "/bufferViews", "/buffers", "/samplers"};

// Rounds in which objects learn what they refer to refers to: node, mesh, material, texture, image.
constexpr int kRounds = 5;

std::string_view bytes_of_numbers(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

}  // namespace

void Content::Box::add(const model::Vector3& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(point[i])) continue;
    least[i] = std::min(least[i], point[i]);
    greatest[i] = std::max(greatest[i], point[i]);
  }
}

void Content::Box::add(const Box& box) {
  if (box.empty()) return;
  add(box.least);
  add(box.greatest);
}

model::Vector3 Content::Box::corner(unsigned i) const {
  return {(i & 1U) != 0 ? greatest[0] : least[0], (i & 2U) != 0 ? greatest[1] : least[1],
          (i & 4U) != 0 ? greatest[2] : least[2]};
}

Content::Box Content::Box::nothing() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

Content::Content(const Side& side)
    : side_(side),
      types_(side.graph().set()),
      storage_(storage_extensions(side.graph().set(), types_)) {
  find_lists();
  read_surfaces();
  read_items();
  sum_up();
}

std::uint32_t Content::list(std::string_view pointer) const {
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    if (lists_[i].pointer == pointer) return static_cast<std::uint32_t>(i);
  }
  return kNoItem;
}

ItemId Content::find(json::NodeId value) const {
  const auto found = ids_.find(value);
  return found == ids_.end() ? ItemId{} : found->second;
}

void Content::add_list(std::string pointer, json::NodeId array) {
  const json::Document& document = side_.document();
  if (array == json::kNoNode || !document.is_array(array)) return;
  if (list(pointer) != kNoItem) return;
  const auto number = static_cast<std::uint32_t>(lists_.size());
  ItemList& added = lists_.emplace_back();
  added.pointer = std::move(pointer);
  if (document.kind(array) == json::Kind::number_array) {  // no objects; a value of the root
    Item none;
    none.node = array;
    added.items.assign(document.array_size(array), none);
    return;
  }
  arrays_.insert(array);
  added.items.reserve(document.array_size(array));
  for (const json::NodeId element : document.elements(array)) {
    ids_[element] = {number, static_cast<std::uint32_t>(added.items.size())};
    added.items.emplace_back().node = element;
  }
}

void Content::find_lists() {
  const json::Document& document = side_.document();
  for (const std::string_view pointer : kLists) {
    add_list(std::string(pointer), document.find(document.root(), pointer.substr(1)));
  }
  for (const schema::TargetArray& array : side_.graph().checked().targets) {
    const bool part =
        std::find(std::begin(kNoLists), std::end(kNoLists), array.pointer) != std::end(kNoLists);
    if (!part) add_list(array.pointer, array.node);
  }
}

Hash128 Content::elements(std::uint32_t accessor, bool& readable) const {
  const auto [at, is_new] = elements_.try_emplace(accessor);
  if (is_new) {
    if (const auto column = Column::open(side_, accessor)) {
      constexpr std::size_t kElements = 1024;
      Hash128 hash = hash_of_all(column->count(), column->components());
      std::vector<std::byte> block(kElements * column->packed_size());
      std::vector<double> numbers;
      std::uint64_t next = 0;
      for (std::uint64_t first = 0; first < column->count(); first += kElements) {
        const auto count =
            static_cast<std::size_t>(std::min<std::uint64_t>(kElements, column->count() - first));
        column->read(block.data(), first, count, next);
        numbers.clear();
        for (std::size_t i = 0; i < count; ++i) {
          const Element element = column->decode(block.data() + i * column->packed_size());
          for (unsigned k = 0; k < column->components(); ++k) numbers.push_back(element[k] + 0.0);
        }
        hash = hash_of_all(hash, hash_content(bytes_of_numbers(numbers)));
      }
      at->second = {hash, true};
    }
  }
  readable = at->second.readable;
  return at->second.hash;
}

Hash128 Content::bytes(std::uint32_t view) const {
  const model::BufferView& described = side_.views().buffer_views[view];
  const auto part =
      side_.resources().part(side_.document(), described, 0, described.byte_length.value_or(0));
  return part ? hash_content(part->text()) : Hash128{};
}

void Content::read_surfaces() {
  const auto& meshes = side_.views().meshes;
  surfaces_.resize(meshes.size());
  boxes_.assign(meshes.size(), Box::nothing());
  std::vector<bool> blends;
  for (std::uint32_t i = 0; i < side_.asset().count(RootArray::materials); ++i) {
    blends.push_back(model::read_material(side_.asset(), i).alpha_mode == model::AlphaMode::blend);
  }
  std::vector<std::uint32_t> skins(meshes.size(), kNoItem);
  for (const model::Node& node : side_.views().nodes) {
    if (node.mesh && node.skin && skins[*node.mesh] == kNoItem) skins[*node.mesh] = *node.skin;
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::vector<double> joints =
        skins[i] == kNoItem ? std::vector<double>() : joint_names(*this, skins[i]);
    for (const model::Primitive& primitive : meshes[i].primitives) {
      Surface& surface = surfaces_[i].emplace_back();
      surface.primitive = primitive.node;
      surface.material = primitive.material;
      if (primitive.node == json::kNoNode) continue;
      const Soup soup = read_soup(side_, primitive.node, joints);
      surface.readable = soup.readable;
      surface.elements = soup.elements();
      surface.sum = hash_soup(soup);
      if (surface.material && blends[*surface.material]) surface.order = hash_order(soup, {});
      if (const SoupStream* positions = soup.find(model::SemanticKind::position);
          positions != nullptr && positions->width == 3) {
        for (std::size_t vertex = 0; vertex < soup.vertices(); ++vertex) {
          const double* at = soup.row(static_cast<std::uint32_t>(vertex)) + positions->offset;
          boxes_[i].add(model::Vector3{at[0], at[1], at[2]});
        }
      }
    }
  }
}

void Content::read_items() {
  LeafReader reader(*this, leaves_);
  leaves_.reserve(side_.document().next(side_.document().root()) / 2);  // keys are no leaves
  for (std::uint32_t list = 0; list < lists_.size(); ++list) {
    for (std::uint32_t index = 0; index < lists_[list].items.size(); ++index) {
      Item& item = lists_[list].items[index];
      item.first = static_cast<std::uint32_t>(leaves_.size());
      if (side_.document().is_object(item.node)) {
        reader.read(item.node);
        add_special({list, index});
      }
      item.last = static_cast<std::uint32_t>(leaves_.size());
      label(item);
    }
  }
  root_.node = side_.document().root();
  root_.first = static_cast<std::uint32_t>(leaves_.size());
  reader.read_root();
  root_.last = static_cast<std::uint32_t>(leaves_.size());
}

void Content::label(Item& item) const {
  const json::Document& document = side_.document();
  if (!document.is_object(item.node)) return;
  const json::NodeId name = document.find(item.node, "name");
  if (name != json::kNoNode && document.is_string(name)) {
    item.label = hash_content(document.string(name));
  }
}

void Content::add_special(ItemId id) {
  const std::string& pointer = lists_[id.list].pointer;
  if (pointer == "/meshes") return add_surfaces(id.index);
  if (pointer == "/skins") return add_joints(lists_[id.list].items[id.index].node);
  if (pointer == "/animations") return add_channels(id.index);
  if (pointer == "/images") return add_image(id.index);
  if (pointer == "/nodes") return add_place(id.index);
}

void Content::add_surfaces(std::uint32_t mesh) {
  const std::uint32_t materials = list("/materials");
  struct Group {
    std::optional<std::uint32_t> material;
    Hash128 sum;
  };
  std::vector<Group> groups;
  std::unordered_map<std::uint32_t, std::size_t> by_material;
  for (const Surface& surface : surfaces_[mesh]) {
    if (surface.primitive == json::kNoNode) continue;
    const auto [at, is_new] =
        by_material.try_emplace(surface.material.value_or(kNoItem), groups.size());
    if (is_new) groups.push_back({surface.material, {}});
    add_to_sum(groups[at->second].sum, surface.sum);
  }
  for (const Group& group : groups) {
    Leaf leaf{hash_content("surface"),
              group.sum,
              lists_[list("/meshes")].items[mesh].node,
              {},
              LeafKind::surface};
    if (group.material) leaf.target = {materials, *group.material};
    leaves_.push_back(leaf);
  }
}

void Content::add_joints(json::NodeId object) {
  const model::Skin skin = model::read_skin(side_.asset(), object);
  const auto matrices =
      skin.inverse_bind_matrices ? Column::open(side_, *skin.inverse_bind_matrices) : std::nullopt;
  for (std::size_t i = 0; i < skin.joint_nodes.size(); ++i) {
    Leaf leaf{
        hash_content("joint"), {}, object, {list("/nodes"), skin.joint_nodes[i]}, LeafKind::joint};
    if (matrices && i < matrices->count()) {
      const Element matrix = matrices->at(i);
      leaf.value = hash_content({reinterpret_cast<const char*>(matrix.data()), sizeof(matrix)});
    }
    leaves_.push_back(leaf);
  }
}

void Content::add_channels(std::uint32_t animation) {
  const model::Animation& all = side_.views().animations[animation];
  for (const model::AnimationChannel& channel : all.channels) {
    Hash128 value;
    if (channel.sampler) {
      const model::AnimationSampler& sampler = all.samplers[*channel.sampler];
      bool readable = false;
      value = hash_of_all(static_cast<int>(sampler.interpolation), static_cast<int>(channel.path),
                          sampler.input ? elements(*sampler.input, readable) : Hash128{},
                          sampler.output ? elements(*sampler.output, readable) : Hash128{});
    }
    Leaf leaf{hash_content("channel"), value, channel.object, {}, LeafKind::channel};
    if (channel.node) leaf.target = {list("/nodes"), *channel.node};
    leaves_.push_back(leaf);
  }
}

void Content::add_image(std::uint32_t image) {
  const model::ImageData& data = side_.resources().images[image];
  const Hash128 value = data.bytes ? hash_content(data.bytes->text()) : Hash128{};
  leaves_.push_back({hash_content("texels"),
                     value,
                     lists_[list("/images")].items[image].node,
                     {},
                     LeafKind::texels});
}

// Rounded, because it may be a matrix or its parts.
void Content::add_place(std::uint32_t node) {
  const model::Node& described = side_.views().nodes[node];
  const model::Affine place = model::stored_transform(side_.asset(), described);
  std::array<float, 12> numbers{};
  for (std::size_t i = 0; i < 12; ++i) {
    numbers[i] = static_cast<float>(place.columns[i / 3][i % 3]) + 0.0F;
  }
  leaves_.push_back({hash_content("place"),
                     hash_content({reinterpret_cast<const char*>(numbers.data()), sizeof(numbers)}),
                     described.object,
                     {},
                     LeafKind::place});
}

void Content::sum_up() {
  const std::uint32_t nodes = list("/nodes");
  const auto counts = [](const Leaf& leaf) {
    return leaf.kind != LeafKind::name && leaf.kind != LeafKind::aside;
  };
  for (ItemList& list : lists_) {
    for (Item& item : list.items) {
      for (std::uint32_t i = item.first; i < item.last; ++i) {
        const Leaf& leaf = leaves_[i];
        if (counts(leaf)) add_to_sum(item.own, hash_of_all(leaf.path, leaf.value));
      }
      item.content = item.own;
    }
  }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::vector<Hash128>> next(lists_.size());
    for (std::size_t k = 0; k < lists_.size(); ++k) {
      for (const Item& item : lists_[k].items) {
        Hash128 sum;
        for (std::uint32_t i = item.first; i < item.last; ++i) {
          const Leaf& leaf = leaves_[i];
          if (!counts(leaf)) continue;
          Hash128 target;
          if (leaf.target) {
            const Item& to = this->item(leaf.target);
            target = leaf.target.list == nodes ? to.label : to.content;
          }
          add_to_sum(sum, hash_of_all(leaf.path, leaf.value, target));
        }
        next[k].push_back(hash_of_all(item.own, sum));
      }
    }
    for (std::size_t k = 0; k < lists_.size(); ++k) {
      for (std::size_t i = 0; i < next[k].size(); ++i) lists_[k].items[i].content = next[k][i];
    }
  }
}

std::vector<double> joint_names(const Content& content, std::uint32_t skin) {
  const Side& side = content.side();
  const json::NodeId object = side.asset().elements(RootArray::skins)[skin];
  const json::Document& document = side.document();
  std::vector<double> names;
  std::unordered_map<Hash128, std::uint64_t, HashHasher> repeats;
  for (const model::NodeIndex joint : model::read_skin(side.asset(), object).joint_nodes) {
    const json::NodeId node = side.asset().elements(RootArray::nodes)[joint];
    const json::NodeId name = document.find(node, "name");
    const bool named = name != json::kNoNode && document.is_string(name);
    const Hash128 hash = hash_content(named ? document.string(name) : std::string());
    const Hash128 whole = hash_of_all(hash, ++repeats[hash]);
    names.push_back(static_cast<double>(whole.low >> 12U));
  }
  return names;
}

}  // namespace gltfx::prove
