// SPDX-License-Identifier: Apache-2.0
// An image that several assets of a run share is encoded once.
#include "steps/image_encodings.hpp"

#include <thread>

#include <gmock/gmock.h>

#include "convert_image_support.hpp"

namespace gltfx {
namespace {

using steps::ImageEncodings;
using test::asset_with;
using test::file_image;
using test::kColorSlot;
using test::OrderedJson;

codec::TranscodeRequest to_webp(const std::string& file) {
  codec::TranscodeRequest request;
  request.image.bytes = std::as_bytes(std::span(file));
  request.image.origin = {1, 2};
  request.format = codec::EncodedFormat::webp;
  return request;
}

std::string webp_of(ImageEncodings& encodings, const codec::TranscodeRequest& request) {
  const codec::EncodeResult result = encodings.transcode(request);
  const auto* image = std::get_if<codec::EncodedImage>(&result);
  return image == nullptr
             ? std::string()
             : std::string(reinterpret_cast<const char*>(image->bytes.data()), image->bytes.size());
}

TEST(ImageEncodings, MakeEqualRequestsOnce) {
  ImageEncodings encodings;
  const std::string file = test::png_file({64, 32, 3, 8});
  const std::string copy = file;
  const std::string first = webp_of(encodings, to_webp(file));
  EXPECT_EQ(test::decoded(first), test::decoded(file));
  EXPECT_EQ(webp_of(encodings, to_webp(copy)), first);
  EXPECT_EQ(encodings.encoded(), 1U);
}

TEST(ImageEncodings, TellRequestsApart) {
  ImageEncodings encodings;
  const std::string file = test::png_file({64, 32, 3, 8});
  const std::string other = test::png_file({64, 33, 3, 8});
  const auto changes = std::to_array<void (*)(codec::TranscodeRequest&)>(
      {[](codec::TranscodeRequest&) {},
       [](codec::TranscodeRequest& request) { request.quality = 50; },
       [](codec::TranscodeRequest& request) { request.options.near_lossless = 60; },
       [](codec::TranscodeRequest& request) { request.format = codec::EncodedFormat::png; },
       [](codec::TranscodeRequest& request) { request.image.resize.max_side = 16; },
       [](codec::TranscodeRequest& request) {
         request.image.resize.max_side = 16;
         request.image.resize.kind = codec::TexelKind::normal;
       },
       [](codec::TranscodeRequest& request) { request.image.origin.file = 3; }});
  for (unsigned round = 0; round < 2; ++round) {
    for (const auto& change : changes) {
      codec::TranscodeRequest request = to_webp(file);
      change(request);
      EXPECT_NE(webp_of(encodings, request), "");
    }
    webp_of(encodings, to_webp(other));
  }
  EXPECT_EQ(encodings.encoded(), changes.size() + 1);
}

TEST(ImageEncodings, KeepErrorsOfTheBytes) {
  ImageEncodings encodings;
  const std::string broken = test::png_file({64, 32, 3, 8}).substr(0, 90);
  EXPECT_EQ(webp_of(encodings, to_webp(broken)), "");
  EXPECT_EQ(webp_of(encodings, to_webp(broken)), "");
  EXPECT_EQ(encodings.encoded(), 1U);
}

TEST(ImageEncodings, ServeSeveralThreads) {
  ImageEncodings encodings;
  const std::string file = test::png_file({64, 32, 3, 8});
  std::vector<std::string> made(4);
  std::vector<std::thread> threads;
  for (std::string& each : made) {
    threads.emplace_back([&] { each = webp_of(encodings, to_webp(file)); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(made, testing::Each(testing::AllOf(testing::Not(""), made.front())));
  EXPECT_EQ(encodings.encoded(), 1U);
}

TEST(ImagesOfManyAssets, DoNotDependOnTheNumberOfThreads) {
  const container::test::TempFolder folder;
  folder.write("in/wood.png", test::png_file({64, 32, 3, 8}));
  std::vector<std::string> names;
  for (unsigned i = 0; i < 6; ++i) {
    names.push_back(std::string("a").append(std::to_string(i)).append(".gltf"));
    folder.write("in/" + names.back(), asset_with(kColorSlot, {file_image("wood.png")}));
  }
  for (const unsigned jobs : {1U, 4U}) {
    const auto out = folder.path() / std::to_string(jobs);
    std::vector<EditInput> inputs;
    for (const std::string& name : names) {
      inputs.push_back({(folder.path() / "in" / name).native(), (out / name).native()});
    }
    ConvertOptions options;
    options.images = {{ImageTarget::webp, std::nullopt}};
    options.shared_folder = true;
    convert_files(inputs, options, jobs, [](ConvertReport&& report) {
      EXPECT_TRUE(report.written) << report.path << ": " << report.error;
    });
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(out)) {
      ++files;
      EXPECT_EQ(container::test::content_of(entry.path()),
                container::test::content_of(folder.path() / "1" / entry.path().filename()));
    }
    EXPECT_EQ(files, names.size() + 1) << "one image";
  }
}

}  // namespace
}  // namespace gltfx
