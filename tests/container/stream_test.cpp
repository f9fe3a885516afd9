// SPDX-License-Identifier: Apache-2.0
#include "container/stream.hpp"

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "container/file.hpp"

namespace gltfx::container {
namespace {

using testing::HasSubstr;

/// Writes `content` into a pipe from another thread, after a pause, and reads it back.
Result<Bytes> through_pipe(const std::string& content, std::uint64_t max_bytes, int flags = 0) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const UniqueFd reading(ends[0]);
  EXPECT_EQ(::fcntl(reading.get(), F_SETFL, flags), 0);
  std::thread writer([&content, to = ends[1]] {
    const UniqueFd writing(to);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    for (std::size_t done = 0; done < content.size();) {
      const ssize_t put = ::write(writing.get(), content.data() + done, content.size() - done);
      if (put <= 0) break;
      done += static_cast<std::size_t>(put);
    }
  });
  Result<Bytes> bytes = read_stream(reading.get(), max_bytes);
  std::array<char, 4096> rest{};
  while (!bytes && ::read(reading.get(), rest.data(), rest.size()) > 0) {
  }
  writer.join();
  return bytes;
}

TEST(ReadStream, ReadsToTheEnd) {
  for (const std::size_t size : {0U, 1U, 65536U, 300001U}) {
    const std::string content(size, 'c');
    const auto bytes = through_pipe(content, UINT64_MAX);
    ASSERT_TRUE(bytes);
    EXPECT_TRUE(bytes->text() == content);
  }
}

TEST(ReadStream, WaitsWhereTheDescriptorDoesNotBlock) {
  const auto bytes = through_pipe("late", UINT64_MAX, O_NONBLOCK);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->text(), "late");
}

TEST(ReadStream, MoreThanTheLimitIsAnError) {
  EXPECT_TRUE(through_pipe("12345", 5));
  const auto bytes = through_pipe("123456", 5);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("limit of 5 bytes"));
}

TEST(ReadStream, ABadDescriptorIsAnError) {
  const auto bytes = read_stream(-1, 5);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace gltfx::container
