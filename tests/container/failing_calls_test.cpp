// SPDX-License-Identifier: Apache-2.0
// Whichever system call fails, a file is read whole or there is an error.
#include "base/support/failing_calls.hpp"

#include <cerrno>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "container/container.hpp"
#include "container/file.hpp"
#include "container/glb_builder.hpp"
#include "container/resolver.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container::test {
namespace {

using gltfx::test::Call;
using gltfx::test::fail_each_call;
using gltfx::test::FailingCall;

void expect_read_or_error(const Resolver& resolver, const std::string& path,
                          const std::string& content) {
  fail_each_call([&](Call call, int number) {
    FailingCall failing(call, number, EIO);
    const Resolved resolved = resolver.open(path);
    const bool failed = failing.stop();
    if (resolved.error == ResolveError::none) {
      EXPECT_TRUE(resolved.bytes.text() == content);
    } else {
      EXPECT_TRUE(failed);
      EXPECT_TRUE(resolved.bytes.text().empty());
    }
    return failed;
  });
}

TEST(FailingCalls, FilesOfAnAssetAreWholeOrErrors) {
  const TempFolder folder;
  const std::string large(kCopyBelow + 1, 'x');
  folder.write("sub/small.bin", "content");
  folder.write("sub/large.bin", large);
  folder.link("relative", "sub/small.bin");
  folder.link("absolute", folder.path() / "sub/small.bin");
  for (const Confinement confinement : {Confinement::automatic, Confinement::by_hand}) {
    const Resolver resolver(folder.path(), folder.path(), confinement);
    for (const char* path : {"sub/small.bin", "relative", "absolute"}) {
      expect_read_or_error(resolver, path, "content");
    }
    expect_read_or_error(resolver, "sub/large.bin", large);
  }
}

TEST(FailingCalls, AnAssetIsWholeOrAnError) {
  const TempFolder folder;
  const auto small = folder.write("small.gltf", "{}");
  const auto text = folder.write("large.gltf", "{" + std::string(kCopyBelow, ' ') + "}");
  const auto binary =
      folder.write("large.glb", glb(json_chunk() + bin_chunk(std::string(kCopyBelow, 'b'))));
  for (const auto& path : {small, text, binary}) {
    fail_each_call([&](Call call, int number) {
      FailingCall failing(call, number, EIO);
      const bool opened(open_file(path));
      const bool failed = failing.stop();
      EXPECT_EQ(opened, !failed);
      return failed;
    });
  }
}

TEST(FailingCalls, WhatMayNotBeReadIsSaidSo) {
  const TempFolder folder;
  folder.write("a.bin", "content");
  const Resolver resolver(folder.path(), folder.path(), Confinement::by_hand);
  for (const int error : {EACCES, EPERM}) {
    FailingCall failing(Call::openat, 1, error);
    const Resolved resolved = resolver.open("a.bin");
    EXPECT_TRUE(failing.stop());
    EXPECT_EQ(resolved.error, ResolveError::no_permission);
    EXPECT_EQ(resolved.problem, "");
  }
}

TEST(FailingCalls, AnAbsolutePathIsOutsideWhenTheWayBackIsBarred) {
  const TempFolder folder;
  const auto path = folder.write("a.bin", "content");
  const UniqueFd root(::open(folder.path().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  EXPECT_EQ(walk_beneath(root.get(), path).error, ResolveError::none);
  FailingCall failing(Call::open, 1, EIO);
  EXPECT_EQ(walk_beneath(root.get(), path).error, ResolveError::outside_root);
  EXPECT_TRUE(failing.stop());
}

TEST(FailingCalls, ReadingGoesOnAfterASignal) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", "{}");
  FailingCall failing(Call::pread, 1, EINTR);
  EXPECT_TRUE(open_file(path));
  EXPECT_TRUE(failing.stop());
}

}  // namespace
}  // namespace gltfx::container::test
