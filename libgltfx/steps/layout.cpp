// SPDX-License-Identifier: Apache-2.0
#include "steps/layout.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "change/buffer_layout.hpp"
#include "change/commit.hpp"
#include "change/companions.hpp"
#include "change/shared_bytes.hpp"
#include "container/base64.hpp"
#include "container/near_files.hpp"
#include "container/uri.hpp"
#include "graph/renumber.hpp"
#include "graph/unknown_indices.hpp"
#include "json/writer.hpp"
#include "model/asset_bytes.hpp"
#include "model/fields.hpp"
#include "steps/file_names.hpp"
#include "steps/geometry_input.hpp"
#include "steps/new_buffer.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using change::BufferUser;
using change::ByteRange;
using container::Bytes;
using model::OpenedAsset;
using model::RootArray;
using model::Storage;
using Ranges = std::vector<ByteRange>;
using Trouble = std::optional<Error>;

// The parts of `ranges` that are not in `taken`. Both are sorted and have no overlaps.
Ranges without(const Ranges& ranges, const Ranges& taken) {
  Ranges left;
  auto next = taken.begin();
  for (ByteRange range : ranges) {
    while (next != taken.end() && next->end <= range.begin) ++next;
    for (auto at = next; at != taken.end() && at->begin < range.end; ++at) {
      if (at->begin > range.begin) left.push_back({range.begin, at->begin});
      range.begin = std::min(at->end, range.end);
    }
    if (range.begin < range.end) left.push_back(range);
  }
  return left;
}

std::uint64_t size_of(const Ranges& ranges) {
  std::uint64_t size = 0;
  for (const ByteRange& range : ranges) size += range.end - range.begin;
  return size;
}

/// The bytes of all buffers of an asset that have users.
class Named {
 public:
  Named(const OpenedAsset& asset, const schema::Set& schemas)
      : graph(asset.document(), schemas), users(change::buffer_users(graph)) {
    if (!users) return;
    for (const BufferUser& user : *users) ranges_[user.buffer].push_back(user.bytes);
    for (auto& [buffer, ranges] : ranges_) change::add_ranges(ranges, {});
  }
  const Ranges& of(std::uint64_t buffer) const {
    const auto found = ranges_.find(buffer);
    return found == ranges_.end() ? none_ : found->second;
  }

  const graph::Graph graph;
  const Result<std::vector<BufferUser>> users;

 private:
  std::map<std::uint64_t, Ranges> ranges_;  ///< by buffer
  const Ranges none_;
};

/// The unfinished content of a buffer of the new asset.
struct NewContent {
  std::vector<Bytes> pieces;
  std::uint64_t size = 0;

  // Returns the new offset of the range.
  std::uint64_t add(const Bytes& bytes, const ByteRange& range) {
    const std::uint64_t gap =
        (range.begin % kAlignment + kAlignment - size % kAlignment) % kAlignment;
    if (gap > 0) pieces.push_back(Bytes::from_string(std::string(gap, '\0')));
    const std::uint64_t begin = size + gap;
    pieces.push_back(bytes.part(range.begin, range.end - range.begin));
    size = begin + range.end - range.begin;
    return begin;
  }
};

/// A range of bytes after the steps, and its new offset.
struct Moved {
  ByteRange from;
  std::uint64_t to;
};

class Layout {
 public:
  Layout(const OpenedAsset& before, const OpenedAsset& now, const schema::Set& schemas)
      : old_count_(model::Asset(before.document()).count(RootArray::buffers)),
        before_(before, schemas),
        now_(now, schemas),
        asset_(now),
        document_(now.document()),
        elements_(document_),
        bytes_(elements_, now.container(), now.resolver()),
        editor_(document_),
        may_cut_(before_.users && now_.users &&
                 graph::find_unknown_offset(now_.graph) == json::kNoNode) {}

  Result<change::Change> run(const StepInput& input) {
    if (!now_.users) return now_.users.error();
    list_files();
    if (auto trouble = choose_home()) return *trouble;
    choose_removed();
    std::vector<std::uint64_t> changed;
    for (std::uint64_t i = 0; i < old_count_; ++i) {
      if (outcome_.removed[i]) continue;
      if (i != outcome_.home && freed(i).empty()) continue;
      if (i == outcome_.home && freed(i).empty() && !outcome_.home_gets_more) continue;
      if (auto trouble = fill(i)) return *trouble;
      changed.push_back(i);
    }
    renumber();
    for (const std::uint64_t i : changed) {
      if (auto trouble = store(i, input)) return *trouble;
    }
    change_.edits = editor_.take();
    return std::move(change_);
  }

  std::uint64_t freed_size() {
    std::uint64_t size = 0;
    list_files();
    for (std::uint64_t i = 0; i < count(); ++i) {
      size += size_of(i < old_count_ ? freed(i) : unnamed(i));
    }
    return size;
  }

