// SPDX-License-Identifier: Apache-2.0
#include "steps/layout.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/bin_cut.hpp"
#include "change/commit.hpp"
#include "change/companions.hpp"
#include "container/near_files.hpp"
#include "container/uri.hpp"
#include "graph/renumber.hpp"
#include "graph/unknown_indices.hpp"
#include "json/writer.hpp"
#include "model/asset_bytes.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "steps/file_names.hpp"
#include "steps/json_edits.hpp"
#include "steps/new_buffer.hpp"
#include "steps/storage.hpp"
#include "steps/stored_size.hpp"
#include "steps/used_bytes.hpp"

namespace gltfx::steps {
namespace {

using change::BufferUser;
using change::ByteRange;
using container::Bytes;
using model::OpenedAsset;
using model::RootArray;
using model::Storage;
using Trouble = std::optional<Error>;

/// The unfinished content of a buffer of the new asset.
struct NewContent {
  std::vector<Bytes> pieces;
  std::uint64_t size = 0;

  // Returns the new offset of the range.
  std::uint64_t add(const Bytes& bytes, const ByteRange& range) {
    const std::uint64_t begin = aligned_like(range.begin, size);
    if (begin > size) pieces.push_back(Bytes::from_string(std::string(begin - size, '\0')));
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
  Layout(const UsedBytes& before, const OpenedAsset& now, const schema::Set& schemas)
      : before_(before),
        now_(now, schemas),
        asset_(now),
        document_(now.document()),
        elements_(document_),
        bytes_(elements_, now.container(), now.resolver()),
        editor_(document_),
        may_cut_(before_.users && now_.users &&
                 graph::find_unknown_offset(now_.graph) == json::kNoNode) {
    outcome_.removed.assign(count(), false);
    group_buffers();
  }

  Result<change::Change> run(const StepInput& input) {
    if (!now_.users) return now_.users.error();
    choose_home();
    if (auto trouble = find_dangling()) return *trouble;
    choose_removed();
    std::vector<std::uint64_t> changed;
    for (const auto& [first, members] : members_) {
      const bool is_left = std::any_of(members.begin(), members.end(),
                                       [this](std::uint64_t i) { return !outcome_.removed[i]; });
      const bool gets_more = first == outcome_.home && outcome_.home_gets_more;
      if (!is_left || (!gets_more && freed(first).empty())) continue;
      if (auto trouble = fill(first)) return *trouble;
      changed.push_back(first);
    }
    if (auto trouble = renumber()) return *trouble;
    for (const std::uint64_t first : changed) {
      if (auto trouble = store(first, input)) return *trouble;
    }
    change_.edits = editor_.take();
    return std::move(change_);
  }

  std::uint64_t freed_size() {
    std::uint64_t size = 0;
    for (const auto& [first, members] : members_) {
      size += size_of(is_new(first) ? unused(first) : freed(first));
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
    return index >= before_.buffers && NewBuffer::is_own(path_of(buffer(index)));
  }

  // Old buffers with the same file or chunk share its bytes, so their bytes change together.
  void group_buffers() {
    std::map<std::string, unsigned> references;
    for (const auto& [node, path] : change::referred_files(document_)) ++references[path];
    std::map<std::string, std::uint64_t> known;
    std::map<std::uint64_t, std::uint64_t> chunks;
    for (std::uint64_t i = 0; i < count(); ++i) {
      const bool is_file = i < before_.buffers && bytes_.buffer_storage(i) == Storage::file;
      const auto chunk = bytes_.buffer_chunk(i);
      const std::uint64_t first = is_file ? known.emplace(path_of(buffer(i)), i).first->second
                                  : chunk ? chunks.emplace(chunk->offset, i).first->second
                                          : i;
      members_[first].push_back(i);
    }
    for (const auto& [path, first] : known) {
      const auto found = references.find(path);
      if (found != references.end() && found->second > members_[first].size()) fixed_.insert(first);
    }
  }

  // The bytes of old buffers with one file that lost their last user.
  ByteRanges freed(std::uint64_t first) {
    const Storage storage = bytes_.buffer_storage(first);
    if (!may_cut_ || storage == Storage::nowhere || fixed_.contains(first)) return {};
    return without(before_.of(members_.at(first)), now_.of(members_.at(first)));
  }
  // The bytes of a new buffer without users.
  ByteRanges unused(std::uint64_t index) {
    const auto bytes = bytes_.buffer(index);
    return bytes ? without({{0, bytes->size()}}, now_.of({index})) : ByteRanges();
  }

  std::uint64_t declared_length(std::uint64_t index) const {
    return model::unsigned_member(document_, buffer(index), "byteLength").value_or(0);
  }

  // Buffers with users of bytes after their end, which would be new bytes then.
  std::set<std::uint64_t> overrun() const {
    std::set<std::uint64_t> found;
    for (const BufferUser& user : *now_.users) {
      if (user.bytes.end > declared_length(user.buffer)) found.insert(user.buffer);
    }
    return found;
  }

  // Chooses the old buffer that stores new bytes. If none can, the first buffer of a step stays and
  // gets a file.
  void choose_home() {
    for (std::uint64_t i = count(); i > before_.buffers; --i) {
      if (!is_new(i - 1)) continue;
      outcome_.home_gets_more = true;
      outcome_.home = i - 1;
    }
    const std::set<std::uint64_t> overrun = this->overrun();
    for (const auto& [first, members] : members_) {
      if (first >= before_.buffers || buffer(first) == json::kNoNode) continue;
      if (fixed_.contains(first) || bytes_.buffer_storage(first) == Storage::nowhere) continue;
      const auto bytes = bytes_.buffer(first);
      const bool is_whole =
          bytes && std::all_of(members.begin(), members.end(), [&](std::uint64_t i) {
            return !overrun.contains(i) && declared_length(i) <= bytes->size();
          });
      if (!is_whole) continue;
      outcome_.home = first;
      return;
    }
  }

  // A reference to a missing buffer would lead to the buffer that a step added.
  Trouble find_dangling() const {
    if (!outcome_.home_gets_more) return std::nullopt;
    for (const graph::IndexUse& use : before_.graph.indices()) {
      if (use.array != "/buffers" || use.index < before_.buffers || use.index >= count()) continue;
      return Error{fmt::format("{} refers to a buffer that does not exist (see 'gltfx fix')",
                               printable(before_.graph.tree().pointer(use.at)))};
    }
    return std::nullopt;
  }

  // Chooses the buffers of steps, and buffers that lost their last use if no unknown index would
  // change.
  void choose_removed() {
    const bool certain = graph::find_unknown_with_integer(now_.graph) == json::kNoNode;
    bool is_last = true;  // all buffers after it are removed
    for (std::uint64_t i = count(); i > 0; --i) {
      const std::uint64_t index = i - 1;
      outcome_.removed[index] =
          (is_new(index) && index != outcome_.home) || ((certain || is_last) && is_left(index));
      is_last = is_last && outcome_.removed[index];
    }
  }
  bool is_left(std::uint64_t index) const {
    const json::NodeId object = buffer(index);
    if (index >= before_.buffers || object == json::kNoNode) return false;
    if (index == outcome_.home && outcome_.home_gets_more) return false;
    if (before_.of({index}).empty() || !may_cut_) return false;
    if (!now_.graph.users(object).empty()) return false;
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (name != "uri" && name != "chunk" && name != "byteLength" && name != "extensions") {
        return false;
      }
    }
    return true;
  }

  // Collects the bytes of the buffers with one file.
  Trouble fill(std::uint64_t first) {
    NewContent& content = outcome_.contents[first];
    if (!is_new(first)) {
      const auto bytes = bytes_.buffer(first);
      if (!bytes) return bytes.error();
      std::uint64_t length = bytes->size();
      if (bytes_.buffer_storage(first) == Storage::bin_chunk && members_.at(first).size() == 1) {
        const auto declared = model::unsigned_member(document_, buffer(first), "byteLength");
        length = chunk_data_length(declared.value_or(length), length);
      }
      for (const ByteRange& range : without({{0, length}}, freed(first))) {
        const std::uint64_t to = content.add(*bytes, range);
        for (const std::uint64_t i : members_.at(first)) outcome_.moved[i].push_back({range, to});
      }
    }
    for (std::uint64_t i = before_.buffers; first == outcome_.home && i < count(); ++i) {
      if (!is_new(i)) continue;
      const auto made = bytes_.buffer(i);
      if (!made) return made.error();
      for (const ByteRange& range : now_.of({i})) {
        if (range.end > made->size()) return Error{"an object refers to bytes that no buffer has"};
        outcome_.moved[i].push_back({range, content.add(*made, range)});
      }
    }
    return std::nullopt;
  }

  // Updates the offsets of all users and removes buffers.
  Trouble renumber() {
    for (const BufferUser& user : *now_.users) move(user);
    std::vector<std::uint64_t> position(count());
    std::uint64_t next = 0;
    for (std::uint64_t i = 0; i < count(); ++i) position[i] = outcome_.removed[i] ? 0 : next++;
    for (std::uint64_t i = 0; i < count(); ++i) {
      if (is_new(i)) position[i] = position[outcome_.home];
    }
    const json::NodeId list = document_.find(document_.root(), "buffers");
    std::set<json::NodeId> removed;
    for (std::uint64_t i = 0; i < count(); ++i) {
      if (!outcome_.removed[i]) continue;
      editor_.remove(list, buffer(i));
      removed.insert(buffer(i));
    }
    if (next == 0 && count() > 0) editor_.remove(document_.root(), list - 1);
    if (removed.empty()) return std::nullopt;
    auto dropped = change::drop_bins(
        now_.graph, asset_.container(),
        [&](json::NodeId object) { return removed.contains(object); }, editor_);
    if (!dropped) return dropped.error();
    change_.bins = *std::move(dropped);
    auto edits = graph::renumber(
        now_.graph,
        [&](json::NodeId array, std::uint64_t index) {
          return array == list ? position[index] : index;
        },
        [](graph::Place) { return false; });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
    return std::nullopt;
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

  Trouble store(std::uint64_t first, const StepInput& input) {
    NewContent& content = outcome_.contents[first];
    for (const std::uint64_t i : members_.at(first)) {
      if (!outcome_.removed[i])
        set_number(document_, editor_, buffer(i), "byteLength", content.size);
    }
    if (is_new(first)) {
      store_new_file(first, asset_stem(input), ".bin",
                     Bytes::from_string(container::join(content.pieces)), input);
      return std::nullopt;
    }
    switch (bytes_.buffer_storage(first)) {
      case Storage::bin_chunk:
        change_.bins[model::position_of(asset_.container(), *bytes_.buffer_chunk(first))].whole =
            std::move(content.pieces);
        return std::nullopt;
      case Storage::data_uri: {
        const json::NodeId uri = document_.find(buffer(first), "uri");
        auto text = change::with_data(document_.string(uri), container::join(content.pieces));
        if (!text) return text.error();
        editor_.replace_scalar(uri, json::string_value(*text));
        return std::nullopt;
      }
      default:
        return store_file(first, content.pieces, input);
    }
  }

  Trouble store_file(std::uint64_t first, const std::vector<Bytes>& pieces,
                     const StepInput& input) {
    const auto uri = container::classify_uri(model::string_member(document_, buffer(first), "uri"));
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
    } else {
      store_new_file(first, stem_in_folder(uri.path), ending_of(uri.path), std::move(bytes), input);
    }
    return std::nullopt;
  }

  void store_new_file(std::uint64_t first, const std::string& stem, const std::string& ending,
                      Bytes bytes, const StepInput& input) {
    FileNames names(taken_names(input));
    std::string path = names.take(stem + content_mark({bytes}), ending);
    for (const std::uint64_t i : members_.at(first)) {
      if (outcome_.removed[i]) continue;
      editor_.replace_scalar(document_.find(buffer(i), "uri"),
                             json::string_value(container::uri_of_path(path)));
    }
    change_.files.push_back({std::move(path), {std::move(bytes)}});
  }

  const UsedBytes& before_;
  const UsedBytes now_;
  const OpenedAsset& asset_;
  const json::Document& document_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  json::Editor editor_;
  const bool may_cut_;
  std::map<std::uint64_t, std::vector<std::uint64_t>>
      members_;                    ///< buffers with one file, by first
  std::set<std::uint64_t> fixed_;  ///< first buffers of files that other objects also refer to
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

Result<change::Change> lay_out(const UsedBytes& before, const StepInput& now) {
  return Layout(before, now.asset, now.schemas).run(now);
}

std::uint64_t laid_out_size(const UsedBytes& before, const OpenedAsset& now,
                            const schema::Set& schemas) {
  const std::uint64_t size = stored_size(now);
  return size - std::min(size, Layout(before, now, schemas).freed_size());
}

}  // namespace gltfx::steps
