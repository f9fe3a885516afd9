// SPDX-License-Identifier: Apache-2.0
#include "edit_run.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "edit/companions.hpp"
#include "input_paths.hpp"
#include "json/parse.hpp"
#include "pipeline/open_asset.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// Why the copy that --backup made cannot take the place of the asset, or nothing. Links are
// followed to the asset, not to the copy.
std::optional<std::string> restore(const std::string& path) {
  std::error_code error;
  const fs::path copy = path + ".bak";
  const fs::file_status found = fs::symlink_status(copy, error);
  if (!fs::exists(found)) return "there is no " + quoted(copy.native(), 200);
  if (!fs::is_regular_file(found)) return quoted(copy.native(), 200) + " is not a regular file";
  const fs::path target = fs::canonical(path, error);
  if (!error) fs::rename(copy, target, error);
  if (error) return "cannot be restored: " + error.message();
  return std::nullopt;
}

// Files that the asset refers to, of which there are copies, too. Only those below its folder.
std::set<std::string> files_with_copies(const std::string& path) {
  std::set<std::string> files;
  const auto container =
      container::open_file(container::open_regular(AT_FDCWD, path.c_str(), O_NOFOLLOW), path);
  if (!container || !container->json) return files;
  const json::Parsed parsed = json::parse(container->json);
  if (parsed.document.empty()) return files;
  const fs::path named = fs::path(path).parent_path();
  const fs::path folder = named.empty() ? fs::path(".") : named;
  const container::Resolver resolver(folder, folder);
  for (const std::string& file : edit::referred_paths(parsed.document)) {
    std::uint64_t size = 0;
    const std::string copy = file + ".bak";
    if (resolver.stat(copy, size) != container::ResolveError::none) continue;
    // A link that leads elsewhere: what it leads to was never changed.
    if (resolver.stat(file, size) == container::ResolveError::outside_root) continue;
    files.insert((folder / file).native());
  }
  return files;
}

bool goes_into_file(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
}

// The asset comes last: until then it is the one that the new files go with.
std::optional<std::string> restore_with_files(const std::string& path) {
  for (const std::string& file : files_with_copies(path + ".bak")) {
    if (auto why = restore(file)) return why;
  }
  return restore(path);
}

}  // namespace

// A patch has tabs and carriage returns as they are; only a terminal obeys the latter.
std::string diff_text(std::string_view diff, bool raw) {
  if (raw || goes_into_file(STDOUT_FILENO)) return std::string(diff);
  const bool terminal = ::isatty(STDOUT_FILENO) != 0;
  std::string text;
  for (std::string_view rest = diff; !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of(terminal ? "\n\t" : "\n\t\r"), rest.size());
    text.append(printable(rest.substr(0, end))).append(rest.substr(end, 1));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (text != diff && !terminal) {
    complain(
        "note: the diff has escapes for characters that hide or reorder text; --raw prints them");
  }
  return text;
}

ExitCode restore_all(const EditRequest& request, const std::string& root) {
  const auto named = expand_paths(request.paths, request.quiet);
  if (!named) {
    complain(named.error().message);
    return ExitCode::usage;
  }
  ExitCode code = ExitCode::ok;
  for (const std::string& path : named->paths) {
    std::error_code error;
    const bool has_copy = fs::exists(fs::symlink_status(path + ".bak", error));
    if (named->several && !has_copy) continue;
    if (const auto file = open_asset_file(path, {root, named->searched}); !file) {
      complain(fmt::format("{}: {}", printable(path), printable(file.error().message)));
      code = worse(code, ExitCode::unreadable);
    } else if (const auto why = restore_with_files(path)) {
      complain(fmt::format("{}: {}", printable(path), printable(*why)));
      code = worse(code, ExitCode::internal);
    } else if (!request.quiet) {
      code = worse(code, print(printable(path) + ": restored\n"));
    }
  }
  return code;
}

ExitCode exit_code_of(EditProblem problem) {
  if (problem == EditProblem::unreadable) return ExitCode::unreadable;
  return problem == EditProblem::refused ? ExitCode::findings : ExitCode::internal;
}

}  // namespace gltfx::tool
