// SPDX-License-Identifier: Apache-2.0
// New images from sources that are missing, do not match or cannot be encoded.
#include "steps/upgrade/render.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::upgrade {
namespace {

using testing::HasSubstr;

// Images with one channel of zeros and one row; the last one may have more rows.
class Zeros : public Pictures {
 public:
  explicit Zeros(std::vector<std::uint32_t> widths, std::uint32_t last_height = 1)
      : widths_(std::move(widths)), last_height_(last_height) {}
  const Picture& picture(std::uint64_t image) override {
    picture_.problem = image < widths_.size() ? "" : "it is gone";
    return picture_;
  }
  std::shared_ptr<const codec::Image> pixels(std::uint64_t image) override {
    if (image >= widths_.size()) return nullptr;
    auto made = std::make_shared<codec::Image>();
    made->width = widths_[image];
    made->height = image + 1 == widths_.size() ? last_height_ : 1;
    made->channels = 1;
    made->bits = 8;
    auto owned = std::make_shared<std::vector<std::byte>>(std::size_t{made->width} * made->height);
    made->pixels = *owned;
    made->owner = owned;
    return made;
  }
  std::uint64_t same_as(std::uint64_t image) override { return image; }

 private:
  std::vector<std::uint32_t> widths_;
  std::uint32_t last_height_;
  Picture picture_;
};

std::string problem_of(std::vector<std::uint32_t> widths, const ImageJob& job,
                       std::uint32_t last_height = 1) {
  Zeros pictures(std::move(widths), last_height);
  ImageCache cache;
  const auto file = render(job, pictures, cache, {});
  return file ? "none" : file.error().message;
}

TEST(Render, SaysWhyThereIsNoImage) {
  ImageJob job;
  job.channels.fill(ChannelSource::constant(0.5));
  EXPECT_EQ(problem_of({2}, job), "a new image has no source");
  job.channels[0] = ChannelSource::of(1, 0);
  EXPECT_EQ(problem_of({2}, job), "image 1: it is gone");
  job.channels[3] = ChannelSource::of(0, 0);
  EXPECT_EQ(problem_of({2, 3}, job), "image 0 has a different size than the other one");
  EXPECT_EQ(problem_of({2, 2}, job, 5), "image 0 has a different size than the other one");
  EXPECT_THAT(problem_of({0, 0}, job), HasSubstr("the new image cannot be encoded: "));
}

TEST(Render, AnAlphaBelowOneIsKept) {
  Zeros pictures({1});
  Recipe recipe;
  recipe.images[0] = pictures.pixels(0);
  recipe.job.channels = {ChannelSource::of(0, 0), ChannelSource::constant(0),
                         ChannelSource::constant(0), ChannelSource::constant(0.5)};
  const Texels texels = mix(recipe);
  EXPECT_EQ(texels.raster.channels, 4U);
  EXPECT_EQ(texels.bytes.at(3), std::byte{128});
}

}  // namespace
}  // namespace gltfx::upgrade
