// SPDX-License-Identifier: Apache-2.0
#include "input_paths.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

// The Error of a walk without assets.
Error no_assets(const InputWalk& walk) {
  constexpr std::size_t kMostNames = 3;
  const std::vector<std::string>& all = walk.without_assets();
  std::vector<std::string> names;
  for (const std::string& name : all) {
    if (names.size() < kMostNames) names.push_back(quoted(name, 200));
  }
  std::string text = fmt::format("no .gltf, .glb or .vrm in {}", fmt::join(names, ", "));
  if (all.size() > kMostNames) text += fmt::format(" and {} more", all.size() - kMostNames);
  if (walk.ignored() > 0)
    text += fmt::format(" ({} in .gitignore; see --no-ignore)", walk.ignored());
  return Error{text + ". Use --allow-empty if that is expected."};
}

}  // namespace

Result<Inputs> expand_paths(const NamedPaths& named, bool quiet) {
  InputWalk walk(named);
  Inputs inputs;
  bool found = false;
  while (auto input = walk.next_of_all()) {
    found = found || !input->unmatched;
    if (!input->ours) {
      inputs.paths_of_others.push_back(std::move(input->path));
      inputs.places_of_others.push_back(std::move(input->place));
      continue;
    }
    inputs.paths.push_back(std::move(input->path));
    inputs.places.push_back(std::move(input->place));
  }
  if (!found && !named.allow_empty && !walk.without_assets().empty()) return no_assets(walk);
  inputs.folders = walk.folders();
  inputs.searched = walk.searched();
  inputs.several = walk.several();
  if (!quiet) say_notes(walk);
  return inputs;
}

void say_notes(const InputWalk& walk) {
  for (const std::string& name : walk.without_assets()) {
    complain(fmt::format("note: no .gltf, .glb or .vrm in {}", quoted(name, 200)));
  }
  if (walk.ignored() > 0) {
    complain(fmt::format("note: {} asset{} left out, as .gitignore asks; --no-ignore includes them",
                         walk.ignored(), walk.ignored() == 1 ? " is" : "s are"));
  }
}

std::optional<Error> nothing_found(const NamedPaths& named) {
  if (named.allow_empty) return std::nullopt;
  InputWalk walk(named);
  while (const auto input = walk.next_of_all()) {
    if (!input->unmatched) return std::nullopt;
  }
  if (walk.without_assets().empty()) return std::nullopt;
  return no_assets(walk);
}

Result<std::string> read_list(const std::string& file) {
  if (file.empty()) return std::string();
  if (file != "-") return read_text_file(file, kLongestList);
  auto text = read_stdin(kLongestList);
  if (text) return text;
  return Error{"--files-from: cannot read standard input: " + text.error().message};
}

Result<std::uint64_t> look_ahead(const NamedPaths& named, std::vector<std::string> outputs,
                                 bool count) {
  std::error_code error;
  std::erase_if(outputs, [&](const std::string& output) {
    return output.empty() || !std::filesystem::exists(output, error);
  });
  std::uint64_t files = 0;
  if (outputs.empty() && !count) return files;
  InputWalk walk(named);
  while (const auto input = walk.next()) {
    ++files;
    for (const std::string& output : outputs) {
      if (!std::filesystem::equivalent(output, input->path, error)) continue;
      return Error{"the output " + quoted(output, 200) + " is an input of this run"};
    }
  }
  return files;
}

std::optional<Error> check_root(const std::string& root) {
  std::error_code error;
  if (root.empty() || std::filesystem::is_directory(root, error)) return std::nullopt;
  return Error{"--root: " + quoted(root, 200) + " is not a folder"};
}

}  // namespace gltfx::tool
