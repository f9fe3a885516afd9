// SPDX-License-Identifier: Apache-2.0
/// Files that are only there while another one is written.
#pragma once

#include <cstddef>
#include <string>

namespace gltfx {

/// Keeps the name of a temporary file where remove_temporaries() finds it, from before the file is
/// created until its place is taken or it is gone. There is room for a fixed number; names beyond,
/// and those longer than a path may be, are not kept.
class TemporaryName {
 public:
  explicit TemporaryName(const std::string& path);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  std::size_t slot_;
};

/// Deletes the temporary files of this process. For signal handlers of a program that is about to
/// end: async-signal-safe, keeps errno. The library installs no handler.
void remove_temporaries() noexcept;

}  // namespace gltfx
