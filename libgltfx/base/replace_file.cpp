// SPDX-License-Identifier: Apache-2.0
#include "base/replace_file.hpp"

#include <cerrno>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/file_state.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;

constexpr mode_t kOwnerOnly = 0600;
constexpr mode_t kWritable = 0222;

Error refusal(const fs::path& path, std::string_view why) {
  return {fmt::format("{} {}", quoted(path.native(), 200), why)};
}

// Why a file must not be replaced, or nothing.
Trouble objection(const fs::path& path, const struct stat& status, const FileState& seen) {
  if (!S_ISREG(status.st_mode)) return refusal(path, "is not a regular file");
  if (!(state_of(status) == seen)) {
    return refusal(path, "was changed by another program since it was read; run again");
  }
  if (status.st_nlink > 1) {
    return refusal(path, "has other hard links, which would keep the old bytes; copy it first");
  }
  if ((status.st_mode & kWritable) == 0 || ::access(path.c_str(), W_OK) != 0) {
    return refusal(path, "is read-only");
  }
  return std::nullopt;
}

std::optional<Error> put(FileDraft& draft, std::string_view bytes) {
  if (auto trouble = draft.write(bytes)) return trouble;
  if (auto trouble = draft.finish()) return trouble;
  return draft.publish();
}

}  // namespace

FileDraft::FileDraft(const fs::path& path, const std::optional<FileState>& seen)
    : target_(path), seen_(seen) {
  if (!seen) {
    file_.emplace(target_);
    return;
  }
  std::error_code error;
  target_ = fs::canonical(path, error);
  if (error) {
    trouble_ = file_error("examine", path, error.value());
  } else if (trouble_ = check_replaceable(target_, *seen); !trouble_) {
    look_at(target_);
  }
}

FileDraft::FileDraft(const fs::path& path, const fs::path& like) : target_(path) { look_at(like); }

void FileDraft::look_at(const fs::path& like) {
  like_ = like;
  if (::stat(like.c_str(), &old_) != 0) {
    trouble_ = file_error("examine", like, errno);
  } else {
    file_.emplace(target_, kOwnerOnly);
  }
}

Trouble FileDraft::write(std::string_view bytes) {
  return trouble_ ? trouble_ : file_->write(bytes);
}

void FileDraft::begin_sync() const {
  if (file_) file_->begin_sync();
}

Trouble FileDraft::finish() {
  if (auto trouble = write({})) return trouble;
  if (!like_.empty()) {
    if (auto trouble = keep_attributes(file_->fd(), like_, old_)) return trouble;
  }
  return file_->make_durable();
}

// Another program may have saved the file while the draft was written.
Trouble FileDraft::publish() {
  if (!seen_) return file_->move_to_free_place();
  if (auto trouble = check_replaceable(target_, *seen_)) return trouble;
  return file_->move_over();
}

UniqueFd FileDraft::reader() const { return file_ ? file_->reader() : UniqueFd(); }

std::optional<Error> check_replaceable(const fs::path& path, const FileState& seen) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return file_error("examine", path, errno);
  return objection(path, status, seen);
}

std::optional<Error> replace_file(const fs::path& path, std::string_view bytes,
                                  const FileState& seen) {
  FileDraft draft(path, seen);
  return put(draft, bytes);
}

std::optional<Error> create_file(const fs::path& path, std::string_view bytes) {
  FileDraft draft(path, std::nullopt);
  return put(draft, bytes);
}

Result<std::optional<FileState>> state_if_there(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 && errno == ENOENT) return std::optional<FileState>();
  const auto seen = file_state(path);
  if (!seen) return seen.error();
  return std::optional(*seen);
}

std::optional<Error> write_file(const fs::path& path, std::string_view bytes) {
  const auto seen = state_if_there(path);
  if (!seen) return seen.error();
  FileDraft draft(path, *seen);
  return put(draft, bytes);
}

}  // namespace gltfx
