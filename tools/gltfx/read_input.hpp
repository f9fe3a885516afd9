// SPDX-License-Identifier: Apache-2.0
/// Small inputs read whole: standard input, schema files (`--schema`, `--schema-dir`), baselines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/unique_fd.hpp"
#include "schema/set.hpp"

namespace gltfx::tool {

/// Maximum size of an asset from standard input, which is held in memory.
inline constexpr std::uint64_t kLongestAsset = std::uint64_t{1} << 30U;
/// Maximum size of a list of files or a baseline.
inline constexpr std::uint64_t kLongestList = std::uint64_t{256} << 20U;
/// Maximum size of a line of a report.
inline constexpr std::uint64_t kLongestLine = std::uint64_t{64} << 20U;
/// Maximum size of a configuration or a key.
inline constexpr std::uint64_t kLongestConfig = std::uint64_t{1} << 20U;

/// All bytes of standard input. An Error when there are more than `most`.
Result<std::string> read_stdin(std::uint64_t most);

/// All bytes of a regular file that the user named for gltfx itself. The Error names it: also when
/// it is a pipe or a device, or has more than `most` bytes.
Result<std::string> read_text_file(const std::string& path, std::uint64_t most);

/// The files of a folder whose names have that ending, sorted.
Result<std::vector<std::string>> files_in(const std::string& folder, std::string_view ending);

/// A regular file, one line after the other.
class LineReader {
 public:
  static Result<LineReader> open(const std::string& path);

  /// The next line without its line break; nothing if no complete line is left. An Error when the
  /// file cannot be read, or a line is longer than kLongestLine.
  Result<std::optional<std::string>> next();

 private:
  explicit LineReader(UniqueFd fd) : fd_(std::move(fd)) {}

  UniqueFd fd_;
  std::string buffer_;
  std::size_t begin_ = 0;  ///< of the bytes that were not returned yet
};

/// The schemas with the user's files added; null means the built-in set when there are none. The
/// Error has a line for each mistake: file:line:column and the mistake.
Result<std::shared_ptr<const schema::Set>> load_schemas(const std::vector<std::string>& files,
                                                        const std::vector<std::string>& folders);

}  // namespace gltfx::tool
