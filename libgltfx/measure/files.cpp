// SPDX-License-Identifier: Apache-2.0
// The files of an asset and their bytes.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "base/hash.hpp"
#include "base/random_bytes.hpp"
#include "measure/take.hpp"
#include "model/fields.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx::measure {
namespace {

using model::RootArray;

std::string file_name(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

// The names of a root array of strings, sorted.
std::vector<std::string> names_in(const std::vector<std::string>& list) {
  std::vector<std::string> names = list;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Finds equal stretches of bytes that are stored more than once.
class DuplicateBytes {
 public:
  explicit DuplicateBytes(const Source& source) : source_(source), hash_(secret()) {}

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
  static KeyedHash::Secret secret() {
    KeyedHash::Secret bytes{};
    fill_with_random(bytes);
    return bytes;
  }

  void add(std::uint32_t buffer, std::uint64_t offset, std::uint64_t length) {
    const auto& bytes = source_.resources().buffers[buffer];
    if (!bytes || offset > bytes->size() || length > bytes->size() - offset) return;
    if (!seen_.emplace(buffer, offset, length).second) return;
    // Ranges may overlap a thousandfold.
    read_ = saturating_add(read_, length);
    if (read_ > kReadsPerByte * std::max<std::uint64_t>(bytes->size(), 1U << 20U)) return;
    add(bytes->text().substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)));
  }
  void add(std::string_view bytes) {
    const Hash128 hash = hash_.of(bytes);
    if (!contents_.emplace(bytes.size(), hash.low, hash.high).second) twice_ += bytes.size();
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

  static constexpr std::uint64_t kReadsPerByte = 16;
  const Source& source_;
  KeyedHash hash_;
  std::set<std::tuple<std::uint32_t, std::uint64_t, std::uint64_t>> seen_;
  std::set<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>> contents_;
  std::uint64_t read_ = 0, twice_ = 0;
};

// A file that the asset refers to and that cannot be read; empty: there is none.
std::string unread_file(const Source& source) {
  const auto look = [&](RootArray array, std::string_view what, const auto& has_bytes) {
    const auto& objects = source.asset().elements(array);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] == json::kNoNode || has_bytes(i)) continue;
      if (source.document().find(objects[i], "uri") == json::kNoNode) continue;
      return "The file of " + std::string(what) + " " + std::to_string(i) + " could not be read.";
    }
    return std::string();
  };
  const model::ResourceData& data = source.resources();
  std::string missing = look(RootArray::buffers, "buffer",
                             [&](std::size_t i) { return data.buffers[i].has_value(); });
  if (!missing.empty()) return missing;
  return look(RootArray::images, "image",
              [&](std::size_t i) { return data.images[i].bytes.has_value(); });
}

// Sets the measures of the asset.
class AssetColumns {
 public:
  explicit AssetColumns(Taking& taking) : taking_(taking) {}

  template <class Value>
  void set(Name name, const Value& value) {
    if (Column* column = taking_.column(MeasureScope::asset, name)) column->set(0, value());
  }
  // The same, or null if a file is missing.
  template <class Value>
  void set_if_read(Name name, const std::string& missing, const Value& value) {
    Column* column = taking_.column(MeasureScope::asset, name);
    if (column == nullptr) return;
    if (!missing.empty()) return column->could_not_be_taken(0, missing);
    column->set(0, value());
  }

 private:
  Taking& taking_;
};

std::uint64_t sum_of_sizes(const std::vector<FileFacts>& files) {
  std::uint64_t sum = 0;
  for (const FileFacts& file : files) sum = saturating_add(sum, file.bytes);
  return sum;
}

std::uint64_t largest_size(const std::vector<FileFacts>& files) {
  std::uint64_t largest = 0;
  for (const FileFacts& file : files) largest = std::max(largest, file.bytes);
  return largest;
}

}  // namespace

void take_files(Taking& taking) {
  const Source& source = taking.source();
  AssetColumns columns(taking);
  const json::Document& document = source.document();
  const json::NodeId header = model::object_member(document, document.root(), "asset");
  const auto text = [](std::string value) { return MeasureValue(std::move(value)); };
  const auto member = [&](const char* name) {
    return [&, name] { return text(model::string_member(document, header, name)); };
  };
  columns.set(Name::generator, member("generator"));
  columns.set(Name::version, member("version"));
  columns.set(Name::file_name, [&] { return text(file_name(source.name())); });
  columns.set(Name::container, [&] {
    const bool glb = source.container().format == container::Format::glb;
    return text(glb ? "glb" : "gltf");
  });
  columns.set(Name::extensions,
              [&] { return MeasureValue(names_in(source.graph().checked().extensions_used)); });
  columns.set(Name::required_extensions,
              [&] { return MeasureValue(names_in(source.graph().checked().extensions_required)); });

  const std::string missing = unread_file(source);
  const auto files = [&]() -> const std::vector<FileFacts>& { return source.byte_count().files; };
  columns.set_if_read(Name::file_size, missing, [&] { return sum_of_sizes(files()); });
  columns.set_if_read(Name::largest_file, missing, [&] { return largest_size(files()); });
  columns.set_if_read(Name::files, missing, [&] { return std::uint64_t{files().size()}; });
  columns.set_if_read(Name::embedded, missing, [&] { return MeasureValue(files().size() == 1); });
  columns.set_if_read(Name::unused_bytes, missing, [&] {
    return source.byte_count().shares[static_cast<std::size_t>(ByteUse::unused)];
  });
  columns.set_if_read(Name::duplicate_bytes, missing,
                      [&] { return DuplicateBytes(source).count(); });
}

}  // namespace gltfx::measure
