// SPDX-License-Identifier: Apache-2.0
#include "container/resolve_fault.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t kShownPath = 200;

struct Wording {
  ResolveFault fault;
  std::string_view statement;  ///< follows the path
  std::string_view help;
};

constexpr std::array kWordings{
    Wording{ResolveFault::none, "can be read", ""},
    Wording{ResolveFault::not_found, "does not exist",
            "correct the path, including upper and lower case, or add the file"},
    Wording{ResolveFault::outside_root, "is outside the folder of the asset",
            "move the file to the folder of the asset, or set a common parent folder with --root"},
    Wording{ResolveFault::not_regular, "is not a regular file",
            "use a regular file, not a folder, pipe, socket or device"},
    Wording{ResolveFault::no_permission, "cannot be read: permission denied",
            "grant read permission for the file and its folders"},
    Wording{ResolveFault::no_root, "is not checked because standard input has no folder",
            "set the folder of external files with --root, or pass the asset as a path"},
    Wording{ResolveFault::io_error, "cannot be read",
            "check the disk or network share and try again"},
    Wording{ResolveFault::truncated, "became shorter while it was read",
            "try again when the file is complete"},
    Wording{ResolveFault::too_large, "is too large",
            "raise the size limit, free memory, or split the file"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kWordings.size(); ++i) {
    if (kWordings[i].fault != static_cast<ResolveFault>(i)) return false;
  }
  return true;
}
static_assert(in_order());

const Wording& wording(ResolveFault fault) { return kWordings[static_cast<std::size_t>(fault)]; }

}  // namespace

ResolveFault fault_of_errno(int error) {
  switch (error) {
    case 0:
      return ResolveFault::none;
    case ENOENT:
    case ENOTDIR:
    case ENAMETOOLONG:
      return ResolveFault::not_found;
    case EXDEV:
      return ResolveFault::outside_root;
    case ENXIO:
    case EISDIR:
      return ResolveFault::not_regular;
    case EACCES:
    case EPERM:
      return ResolveFault::no_permission;
    case ENOMEM:
    case EFBIG:
    case EOVERFLOW:
      return ResolveFault::too_large;
    default:
      return ResolveFault::io_error;
  }
}

std::string errno_text(int error) { return std::generic_category().message(error); }

std::string describe(ResolveFault fault, std::string_view path, std::string_view problem) {
  const std::string name = quoted(path, kShownPath);
  if (problem.empty()) return fmt::format("{} {}.", name, wording(fault).statement);
  return fmt::format("{} {}: {}.", name, wording(fault).statement, printable(problem));
}

std::string_view help(ResolveFault fault) { return wording(fault).help; }

}  // namespace gltfx::container
