// SPDX-License-Identifier: Apache-2.0
// EXR, without threads because workers are forked.
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include "image_decode.hpp"
#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

// Memory of libopenexr for a block of rows, in addition to the pixels.
constexpr std::uint64_t kBytesPerTexel = 8;
constexpr int kNoThreads = 0;

class Input : public Imf::IStream {
 public:
  explicit Input(std::span<const std::byte> bytes) : IStream("image"), bytes_(bytes) {}

  bool read(char to[], int size) override {
    const auto count = static_cast<std::uint64_t>(std::max(size, 0));
    if (at_ > bytes_.size() || bytes_.size() - at_ < count) {
      throw Iex::InputExc("Its data is truncated.");
    }
    std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override { at_ = to; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t at_ = 0;
};

class Memory : public Imf::OStream {
 public:
  Memory() : OStream("image") {}

  void write(const char from[], int size) override {
    const auto end = at_ + static_cast<std::size_t>(size);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, from, static_cast<std::size_t>(size));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t to) override { at_ = static_cast<std::size_t>(to); }
  std::span<const std::byte> file() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

// Colours come before alpha, and both before other channels, such as depth; channels of layers come
// last.
int rank_of(std::string_view name) {
  constexpr std::array<std::string_view, 5> kOrder{"R", "G", "B", "Y", "A"};
  const std::size_t dot = name.rfind('.');
  const bool layered = dot != std::string_view::npos;
  const auto at = std::find(kOrder.begin(), kOrder.end(), name.substr(layered ? dot + 1 : 0));
  return static_cast<int>(at - kOrder.begin()) + (layered ? 100 : 0);
}

// The names of the first four channels in the order of rank_of().
std::vector<std::string> chosen_channels(const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (auto each = channels.begin(); each != channels.end(); ++each) {
    if (each.channel().xSampling == 1 && each.channel().ySampling == 1)
      names.emplace_back(each.name());
  }
  std::stable_sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return rank_of(a) < rank_of(b);
  });
  names.resize(std::min<std::size_t>(names.size(), 4));
  return names;
}

}  // namespace

Answer decode_exr(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  Input input(bytes);
  Imf::InputFile file(input, kNoThreads);
  const Imath::Box2i window = file.header().dataWindow();
  const std::vector<std::string> names = chosen_channels(file.header().channels());
  Image image;
  image.width = static_cast<std::uint32_t>(std::int64_t{window.max.x} - window.min.x + 1);
  image.height = static_cast<std::uint32_t>(std::int64_t{window.max.y} - window.min.y + 1);
  image.channels = static_cast<std::uint32_t>(names.size());
  image.bits = 32;
  if (names.empty() || image.texels() == 0) {
    return DecodeError{ErrorKind::malformed, "It has no channel that can be decoded."};
  }
  if (image.texels() > job.max_pixels) return too_many_texels();
  if (exceeds_memory(job, image.texels(), kBytesPerTexel)) return no_memory();
  const std::span<std::byte> pixels = create_pixels(image, job, output);
  if (pixels.empty()) return image;
  const std::size_t texel = names.size() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < names.size(); ++i) {
    buffer.insert(names[i], Imf::Slice::Make(Imf::FLOAT, pixels.data() + i * sizeof(float), window,
                                             texel, texel * image.width));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

Answer encode_exr(const Job& job, std::span<const std::byte> texels, const Output& output) {
  const Raster& raster = job.raster;
  constexpr std::array<std::string_view, 5> kNames{"", "Y", "YA", "RGB", "RGBA"};
  const std::size_t texel = raster.channels * sizeof(float);
  Imf::Header header(static_cast<int>(raster.width), static_cast<int>(raster.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < raster.channels; ++i) {
    const std::string name(1, kNames[raster.channels][i]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, texels.data() + i * sizeof(float),
                                         header.dataWindow(), texel, texel * raster.width));
  }
  Memory memory;
  {
    Imf::OutputFile file(memory, header, kNoThreads);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(raster.height));
  }  // writes the table of offsets
  return hand_over(memory.file(), output);
}

}  // namespace gltfx::codec
