// SPDX-License-Identifier: Apache-2.0
/// The order in which the Khronos validator speaks of how objects refer to each other.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/path_copy.hpp"
#include "base/sink.hpp"

namespace gltfx::validate {

/// A sink for link rules that holds broken references back until the rule comes by that looks at
/// the index. What nobody comes by for, that validator does not look at either.
class LinkOrder final : public Sink {
 public:
  explicit LinkOrder(Sink& reported) : reported_(reported) {}

  /// Where the walk leaves broken references.
  Sink& held() { return held_; }
  /// Reports those whose index stands inside `place`, in the order of the walk; each once.
  void release(Span place);

  void report(const Path& path, Finding finding) override;
  /// From now on everything is reported below `path`. The path is copied.
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
  std::vector<std::size_t> by_place_;  ///< positions in held_.all by where their index stands
  std::optional<PathCopy> below_;
};

}  // namespace gltfx::validate
