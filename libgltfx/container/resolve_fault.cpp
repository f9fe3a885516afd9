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
  std::string_view remedy;
};

constexpr std::array kWordings{
    Wording{ResolveFault::none, "can be read", ""},
    Wording{ResolveFault::not_found, "does not exist",
            "Check the spelling, upper and lower case included, and that the file was shipped."},
    Wording{ResolveFault::outside_root, "lies outside the folder that may be read",
            "Move the file into the asset's folder, or name a common parent folder with --root."},
    Wording{ResolveFault::not_regular, "is not a regular file",
            "Name a file; folders, pipes, sockets and devices are not read."},
    Wording{ResolveFault::no_permission, "may not be read",
            "Give yourself permission to read it, and to enter the folders above it."},
    Wording{ResolveFault::no_root, "is not looked up, because standard input has no folder",
            "Name the folder that external files lie in with --root, or pass the asset by path."},
    Wording{ResolveFault::io_error, "cannot be read",
            "Check the disk or network share it lies on and try again."},
    Wording{ResolveFault::truncated, "became shorter while it was read",
            "Wait until whatever writes the file has finished and try again."},
    Wording{ResolveFault::too_large, "is too large to be read",
            "Raise the size limit or free memory, or split the file."},
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

std::string_view remedy(ResolveFault fault) { return wording(fault).remedy; }

}  // namespace gltfx::container
