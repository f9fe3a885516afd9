// SPDX-License-Identifier: Apache-2.0
#include "container/sniff.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace gltfx::container {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::string_view kGlbSuffix = ".glb";
// https://github.com/git-lfs/git-lfs/blob/main/docs/spec.md: the version line comes first and the
// whole pointer has less than 1024 bytes.
constexpr std::string_view kLfsLine = "version https://git-lfs.github.com/spec/v1";
constexpr std::size_t kLfsMaximum = 1024;

bool named_glb(std::string_view name) {
  if (name.size() < kGlbSuffix.size()) return false;
  const std::string_view end = name.substr(name.size() - kGlbSuffix.size());
  return std::equal(end.begin(), end.end(), kGlbSuffix.begin(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

/// A whole magic, or a file that was cut inside it.
bool begins_glb(std::string_view head) {
  return head.starts_with(kMagic) || kMagic.starts_with(head);
}

bool is_binary_byte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 && (byte < '\t' || byte > '\r');
}

bool begins_json(std::string_view head) {
  constexpr std::string_view kWhitespace = "{\t\n\r ";
  return kWhitespace.find(head.front()) != std::string_view::npos ||
         head.starts_with("\xEF\xBB\xBF") || head.starts_with("\xFF\xFE") ||
         head.starts_with("\xFE\xFF");
}

}  // namespace

bool is_git_lfs_pointer(std::string_view head, std::size_t file_size) {
  return file_size < kLfsMaximum && head.starts_with(kLfsLine);
}

Format sniff(std::string_view head, std::size_t file_size, std::string_view name) {
  head = head.substr(0, kSniffBytes);
  if (head.empty()) return named_glb(name) ? Format::glb : Format::empty;
  if (begins_glb(head)) return Format::glb;
  if (is_git_lfs_pointer(head, file_size)) return Format::git_lfs_pointer;
  if (begins_json(head)) return Format::gltf;
  if (named_glb(name)) return Format::glb;
  return std::any_of(head.begin(), head.end(), is_binary_byte) ? Format::unknown : Format::gltf;
}

}  // namespace gltfx::container
