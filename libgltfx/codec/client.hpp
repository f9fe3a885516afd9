// SPDX-License-Identifier: Apache-2.0
/// Decodes Draco meshes and images in worker processes, and encodes images there: what a hostile
/// payload breaks is a process that has no files, no network and little memory. Nothing is started
/// before the first call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/origin.hpp"

namespace gltfx::codec {

enum class ErrorKind : std::uint8_t {
  unavailable,    ///< no worker could be started: says nothing about the bytes
  malformed,      ///< the decoder refuses the bytes
  too_large,      ///< more pixels than asked for, found in the header before any are decoded
  out_of_memory,  ///< decoding takes more memory than bytes of that number may ask for
  timed_out,      ///< decoding takes more processor time than bytes of that number may take
  died,           ///< the worker crashed on the bytes, or answered nonsense
  stalled,        ///< the worker neither worked nor answered: need not be the error of the bytes
};

/// Why there is no result.
struct DecodeError {
  ErrorKind kind = ErrorKind::malformed;
  std::string message;  ///< one sentence; text of a decoder in it is not neutralised
};
/// Whether it took a limit of time or memory, or a process, to find it: callers with many payloads
/// had better not ask for many of those.
inline bool is_costly(const DecodeError& error) {
  return error.kind == ErrorKind::out_of_memory || error.kind == ErrorKind::timed_out ||
         error.kind == ErrorKind::died || error.kind == ErrorKind::stalled;
}

/// How the components of a decoded attribute are stored.
enum class Component : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  other,  ///< 64 bits or booleans; no values are handed over
};

struct DracoAttribute {
  std::uint32_t id = 0;  ///< unique in the mesh; what glTF refers to
  Component component = Component::float32;
  std::uint32_t components = 0;  ///< of each value, 1 to 255
  bool normalized = false;
  /// How far apart quantised values are in each component; 0: stored as they were.
  double quantization_step = 0;
  /// `points * components` packed components, by point.
  std::span<const std::byte> values;
};

/// A decoded mesh. Its memory is read-only, shared by copies and independent of the client.
struct DracoMesh {
  std::uint32_t points = 0;
  std::uint32_t faces = 0;
  std::span<const std::uint32_t> indices;  ///< `faces * 3`, each below `points`
  std::vector<DracoAttribute> attributes;
  std::shared_ptr<const void> owner;  ///< of all bytes above
};
using DracoResult = std::variant<DracoMesh, DecodeError>;

/// `radiance` and `openexr` hold floats.
/// `avif` takes a decoder that not every installation has.
enum class ImageFormat : std::uint8_t { png, jpeg, webp, avif, ktx2, radiance, openexr };
constexpr bool holds_floats(ImageFormat format) {
  return format == ImageFormat::radiance || format == ImageFormat::openexr;
}

/// An image to decode. The format is the declared one: content is never sniffed.
struct ImageRequest {
  std::span<const std::byte> bytes;
  ImageFormat format = ImageFormat::png;
  std::uint32_t level = 0;  ///< KTX2: which one of the mipmaps, the largest first
  std::uint64_t max_pixels = std::uint64_t{1} << 28U;
  /// Both sides may be halved so many times, up to three, where that takes less time: JPEG.
  std::uint32_t halvings = 0;
  bool pixels = false;   ///< hand over the pixels
  bool normals = false;  ///< look at the first three channels as at a normal map
  Origin origin = {};
};

/// One channel over all texels. Values are 0 to 255, or to 65535 where `Image::bits` is 16.
struct ChannelStatistics {
  std::uint32_t least = 0;
  std::uint32_t greatest = 0;
  std::uint64_t zeros = 0;  ///< texels with 0
  std::uint64_t fulls = 0;  ///< texels with the greatest value that the depth has
  bool constant() const { return least == greatest; }
};

/// The first three channels as vectors 2c - 1 with c from 0 to 1 (specification section 3.9.3).
/// Texels that are grey are no vectors, but what fills an image between its charts: they are left
/// out.
struct NormalStatistics {
  std::uint64_t vectors = 0;   ///< texels that are not grey
  std::uint64_t not_unit = 0;  ///< texels whose length is not within 0.1 of 1
  std::uint64_t far_off = 0;   ///< likewise 0.3: no rounding or lossy coding explains it
  std::uint64_t inward = 0;    ///< texels with z below -2/255
  double mean_length = 0;
  double steepest = 0;  ///< greatest |x| or |y|: about 1/255 in a flat map
};

