// SPDX-License-Identifier: Apache-2.0
#include "codec/protocol.hpp"

#include <limits>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/packet.hpp"

namespace gltfx::codec {
namespace {

Job some_job() {
  Job job;
  job.task = Task::image;
  job.format = ImageFormat::webp;
  job.pixels = true;
  job.normals = true;
  job.halvings = 3;
  job.floats = true;
  job.resize = {512, TexelKind::normal, true, 0.25F, Wrap::mirror, Wrap::clamp};
  job.options = {60, false, true};
  job.input_bytes = 7;
  job.max_pixels = 1ULL << 40U;
  job.memory_bytes = 9;
  job.milliseconds = 11;
  return job;
}

DracoMesh some_mesh() {
  DracoMesh mesh;
  mesh.points = 4;
  mesh.faces = 1;
  mesh.attributes.resize(2);
  mesh.attributes[0] = {5, Component::uint8, 3, true, 0.25, {}, DracoUse::color};
  mesh.attributes[1] = {9, Component::float32, 2, false, 0, {}, DracoUse::tex_coord};
  return mesh;
}

Image some_image() {
  Image image;
  image.width = 3;
  image.height = 2;
  image.channels = 4;
  image.bits = 16;
  image.statistics[3] = {5, 65535, 0, 2};
  image.grey = false;
  image.doubt = "ends early";
  image.normals = {4, 3, 2, 1, 0.5, 1};
  return image;
}

EncodedImage some_encoded_image() {
  EncodedImage image;
  image.size = 7;
  image.source = {4, 2, 3, 16};
  image.raster = {2, 1, 3, 8};
  image.distance = ImageDistance{2.5, 0.25};
  return image;
}

Frame changed(Frame frame, std::size_t at, int to) {
  frame[at] = static_cast<std::byte>(to);
  return frame;
}

TEST(Protocol, JobsAndGreetingsArriveAsTheyWere) {
  EXPECT_EQ(read_job(write_job(some_job())), some_job());
  EXPECT_EQ(read_hello(write_hello({true})), Hello{true});
}

TEST(Protocol, MessagesOfTheLauncherArriveAsTheyWere) {
  const Control control{Control::Kind::finish, 1ULL << 40U};
  EXPECT_EQ(read_control(write_control(control)), control);
  EXPECT_FALSE(read_control(write_hello({true})));
  Frame longer = write_control(control);
  longer.push_back({});
  EXPECT_FALSE(read_control(longer));
  longer.resize(longer.size() - 2);
  EXPECT_FALSE(read_control(longer));
}

TEST(Protocol, AMeshArrivesAsItWas) {
  const auto answer = read_answer(write_answer(some_mesh()));
  ASSERT_TRUE(answer && std::holds_alternative<DracoMesh>(*answer));
  const auto& mesh = std::get<DracoMesh>(*answer);
  EXPECT_EQ(mesh.points, 4U);
  EXPECT_EQ(mesh.faces, 1U);
  ASSERT_EQ(mesh.attributes.size(), 2U);
  EXPECT_EQ(mesh.attributes[0].id, 5U);
  EXPECT_EQ(mesh.attributes[0].component, Component::uint8);
  EXPECT_TRUE(mesh.attributes[0].normalized);
  EXPECT_EQ(mesh.attributes[0].quantization_step, 0.25);
}

TEST(Protocol, AnImageArrivesAsItWas) {
  const auto answer = read_answer(write_answer(some_image()));
  ASSERT_TRUE(answer && std::holds_alternative<Image>(*answer));
  const auto& image = std::get<Image>(*answer);
  EXPECT_EQ(image.statistics[3].greatest, 65535U);
  EXPECT_EQ(image.statistics[3].fulls, 2U);
  EXPECT_FALSE(image.grey);
  EXPECT_EQ(image.doubt, "ends early");
  EXPECT_EQ(image.normals.steepest, 1);
}

TEST(Protocol, AnEncodedImageArrivesAsItWas) {
  EncodedImage image = some_encoded_image();
  for (const auto& distance : {std::optional<ImageDistance>(), {ImageDistance{2.5, 0.25}}}) {
    image.distance = distance;
    const auto answer = read_answer(write_answer(image));
    ASSERT_TRUE(answer && std::holds_alternative<EncodedImage>(*answer));
    const auto& read = std::get<EncodedImage>(*answer);
    EXPECT_EQ(read.size, 7U);
    EXPECT_EQ(read.source, image.source);
    EXPECT_EQ(read.raster, image.raster);
    EXPECT_EQ(read.distance, distance);
  }
  image.distance = ImageDistance{-1, 0};
  EXPECT_FALSE(read_answer(write_answer(image)));
}

TEST(Protocol, AErrorArrivesAsItWasButForItsLength) {
  const auto answer =
      read_answer(write_answer(DecodeError{ErrorKind::malformed, std::string(9000, 'x')}));
  ASSERT_TRUE(answer && std::holds_alternative<DecodeError>(*answer));
  EXPECT_EQ(std::get<DecodeError>(*answer).message.size(), kMostMessageBytes);
}

TEST(Protocol, EveryAnswerIsWrittenInOneWay) {
  EncodedImage without_distance = some_encoded_image();
  without_distance.distance.reset();
  const std::vector<Frame> frames{
      write_answer(some_mesh()), write_answer(some_image()), write_answer(some_encoded_image()),
      write_answer(without_distance), write_answer(DecodeError{ErrorKind::malformed, "why"})};
  for (const Frame& frame : frames) {
    for (std::size_t at = 0; at < frame.size(); ++at) {
      for (int value = 0; value < 256; ++value) {
        const Frame other = changed(frame, at, value);
        const auto answer = read_answer(other);
        if (!answer) continue;
        EXPECT_EQ(write_answer(*answer), other) << at << ' ' << value;
      }
    }
  }
}

TEST(Protocol, EveryCutAndEveryTailIsRefused) {
  const std::vector<Frame> frames{write_job(some_job()), write_hello({}), write_answer(some_mesh()),
                                  write_answer(some_image()), write_answer(DecodeError{})};
  for (const Frame& frame : frames) {
    for (std::size_t size = 0; size < frame.size(); ++size) {
      const Frame cut(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(read_job(cut) || read_hello(cut) || read_answer(cut)) << size;
    }
    Frame longer = frame;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(read_job(longer) || read_hello(longer) || read_answer(longer));
  }
}

TEST(Protocol, AFrameOfAnotherKindIsRefused) {
  EXPECT_FALSE(read_job(write_hello({})));
  EXPECT_FALSE(read_hello(write_job({})));
  EXPECT_FALSE(read_answer(write_job({})));
  EXPECT_FALSE(read_job(changed(write_job({}), 0, 'x')));
}

TEST(Protocol, ValuesOutOfRangeAreRefused) {
  EXPECT_FALSE(read_hello(changed(write_hello({}), 5, 2)));  // neither true nor false
  EXPECT_FALSE(read_job(changed(write_job({}), 5, 2)));      // no such task
  DracoMesh mesh = some_mesh();
  mesh.attributes[0].components = 0;
  EXPECT_FALSE(read_answer(write_answer(mesh)));
  mesh = some_mesh();
  mesh.attributes[0].quantization_step = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(read_answer(write_answer(mesh)));
  Image image = some_image();
  image.channels = 5;
  EXPECT_FALSE(read_answer(write_answer(image)));
  image = some_image();
  image.width = 0;
  EXPECT_FALSE(read_answer(write_answer(image)));
  image = some_image();
  image.statistics[0].least = 9;  // above the greatest
  EXPECT_FALSE(read_answer(write_answer(image)));
  image = some_image();
  image.statistics[0].zeros = 7;  // more than the six texels
  EXPECT_FALSE(read_answer(write_answer(image)));
  image = some_image();
  image.normals.mean_length = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read_answer(write_answer(image)));
}

TEST(Protocol, ResultsLieOneAfterTheOther) {
  DracoMesh mesh = some_mesh();
  ASSERT_EQ(result_size(mesh), 16U + 16U + 32U);  // 12 bytes of indices, 4 x 3 bytes, 4 x 2 floats
  alignas(8) std::array<std::byte, 64> memory{};
  memory[0] = std::byte{3};
  ASSERT_TRUE(attach(mesh, memory));
  EXPECT_EQ(mesh.indices[0], 3U);
  EXPECT_EQ(mesh.attributes[0].values.data(), memory.data() + 16);
  EXPECT_EQ(mesh.attributes[0].values.size(), 12U);
  EXPECT_EQ(mesh.attributes[1].values.data(), memory.data() + 32);
}

TEST(Protocol, AResultThatIsTooShortOrLeadsNowhereIsRefused) {
  DracoMesh mesh = some_mesh();
  alignas(8) std::array<std::byte, 64> memory{};
  EXPECT_FALSE(attach(mesh, std::span(memory).first(63)));
  memory[8] = std::byte{4};  // the third index; there are four points
  EXPECT_FALSE(attach(mesh, memory));
  Image image = some_image();
  EXPECT_EQ(result_size(image), 48U);
  EXPECT_FALSE(attach(image, std::span(memory).first(47)));
  EXPECT_TRUE(attach(image, memory));
  EXPECT_EQ(image.pixels.size(), 48U);
}

TEST(Protocol, SizesThatOverflowAreRefused) {
  Image image = some_image();
  image.width = image.height = std::numeric_limits<std::uint32_t>::max();
  image.statistics = {};
  image.normals = {};
  EXPECT_FALSE(result_size(image));
  EXPECT_FALSE(read_answer(write_answer(image)));
}

}  // namespace
}  // namespace gltfx::codec
