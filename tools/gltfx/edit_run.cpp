// SPDX-License-Identifier: Apache-2.0
#include "edit_run.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.hpp"
#include "change/backup.hpp"
#include "input_paths.hpp"
#include "pipeline/open_asset.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

bool goes_into_file(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

// A patch keeps tabs and carriage returns; only a terminal interprets the latter.
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

std::string external_assets_text(const EditOutcome& report, std::string_view what) {
  constexpr std::size_t kMost = 8;
  const std::vector<std::string>& assets = report.external_assets;
  if (assets.empty()) return {};
  std::string text = fmt::format("{}: {}: ", report.path, what);
  for (std::size_t i = 0; i < std::min(assets.size(), kMost); ++i) {
    text.append(i == 0 ? "" : ", ").append(assets[i]);
  }
  if (assets.size() > kMost) text += fmt::format(" and {} more", assets.size() - kMost);
  return printable(text);
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
    const bool has_copy = fs::exists(fs::symlink_status(change::backup_of(path), error));
    if (named->several && !has_copy) continue;
    if (const auto file = open_asset_file(path, {root, named->searched}); !file) {
      complain(fmt::format("{}: {}", printable(path), printable(file.error().message)));
      code = worse(code, ExitCode::unreadable);
    } else if (const auto why = change::restore(path)) {
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
