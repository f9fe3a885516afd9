// SPDX-License-Identifier: Apache-2.0
#include "base/stale_files.hpp"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

namespace gltfx {
namespace {

namespace fs = std::filesystem;

// Taken when the program is loaded: before it can have made a file.
const fs::file_time_type kStart = fs::file_time_type::clock::now() - std::chrono::seconds(1);

/// A temporary file's own name, and that of the file it was to become: NAME.PID-N.part
struct Leftover {
  std::string name, target;
};

// Takes a number with that mark before it off the end of a text; -1: there is none.
long take_number(std::string_view& text, char mark) {
  const std::size_t at = text.rfind(mark);
  if (at == std::string_view::npos) return -1;
  long number = -1;
  const auto [end, fault] =
      std::from_chars(text.data() + at + 1, text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size()) return -1;
  text = text.substr(0, at);
  return number;
}

// A number of a process that is used again, as in containers, tells nothing; the time does.
bool is_stale(long process, const fs::path& file) {
  std::error_code fault;
  if (process == ::getpid()) return fs::last_write_time(file, fault) < kStart && !fault;
  return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

std::vector<Leftover> leftovers_in(const fs::path& folder) {
  std::vector<Leftover> found;
  std::error_code fault;
  for (fs::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault)) {
    const std::string name = at->path().filename();
    constexpr std::string_view kEnding = ".part";
    if (!name.ends_with(kEnding)) continue;
    std::string_view rest = std::string_view(name).substr(0, name.size() - kEnding.size());
    const long attempt = take_number(rest, '-');
    const long process = attempt < 0 ? -1 : take_number(rest, '.');
    if (process > 0 && is_stale(process, at->path())) found.push_back({name, std::string(rest)});
  }
  return found;
}

}  // namespace

void remove_stale_files(const fs::path& target) {
  static std::mutex mutex;
  static std::map<fs::path, std::vector<Leftover>> known;
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  const std::lock_guard lock(mutex);
  auto found = known.find(folder);
  if (found == known.end()) found = known.emplace(folder, leftovers_in(folder)).first;
  for (const Leftover& leftover : found->second) {
    std::error_code ignored;
    if (leftover.target == target.filename()) fs::remove(folder / leftover.name, ignored);
  }
}

}  // namespace gltfx
