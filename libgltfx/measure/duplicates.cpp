// SPDX-License-Identifier: Apache-2.0
// Waste: what is stored again, and bytes that are the same.
#include "measure/duplicates.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/secret_hash.hpp"
#include "graph/equal_objects.hpp"
#include "measure/take.hpp"
#include "model/accessor_data.hpp"
#include "model/draco.hpp"
#include "model/fields.hpp"
#include "model/memory_budget.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx::measure {
namespace {

using json::NodeId;
using model::RootArray;

constexpr std::uint64_t kLeastBytes = std::uint64_t{1} << 26U, kReadsPerByte = 8;

// Hashes content, as much as the files have bytes for: objects may share bytes a thousandfold.
class ContentHash {
 public:
  explicit ContentHash(const Source& source) : left_(most_bytes(source.byte_count().files)) {}

  // Call it before bytes are made. False from then on, once too many were asked for.
  bool take(const Checked& bytes) {
    exhausted_ = exhausted_ || !left_.take(bytes);
    return !exhausted_;
  }
  static std::string of(std::string_view bytes) {
    const Hash128 hash = secret_hash().of(bytes);
    return fmt::format("{}:{:x}:{:x}", bytes.size(), hash.low, hash.high);
  }
  bool exhausted() const { return exhausted_; }

 private:
  static std::uint64_t most_bytes(const std::vector<FileFacts>& files) {
    std::uint64_t bytes = kLeastBytes / kReadsPerByte;
    for (const FileFacts& file : files) bytes = saturating_add(bytes, file.bytes);
    return checked_mul(bytes, kReadsPerByte).value_or(UINT64_MAX);
  }

  model::MemoryBudget left_;
  bool exhausted_ = false;
};

// The number of bytes in buffer views and files of images that equal earlier ones.
class DuplicateBytes {
 public:
  DuplicateBytes(const Source& source, ContentHash& hash) : source_(source), hash_(hash) {}

  std::uint64_t count() {
    for (const model::BufferView& view : source_.views().buffer_views) {
      if (view.node == json::kNoNode) continue;
      if (const auto stream = model::read_meshopt_view(source_.asset(), view.node)) {
        add(stream->buffer, stream->byte_offset, stream->byte_length);
      } else if (view.buffer) {
        add(*view.buffer, view.byte_offset.value_or(0), view.byte_length.value_or(0));
      }
    }
    add_image_files();
    return twice_;
  }

 private:
  void add(std::uint32_t buffer, std::uint64_t offset, std::uint64_t length) {
    const auto& bytes = source_.resources().buffers[buffer];
    if (!bytes || offset > bytes->size() || length > bytes->size() - offset) return;
    if (!ranges_.emplace(buffer, offset, length).second) return;
    add(bytes->text().substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)));
  }
  void add(std::string_view bytes) {
    if (!hash_.take(Checked(bytes.size()))) return;
    if (!contents_.insert(ContentHash::of(bytes)).second) twice_ += bytes.size();
  }
  void add_image_files() {
    const auto& objects = source_.asset().elements(RootArray::images);
    std::set<std::string> files;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] == json::kNoNode || !source_.resources().images[i].bytes) continue;
      const std::string uri = model::string_member(source_.document(), objects[i], "uri");
      if (uri.empty() || !files.insert(uri).second) continue;
      add(source_.resources().images[i].bytes->text());
    }
  }

  const Source& source_;
  ContentHash& hash_;
  std::set<std::tuple<std::uint32_t, std::uint64_t, std::uint64_t>> ranges_;
  std::set<std::string> contents_;
  std::uint64_t twice_ = 0;
};

// Finds objects that equal earlier ones, from those that refer to nothing to those that refer to
// them. Names do not count.
class DuplicateObjects {
 public:
  DuplicateObjects(const Source& source, ContentHash& hash)
      : source_(source), tree_(source.graph().tree()), hash_(hash), equal_(source.graph()) {
    for (std::uint32_t i = 0; i < source.views().accessors.size(); ++i) {
      accessors_.emplace(source.views().accessors[i].node, i);
    }
  }