 private:
  std::uint64_t count() const { return elements_.count(RootArray::buffers); }
  json::NodeId buffer(std::uint64_t index) const {
    return elements_.elements(RootArray::buffers)[index];
  }
  std::string path_of(json::NodeId object) const {
    return container::classify_uri(model::string_member(document_, object, "uri")).path;
  }
  bool is_new(std::uint64_t index) const {
    return index >= old_count_ && NewBuffer::is_own(path_of(buffer(index)));
  }

  // Counts the references to each file.
  void list_files() {
    for (const auto& [node, path] : change::referred_files(document_)) ++files_[path];
    outcome_.removed.assign(count(), false);
  }
  bool is_shared(std::uint64_t index) const {
    const auto found = files_.find(path_of(buffer(index)));
    return found != files_.end() && found->second > 1;
  }

  // The bytes of an old buffer that lost their last user.
  Ranges freed(std::uint64_t index) {
    const Storage storage = bytes_.buffer_storage(index);
    if (!may_cut_ || storage == Storage::nowhere || is_shared(index)) return {};
    return without(before_.of(index), now_.of(index));
  }
  Ranges unnamed(std::uint64_t index) {
    if (!is_new(index)) return {};
    const auto bytes = bytes_.buffer(index);
    return bytes ? without({{0, bytes->size()}}, now_.of(index)) : Ranges();
  }

  // Otherwise new bytes would follow inside the declared length, where views may refer to them.
  bool has_declared_bytes(std::uint64_t index) {
    const auto bytes = bytes_.buffer(index);
    return bytes && model::unsigned_member(document_, buffer(index), "byteLength").value_or(0) <=
                        bytes->size();
  }

  Trouble choose_home() {
    for (std::uint64_t i = old_count_; i < count(); ++i)
      outcome_.home_gets_more = outcome_.home_gets_more || is_new(i);
    for (std::uint64_t i = 0; i < old_count_; ++i) {
      if (buffer(i) == json::kNoNode || is_shared(i)) continue;
      if (bytes_.buffer_storage(i) == Storage::nowhere || !has_declared_bytes(i)) continue;
      outcome_.home = i;
      return std::nullopt;
    }
    if (!outcome_.home_gets_more) return std::nullopt;
    return Error{"no buffer of the asset can store new bytes"};
  }

