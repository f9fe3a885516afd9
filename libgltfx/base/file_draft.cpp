// SPDX-License-Identifier: Apache-2.0
#include "base/file_draft.hpp"

#include <cerrno>
#include <system_error>

#include "base/file_attributes.hpp"
#include "base/replace_file.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;

constexpr mode_t kOwnerOnly = 0600;

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
    trouble_ = file_error("look at", path, error.value());
  } else if (trouble_ = check_replaceable(target_, *seen); !trouble_) {
    look_at(target_);
  }
}

FileDraft::FileDraft(const fs::path& path, const fs::path& like) : target_(path) { look_at(like); }

void FileDraft::look_at(const fs::path& like) {
  like_ = like;
  if (::stat(like.c_str(), &old_) != 0) {
    trouble_ = file_error("look at", like, errno);
  } else {
    file_.emplace(target_, kOwnerOnly);
  }
}

Trouble FileDraft::write(std::string_view bytes) {
  return trouble_ ? trouble_ : file_->write(bytes);
}

Trouble FileDraft::finish() {
  if (auto trouble = write({})) return trouble;
  if (!like_.empty()) {
    if (auto trouble = keep_attributes(file_->fd(), like_, old_)) return trouble;
  }
  return file_->make_durable();
}

// Writing takes time in which somebody else may have saved the file.
Trouble FileDraft::publish() {
  if (!seen_) return file_->move_to_free_place();
  if (auto trouble = check_replaceable(target_, *seen_)) return trouble;
  return file_->move_over();
}

UniqueFd FileDraft::reader() const { return file_ ? file_->reader() : UniqueFd(); }

}  // namespace gltfx
