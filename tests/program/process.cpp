// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "container/temp_folder.hpp"

namespace gltfx::program {
namespace {

void redirect(int fd, const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, fd) < 0) ::_exit(126);
  ::close(file);
}

[[noreturn]] void become(const std::vector<std::string>& words, const Setting& setting,
                         const std::string& io) {
  redirect(STDIN_FILENO, io + "/in", O_RDONLY);
  redirect(STDOUT_FILENO, io + "/out", O_WRONLY | O_CREAT);
  redirect(STDERR_FILENO, io + "/err", O_WRONLY | O_CREAT);
  if (!setting.folder.empty() && ::chdir(setting.folder.c_str()) != 0) ::_exit(126);
  // Not the key of the user who runs the tests.
  const auto build = std::filesystem::path(program()).parent_path().parent_path();
  ::setenv("XDG_STATE_HOME", (build / "tests/state").c_str(), 1);
  ::unsetenv("GLTFX_CACHE_KEY");
  for (const auto& [name, value] : setting.environment) {
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments.front(), arguments.data());
  ::_exit(127);
}

}  // namespace

const std::string kSound = R"({"asset": {"version": "2.0"}, "scenes": [{"name": "empty"}]})";
const std::string kInfo = R"({"asset": {"version": "2.0"}, "materials": [{"name": "spare"}]})";
const std::string kWarning =
    R"({"asset": {"version": "2.0"}, "scenes": [{"name": "empty", "colour": 1}]})";
const std::string kFaulty =
    R"({"asset": {"version": "2.0"}, "cameras": [{"name": "eye", "type": "perspective",
 "perspective": {"yfov": -1, "znear": 0.1}}], "nodes": [{"camera": 0}], "scenes": [{"nodes": [0]}]})";

Outcome run(const std::vector<std::string>& words, const Setting& setting) {
  const container::test::TempFolder folder;
  const std::string io = folder.path().native();
  folder.write("in", setting.input);
  const pid_t child = ::fork();
  if (child == 0) become(words, setting, io);
  int status = 0;
  struct rusage usage {};
  ::wait4(child, &status, 0, &usage);
  Outcome outcome;
  outcome.peak_kib = usage.ru_maxrss;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_file(io + "/out");
  outcome.err = read_file(io + "/err");
  return outcome;
}

Outcome gltfx(std::vector<std::string> arguments, const Setting& setting) {
  ::unsetenv("NO_COLOR");
  arguments.insert(arguments.begin(), program());
  return run(arguments, setting);
}

Outcome bash(const std::string& line, const Setting& setting) {
  Setting with_program = setting;
  with_program.environment.emplace_back("GLTFX", program());
  return run({"bash", "-c", line}, with_program);
}

std::string program() { return GLTFX_PROGRAM; }

std::string fixture(std::string_view name) {
  return std::string(GLTFX_SOURCE_DIR "/fixtures/").append(name);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace gltfx::program