  // Chooses the buffers of steps, and buffers that lost their last use if no unknown index would
  // change.
  void choose_removed() {
    const bool certain = graph::find_unknown_with_integer(now_.graph) == json::kNoNode;
    for (std::uint64_t i = count(); i > 0; --i) {
      const std::uint64_t index = i - 1;
      const bool is_last =
          std::all_of(outcome_.removed.begin() + static_cast<std::ptrdiff_t>(i),
                      outcome_.removed.end(), [](bool removed) { return removed; });
      outcome_.removed[index] = is_new(index) || ((certain || is_last) && is_left(index));
    }
  }
  bool is_left(std::uint64_t index) const {
    const json::NodeId object = buffer(index);
    if (index >= old_count_ || object == json::kNoNode) return false;
    if (index == outcome_.home && outcome_.home_gets_more) return false;
    if (before_.of(index).empty() || !may_cut_ || is_shared(index)) return false;
    if (!now_.graph.users(object).empty()) return false;
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (name != "uri" && name != "byteLength" && name != "extensions") return false;
    }
    return true;
  }

  Trouble fill(std::uint64_t index) {
    const auto bytes = bytes_.buffer(index);
    if (!bytes) return bytes.error();
    const auto declared =
        model::unsigned_member(document_, buffer(index), "byteLength").value_or(bytes->size());
    const std::uint64_t length = bytes_.buffer_storage(index) == Storage::bin_chunk
                                     ? chunk_data_length(declared, bytes->size())
                                     : bytes->size();
    NewContent& content = outcome_.contents[index];
    for (const ByteRange& range : without({{0, length}}, freed(index))) {
      outcome_.moved[index].push_back({range, content.add(*bytes, range)});
    }
    for (std::uint64_t i = old_count_; index == outcome_.home && i < count(); ++i) {
      if (!is_new(i)) continue;
      const auto made = bytes_.buffer(i);
      if (!made) return made.error();
      for (const ByteRange& range : now_.of(i)) {
        if (range.end > made->size()) return Error{"an object refers to bytes that no buffer has"};
        outcome_.moved[i].push_back({range, content.add(*made, range)});
      }
    }
    return std::nullopt;
  }

  // Updates the offsets of all users and removes buffers.
  void renumber() {
    for (const BufferUser& user : *now_.users) move(user);
    std::vector<std::uint64_t> position(count());
    std::uint64_t next = 0;
    for (std::uint64_t i = 0; i < count(); ++i) position[i] = outcome_.removed[i] ? 0 : next++;
    for (std::uint64_t i = 0; i < count(); ++i) {
      if (is_new(i)) position[i] = position[outcome_.home];
    }
    const json::NodeId list = document_.find(document_.root(), "buffers");
    for (std::uint64_t i = 0; i < count(); ++i) {
      if (!outcome_.removed[i]) continue;
      editor_.remove(list, buffer(i));
      if (bytes_.buffer_storage(i) == Storage::bin_chunk) change_.bin.drop = true;
    }
    if (next == 0 && count() > 0) editor_.remove(document_.root(), list - 1);
    if (next == count()) return;
    auto edits = graph::renumber(
        now_.graph,
        [&](json::NodeId array, std::uint64_t index) {
          return array == list ? position[index] : index;
        },
        [](graph::Place) { return false; });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
  }

  void move(const BufferUser& user) {
    const auto found = outcome_.moved.find(user.buffer);
    if (found == outcome_.moved.end()) return;
    const auto after = std::upper_bound(
        found->second.begin(), found->second.end(), user.bytes.begin,
        [](std::uint64_t begin, const Moved& part) { return begin < part.from.begin; });
    if (after == found->second.begin()) return;
    const Moved& part = *std::prev(after);
    change::move_user(document_, user, part.to + user.bytes.begin - part.from.begin, editor_);
  }

  Trouble store(std::uint64_t index, const StepInput& input) {
    NewContent& content = outcome_.contents[index];
    const json::NodeId object = buffer(index);
    set_number(document_, editor_, object, "byteLength", content.size);
    const json::NodeId uri = document_.find(object, "uri");
    switch (bytes_.buffer_storage(index)) {
      case Storage::bin_chunk:
        change_.bin.whole = std::move(content.pieces);
        return std::nullopt;
      case Storage::data_uri:
        editor_.replace_scalar(
            uri, json::string_value(container::data_uri("application/octet-stream",
                                                        container::join(content.pieces))));
        return std::nullopt;
      default:
        return store_file(index, content.pieces, input);
    }
  }

  Trouble store_file(std::uint64_t index, const std::vector<Bytes>& pieces,
                     const StepInput& input) {
    const json::NodeId member = document_.find(buffer(index), "uri");
    const auto uri = container::classify_uri(document_.string(member));
    container::Resolved file = asset_.resolver().open(uri);
    if (file.error != container::ResolveError::none)
      return Error{"the bytes of a buffer are missing"};
    std::error_code error;
    const auto folder = asset_.resolver().looks_on_disk()
                            ? std::filesystem::temp_directory_path(error)
                            : std::filesystem::path();
    Bytes bytes = container::gathered(pieces, folder);
    if (change::is_in_place(input.options, asset_.name()) || keeps_file_names(input)) {
      change_.replaced.push_back({uri.path, file.state, std::move(file.bytes), std::move(bytes)});
      return std::nullopt;
    }
    FileNames names(taken_names(input));
    std::string path =
        names.take(stem_in_folder(uri.path) + content_mark({bytes}), ending_of(uri.path));
    editor_.replace_scalar(member, json::string_value(container::uri_of_path(path)));
    change_.files.push_back({std::move(path), {std::move(bytes)}});
    return std::nullopt;
  }

  const std::uint64_t old_count_;
  const Named before_, now_;
  const OpenedAsset& asset_;
  const json::Document& document_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  json::Editor editor_;
  const bool may_cut_;
  std::map<std::string, unsigned> files_;
  /// The outcome for buffers, by index.
  struct {
    std::uint64_t home = UINT64_MAX;  ///< buffer for new bytes
    bool home_gets_more = false;
    std::vector<bool> removed;
    std::map<std::uint64_t, NewContent> contents;
    std::map<std::uint64_t, std::vector<Moved>> moved;  ///< by old buffer, sorted
  } outcome_;
  change::Change change_;
};

}  // namespace

Result<change::Change> lay_out(const OpenedAsset& before, const StepInput& now) {
  return Layout(before, now.asset, now.schemas).run(now);
}

std::uint64_t laid_out_size(const OpenedAsset& before, const OpenedAsset& now,
                            const schema::Set& schemas) {
  const std::uint64_t size = stored_size(now);
  return size - std::min(size, Layout(before, now, schemas).freed_size());
}

std::uint64_t stored_size(const OpenedAsset& asset) {
  const container::Container& container = asset.container();
  std::uint64_t bytes = container.json ? container.json->size() : 0;
  if (container.format == container::Format::glb) {
    constexpr std::uint64_t kHeader = 12, kChunkHeader = 8, kWord = 4;
    bytes = kHeader + kChunkHeader + (bytes + kWord - 1) / kWord * kWord;
    for (std::size_t i = 1; i < container.chunks.size(); ++i) {
      bytes += kChunkHeader + container.chunks[i].length;
    }
  }
  for (const std::string& path : change::referred_paths(asset.document())) {
    std::uint64_t size = 0;
    if (asset.resolver().stat(path, size) == container::ResolveError::none) bytes += size;
  }
  return bytes;
}

}  // namespace gltfx::steps
