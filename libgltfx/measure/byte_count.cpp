// SPDX-License-Identifier: Apache-2.0
#include "measure/byte_count.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/checked.hpp"
#include "container/uri.hpp"
#include "model/buffer_chunk.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx::measure {
namespace {

using model::RootArray;

/// The use of bytes, and the mesh, image, animation or skin that they belong to.
struct Owner {
  ByteUse use = ByteUse::other;
  std::uint32_t index = 0;
};

// The owner of the data that an element of a root array refers to.
Owner owner_of(const graph::Tree& tree, json::NodeId element) {
  constexpr std::pair<std::string_view, ByteUse> kOwners[] = {{"meshes", ByteUse::meshes},
                                                              {"images", ByteUse::images},
                                                              {"animations", ByteUse::animations},
                                                              {"skins", ByteUse::skins}};
  if (element == json::kNoNode) return {};
  for (const auto& [array, use] : kOwners) {
    if (tree.name(tree.parent(element)) == array) return {use, tree.position(element)};
  }
  return {};
}

constexpr std::uint64_t kPadding =
    15;  // at most so many bytes between two objects count as padding

/// Contiguous bytes: a file, a chunk, the content of a data URI.
struct Store {
  struct Part {
    std::uint64_t begin = 0, end = 0;
    Owner owner;
  };
  std::uint64_t size = 0;
  std::vector<Part> parts;
};

class Counter {
 public:
  Counter(const container::Container& container, container::OpenedFiles& files,
          const model::Asset& asset, const model::Views& views,
          const model::ResourceData& resources, const graph::Graph& graph)
      : container_(container),
        files_(files),
        asset_(asset),
        views_(views),
        resources_(resources),
        graph_(graph) {
    count_.meshes.resize(asset.count(RootArray::meshes));
    count_.images.resize(asset.count(RootArray::images));
    count_.animations.resize(asset.count(RootArray::animations));
    count_.skins.resize(asset.count(RootArray::skins));
  }

  ByteCount run() {
    take_container();
    place_buffers();
    place_images();
    for (const graph::IndexUse& use : graph_.indices()) {
      if (use.array == "/bufferViews") place(use);
    }
    for (Store& store : stores_) resolve(store);
    return std::move(count_);
  }

 private:
  const json::Document& document() const { return asset_.document(); }
  std::uint64_t& share(ByteUse use) { return count_.shares[static_cast<std::size_t>(use)]; }

  // Chunks of other types are unused; all bytes outside of chunks are headers and padding. Of
  // version 2, only the first BIN chunk counts.
  void take_container() {
    count_.files.push_back({{}, container_.bytes.size()});
    std::uint64_t inner = document().text().size();
    share(ByteUse::json) += inner;
    const bool any_bin = container_.glb_version == 3U;
    for (const container::Chunk& chunk : container_.chunks) {
      const bool is_first = container_.bin && chunk.offset == container_.bin->offset;
      if (chunk.type == container::kChunkJson) continue;
      if (is_first || (any_bin && chunk.type == container::kChunkBin)) {
        by_chunk_.emplace(chunk.offset, stores_.size());
        stores_.push_back({chunk.length, {}});
      } else {
        share(ByteUse::unused) += chunk.length;
      }
      inner += chunk.length;
    }
    const std::uint64_t whole = std::max<std::uint64_t>(container_.bytes.size(), inner);
    share(ByteUse::padding) += whole - inner;
  }

  // The store that a `uri` leads to. `decoded`: the bytes of a data URI.
  std::optional<std::size_t> store_of(json::NodeId object,
                                      const std::optional<container::Bytes>& decoded) {
    const json::NodeId member = document().find(object, "uri");
    if (member == json::kNoNode || !document().is_string(member)) return std::nullopt;
    std::string buffer;
    const container::Uri uri = container::classify_uri(document().string(member, buffer));
    if (uri.kind == container::UriKind::relative_path) return file_store(uri);
    if (uri.kind != container::UriKind::data || !decoded) return std::nullopt;
    const std::uint64_t text = document().raw(member).size();
    if (text < decoded->size()) return std::nullopt;
    share(ByteUse::json) -= text;
    share(ByteUse::base64) += text - decoded->size();
    stores_.push_back({decoded->size(), {}});
    return stores_.size() - 1;
  }

  std::optional<std::size_t> file_store(const container::Uri& uri) {
    const auto [entry, fresh] = by_path_.try_emplace(uri.path);
    if (!fresh) return entry->second;
    const container::Resolved& file = files_.open(uri);
    if (file.error != container::ResolveError::none) return std::nullopt;
    const std::uint64_t size = file.bytes.size();
    count_.files.push_back({uri.normalized, size});
    stores_.push_back({size, {}});
    entry->second = stores_.size() - 1;
    return entry->second;
  }

  // Buffers may share a chunk.
  std::optional<std::size_t> chunk_store(json::NodeId buffer, std::size_t index,
                                         const schema::Version& version) const {
    const auto chunk = model::chunk_of(container_, document(), buffer, index, version);
    if (!chunk) return std::nullopt;
    const auto found = by_chunk_.find(chunk->offset);
    return found == by_chunk_.end() ? std::nullopt : std::optional(found->second);
  }

