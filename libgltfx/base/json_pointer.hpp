// SPDX-License-Identifier: Apache-2.0
/// JSON pointers (RFC 6901): the address of a value in a document.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gltfx {

/// One step of a path that is built while walking a document. Steps live on the stack and point to
/// their parent, so a path costs nothing until its text is requested.
///
///     Path root;  Path nodes(root, "nodes");  Path node(nodes, 5);  node.pointer() == "/nodes/5"
///
/// A Path must not outlive its parent nor the key it was given.
class Path {
 public:
  Path() = default;
  Path(const Path& parent, std::string_view key) : parent_(&parent), key_(key) {}
  template <typename Index, std::enable_if_t<std::is_integral_v<Index>, bool> = true>
  Path(const Path& parent, Index index)
      : parent_(&parent), index_(static_cast<std::uint64_t>(index)), is_index_(true) {}

  const Path* parent() const { return parent_; }
  bool is_index() const { return is_index_; }
  std::uint64_t index() const { return index_; }
  /// The member's name, unescaped.
  std::string_view key() const { return key_; }

  /// The pointer's text; empty for the root.
  std::string pointer() const;

 private:
  const Path* parent_ = nullptr;
  std::string_view key_;
  std::uint64_t index_ = 0;
  bool is_index_ = false;
};

/// Appends `/key` with `~` and `/` escaped as in RFC 6901 section 3.
void append_pointer_step(std::string& pointer, std::string_view key);

/// The unescaped steps of a pointer, or nothing when it is not one (no leading '/', a '~' that is
/// neither "~0" nor "~1").
std::optional<std::vector<std::string>> split_pointer(std::string_view pointer);

/// `pointer` with every step that is an array index replaced by '*': "/nodes/5/mesh" becomes
/// "/nodes/*/mesh". Findings that agree in this and in their code are repeats of each other.
std::string pointer_pattern(std::string_view pointer);

}  // namespace gltfx
