// SPDX-License-Identifier: Apache-2.0
#include "base/temporary_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/directory.hpp"
#include "base/fork.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

using Trouble = std::optional<Error>;

constexpr std::size_t kSlots = 64;
constexpr std::size_t kLongest = 4096;
constexpr std::size_t kNoSlot = kSlots;

enum State : int { free_slot, being_written, in_use };

struct Slot {
  std::atomic<int> state{free_slot};
  std::array<char, kLongest> path{};
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, kSlots> slots;

namespace fs = std::filesystem;

// Set when the program is loaded, before it can have made a file.
const fs::file_time_type kStart = fs::file_time_type::clock::now() - std::chrono::seconds(1);

constexpr std::chrono::hours kForgotten{24};
constexpr std::string_view kEnding = ".part";

// Eight digits for the space in which process ids are unique: a machine since its start, or a
// container on it.
const std::string& process_space() {
  static constinit MadeOnce<std::string> space;
  return space.get([] {
    std::string boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
    std::error_code error;
    HashParts parts;
    parts.add(boot);
    parts.add(fs::read_symlink("/proc/self/ns/pid", error).native());
    return fmt::format("{:08x}", parts.finish().low & 0xFFFFFFFFU);
  });
}

// Removes a number after `mark` from the end of a text; -1: there is none.
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

// Process ids are reused, so the time decides as well.
bool is_stale(std::string_view space, long process, const fs::path& file) {
  if (space != process_space()) return is_older(file, kStart - kForgotten);
  if (process == ::getpid()) return is_older(file, kStart);
  return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

bool is_space(std::string_view text) {
  return text.size() == process_space().size() &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// NAME.SPACE-PID-N.part
bool is_leftover(const std::string& name, const fs::path& folder) {
  if (!name.ends_with(kEnding)) return false;
  std::string_view rest = std::string_view(name).substr(0, name.size() - kEnding.size());
  const long attempt = take_number(rest, '-');
  const long process = attempt < 0 ? -1 : take_number(rest, '-');
  const std::size_t dot = rest.rfind('.');
  if (process <= 0 || dot == std::string_view::npos || dot == 0) return false;
  const std::string_view space = rest.substr(dot + 1);
  std::error_code error;
  return is_space(space) && fs::is_regular_file(fs::symlink_status(folder / name, error)) &&
         is_stale(space, process, folder / name);
}

// Gives 0, or sets errno: EEXIST if the place is taken.
int rename_to_free_place(const char* from, const char* to) {
#ifdef __linux__
  return ::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
#else  // files in memory, which no other process uses
  if (::access(to, F_OK) != 0) return std::rename(from, to);
  errno = EEXIST;
  return -1;
#endif
}

}  // namespace

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

Error file_error(std::string_view action, const std::filesystem::path& path, int error) {
  return {fmt::format("cannot {} {}: {}", action, quoted(path.native(), 200),
                      std::error_code(error, std::generic_category()).message())};
}

TemporaryFile::TemporaryFile(std::filesystem::path target, unsigned mode)
    : target_(std::move(target)) {
  remove_stale_files(target_);
  for (int attempt = 0; attempt < 1000 && !fd_; ++attempt) {
    name_ = temporary_name(target_, attempt);
    kept_.emplace(name_);
    constexpr int kFlags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW;
    fd_ = UniqueFd(::open(name_.c_str(), kFlags, mode));
    error_ = errno;
    if (!fd_ && error_ != EEXIST) break;
  }
  is_there_ = static_cast<bool>(fd_);
}

TemporaryFile::~TemporaryFile() {
  if (is_there_) ::unlink(name_.c_str());
}

Trouble TemporaryFile::write(std::string_view bytes) {
  if (!fd_) return file_error("create a file beside", target_, error_);
  if (write_all(fd_.get(), bytes)) return std::nullopt;
  if (errno != EFAULT) return file_error("write", target_, errno);
  return Error{fmt::format("cannot write {}: the file that it copies became shorter; run again",
                           quoted(target_.native(), 200))};
}

void TemporaryFile::begin_sync() const {
#ifdef __linux__
  static_cast<void>(::sync_file_range(fd_.get(), 0, 0, SYNC_FILE_RANGE_WRITE));
#endif
}

// EINVAL: the file system cannot make files durable. The descriptor is closed because there may be
// more files to write than a process can hold open.
Trouble TemporaryFile::make_durable() {
  const UniqueFd file = std::move(fd_);
  if (::fsync(file.get()) == 0 || errno == EINVAL) return std::nullopt;
  return file_error("write", target_, errno);
}

UniqueFd TemporaryFile::reader() const { return UniqueFd(::fcntl(fd_.get(), F_DUPFD_CLOEXEC, 0)); }

// The folder is opened before the file moves: afterwards nothing but the disk may fail.
Result<UniqueFd> TemporaryFile::open_folder() const {
  const std::filesystem::path parent = target_.parent_path();
  UniqueFd folder(
      ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return file_error("open the folder of", target_, errno);
  return folder;
}

Trouble TemporaryFile::move_over() {
  const auto folder = open_folder();
  if (!folder) return folder.error();
  if (std::rename(name_.c_str(), target_.c_str()) != 0) {
    return file_error("replace", target_, errno);
  }
  is_there_ = false;
  return sync(*folder);
}

// Refused if the place is taken. File systems without such a rename support such a link.
Trouble TemporaryFile::move_to_free_place() {
  const auto folder = open_folder();
  if (!folder) return folder.error();
  is_there_ = rename_to_free_place(name_.c_str(), target_.c_str()) != 0;
  const bool unknown = is_there_ && (errno == EINVAL || errno == ENOSYS);
  if (is_there_ && !(unknown && ::link(name_.c_str(), target_.c_str()) == 0)) {
    return file_error("create", target_, errno);
  }
  return sync(*folder);
}

Trouble TemporaryFile::sync(const UniqueFd& folder) const {
  if (::fsync(folder.get()) == 0 || errno == EINVAL) return std::nullopt;
  return file_error("make durable", target_, errno);
}

TemporaryName::TemporaryName(const std::string& path) : slot_(kNoSlot) {
  if (path.size() >= kLongest) return;
  for (std::size_t i = 0; i < kSlots; ++i) {
    int expected = free_slot;
    if (!slots[i].state.compare_exchange_strong(expected, being_written)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].state = in_use;
    slot_ = i;
    return;
  }
}

namespace {

ForkMutex looked_at_mutex;
std::set<fs::path> looked_at;  // folders without leftovers since then

}  // namespace

TemporaryName::~TemporaryName() {
  if (slot_ != kNoSlot) slots[slot_].state = free_slot;
}

void remove_temporaries() noexcept {
  const int kept = errno;
  for (const Slot& slot : slots) {
    if (slot.state == in_use) ::unlink(slot.path.data());
  }
  errno = kept;
}

std::string temporary_name(const fs::path& target, int number) {
  return fmt::format("{}.{}-{}-{}{}", target.native(), process_space(), ::getpid(), number,
                     kEnding);
}

void remove_stale_files(const fs::path& target) {
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  const std::lock_guard lock(looked_at_mutex);
  if (!looked_at.insert(folder).second) return;
  std::vector<std::string> found;
  DirectoryReader directory(folder);
  while (const char* entry = directory.next()) {
    if (is_leftover(entry, folder)) found.emplace_back(entry);
  }
  for (const std::string& name : found) {
    std::error_code ignored;
    fs::remove(folder / name, ignored);
  }
}

}  // namespace gltfx
