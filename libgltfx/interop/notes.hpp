// SPDX-License-Identifier: Apache-2.0
/// Notes of a conversion.
#pragma once

#include <gltfx/tinygltf.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json_pointer.hpp"

namespace gltfx::interop {

class Notes {
 public:
  /// The other side cannot hold a value.
  void lost(const Path& path, std::string_view why) { add(path.pointer(), why, true); }
  void lost(std::string pointer, std::string_view why) { add(std::move(pointer), why, true); }
  /// The value has another form.
  void changed(const Path& path, std::string_view how) { add(path.pointer(), how, false); }
  void changed(std::string pointer, std::string_view how) { add(std::move(pointer), how, false); }
  /// The result would be wrong and must not be used. The first reason is kept.
  void fail(std::string reason) {
    if (error_.empty()) error_ = std::move(reason);
  }

  const std::string& error() const { return error_; }
  std::vector<TinygltfNote> take() { return std::move(notes_); }

 private:
  void add(std::string pointer, std::string_view message, bool lost) {
    notes_.push_back({std::move(pointer), std::string(message), lost});
  }

  std::vector<TinygltfNote> notes_;
  std::string error_;
};

}  // namespace gltfx::interop
