// SPDX-License-Identifier: Apache-2.0
/// Runs the program git without a shell.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "base/result.hpp"
#include "base/unique_fd.hpp"

namespace gltfx::tool {

/// How git ended and what it wrote to standard output.
struct GitOutcome {
  int code = 0;  ///< exit code; 128 + signal when one ended it
  std::string out;
};

/// A running git. The destructor ends its input and waits for its end.
class GitProcess {
 public:
  GitProcess(GitProcess&& other) noexcept;
  GitProcess& operator=(GitProcess&&) = delete;
  GitProcess(const GitProcess&) = delete;
  GitProcess& operator=(const GitProcess&) = delete;
  ~GitProcess();

  /// Runs `git -C folder <arguments>`.
  static Result<GitProcess> start(const std::string& folder,
                                  const std::vector<std::string>& arguments);
  /// Writes `input` and reads the whole output. Returns the exit code.
  int exchange(std::string_view input, const std::function<void(std::string_view)>& consume);
  /// Writes a text whose answer is read afterwards. False: git is gone.
  bool ask(std::string_view text);
  /// Reads some output; 0: it is at its end.
  std::size_t read(char* to, std::size_t most);

 private:
  GitProcess(pid_t id, UniqueFd to, UniqueFd from)
      : id_(id), to_(std::move(to)), from_(std::move(from)) {}
  int wait();

  pid_t id_;  ///< 0: it has ended
  UniqueFd to_, from_;
};

/// Git in one folder. Its standard error is that of this program.
class Git {
 public:
  explicit Git(std::string folder) : folder_(std::move(folder)) {}
  const std::string& folder() const { return folder_; }

  /// Runs `git <arguments>` with `input` as its standard input. Words from a repository or an asset
  /// belong in the input, or after "--". An Error when git cannot be started.
  Result<GitOutcome> run(const std::vector<std::string>& arguments,
                         std::string_view input = {}) const;
  /// The same for large output, which is passed on piece by piece and not kept. Returns the exit
  /// code.
  Result<int> stream(const std::vector<std::string>& arguments, std::string_view input,
                     const std::function<void(std::string_view)>& consume) const;

 private:
  std::string folder_;
};

}  // namespace gltfx::tool
