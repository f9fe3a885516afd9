// SPDX-License-Identifier: Apache-2.0
#include "base/shared_text.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/pages.hpp"

namespace gltfx {
namespace {

TEST(SharedText, KeepsTheTextAsLongAsSomebodyHasIt) {
  SharedText copy;
  {
    const SharedText text = share_text(std::string(100, 'x'));
    copy = text;
  }
  EXPECT_EQ(*copy, std::string(100, 'x'));
  EXPECT_EQ(copy->data()[100], '\0');
}

TEST(SharedText, ARoomIsSharedWithANulBehindIt) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{9} << 20U}) {
    TextRoom room(size);
    ASSERT_TRUE(room);
    std::memset(room.data(), 'a', size);
    const SharedText text = std::move(room).share();
    EXPECT_EQ(text->size(), size);
    EXPECT_EQ(text->find_first_not_of('a'), std::string_view::npos);
    EXPECT_EQ(text->data()[size], '\0');
  }
}

TEST(SharedText, ARoomThatIsTooLargeIsNone) { EXPECT_FALSE(TextRoom(SIZE_MAX)); }

TEST(PageAllocator, GrowsAcrossTheSizeWhereHugePagesBegin) {
  std::vector<std::uint32_t, PageAllocator<std::uint32_t>> numbers;
  for (std::uint32_t i = 0; i < 3'000'000; ++i) numbers.push_back(i);
  for (std::uint32_t i = 0; i < 3'000'000; i += 4999) ASSERT_EQ(numbers[i], i);
  numbers.resize(10);
  numbers.shrink_to_fit();
  EXPECT_EQ(numbers.back(), 9U);
}

}  // namespace
}  // namespace gltfx
