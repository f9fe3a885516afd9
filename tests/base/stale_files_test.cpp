// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/leftover.hpp"
#include "base/temporary_file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

std::set<std::string> names_in(const container::test::TempFolder& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.insert(entry.path().filename());
  }
  return names;
}

TEST(StaleFiles, OnlyThoseOfEndedProcessesGo) {
  const container::test::TempFolder folder;
  const pid_t dead = ended_process();
  const std::string gone = left_by(dead, "a.gltf", 0);
  const std::string own = temporary_name("a.gltf", 0);
  const std::string other_space = "a.gltf.feature" + own.substr(own.find('-'));
  std::set<std::string> stay{"a.gltf",
                             other_space,
                             left_by(::getppid(), "a.gltf", 0),
                             temporary_name("a.gltf", 0),
                             "a.gltf.part",
                             "a.gltf.x-0.part",
                             "a.gltf." + std::to_string(dead) + ".part",
                             gone + "ial"};
  for (const std::string& name : stay) folder.write(name, "x");
  folder.write(gone, "x");
  folder.write(left_by(dead, "a.gltf", 17), "x");
  folder.write(left_by(dead, "b.gltf", 0), "x");
  std::filesystem::last_write_time(
      folder.path() / other_space,
      std::filesystem::file_time_type::clock::now() - std::chrono::hours(25));
  std::filesystem::create_directory(folder.path() / left_by(dead, "folder", 0));
  stay.insert(left_by(dead, "folder", 0));
  remove_stale_files(folder.path() / "a.gltf");
  EXPECT_EQ(names_in(folder), stay);
}

TEST(StaleFiles, WhatAnotherMachineWritesStaysForADay) {
  const container::test::TempFolder folder;
  const std::string own = temporary_name("a.gltf", 0);
  const std::string elsewhere = "a.gltf.01234567" + own.substr(own.find('-'));
  const std::string forgotten = "a.gltf.01234567-1-0.part";
  ASSERT_NE(elsewhere, own);
  folder.write(elsewhere, "x");
  folder.write(forgotten, "x");
  std::filesystem::last_write_time(
      folder.path() / forgotten,
      std::filesystem::file_time_type::clock::now() - std::chrono::hours(25));
  remove_stale_files(folder.path() / "a.gltf");
  EXPECT_EQ(names_in(folder), std::set<std::string>{elsewhere});
}

}  // namespace
}  // namespace gltfx
