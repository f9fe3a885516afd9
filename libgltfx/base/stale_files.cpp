// SPDX-License-Identifier: Apache-2.0
#include "base/stale_files.hpp"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "base/directory.hpp"
#include "base/hash.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

// Taken when the program is loaded: before it can have made a file.
const fs::file_time_type kStart = fs::file_time_type::clock::now() - std::chrono::seconds(1);

constexpr std::chrono::hours kForgotten{24};
constexpr std::string_view kEnding = ".part";

// Eight digits for the space in which numbers of processes are unique: a machine since it was
// started, or a container on it.
const std::string& process_space() {
  static const std::string space = [] {
    std::string boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
    std::error_code error;
    HashParts parts;
    parts.add(boot);
    parts.add(fs::read_symlink("/proc/self/ns/pid", error).native());
    return fmt::format("{:08x}", parts.finish().low & 0xFFFFFFFFU);
  }();
  return space;
}

/// A temporary file's own name, and that of the file it was to become: NAME.SPACE-PID-N.part
struct Leftover {
  std::string name, target;
};

// Takes a number with that mark before it off the end of a text; -1: there is none.
long take_number(std::string_view& text, char mark) {
  const std::size_t at = text.rfind(mark);
  if (at == std::string_view::npos) return -1;
  long number = -1;
  const auto [end, error] =
      std::from_chars(text.data() + at + 1, text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return -1;
  text = text.substr(0, at);
  return number;
}

bool is_older(const fs::path& file, fs::file_time_type time) {
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  return !error && written < time;
}

// A number of a process that is used again tells nothing; the time does.
bool is_stale(std::string_view space, long process, const fs::path& file) {
  if (space != process_space()) return is_older(file, kStart - kForgotten);
  if (process == ::getpid()) return is_older(file, kStart);
  return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

std::vector<Leftover> leftovers_in(const fs::path& folder) {
  std::vector<Leftover> found;
  DirectoryReader directory(folder);
  while (const char* entry = directory.next()) {
    const std::string name = entry;
    if (!name.ends_with(kEnding)) continue;
    std::string_view rest = std::string_view(name).substr(0, name.size() - kEnding.size());
    const long attempt = take_number(rest, '-');
    const long process = attempt < 0 ? -1 : take_number(rest, '-');
    const std::size_t dot = rest.rfind('.');
    if (process <= 0 || dot == std::string_view::npos) continue;
    if (!is_stale(rest.substr(dot + 1), process, folder / name)) continue;
    found.push_back({name, std::string(rest.substr(0, dot))});
  }
  return found;
}

}  // namespace

std::string temporary_name(const fs::path& target, int number) {
  return fmt::format("{}.{}-{}-{}{}", target.native(), process_space(), ::getpid(), number,
                     kEnding);
}

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
