// SPDX-License-Identifier: Apache-2.0
#include "pipeline/seal.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/fork.hpp"
#include "base/temporary_file.hpp"
#include "base/text.hpp"
#include "container/file.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

fs::path state_folder() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value == '/' ? fs::path(value) : fs::path();
  };
  if (const fs::path state = absolute("XDG_STATE_HOME"); !state.empty()) return state / "gltfx";
  const fs::path home = absolute("HOME");
  return home.empty() ? home : home / ".local/state/gltfx";
}

// Nothing when there is no such file yet.
Result<std::string> read_secret(const fs::path& path) {
  const container::File file = container::open_regular(AT_FDCWD, path.c_str(), O_NOFOLLOW);
  if (!file.fd && file.error == container::ResolveError::not_found) return std::string();
  struct stat status {};
  if (!file.fd || ::fstat(file.fd.get(), &status) != 0) {
    return Error{"cannot read the key " + quoted(path.native(), 200) + ": " + file.problem};
  }
  constexpr mode_t kOthers = S_IRWXG | S_IRWXO;
  if (status.st_uid != ::geteuid() || (status.st_mode & kOthers) != 0) {
    return Error{"the key " + quoted(path.native(), 200) +
                 " must belong to this user, and others must not have access to it"};
  }
  constexpr std::uint64_t kMost = 4096;
  const container::Copied copy =
      container::copy_range(file.fd.get(), 0, std::min(file.size, kMost));
  if (copy.error == container::ResolveError::none && copy.text->size() >= kShortestSecret) {
    return std::string(*copy.text);
  }
  return Error{"the key " + quoted(path.native(), 200) + " is too short; delete it for a new one"};
}

ForkMutex sodium_mutex;

// libsodium wants it before any other call.
void prepare_sodium() {
  // It may be called again, but not while the process forks: it has a lock of its own.
  static constinit MadeOnce<int> ready;
  ready.get([] {
    const std::lock_guard lock(sodium_mutex);
    return sodium_init();
  });
}

std::string new_secret() {
  prepare_sodium();
  std::array<unsigned char, 32> random{};
  randombytes_buf(random.data(), random.size());
  std::string text(2 * random.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), random.data(), random.size());
  text.back() = '\n';
  return text;
}

// Fails where another process was first.
std::optional<Error> make_secret(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path.parent_path().parent_path(), error);
  if (!error && ::mkdir(path.parent_path().c_str(), S_IRWXU) != 0 && errno != EEXIST) {
    return file_error("create", path.parent_path(), errno);
  }
  if (error) return file_error("create", path.parent_path().parent_path(), error.value());
  TemporaryFile file(path, S_IRUSR | S_IWUSR);
  if (auto problem = file.write(new_secret())) return problem;
  if (auto problem = file.make_durable()) return problem;
  return file.move_to_free_place();
}

}  // namespace

Seal::Seal(std::string_view secret) {
  prepare_sodium();
  crypto_generichash(key_.data(), key_.size(), bytes_of(secret), secret.size(), nullptr, 0);
  name_ = of({"name of the key"});
}

Seal::Tag Seal::of(std::initializer_list<std::string_view> parts) const {
  Tag tag{};
  crypto_generichash_state state;
  crypto_generichash_init(&state, key_.data(), key_.size(), tag.size());
  for (const std::string_view part : parts) {
    crypto_generichash_update(&state, bytes_of(part), part.size());
  }
  crypto_generichash_final(&state, tag.data(), tag.size());
  return tag;
}

bool Seal::fits(const Tag& tag, std::initializer_list<std::string_view> parts) const {
  const Tag right = of(parts);
  return sodium_memcmp(right.data(), tag.data(), tag.size()) == 0;
}

Result<std::string> users_secret() {
  const fs::path folder = state_folder();
  if (folder.empty()) {
    return Error{"there is no folder for the key: neither XDG_STATE_HOME nor HOME is set"};
  }
  const fs::path path = folder / "cache.key";
  auto secret = read_secret(path);
  if (!secret || !secret->empty()) return secret;
  auto problem = make_secret(path);
  secret = read_secret(path);
  if (secret && secret->empty()) {
    return problem ? *std::move(problem) : file_error("read the key", path, ENOENT);
  }
  return secret;
}

}  // namespace gltfx
