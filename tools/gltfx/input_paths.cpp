// SPDX-License-Identifier: Apache-2.0
#include "input_paths.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "base/text.hpp"
#include "commands.hpp"
#include "read_input.hpp"

namespace gltfx::tool {

Inputs expand_paths(const NamedPaths& named, bool quiet) {
  InputWalk walk(named);
  Inputs inputs;
  while (auto input = walk.next_of_all()) {
    if (!input->ours) {
      inputs.places_of_others.push_back(std::move(input->place));
      continue;
    }
    inputs.paths.push_back(std::move(input->path));
    inputs.places.push_back(std::move(input->place));
  }
  inputs.folders = walk.folders();
  inputs.several = walk.several();
  inputs.notes = walk.notes();
  if (!quiet) say_notes(walk);
  return inputs;
}

void say_notes(const InputWalk& walk) {
  for (const std::string& note : walk.notes()) complain("note: " + note);
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
  std::error_code fault;
  std::erase_if(outputs, [&](const std::string& output) {
    return output.empty() || !std::filesystem::exists(output, fault);
  });
  std::uint64_t files = 0;
  if (outputs.empty() && !count) return files;
  InputWalk walk(named);
  while (const auto input = walk.next()) {
    ++files;
    for (const std::string& output : outputs) {
      if (!std::filesystem::equivalent(output, input->path, fault)) continue;
      return Error{"the output " + quoted(output, 200) + " is a file that is to be checked"};
    }
  }
  return files;
}

std::optional<Error> check_root(const std::string& root) {
  std::error_code fault;
  if (root.empty() || std::filesystem::is_directory(root, fault)) return std::nullopt;
  return Error{"--root: " + quoted(root, 200) + " is not a folder"};
}

}  // namespace gltfx::tool
