// SPDX-License-Identifier: Apache-2.0
// The files of an asset and their bytes.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "measure/take.hpp"
#include "model/fields.hpp"

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
}

}  // namespace gltfx::measure
