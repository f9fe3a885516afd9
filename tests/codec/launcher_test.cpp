// SPDX-License-Identifier: Apache-2.0
/// Checks of the decoder programs from outside.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "codec/packet.hpp"
#include "codec/process.hpp"
#include "codec/program_path.hpp"

namespace gltfx::codec {
namespace {

// A worker is a fork of it: a fork keeps the locks of other threads, but not the threads.
TEST(Launchers, HaveOneThread) {
  for (const char* name : {"gltfx-codec-draco", "gltfx-codec-image", "gltfx-codec-openimageio"}) {
    const Process launcher(program_path("", name));
    ASSERT_TRUE(launcher.started()) << name;
    ASSERT_TRUE(receive_packet(launcher.socket())) << name << " does not greet";
    const std::filesystem::path tasks = "/proc/" + std::to_string(launcher.id()) + "/task";
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(tasks), {}), 1) << name;
  }
}

}  // namespace
}  // namespace gltfx::codec
