// SPDX-License-Identifier: Apache-2.0
#include "rules/files_read.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "model/fields.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

using change::ByteRead;
using model::RootArray;

// Elements of the accessor, or the whole view if they are unknown.
ByteRead read_by(const model::Accessor& accessor, const model::BufferView& view) {
  const std::uint64_t begin = view.byte_offset.value_or(0);
  const std::uint64_t size = model::element_size(accessor.format);
  if (!accessor.count || size == 0) {
    return {begin, view.byte_length.value_or(UINT64_MAX), 0, 1};
  }
  const std::uint64_t stride = view.byte_stride.value_or(model::packed_stride(accessor.format));
  return {saturating_add(begin, accessor.byte_offset.value_or(0)), size, stride, *accessor.count};
}

}  // namespace

FilesRead::FilesRead(Fixing& fixing) : reads_(fixing.elements().count(RootArray::buffers)) {
  find_files(fixing);
  find_reads(fixing);
}

void FilesRead::find_files(Fixing& fixing) {
  std::map<json::NodeId, std::uint32_t> buffers;  // by the value that names their file
  std::uint32_t index = 0;
  for (const json::NodeId buffer : fixing.elements().elements(RootArray::buffers)) {
    if (buffer != json::kNoNode) buffers.emplace(fixing.document().find(buffer, "uri"), index);
    ++index;
  }
  for (const auto& [value, path] : change::referred_files(fixing.document())) {
    const container::Resolved file = fixing.opened().resolver().open(path);
    if (file.error != container::ResolveError::none) continue;
    FileRead& read = files_[identity_of(file.state, path)];
    read.paths.insert(path);
    const auto buffer = buffers.find(value);
    if (buffer == buffers.end()) {
      read.otherwise = true;
    } else {
      read.buffers.push_back(buffer->second);
    }
  }
  if (!fixing.opened().resolver().looks_on_disk()) return;
  const auto own = file_state(fixing.opened().name());
  const auto itself = own ? files_.find(identity_of(*own, {})) : files_.end();
  if (itself != files_.end()) itself->second.otherwise = true;
}

void FilesRead::find_reads(Fixing& fixing) {
  const Users& users = fixing.table<Users>();
  std::vector<std::size_t> mentions;
  for (const json::NodeId buffer : fixing.elements().elements(RootArray::buffers)) {
    mentions.push_back(fixing.graph().users(buffer).size());
  }
  const model::Views& views = fixing.views();
  for (std::uint32_t i = 0; i < views.buffer_views.size(); ++i) {
    const model::BufferView& view = views.buffer_views[i];
    if (!view.buffer) continue;
    change::FileReads& reads = reads_[*view.buffer];
    --mentions[*view.buffer];
    const bool whole = users.has_others(i) || !users.sparse_parts_in(i).empty() ||
                       views.usage.view(i).has(model::ViewUse::image);
    if (whole) {
      const std::uint64_t begin = view.byte_offset.value_or(0);
      reads.parts.push_back({begin, view.byte_length.value_or(UINT64_MAX), 0, 1});
    }
    for (const std::uint32_t accessor : users.accessors_in(i)) {
      reads.parts.push_back(read_by(views.accessors[accessor], view));
    }
  }
  // Objects other than buffer views may refer to a buffer, including objects of unknown extensions.
  const bool unknown = !fixing.graph().unknown_extensions().empty();
  for (std::size_t i = 0; i < reads_.size(); ++i) {
    reads_[i].all = unknown || mentions[i] != 0;
  }
}

change::FileReads FilesRead::reads_of(const FileRead& file) const {
  change::FileReads reads;
  reads.all = file.otherwise;
  for (const std::uint32_t buffer : file.buffers) reads.add(reads_[buffer]);
  return reads;
}

namespace {

std::optional<Error> unite(Fixing& fixing, const FileRead& file, change::BufferContents& contents) {
  const auto changed = std::find_if(file.buffers.begin(), file.buffers.end(),
                                    [&](std::uint32_t i) { return contents.contains(i); });
  if (changed == file.buffers.end()) return std::nullopt;
  const std::string name = quoted(*file.paths.begin(), 200);
  if (file.otherwise) {
    return Error{fmt::format("{} is not only a buffer: something else reads its bytes, too", name)};
  }
  if (file.buffers.size() == 1) return std::nullopt;
  const auto& resources = fixing.resources().buffers;
  const std::string_view before = resources[*changed]->text();
  const FilesRead& read = fixing.table<FilesRead>();
  std::vector<change::FileUser> users;
  for (const std::uint32_t buffer : file.buffers) {
    const auto content = contents.find(buffer);
    users.push_back({content == contents.end() ? before : std::string_view(content->second),
                     read.reads_of(buffer)});
  }
  change::MergedFile merged = change::merge_changes(before, users);
  if (!merged.conflicts.empty()) {
    return Error{fmt::format("buffer {} reads the same bytes of {} as something else",
                             file.buffers[merged.conflicts.front().user], name)};
  }
  for (const std::uint32_t buffer : file.buffers) contents.erase(buffer);
  contents.emplace(*changed, std::move(merged.content));
  return std::nullopt;
}

}  // namespace

std::optional<Error> unite_buffers(Fixing& fixing, change::BufferContents& contents) {
  if (contents.empty()) return std::nullopt;
  for (const auto& [identity, file] : fixing.table<FilesRead>().files()) {
    if (auto error = unite(fixing, file, contents)) return error;
  }
  return std::nullopt;
}

void add_other_names(Fixing& fixing, std::vector<change::ReplacedFile>& files) {
  const std::size_t count = files.size();
  for (std::size_t i = 0; i < count; ++i) {
    const change::ReplacedFile file = files[i];
    const auto& known = fixing.table<FilesRead>().files();
    const auto found = known.find(identity_of(file.state, file.path));
    if (found == known.end()) continue;
    for (const std::string& path : found->second.paths) {
      if (path != file.path) files.push_back({path, file.state, file.before, file.after});
    }
  }
}

}  // namespace gltfx::validate
