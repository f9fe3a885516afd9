// SPDX-License-Identifier: Apache-2.0
/// The order in which the Khronos validator reports references between objects.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/json_pointer.hpp"
#include "base/sink.hpp"

namespace gltfx {

/// Owns the steps of a path, but not their names: the document must outlive it.
class PathCopy {
 public:
  /// The steps of `path`, below those of `before` when it is given.
  explicit PathCopy(const Path& path, const Path* before = nullptr) {
    std::vector<const Path*> steps;
    collect(path, steps);
    if (before != nullptr) collect(*before, steps);
    steps_.reserve(steps.size() + 1);
    steps_.emplace_back();
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      const Path& parent = steps_.back();
      if ((*step)->is_index()) {
        steps_.emplace_back(parent, (*step)->index());
      } else {
        steps_.emplace_back(parent, (*step)->key());
      }
    }
  }
  PathCopy(PathCopy&&) = default;
  PathCopy& operator=(PathCopy&&) = default;
  PathCopy(const PathCopy&) = delete;
  PathCopy& operator=(const PathCopy&) = delete;
  ~PathCopy() = default;

  const Path& path() const { return steps_.back(); }

 private:
  static void collect(const Path& path, std::vector<const Path*>& steps) {
    for (const Path* at = &path; at->parent() != nullptr; at = at->parent()) steps.push_back(at);
  }

  std::vector<Path> steps_;  // reserved before it is filled: steps point to each other
};

}  // namespace gltfx

namespace gltfx::validate {

/// A sink for link rules that holds broken references back until a rule checks the index.
/// References that no rule checks are not checked by the Khronos validator either.
class LinkOrder final : public Sink {
 public:
  explicit LinkOrder(Sink& reported) : reported_(reported) {}

  /// The sink for broken references found by the walk.
  Sink& held() { return held_; }
  /// Reports the held references whose index is inside `place`, in the order of the walk; each
  /// once.
  void release(Span place);

  void report(const Path& path, Finding finding) override;
  /// Reports all following findings below `path`. The path is copied.
  void report_below(const Path& path) { below_.emplace(path); }
  void report_from_root() { below_.reset(); }

 private:
  struct Held {
    PathCopy path;
    Finding finding;
    bool released = false;
  };
  class HoldingSink final : public Sink {
   public:
    void report(const Path& path, Finding finding) override;
    std::vector<Held> all;
  };
  void sort();

  Sink& reported_;
  HoldingSink held_;
  std::vector<std::size_t> by_place_;  ///< positions in held_.all, by place of the index
  std::optional<PathCopy> below_;
};

}  // namespace gltfx::validate
