// SPDX-License-Identifier: Apache-2.0
/// gltfx_manual FOLDER DATE: manual pages and completions of gltfx, made from the tables of its
/// command line.
#include <gltfx/version.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "pages.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

bool write(const fs::path& path, const std::string& text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (file && !text.empty()) return true;
  std::cerr << "gltfx_manual: " << path.native()
            << (text.empty() ? " has no text\n" : " cannot be written\n");
  return false;
}

bool write_all(const fs::path& folder, const std::string& date) {
  const std::vector<CommandEntry> table = command_table();
  const Edition edition{date, std::string(version())};
  bool done = write(folder / "man5/gltfx.toml.5", config_page(edition));
  for (const CommandEntry& command : table) {
    const std::string name = page_of(command) + ".1";
    done = write(folder / "man1" / name, command_page(table, command, edition)) && done;
  }
  done = write(folder / "completions/bash/gltfx", bash_completion(table)) && done;
  done = write(folder / "completions/zsh/_gltfx", zsh_completion(table)) && done;
  return write(folder / "completions/fish/gltfx.fish", fish_completion(table)) && done;
}

}  // namespace
}  // namespace gltfx::tool

int main(int count, char** words) {
  if (count == 3) return gltfx::tool::write_all(words[1], words[2]) ? 0 : 1;
  std::cerr << "usage: gltfx_manual FOLDER DATE\n";
  return 2;
}
