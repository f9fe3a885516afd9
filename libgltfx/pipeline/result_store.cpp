// SPDX-License-Identifier: Apache-2.0
// A file is a header and records. The header: a number with the version of the layout, and the name
// of the secret. A record: length of the value, the key, the seal of key and value, the value.
// Numbers lie as the machine has them, which the header tells: what another kind of machine wrote
// is not read.
#include "pipeline/result_store.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>
#include <tuple>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/directory.hpp"
#include "base/file_state.hpp"
#include "base/temporary_file.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".results";
constexpr std::uint64_t kMagic = 0x0252'5846'544C'4701;  // with the version of the layout
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30U;
constexpr std::size_t kManyFiles = 16;

struct RecordHead {
  std::uint64_t length = 0;
  Hash128 key;
  Seal::Tag tag{};
};
static_assert(sizeof(RecordHead) == 40);

template <class T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

constexpr std::string_view kDomain = "gltfx result 1";
constexpr std::uint64_t kHeadSize = sizeof kMagic + sizeof(Seal::Tag);

void append_record(std::string& out, const Seal& seal, const Hash128& key, std::string_view value) {
  const RecordHead head{value.size(), key, seal.of({kDomain, bytes_of(key), value})};
  out += bytes_of(head);
  out += value;
}

// The secret of the hash is another than that of the seal.
KeyedHash::Secret hash_secret(const Seal& seal) {
  KeyedHash::Secret secret{};
  Seal::Tag tag{};
  for (std::size_t at = 0; at < secret.size(); at += tag.size()) {
    tag = seal.of({"secret of the hash", bytes_of(at)});
    std::copy(tag.begin(), tag.end(), secret.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return secret;
}

// The bytes [offset, offset + length), or as many as there are.
std::string read_at(int fd, std::uint64_t offset, std::size_t length) {
  std::string bytes(length, '\0');
  std::size_t done = 0;
  while (done < length) {
    const ssize_t got =
        ::pread(fd, bytes.data() + done, length - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

// Files of a cache that others fill, or on a read-only volume, are read too.
UniqueFd open_segment(const std::string& path) {
  constexpr int kFlags = O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW;
  UniqueFd file(::open(path.c_str(), O_RDWR | kFlags));
  if (!file && (errno == EACCES || errno == EROFS)) {
    file = UniqueFd(::open(path.c_str(), O_RDONLY | kFlags));
  }
  return file;
}

// Whoever writes to a file holds it shared, so that nobody takes it away meanwhile.
bool lock(int fd, int how) {
  while (::flock(fd, how | LOCK_NB) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

// Sorted by name, the newest comes last.
std::string fresh_name(const std::string& folder) {
  std::random_device random;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto since_1970 = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  return fmt::format("{}/{:016x}{:08x}{}", folder, since_1970, random(), kEnding);
}

}  // namespace

ResultStore::ResultStore(std::string folder, std::string_view secret, Owner owner)
    : folder_(std::move(folder)), seal_(secret), hash_(hash_secret(seal_)), owner_(owner) {}

std::string ResultStore::head() const {
  return std::string(bytes_of(kMagic)).append(bytes_of(seal_.name()));
}

Hash128 ResultStore::hash(std::string_view bytes) const { return hash_.of(bytes); }

Result<std::unique_ptr<ResultStore>> ResultStore::open(const std::string& folder,
                                                       std::string_view secret, Owner owner) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return file_error("create the cache", folder, error.value());
  std::unique_ptr<ResultStore> store(new ResultStore(folder, secret, owner));
  if (auto problem = store->load()) return *std::move(problem);
  return store;
}

ResultStore::~ResultStore() {
  for (const Segment& segment : segments_) {
    if (segment.used) ::futimens(segment.fd.get(), nullptr);  // of use just now
  }
}

std::optional<Error> ResultStore::load() {
  DirectoryReader directory(folder_);
  while (const char* name = directory.next()) {
    if (!std::string_view(name).ends_with(kEnding)) continue;
    Segment segment;
    segment.path = fs::path(folder_) / name;
    segment.fd = open_segment(segment.path);
    struct stat status {};
    if (!segment.fd || ::fstat(segment.fd.get(), &status) != 0 || !S_ISREG(status.st_mode))
      continue;
    segment.size = static_cast<std::uint64_t>(status.st_size);
    segment.last_use = state_of(status).modified;
    const std::string found = read_at(segment.fd.get(), 0, kHeadSize);
    if (!found.starts_with(bytes_of(kMagic))) continue;
    segment.foreign = found != head() || (owner_ == Owner::user && status.st_uid != ::geteuid());
    foreign_files_ += segment.foreign ? 1U : 0U;
    segments_.push_back(std::move(segment));
  }
  if (directory.error()) return file_error("list the cache", folder_, directory.error().value());
  drop_oldest();
  std::sort(segments_.begin(), segments_.end(),
            [](const Segment& a, const Segment& b) { return a.path < b.path; });
  for (std::uint32_t i = 0; i < segments_.size(); ++i) {
    if (!segments_[i].foreign) index(i);
  }
  return std::nullopt;
}

void ResultStore::drop_oldest() {
  std::uint64_t sum = 0;
  for (const Segment& segment : segments_) sum += segment.size;
  if (sum <= kMostBytes) return;
  std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) {
    return std::tie(a.last_use, a.path) > std::tie(b.last_use, b.path);
  });
  while (sum > kMostBytes && !segments_.empty()) {
    const Segment& oldest = segments_.back();
    sum -= oldest.size;
    if (lock(oldest.fd.get(), LOCK_EX)) ::unlink(oldest.path.c_str());
    segments_.pop_back();
  }
}

// Values are skipped, whole or not: read() checks them.
void ResultStore::index(std::uint32_t number) {
  const Segment& segment = segments_[number];
  constexpr std::size_t kWindow = std::size_t{1} << 20U;
  std::string window;
  std::uint64_t begin = 0;  // of the window
  for (std::uint64_t at = kHeadSize; at + sizeof(RecordHead) <= segment.size;) {
    if (at + sizeof(RecordHead) > begin + window.size()) {
      begin = at;
      window = read_at(segment.fd.get(), begin, kWindow);
      if (window.size() < sizeof(RecordHead)) return;
    }
    RecordHead head;
    std::memcpy(&head, window.data() + (at - begin), sizeof head);
    const std::uint64_t left = segment.size - at - sizeof head;
    if (head.length > left) return;
    index(head.key.low, number, at);
    at += sizeof head + head.length;
  }
}

void ResultStore::index(std::uint64_t key, std::uint32_t segment, std::uint64_t offset) {
  if (2 * (filled_ + 1) > slots_.size()) grow();
  std::size_t at = key & (slots_.size() - 1);
  while (slots_[at].offset != 0 && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
  if (slots_[at].offset == 0) ++filled_;
  slots_[at] = {key, offset, segment};
}

void ResultStore::grow() {
  std::vector<Slot> before(std::max<std::size_t>(1024, 2 * slots_.size()));
  before.swap(slots_);
  filled_ = 0;
  for (const Slot& slot : before) {
    if (slot.offset != 0) index(slot.key, slot.segment, slot.offset);
  }
}

std::optional<std::string> ResultStore::find(const Hash128& key) const {
  if (slots_.empty()) return std::nullopt;
  std::size_t at = key.low & (slots_.size() - 1);
  while (slots_[at].offset != 0 && slots_[at].key != key.low) at = (at + 1) & (slots_.size() - 1);
  if (slots_[at].offset == 0) return std::nullopt;
  return read(slots_[at], key);
}

std::optional<std::string> ResultStore::read(const Slot& slot, const Hash128& key) const {
  const Segment& segment = segments_[slot.segment];
  constexpr std::size_t kMostly = 1024;  // what one read brings
  std::string bytes = read_at(segment.fd.get(), slot.offset, kMostly);
  RecordHead head;
  if (bytes.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof head);
  if (!(head.key == key) || head.length > segment.size) return std::nullopt;
  if (bytes.size() < sizeof head + head.length) {
    bytes = read_at(segment.fd.get(), slot.offset, sizeof head + head.length);
  }
  if (bytes.size() < sizeof head + head.length) return std::nullopt;
  bytes.resize(sizeof head + head.length);
  bytes.erase(0, sizeof head);
  if (!seal_.fits(head.tag, {kDomain, bytes_of(key), bytes})) return std::nullopt;
  // Only ever set, and looked at when all threads are done.
  std::atomic_ref(segment.used).store(true, std::memory_order_relaxed);
  return bytes;
}

bool ResultStore::create_own() {
  if (own_) return true;
  const std::string path = fresh_name(folder_);
  constexpr int kFlags = O_RDWR | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC | O_NOFOLLOW;
  own_ = UniqueFd(::open(path.c_str(), kFlags, 0666));
  return own_ && lock(own_.get(), LOCK_SH) && write_all(own_.get(), head());
}

void ResultStore::add(std::span<const Value> values) {
  std::string records;
  for (const Value& value : values) append_record(records, seal_, value.key, value.bytes);
  const std::lock_guard guard(mutex_);
  if (problem_ || (create_own() && write_all(own_.get(), records))) return;
  problem_ = file_error("write to the cache", folder_, errno);
}

std::optional<Error> ResultStore::problem() const {
  const std::lock_guard guard(mutex_);
  return problem_;
}

// Those that other runs write to now stay as they are. The index knows the newest copy of a value;
// what this run added is newer still, so that the file of all takes the place of one from before
// it.
void ResultStore::tidy() {
  const auto readable = std::count_if(segments_.begin(), segments_.end(),
                                      [](const Segment& segment) { return !segment.foreign; });
  if (static_cast<std::size_t>(readable) < kManyFiles) return;
  std::vector<bool> ours(segments_.size());
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    ours[i] = !segments_[i].foreign && lock(segments_[i].fd.get(), LOCK_EX);
  }
  const auto newest = std::find(ours.rbegin(), ours.rend(), true);
  if (newest == ours.rend()) return;
  const auto last = static_cast<std::size_t>(newest.base() - ours.begin()) - 1;
  TemporaryFile together(segments_[last].path);
  std::optional<Error> trouble = together.write(head());
  std::string records;
  constexpr std::size_t kAtOnce = std::size_t{1} << 20U;
  for (const Slot& slot : slots_) {
    if (slot.offset == 0 || !ours[slot.segment] || trouble) continue;
    RecordHead record;
    const std::string bytes = read_at(segments_[slot.segment].fd.get(), slot.offset, sizeof record);
    std::memcpy(&record, bytes.data(), std::min(bytes.size(), sizeof record));
    if (const auto value = read(slot, record.key))
      append_record(records, seal_, record.key, *value);
    if (records.size() < kAtOnce) continue;
    trouble = together.write(records);
    records.clear();
  }
  if (!trouble) trouble = together.write(records);
  if (!trouble) trouble = together.move_over();
  if (trouble) return;
  for (std::size_t i = 0; i < last; ++i) {
    if (ours[i]) ::unlink(segments_[i].path.c_str());
  }
}

}  // namespace gltfx