  void place_buffers() {
    const auto& objects = asset_.elements(RootArray::buffers);
    buffers_.resize(objects.size());
    const schema::Version version = schema::stated_version(document());
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] == json::kNoNode) continue;
      buffers_[i] = store_of(objects[i], resources_.buffers[i]);
      if (!buffers_[i]) buffers_[i] = chunk_store(objects[i], i, version);
    }
  }

  void place_images() {
    const auto& objects = asset_.elements(RootArray::images);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] == json::kNoNode) continue;
      const auto store = store_of(objects[i], resources_.images[i].bytes);
      if (!store) continue;
      const Owner owner{ByteUse::images, static_cast<std::uint32_t>(i)};
      stores_[*store].parts.push_back({0, stores_[*store].size, owner});
    }
  }

  // The owner of an accessor: the first of those that refer to it, in the order of ByteUse.
  std::optional<Owner> owner_of_accessor(json::NodeId accessor) const {
    std::optional<Owner> owner;
    for (const graph::Use& use : graph_.users(accessor)) {
      if (use.kind != graph::UseKind::index) continue;
      const Owner user = owner_of(graph_.tree(), graph_.tree().root_element(use.at.node));
      if (!owner || user.use < owner->use) owner = user;
    }
    return owner;
  }

  // Assigns bytes to a user of a buffer view; an accessor assigns them to its own users.
  void place(const graph::IndexUse& use) {
    const auto index = asset_.index(static_cast<double>(use.index), RootArray::buffer_views);
    if (!index) return;
    const graph::Tree& tree = graph_.tree();
    const model::BufferView& view = views_.buffer_views[*index];
    const json::NodeId user = tree.root_element(use.at.node);
    Owner owner = owner_of(tree, user);
    std::uint64_t begin = 0, length = view.byte_length.value_or(0);
    if (user != json::kNoNode && tree.name(tree.parent(user)) == "accessors") {
      const auto behind = owner_of_accessor(user);
      if (!behind) return;
      owner = *behind;
      narrow(views_.accessors[tree.position(user)], *index, begin, length);
    }
    if (const auto stream = model::read_meshopt_view(asset_, view.node)) {
      put(stream->buffer, stream->byte_offset, stream->byte_length, owner);
    } else if (view.buffer) {
      put(*view.buffer, saturating_add(view.byte_offset.value_or(0), begin), length, owner);
    }
  }

  // Narrows the range to the part of the view that the elements use; sparse accessors use all of
  // their views.
  static void narrow(const model::Accessor& accessor, std::uint32_t view_index,
                     std::uint64_t& begin, std::uint64_t& length, std::uint64_t stride) {
    if (accessor.buffer_view != view_index || stride == 0) return;
    const std::uint64_t offset = accessor.byte_offset.value_or(0);
    const Checked size = checked_mul(accessor.count.value_or(0), stride);
    if (!size || offset > length) return;
    begin = offset;
    length = std::min(*size, length - offset);
  }
  void narrow(const model::Accessor& accessor, std::uint32_t view_index, std::uint64_t& begin,
              std::uint64_t& length) const {
    const std::uint64_t packed = model::packed_stride(accessor.format);
    narrow(accessor, view_index, begin, length,
           views_.buffer_views[view_index].byte_stride.value_or(packed));
  }

  void put(std::uint32_t buffer, std::uint64_t begin, std::uint64_t length, const Owner& owner) {
    if (!buffers_[buffer]) return;
    Store& store = stores_[*buffers_[buffer]];
    const std::uint64_t end = std::min(saturating_add(begin, length), store.size);
    if (begin < end) store.parts.push_back({begin, end, owner});
  }

  void resolve(Store& store) {
    std::stable_sort(store.parts.begin(), store.parts.end(),
                     [](const Store::Part& a, const Store::Part& b) { return a.begin < b.begin; });
    std::uint64_t covered = 0;
    for (const Store::Part& part : store.parts) {
      const std::uint64_t begin = std::max(part.begin, covered);
      if (begin >= part.end) continue;
      leave(begin - covered);
      give(part.owner, part.end - begin);
      covered = part.end;
    }
    leave(store.size - covered);
  }

  void leave(std::uint64_t gap) {
    share(gap <= kPadding ? ByteUse::padding : ByteUse::unused) += gap;
  }

  void give(const Owner& owner, std::uint64_t bytes) {
    share(owner.use) += bytes;
    if (owner.use == ByteUse::meshes) count_.meshes[owner.index] += bytes;
    if (owner.use == ByteUse::images) count_.images[owner.index] += bytes;
    if (owner.use == ByteUse::animations) count_.animations[owner.index] += bytes;
    if (owner.use == ByteUse::skins) count_.skins[owner.index] += bytes;
  }

  const container::Container& container_;
  container::OpenedFiles& files_;
  const model::Asset& asset_;
  const model::Views& views_;
  const model::ResourceData& resources_;
  const graph::Graph& graph_;
  ByteCount count_;
  std::vector<Store> stores_;
  std::vector<std::optional<std::size_t>> buffers_;            // stores, by index of the buffer
  std::map<std::string, std::optional<std::size_t>> by_path_;  // stores of files
  std::map<std::uint64_t, std::size_t> by_chunk_;  // stores of BIN chunks, by their offset
};

}  // namespace

ByteCount count_bytes(const container::Container& container, container::OpenedFiles& files,
                      const model::Asset& asset, const model::Views& views,
                      const model::ResourceData& resources, const graph::Graph& graph) {
  return Counter(container, files, asset, views, resources, graph).run();
}

}  // namespace gltfx::measure
