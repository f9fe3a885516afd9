// SPDX-License-Identifier: Apache-2.0
#include "base/stale_files.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

// The number of a process that runs no more.
std::string ended_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return std::to_string(child);
}

TEST(StaleFiles, OnlyThoseOfEndedProcessesAndOfThatNameGo) {
  const container::test::TempFolder folder;
  const std::string dead = ended_process();
  const std::string alive = std::to_string(::getppid());
  const std::string own = std::to_string(::getpid());
  const std::set<std::string> stay{"a.gltf",
                                   "b.gltf." + dead + "-0.part",
                                   "a.gltf." + alive + "-0.part",
                                   "a.gltf." + own + "-0.part",
                                   "a.gltf.part",
                                   "a.gltf.x-0.part",
                                   "a.gltf." + dead + ".part",
                                   "a.gltf." + dead + "-0.partial"};
  for (const std::string& name : stay) folder.write(name, "x");
  folder.write("a.gltf." + dead + "-0.part", "x");
  folder.write("a.gltf." + dead + "-17.part", "x");
  remove_stale_files(folder.path() / "a.gltf");
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    left.insert(entry.path().filename());
  }
  EXPECT_EQ(left, stay);
}

}  // namespace
}  // namespace gltfx
