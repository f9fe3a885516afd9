// SPDX-License-Identifier: Apache-2.0
/// What a user is told of things that are not drawn: one sentence for each kind, however many
/// there are.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gltfx {

class SceneNotes {
 public:
  /// A sentence of its own.
  void add(std::string sentence);
  /// Something with a place that shares its fate with others: "Image 3", "is not there".
  void add(const std::string& place, const std::string& fate);

  /// All of them; those beyond a few dozen are counted.
  std::vector<std::string> take();

 private:
  struct Kind {
    std::string first;
    std::uint64_t count = 0;
  };
  std::vector<std::string> sentences_;
  std::uint64_t more_ = 0;
  std::map<std::string, Kind> kinds_;
};

}  // namespace gltfx
