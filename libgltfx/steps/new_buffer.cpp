// SPDX-License-Identifier: Apache-2.0
#include "steps/new_buffer.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "change/companions.hpp"
#include "model/asset.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;

// The resolver has the bytes of files with this prefix and does not search the disk for them.
constexpr std::string_view kPrefix = "gltfx-new-bytes-";

}  // namespace

NewBuffer::NewBuffer(const model::OpenedAsset& asset)
    : index_(model::Asset(asset.document()).count(model::RootArray::buffers)) {
  std::set<std::string> taken = change::referred_paths(asset.document());
  path_ = own_path(taken, index_);
}

std::string NewBuffer::own_path(std::set<std::string>& taken, std::uint64_t number) {
  std::string path;
  do path = fmt::format("{}{}.bin", kPrefix, number++);
  while (!taken.insert(path).second);
  return path;
}

std::uint64_t NewBuffer::add(Bytes bytes) {
  const std::uint64_t begin = aligned(size_);
  if (begin > size_) pieces_.push_back(Bytes::from_string(std::string(begin - size_, '\0')));
  size_ = begin + bytes.size();
  pieces_.push_back(std::move(bytes));
  return begin;
}

std::uint64_t NewBuffer::add(std::string bytes) {
  return add(Bytes::from_string(std::move(bytes)));
}

void NewBuffer::add_to(change::Change& change) {
  if (empty()) return;
  change.additions.add_element("buffers",
                               fmt::format(R"({{"byteLength":{},"uri":"{}"}})", size_, path_));
  change.files.push_back({path_, std::move(pieces_)});
  pieces_.clear();
}

bool NewBuffer::is_own(const std::string& path) { return path.starts_with(kPrefix); }

}  // namespace gltfx::steps
