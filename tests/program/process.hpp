// SPDX-License-Identifier: Apache-2.0
/// Runs a program and keeps its output.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gltfx::program {

/// How a program ended and what it wrote.
struct Outcome {
  int code = -1;  ///< exit code; 128 + signal when one ended it
  std::string out;
  std::string err;
  long peak_kib = 0;  ///< most memory that was resident
};

struct Setting {
  std::string folder;  ///< working directory; empty: that of the test
  std::string input;   ///< standard input
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to the test's own
};

/// Runs `words` (the first is looked up on the PATH) and waits for the end.
Outcome run(const std::vector<std::string>& words, const Setting& setting = {});

/// Runs gltfx. NO_COLOR is taken out of the environment.
Outcome gltfx(std::vector<std::string> arguments, const Setting& setting = {});

/// Runs a line of bash; "$GLTFX" is the program.
Outcome bash(const std::string& line, const Setting& setting = {});

/// The path of the built program.
std::string program();
/// A file below fixtures/.
std::string fixture(std::string_view name);

// Small assets: without any finding, with one info (an unused object), one warning (an unknown
// member), one error (a number out of range).
extern const std::string kSound;
extern const std::string kInfo;
extern const std::string kWarning;
extern const std::string kFaulty;

std::string read_file(const std::string& path);

}  // namespace gltfx::program
