// SPDX-License-Identifier: Apache-2.0
#include "git_tree.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/container.hpp"
#include "container/content.hpp"

namespace gltfx::tool {
namespace {

// Files of a commit are held in memory.
constexpr std::uint64_t kLargestBlob = std::uint64_t{1} << 30U;

// The components of a path, the first one last.
void push_components(std::string_view path, std::vector<std::string>& stack) {
  while (!path.empty()) {
    const std::size_t slash = path.rfind('/');
    const std::size_t begin = slash == std::string_view::npos ? 0 : slash + 1;
    stack.emplace_back(path.substr(begin));
    path = slash == std::string_view::npos ? std::string_view() : path.substr(0, slash);
  }
}

std::optional<std::string> read_line(GitProcess& git) {
  constexpr std::size_t kLongest = 4096;
  std::string line;
  char byte = 0;
  while (line.size() < kLongest && git.read(&byte, 1) == 1) {
    if (byte == '\n') return line;
    line += byte;
  }
  return std::nullopt;
}

// Reads `size` bytes, and keeps them unless they are too many. False: the output has ended.
bool read_bytes(GitProcess& git, std::uint64_t size, std::string& bytes) {
  constexpr std::uint64_t kStep = std::uint64_t{1} << 20U;
  const bool kept = size <= kLargestBlob;
  std::string dropped;
  for (std::uint64_t done = 0; done < size;) {
    const auto step = static_cast<std::size_t>(std::min(kStep, size - done));
    std::string& to = kept ? bytes : dropped;
    const std::size_t before = kept ? to.size() : 0;
    to.resize(before + step);
    const std::size_t got = git.read(to.data() + before, step);
    to.resize(before + got);
    if (got == 0) return false;
    done += got;
  }
  return true;
}

bool is_pointer(const std::string& bytes) {
  return container::is_git_lfs_pointer(bytes, bytes.size());
}

}  // namespace

std::optional<RepositoryName> GitTree::follow(const RepositoryName& name) {
  constexpr int kMostLinks = 40;
  constexpr std::size_t kMostComponents = 10'000;
  std::vector<std::string> left;
  push_components(name, left);
  RepositoryName place;
  for (int links = 0; !left.empty();) {
    const std::string part = std::move(left.back());
    left.pop_back();
    if (part.empty() || part == ".") continue;
    if (part == "..") {
      if (place.empty()) return std::nullopt;
      const std::size_t slash = place.rfind('/');
      place.resize(slash == std::string::npos ? 0 : slash);
      continue;
    }
    RepositoryName whole = place.empty() ? part : fmt::format("{}/{}", place, part);
    const auto entry = index_.entries().find(whole);
    if (entry == index_.entries().end() || entry->second.mode != kSymbolicLink) {
      place = std::move(whole);
      continue;
    }
    const auto target = blob(entry->second.object);
    const bool outside = !target || target->empty() || target->front() == '/';
    if (outside || ++links > kMostLinks || left.size() > kMostComponents) return std::nullopt;
    push_components(*target, left);
  }
  return place;
}

std::optional<std::string> GitTree::blob(const std::string& object) {
  const std::lock_guard lock(reading_);
  if (!batch_) {
    auto started = GitProcess::start(index_.folder(), {"cat-file", "--batch"});
    if (!started) return std::nullopt;
    batch_.emplace(*std::move(started));
  }
  if (!batch_->ask(object + "\n")) return std::nullopt;
  const auto head = read_line(*batch_);  // "<object> blob <size>" or "<object> missing"
  if (!head || head->ends_with(" missing")) return std::nullopt;
  const std::size_t number = head->rfind(' ') + 1;
  std::uint64_t size = 0;
  const auto read = std::from_chars(head->data() + number, head->data() + head->size(), size);
  if (read.ec != std::errc()) return std::nullopt;
  std::string bytes;
  char line_break = 0;
  if (!read_bytes(*batch_, size, bytes) || batch_->read(&line_break, 1) != 1) return std::nullopt;
  if (size > kLargestBlob) return std::nullopt;
  return bytes;
}

// What git would write into a working tree.
std::optional<std::string> GitTree::filtered(const RepositoryName& name,
                                             const std::string& object) const {
  std::string bytes;
  bool whole = true;
  const auto code = Git(index_.folder())
                        .stream({"cat-file", "--filters", "--path=" + name, object}, {},
                                [&](std::string_view piece) {
                                  whole = whole && bytes.size() + piece.size() <= kLargestBlob;
                                  if (whole) bytes += piece;
                                });
  if (!code || *code != 0 || !whole || is_pointer(bytes)) return std::nullopt;
  return bytes;
}

GitTree::Loaded GitTree::load(const RepositoryName& name) {
  const auto file = follow(name);
  const IndexEntry* entry = file ? index_.file(*file) : nullptr;
  if (entry == nullptr) return {};
  const std::string& object = entry->object;
  Loaded loaded{blob(object), {}};
  if (!loaded.bytes) {
    loaded.problem = fmt::format("git cannot give it, or it has more than {} bytes", kLargestBlob);
  } else if (is_pointer(*loaded.bytes)) {
    if (auto kept = filtered(*file, object)) {
      loaded.bytes = std::move(kept);
    } else {
      loaded.problem = "it is a Git LFS pointer; 'git lfs fetch --all' gets files of all commits";
    }
  }
  return loaded;
}

std::optional<container::Bytes> GitTree::read(const RepositoryName& name) {
  Loaded loaded = load(name);
  if (!loaded.problem.empty()) {
    const std::lock_guard lock(noting_);
    std::string sentence = fmt::format("{} at {}: {}", printable(index_.path_of(name)),
                                       printable(label_), loaded.problem);
    const bool said = std::find(problems_.begin(), problems_.end(), sentence) != problems_.end();
    if (!said) problems_.push_back(std::move(sentence));
  }
  if (!loaded.bytes) return std::nullopt;
  return container::Bytes::from_string(*std::move(loaded.bytes));
}

container::Resolver GitTree::resolver(const RepositoryName& asset) {
  const container::Resolver from_top([this](const std::string& path) { return read(path); },
                                     container::ReadNames::paths);
  return from_top.in_folder_of(asset);
}

Result<model::OpenedAsset> GitTree::open(const RepositoryName& asset, std::string shown) {
  Loaded loaded = load(asset);
  if (!loaded.problem.empty()) return Error{std::move(loaded.problem)};
  if (!loaded.bytes) return Error{fmt::format("it is no file at {}", printable(label_))};
  auto opened =
      container::open_bytes(container::Bytes::from_string(*std::move(loaded.bytes)), asset);
  return model::OpenedAsset(std::move(shown), std::move(opened), resolver(asset));
}

std::vector<std::string> GitTree::take_problems() {
  const std::lock_guard lock(noting_);
  return std::exchange(problems_, {});
}

}  // namespace gltfx::tool
