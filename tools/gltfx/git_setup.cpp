// SPDX-License-Identifier: Apache-2.0
#include "git_setup.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "git.hpp"
#include "output.hpp"
#include "path_pattern.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

struct GitSetting {
  const char* key;
  const char* value;
};

constexpr std::array<GitSetting, 4> kSettings{{
    {"diff.gltfx.command", "gltfx compare --git-driver"},
    {"diff.gltfx.textconv", "gltfx inspect --format outline"},
    {"diff.gltfx.cachetextconv", "true"},
    {"difftool.gltfx.cmd",
     "page=$(gltfx compare --git-driver \"$MERGED\" \"$LOCAL\" \"$REMOTE\") && "
     "echo \"$page\" && git web--browse \"$page\""},
}};
constexpr std::array<std::string_view, 3> kEndings{".glb", ".gltf", ".vrm"};

constexpr std::string_view kUnset = "-diff";

// Takes the first word of a line.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kSpace = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

// What the attributes of git say about `diff` of a file with that name: "diff=lfs", "-diff", or
// nothing.
std::string diff_attribute(std::string_view attributes, std::string_view name) {
  std::string found;
  while (!attributes.empty()) {
    const std::size_t end = std::min(attributes.find('\n'), attributes.size());
    std::string_view line = attributes.substr(0, end);
    attributes.remove_prefix(std::min(end + 1, attributes.size()));
    const std::string_view pattern = take_word(line);
    if (pattern.empty() || pattern.front() == '#' || !fits_pattern(pattern, name)) continue;
    for (auto word = take_word(line); !word.empty(); word = take_word(line)) {
      if (word == "diff" || word.starts_with("diff=")) found = word;
      if (word == kUnset || word == "binary") found = kUnset;
      if (word == "!diff") found.clear();
    }
  }
  return found;
}

/// Does what is to be done, and keeps count of it.
class GitSetup {
 public:
  explicit GitSetup(bool global) : global_(global) {}

  ExitCode execute() {
    const auto file = attributes_file();
    if (!file) {
      complain(file.error().message);
      return ExitCode::usage;
    }
    write_attributes(*file);
    for (const GitSetting& setting : kSettings) write_setting(setting);
    if (text_.empty() && code_ == ExitCode::ok) text_ = "nothing to do: git is set up\n";
    return worse(code_, print(text_));
  }

 private:
  void fail(const std::string& message, ExitCode code) {
    complain(message);
    code_ = worse(code_, code);
  }

  Result<std::string> attributes_file() const {
    if (!global_) {
      const auto top = Git(".").run({"rev-parse", "--show-toplevel"});
      if (!top) return Error{"--setup-git: " + top.error().message};
      if (top->code != 0 || top->out.size() < 2) {
        return Error{"--setup-git: the working directory is in no working tree of git"};
      }
      return top->out.substr(0, top->out.size() - 1) + "/.gitattributes";
    }
    const auto named =
        Git(".").run({"config", "--global", "--type=path", "--get", "core.attributesFile"});
    if (!named) return Error{"--setup-git: " + named.error().message};
    if (named->code == 0 && named->out.size() > 1) {
      return named->out.substr(0, named->out.size() - 1);
    }
    const char* folder = std::getenv("XDG_CONFIG_HOME");
    if (folder != nullptr && *folder != '\0') return std::string(folder) + "/git/attributes";
    const char* home = std::getenv("HOME");
    if (home == nullptr || *home == '\0') return Error{"--setup-git: HOME is not set"};
    return std::string(home) + "/.config/git/attributes";
  }

  // Later lines count, so that new ones at the end replace "diff=lfs" of `git lfs track`, which has
  // no effect.
  void write_attributes(const std::string& file) {
    std::error_code error;
    std::string attributes;
    if (!global_ && fs::is_symlink(file, error)) {
      return fail(fmt::format("{} is a symbolic link, which git does not read", printable(file)),
                  ExitCode::findings);
    }
    if (fs::exists(file, error)) {
      auto read = read_text_file(file, kLongestConfig);
      if (!read) return fail(read.error().message, ExitCode::unreadable);
      attributes = *std::move(read);
    }
    std::string added;
    for (const std::string_view ending : kEndings) {
      const std::string found = diff_attribute(attributes, fmt::format("model{}", ending));
      if (found == "diff=gltfx") continue;
      if (found.empty() || found == "diff=lfs") {
        added += fmt::format("*{} diff=gltfx\n", ending);
      } else {
        fail(fmt::format("{} has {} for *{}, which stays; wanted: diff=gltfx", printable(file),
                         printable(found), ending),
             ExitCode::findings);
      }
    }
    if (added.empty()) return;
    const bool open_line = !attributes.empty() && !attributes.ends_with('\n');
    Output output(file, true);
    output.write(attributes + (open_line ? "\n" : "") + added);
    output.finish();
    if (!output.problem().empty()) return fail(output.problem(), ExitCode::internal);
    text_ += fmt::format("{}:\n", printable(file));
    for (std::string_view rest = added; !rest.empty();) {
      const std::size_t end = rest.find('\n') + 1;
      text_ += fmt::format("  {}", rest.substr(0, end));
      rest.remove_prefix(end);
    }
  }

  void write_setting(const GitSetting& setting) {
    const char* scope = global_ ? "--global" : "--local";
    const auto known = Git(".").run({"config", scope, "--get", setting.key});
    if (!known) return fail(known.error().message, ExitCode::unreadable);
    if (known->code == 0) {
      const std::string value = known->out.substr(0, known->out.find('\n'));
      if (value == setting.value) return;
      return fail(fmt::format("{} is {}, which stays; wanted: {}", setting.key, printable(value),
                              setting.value),
                  ExitCode::findings);
    }
    const auto written = Git(".").run({"config", scope, setting.key, setting.value});
    if (!written || written->code != 0) {
      return fail(fmt::format("git cannot write {}", setting.key), ExitCode::internal);
    }
    text_ += fmt::format("git config {} {} '{}'\n", scope, setting.key, setting.value);
  }

  const bool global_;
  std::string text_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode set_up_git(bool global) { return GitSetup(global).execute(); }

}  // namespace gltfx::tool
