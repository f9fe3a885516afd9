// SPDX-License-Identifier: Apache-2.0
// One file content for all its users.
#include "change/shared_bytes.hpp"

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gltfx::change {
namespace {

using ByteSet = std::set<std::uint64_t>;

ByteSet bytes_of(const std::vector<ByteRange>& ranges) {
  ByteSet bytes;
  for (const ByteRange& range : ranges) {
    for (std::uint64_t at = range.begin; at < range.end; ++at) bytes.insert(at);
  }
  return bytes;
}

ByteSet bytes_of(const FileReads& reads) {
  ByteSet bytes;
  for (const ByteRead& read : reads.parts) {
    for (std::uint64_t i = 0; i < read.count; ++i) {
      for (std::uint64_t b = 0; b < read.size; ++b) bytes.insert(read.begin + i * read.stride + b);
    }
  }
  return bytes;
}

FileReads all_of(std::uint64_t begin, std::uint64_t end) {
  return {false, {{begin, end - begin, 0, 1}}};
}

TEST(SharedBytes, DifferencesAreTheBytesThatDiffer) {
  EXPECT_EQ(bytes_of(differences("abcdef", "abXdeY")), (ByteSet{2, 5}));
  EXPECT_EQ(bytes_of(differences("abc", "abc")), ByteSet());
  EXPECT_EQ(bytes_of(differences("abc", "aXcde")), (ByteSet{1, 3, 4}));
}

// Compares with a simple check of every byte of every element.
TEST(SharedBytes, ARangeIsReadWhereAnElementHasAByteOfIt) {
  std::mt19937 random(7);
  const auto below = [&](unsigned limit) { return std::uint64_t{random() % limit}; };
  for (int trial = 0; trial < 2000; ++trial) {
    FileReads reads;
    for (int i = 0; i < 3; ++i) {
      const std::uint64_t size = below(5);
      reads.parts.push_back({below(40), size, size + below(8), below(6)});
    }
    std::vector<ByteRange> ranges;
    for (std::uint64_t at = below(6); at < 60; at += below(6) + 1) {
      const std::uint64_t end = at + 1 + below(4);
      ranges.push_back({at, end});
      at = end;
    }
    const ByteSet read = bytes_of(reads);
    ByteSet expected;
    for (const ByteRange& range : ranges) {
      for (std::uint64_t at = range.begin; at < range.end; ++at) {
        if (read.contains(at)) expected.insert(range.begin);
      }
    }
    ByteSet found;
    for (const ByteRange& range : ranges_read(reads, ranges)) found.insert(range.begin);
    ASSERT_EQ(found, expected) << trial;
  }
}

TEST(SharedBytes, EverythingIsReadWhereNobodyCanTell) {
  EXPECT_EQ(ranges_read({true, {}}, {{0, 1}, {5, 6}}).size(), 2U);
  EXPECT_EQ(ranges_read({false, {{UINT64_MAX - 1, 4, UINT64_MAX, UINT64_MAX}}}, {{0, 9}}).size(),
            0U);
}

TEST(SharedBytes, ChangesOfAllComeTogether) {
  const std::string before = "aaaaaaaa";
  const MergedFile merged = merge_changes(before, {{"bbaaaaaa", all_of(0, 2)},
                                                   {"aaaaaaab", all_of(6, 8)},
                                                   {"bbaaaaaa", all_of(0, 4)},
                                                   {before, all_of(2, 6)}});
  EXPECT_EQ(merged.content, "bbaaaaab");
  EXPECT_TRUE(merged.conflicts.empty());
}

TEST(SharedBytes, WhoReadsOtherBytesThanItWantsIsInConflict) {
  const std::string before = "aaaaaaaa";
  for (const bool changes : {true, false}) {
    const MergedFile merged =
        merge_changes(before, {{"bbaaaaaa", all_of(0, 2)}, {before, all_of(1, 5), changes}});
    ASSERT_EQ(merged.conflicts.size(), 1U);
    EXPECT_EQ(merged.conflicts[0].user, 1U);
    EXPECT_TRUE(bytes_of(merged.conflicts[0].ranges).contains(1));
  }
  const MergedFile two =
      merge_changes(before, {{"baaaaaaa", all_of(0, 1)}, {"caaaaaaa", all_of(0, 1)}});
  EXPECT_FALSE(two.conflicts.empty());
}

// Changes of a user that only reads are not written, and cause no conflict.
TEST(SharedBytes, LookersOnChangeNothing) {
  const std::string before = "aaaaaaaa";
  const MergedFile merged =
      merge_changes(before, {{"bbaaaaaa", all_of(0, 2)}, {"bbaaaaac", all_of(0, 8), false}});
  EXPECT_EQ(merged.content, "bbaaaaaa");
  EXPECT_TRUE(merged.conflicts.empty());
}

}  // namespace
}  // namespace gltfx::change
