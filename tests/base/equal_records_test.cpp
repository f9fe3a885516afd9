// SPDX-License-Identifier: Apache-2.0
#include "base/equal_records.hpp"

#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EqualRecords, EachHasTheNumberOfTheFirstOne) {
  EXPECT_THAT(first_equal_records("abcabdabcab", 3), ElementsAre(0, 1, 0));
  EXPECT_THAT(first_equal_records("aaaa", 1), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(first_equal_records("", 4), IsEmpty());
}

TEST(EqualRecords, ManyAreFoundAsBySearch) {
  std::mt19937 random(7);
  for (const std::size_t size : {1U, 2U, 13U, 200U}) {
    std::string bytes;
    for (std::size_t i = 0; i < 500; ++i) {
      const std::string record(size, static_cast<char>(random() % 40));
      bytes += record;
      if (random() % 4 == 0) bytes.back() = static_cast<char>(random() % 256);
    }
    const auto first = first_equal_records(bytes, size);
    for (std::size_t i = 0; i < first.size(); ++i) {
      std::size_t j = 0;
      while (bytes.compare(j * size, size, bytes, i * size, size) != 0) ++j;
      EXPECT_EQ(first[i], j) << size << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace gltfx
