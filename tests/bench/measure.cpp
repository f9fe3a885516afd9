// SPDX-License-Identifier: Apache-2.0
// Runs whole programs by turns and prints, one line a program:
//   median seconds, median seconds of processor time, peak resident KiB, exit code
//
//   measure REPEATS -- PROGRAM ARG... -- PROGRAM ARG...
//
// Taking turns makes a busy machine slow all of them equally. Standard output goes to /dev/null.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

extern char** environ;

namespace {

struct Program {
  std::vector<char*> words;  ///< with the closing null
  std::vector<double> seconds;
  std::vector<double> processor_seconds;
  long peak_kib = 0;
  int exit_code = 0;
};

std::vector<Program> read_programs(int argc, char** argv) {
  std::vector<Program> programs;
  for (int i = 2; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--") {
      programs.emplace_back();
    } else if (!programs.empty()) {
      programs.back().words.push_back(argv[i]);
    }
  }
  for (Program& program : programs) program.words.push_back(nullptr);
  return programs;
}

double seconds_of(const struct timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool run(Program& program) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, program.words[0], &files, nullptr, program.words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return false;
  int status = 0;
  struct rusage usage {};
  if (wait4(child, &status, 0, &usage) != child) return false;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  program.seconds.push_back(spent.count());
  program.processor_seconds.push_back(seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime));
  program.peak_kib = std::max(program.peak_kib, usage.ru_maxrss);
  program.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 0;
  std::vector<Program> programs = read_programs(argc, argv);
  if (repeats < 1 || programs.empty()) return 2;
  for (int i = 0; i < repeats; ++i) {
    for (Program& program : programs) {
      if (program.words[0] == nullptr || !run(program)) return 3;
    }
  }
  for (Program& program : programs) {
    std::printf("%.6f %.6f %ld %d\n", median(program.seconds), median(program.processor_seconds),
                program.peak_kib, program.exit_code);
  }
  return 0;
}
