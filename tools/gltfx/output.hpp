// SPDX-License-Identifier: Apache-2.0
/// Output of text: standard output, or a file that appears only when it is complete.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/temporary_file.hpp"

namespace gltfx::tool {

/// Bytes to collect before a write.
inline constexpr std::size_t kOutputBuffer = std::size_t{1} << 16U;

/// Whether both name one file, judged by the paths only; empty is standard output.
bool same_place(const std::string& a, const std::string& b);

/// One place to write to. Not thread-safe. problem() reports failures.
class Output {
 public:
  /// An empty path is standard output. Anything but a regular file (a pipe, /dev/stderr) is written
  /// immediately; a file is written beside its path and moved there by finish(). `folders`: create
  /// its parent folders.
  explicit Output(std::string path, bool folders = false);
  Output(Output&& other) noexcept = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output& operator=(Output&&) = delete;

  /// A closed reader (`| head -1`) is not a failure: the rest is dropped.
  void write(std::string_view text);
  /// Makes the file complete and durable. Without it, a file at the path is not changed.
  void finish();

  /// A sentence about the first failure, or empty.
  const std::string& problem() const { return problem_; }

 private:
  void open(bool folders);
  void note(const std::optional<Error>& trouble);
  void fail(std::string_view action, int error);

  std::string path_;
  std::unique_ptr<TemporaryFile> file_;  ///< null for immediate output
  UniqueFd opened_;
  std::string problem_;
  int fd_ = -1;
  bool reader_gone_ = false;
};

}  // namespace gltfx::tool
