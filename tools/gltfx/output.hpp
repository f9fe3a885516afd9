// SPDX-License-Identifier: Apache-2.0
/// Where text goes: standard output, or a file that appears only when it is complete.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/temporary_file.hpp"

namespace gltfx::tool {

/// Bytes that are worth a write.
inline constexpr std::size_t kOutputBuffer = std::size_t{1} << 16U;

/// Whether both name one file, as far as the words tell; empty is standard output.
bool same_place(const std::string& a, const std::string& b);

/// One place to write to. Not thread-safe. Failures are kept and told by problem().
class Output {
 public:
  /// An empty path is standard output. Anything but a regular file (a pipe, /dev/stderr) is
  /// written as it comes; a file is written beside its place and moved there by finish().
  /// `folders`: those above it are made.
  explicit Output(std::string path, bool folders = false);
  Output(Output&& other) noexcept = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output& operator=(Output&&) = delete;

  /// A reader that went away (`| head -1`) is no failure: the rest is dropped.
  void write(std::string_view text);
  /// Makes the file complete and durable. Without it, a file at the path stays as it was.
  void finish();

  /// A sentence about what went wrong first, or empty.
  const std::string& problem() const { return problem_; }

 private:
  void open(bool folders);
  void note(const std::optional<Error>& trouble);
  void fail(std::string_view action, int error);

  std::string path_;
  std::unique_ptr<TemporaryFile> file_;  ///< null for what is written as it comes
  UniqueFd opened_;
  std::string problem_;
  int fd_ = -1;
  bool reader_gone_ = false;
};

}  // namespace gltfx::tool
