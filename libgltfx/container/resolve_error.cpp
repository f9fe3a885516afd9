// SPDX-License-Identifier: Apache-2.0
#include "container/resolve_error.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t kShownPath = 200;

struct Wording {
  ResolveError error;
  std::string_view statement;  ///< follows the path
  std::string_view help;
};

constexpr std::array kWordings{
    Wording{ResolveError::none, "can be read", ""},
    Wording{ResolveError::not_found, "does not exist",
            "correct the path, including upper and lower case, or add the file"},
    Wording{ResolveError::outside_root, "is outside the folder of the asset",
            "move the file to the folder of the asset, or set a common parent folder with --root"},
    Wording{ResolveError::not_regular, "is not a regular file",
            "use a regular file, not a folder, pipe, socket or device"},
    Wording{ResolveError::no_permission, "cannot be read: permission denied",
            "grant read permission for the file and its folders"},
    Wording{ResolveError::no_root, "is not checked because standard input has no folder",
            "set the folder of external files with --root, or pass the asset as a path"},
    Wording{ResolveError::io_error, "cannot be read",
            "check the disk or network share and try again"},
    Wording{ResolveError::truncated, "became shorter while it was read",
            "try again when the file is complete"},
    Wording{ResolveError::too_large, "is too large",
            "raise the size limit, free memory, or split the file"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kWordings.size(); ++i) {
    if (kWordings[i].error != static_cast<ResolveError>(i)) return false;
  }
  return true;
}
static_assert(in_order());

const Wording& wording(ResolveError error) { return kWordings[static_cast<std::size_t>(error)]; }

}  // namespace

ResolveError error_of_errno(int error) {
  switch (error) {
    case 0:
      return ResolveError::none;
    case ENOENT:
    case ENOTDIR:
    case ENAMETOOLONG:
      return ResolveError::not_found;
    case EXDEV:
      return ResolveError::outside_root;
    case ENXIO:
    case EISDIR:
      return ResolveError::not_regular;
    case EACCES:
    case EPERM:
      return ResolveError::no_permission;
    case ENOMEM:
    case EFBIG:
    case EOVERFLOW:
      return ResolveError::too_large;
    default:
      return ResolveError::io_error;
  }
}

std::string errno_text(int error) { return std::generic_category().message(error); }

std::string describe(ResolveError error, std::string_view path, std::string_view problem) {
  const std::string name = quoted(path, kShownPath);
  if (problem.empty()) return fmt::format("{} {}.", name, wording(error).statement);
  return fmt::format("{} {}: {}.", name, wording(error).statement, printable(problem));
}

std::string_view help(ResolveError error) { return wording(error).help; }

}  // namespace gltfx::container
