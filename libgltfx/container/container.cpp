// SPDX-License-Identifier: Apache-2.0
#include "container/container.hpp"

#include <cstdint>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>

#include "base/work_count.hpp"
#include "container/content.hpp"
#include "container/file.hpp"
#include "container/glb.hpp"

namespace gltfx::container {
namespace {

constexpr std::uint64_t kMaxJson = UINT32_MAX;  // positions in a text are 32 bits wide (Span)

Error failure(const std::filesystem::path& path, ResolveError error, std::string_view problem) {
  std::string sentence = describe(error, path.native(), problem);
  sentence.pop_back();
  return {fmt::format("{}; {}.", sentence, help(error))};
}

Error too_large(const std::filesystem::path& path, std::uint64_t size, std::uint64_t limit) {
  return failure(path, ResolveError::too_large,
                 fmt::format("it has {} bytes, the limit is {}", size, limit));
}

/// The text is the only copy: `bytes` shows the same memory.
Container from_text(SharedText text) {
  Container container;
  container.format = Format::gltf;
  container.bytes = Bytes::from_text(text);
  container.json = std::move(text);
  return container;
}

Container from_memory(SharedText text, std::string_view name) {
  const Format format = sniff(*text, text->size(), name);
  if (format == Format::gltf) return from_text(std::move(text));
  return open_bytes(Bytes::from_text(text), name);
}

Result<Container> copy_whole(const File& file, const std::filesystem::path& path) {
  Copied copy = copy_range(file.fd.get(), 0, file.size);
  if (copy.error != ResolveError::none) return failure(path, copy.error, copy.problem);
  return from_memory(std::move(copy.text), path.native());
}

/// A large file that is not text: its JSON is copied, the rest stays mapped.
Result<Container> open_mapped(const File& file, const std::filesystem::path& path, Format format) {
  Container container;
  container.format = format;
  if (format == Format::glb) {
    const auto error = read_glb(Source(file.fd.get(), file.size), container);
    if (error) return failure(path, error->error, error->problem);
  }
  Loaded mapping = map_file(file.fd.get(), file.size);
  if (mapping.error != ResolveError::none) return failure(path, mapping.error, mapping.problem);
  container.bytes = std::move(mapping.bytes);
  return container;
}

}  // namespace

Result<Container> open_file(const std::filesystem::path& path, const OpenLimits& limits) {
  return open_file(open_regular(AT_FDCWD, path.c_str()), path, limits);
}

Result<Container> open_file(const File& file, const std::filesystem::path& path,
                            const OpenLimits& limits) {
  if (file.error != ResolveError::none) return failure(path, file.error, file.problem);
  ++work_count.opened;
  if (file.size > limits.max_bytes) return too_large(path, file.size, limits.max_bytes);
  if (file.size <= kCopyBelow) return copy_whole(file, path);
  const Copied head = copy_range(file.fd.get(), 0, kSniffBytes);
  if (head.error != ResolveError::none) return failure(path, head.error, head.problem);
  const Format format = sniff(*head.text, file.size, path.native());
  if (format != Format::gltf) return open_mapped(file, path, format);
  if (file.size > kMaxJson) return too_large(path, file.size, kMaxJson);
  return copy_whole(file, path);
}

Container literal_reading(const Container& container) {
  if (!container.literal) return container;
  Container literal = *container.literal;
  literal.bytes = container.bytes;
  return literal;
}

Container open_bytes(Bytes bytes, std::string_view name) {
  const Format format = sniff(bytes.text(), bytes.size(), name);
  return open_bytes(std::move(bytes), format);
}

Container open_bytes(Bytes bytes, Format format) {
  Container container;
  container.format = format;
  if (container.format == Format::gltf && bytes.size() <= kMaxJson) {
    container.json = share_text(std::string(bytes.text()));
  } else if (container.format == Format::glb) {
    read_glb(Source(bytes), container);  // reading memory does not fail
  }
  container.bytes = std::move(bytes);
  return container;
}

}  // namespace gltfx::container