  // Each is found once; materials and meshes need what they refer to.
  const Duplicates::Pairs& images() {
    if (!images_) {
      images_ = merge(RootArray::images, {"uri", "bufferView", "mimeType"},
                      [this](NodeId image) { return bytes_of(image); });
    }
    return *images_;
  }
  const Duplicates::Pairs& materials() {
    if (!materials_) {
      images();
      merge(RootArray::samplers, {}, no_content);
      merge(RootArray::textures, {}, no_content);
      materials_ = merge(RootArray::materials, {}, no_content);
    }
    return *materials_;
  }
  const Duplicates::Pairs& accessors() {
    if (!equal_accessors_) {
      equal_accessors_ =
          merge(RootArray::accessors, {"bufferView", "byteOffset", "sparse", "min", "max"},
                [this](NodeId accessor) { return elements_of(accessor); });
    }
    return *equal_accessors_;
  }
  Duplicates::Pairs meshes() {
    materials();
    accessors();
    return merge(RootArray::meshes, {}, no_content);
  }

 private:
  static std::optional<std::string> no_content(NodeId) { return ""; }

  std::optional<std::string> bytes_of(NodeId image) {
    const auto& bytes = source_.resources().images[tree_.position(image)].bytes;
    if (!bytes || !hash_.take(Checked(bytes->size()))) return std::nullopt;
    return ContentHash::of(bytes->text());
  }

  // `stored`: members that say where the content is.
  template <class Hash>
  Duplicates::Pairs merge(RootArray array, std::initializer_list<std::string_view> stored,
                          const Hash& content) {
    graph::ContentGroups groups;
    for (const NodeId element : source_.asset().elements(array)) {
      if (element == json::kNoNode) continue;
      const auto is_left_out = [&](NodeId value) {
        if (tree_.parent(value) != element) return false;
        const std::string_view name = tree_.name(value);
        return name == "name" || std::find(stored.begin(), stored.end(), name) != stored.end();
      };
      std::string description;
      equal_.describe(element, is_left_out, description);
      groups.add(element, std::move(description));
    }
    Duplicates::Pairs pairs = groups.find(content, [](NodeId, NodeId) { return true; });
    for (const auto& [element, first] : pairs) equal_.merge(element, first);
    return pairs;
  }

  std::optional<std::string> elements_of(NodeId object) {
    const auto found = accessors_.find(object);
    if (found == accessors_.end()) return std::nullopt;
    const model::Accessor& accessor = source_.views().accessors[found->second];
    const auto data =
        model::AccessorData::open(source_.asset(), source_.views(), source_.resources(), accessor,
                                  model::Malformed::unusable);
    const std::uint64_t size = model::element_size(accessor.format);
    if (!data || data->implied() || size == 0) return std::nullopt;
    const auto bytes = checked_mul(data->count(), size);
    if (!hash_.take(bytes)) return std::nullopt;
    std::string elements(static_cast<std::size_t>(*bytes), '\0');
    std::uint64_t next = 0;
    data->read(reinterpret_cast<std::byte*>(elements.data()), 0,
               static_cast<std::size_t>(data->count()), next);
    return ContentHash::of(elements);
  }

  const Source& source_;
  const graph::Tree& tree_;
  ContentHash& hash_;
  graph::EqualObjects equal_;
  std::unordered_map<NodeId, std::uint32_t> accessors_;
  std::optional<Duplicates::Pairs> images_, materials_, equal_accessors_;
};

}  // namespace

void take_duplicates(Taking& taking) {
  const Source& source = taking.source();
  ContentHash hash(source);
  const auto set = [&](Name name, const auto& count) {
    Column* column = taking.column(MeasureScope::asset, name);
    if (column == nullptr) return;
    const std::uint64_t value = count();
    if (hash.exhausted()) {
      column->could_not_be_taken(0, "Objects share too many bytes.");
    } else {
      column->set(0, value);
    }
  };
  set(Name::duplicate_bytes, [&] { return DuplicateBytes(source, hash).count(); });
  DuplicateObjects objects(source, hash);
  set(Name::duplicate_images, [&] { return objects.images().size(); });
  set(Name::duplicate_materials, [&] { return objects.materials().size(); });
  set(Name::duplicate_accessors, [&] { return objects.accessors().size(); });
  set(Name::duplicate_meshes, [&] { return objects.meshes().size(); });
}

Duplicates find_duplicates(const Source& source) {
  ContentHash hash(source);
  DuplicateObjects objects(source, hash);
  Duplicates found{objects.images(), objects.materials(), objects.accessors(), objects.meshes()};
  found.complete = !hash.exhausted();
  return found;
}

}  // namespace gltfx::measure