/// A decoded image: alpha is not multiplied into colours; palettes and transparent colours are
/// resolved; no colour conversion. Of an animation the first frame.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;                     ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  std::uint32_t bits = 8;                         ///< per channel: 8 or 16; 32 are floats
  std::array<ChannelStatistics, 4> statistics{};  ///< of the first `channels`; not of floats
  bool grey = true;                               ///< the colour channels are equal in all texels
  /// What the decoder complained of although it went on, such as an end that came too early; else
  /// empty. One line of the decoder's own words.
  std::string doubt;
  NormalStatistics normals;  ///< where they were asked for and there are three channels
  /// Rows from the top, packed, `channels` numbers a texel in the machine's byte order; empty
  /// unless asked for.
  std::span<const std::byte> pixels;
  std::shared_ptr<const void> owner;  ///< of `pixels`

  std::uint64_t texels() const { return std::uint64_t{width} * height; }
  std::uint32_t full() const { return bits == 16 ? 65535 : 255; }
  bool has_alpha() const { return channels == 2 || channels == 4; }
  /// That of alpha. Precondition: has_alpha().
  const ChannelStatistics& alpha() const { return statistics[channels - 1]; }
  /// Whether a channel has no values but 0 and full: the same in every colour space.
  bool binary(std::size_t channel) const {
    return statistics[channel].zeros + statistics[channel].fulls == texels();
  }
};
using ImageResult = std::variant<Image, DecodeError>;

enum class EncodedFormat : std::uint8_t { png, jpeg, webp, exr };

/// Texels in rows from the top, packed, `channels` numbers each in the machine's byte order.
struct Raster {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 4;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha not multiplied in
  std::uint32_t bits = 8;      ///< per channel: 8 or 16; 32 are floats
  bool operator==(const Raster&) const = default;
};

/// An image to encode. PNG holds 8 and 16 bits; JPEG 8 bits of 1 or 3 channels; WebP 8 bits of 3 or
/// 4; EXR floats.
struct EncodeRequest {
  EncodedFormat format = EncodedFormat::png;
  Raster raster;
  /// JPEG: 1 to 100. WebP: the same, and 0 for lossless. Others lose nothing.
  std::uint32_t quality = 90;
  std::span<const std::byte> pixels;  ///< exactly what `raster` says
  Origin origin = {};                 ///< of the asset that the image is for
};

/// The bytes of an image file: the same for the same request, whatever the time or the machine's
/// load. Independent of the client.
struct EncodedImage {
  std::uint64_t size = 0;
  std::span<const std::byte> bytes;  ///< `size` of them
  std::shared_ptr<const void> owner;
};
using EncodeResult = std::variant<EncodedImage, DecodeError>;

struct Settings {
  /// Folder of the worker programs; empty: that of GLTFX_CODEC_WORKERS in the environment, or else
  /// that of the running program, or else the one they are installed in.
  std::string folder;
  /// Processes of each kind at most; 0: as many as there are processors.
  unsigned workers = 0;
  /// What a request may take at least; more bytes may take more. The libraries that decode images
  /// take a hundred megabytes beside that.
  std::uint64_t mesh_memory_bytes = std::uint64_t{192} << 20U;
  std::uint64_t image_memory_bytes = std::uint64_t{96} << 20U;
  /// Of processor time of the worker, whatever the clock on the wall says; more bytes and more
  /// pixels may take more.
  double seconds = 1;
  /// A worker that uses no processor time at all for so long, and does not answer, is ended.
  double standstill_seconds = 30;
};

/// Keeps workers until it is destroyed; none is given bytes of two origins. One whose system calls
/// are not filtered is refused, unless <gltfx/decoders.hpp> permits it. Any number of threads
/// may call; each call is one request to one worker, and waits while all are busy. A worker that
/// dies, runs out of time or breaks the protocol is ended, and another one is started by the next
/// call. Nothing throws but std::bad_alloc, when this process has no memory left.
class Client {
 public:
  explicit Client(Settings settings = {});
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Decodes a Draco bitstream (version 2.2) that holds a triangle mesh.
  DracoResult decode_draco(std::span<const std::byte> bytes, const Origin& origin = {});
  ImageResult decode_image(const ImageRequest& request);
  /// A DecodeError of kind `malformed` when the format cannot hold what is asked for.
  EncodeResult encode_image(const EncodeRequest& request);
  /// Begins to load the decoders of images, without waiting for it: that takes longer than to
  /// decode most images.
  void prepare_images();

  /// The one that this process shares. Its workers end with the process.
  static Client& shared();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// How often, since this process began, a worker had no result for a reason that does not lie in
/// the bytes alone: missing memory or time, a crash, no worker. What was made meanwhile might be
/// another thing on another machine. Any number of threads may call.
std::uint64_t errors_by_chance();

}  // namespace gltfx::codec
