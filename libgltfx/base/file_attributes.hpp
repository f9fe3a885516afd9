// SPDX-License-Identifier: Apache-2.0
/// What a file has beside its bytes, and would lose when another one takes its place.
#pragma once

#include <filesystem>
#include <optional>

#include "base/result.hpp"

struct stat;

namespace gltfx {

/// Gives the open file `fd` the owner, permissions and extended attributes (access control lists
/// and security labels among them) of the file at `old`, whose `status` the caller has. An access
/// control list that `fd` inherited from its folder goes when `old` has none. Attributes that hold
/// a hash of the old bytes (IMA, EVM) are not copied: the system makes new ones. Permissions come
/// last, so that the file is never open to more users than the old one. Nothing when all is kept,
/// else the first thing that is not.
std::optional<Error> keep_attributes(int fd, const std::filesystem::path& old,
                                     const struct stat& status);

}  // namespace gltfx
