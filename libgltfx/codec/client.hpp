// SPDX-License-Identifier: Apache-2.0
/// Decodes Draco meshes and images in worker processes, and encodes images there: a malicious
/// payload can affect only a process without files or network and with little memory. No process is
/// started before the first call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/origin.hpp"
#include "codec/image_distance.hpp"
#include "codec/image_options.hpp"

namespace gltfx::codec {

enum class ErrorKind : std::uint8_t {
  unavailable,    ///< no worker could be started; independent of the bytes
  malformed,      ///< the decoder refuses the bytes
  unsupported,    ///< the requested format does not support the image
  too_large,      ///< more pixels than requested, found in the header before decoding
  out_of_memory,  ///< decoding takes more memory than the size of the payload allows
  timed_out,      ///< decoding takes more processor time than the size of the payload allows
  died,           ///< the worker crashed on the bytes, or sent an invalid answer
  stalled,        ///< the worker neither worked nor answered; the bytes may be valid
};

/// Why there is no result.
struct DecodeError {
  ErrorKind kind = ErrorKind::malformed;
  std::string message;  ///< one sentence; a decoder's text in it is not escaped
};
/// Whether every machine has this error for these bytes.
inline bool depends_on_bytes_alone(const DecodeError& error) {
  return error.kind == ErrorKind::malformed || error.kind == ErrorKind::unsupported ||
         error.kind == ErrorKind::too_large;
}
/// Whether the error cost a time or memory limit, or a process: callers with many payloads should
/// not repeat it many times.
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
  other,  ///< 64 bits or booleans; no values are returned
};

/// The meaning of attribute values, which selects the prediction of Draco.
enum class DracoUse : std::uint8_t { position, normal, color, tex_coord, generic };

struct DracoAttribute {
  std::uint32_t id = 0;  ///< unique in the mesh; glTF refers to it
  Component component = Component::float32;
  std::uint32_t components = 0;  ///< of each value, 1 to 255
  bool normalized = false;
  /// Distance of quantised values in each component; 0: not quantised.
  double quantization_step = 0;
  /// `points * components` packed components, by point.
  std::span<const std::byte> values;
  DracoUse use = DracoUse::generic;
};

/// A decoded mesh, or one to encode. The memory of a decoded one is read-only, shared by copies and
/// independent of the client.
struct DracoMesh {
  std::uint32_t points = 0;
  std::uint32_t faces = 0;
  std::span<const std::uint32_t> indices;  ///< `faces * 3`, each below `points`
  std::vector<DracoAttribute> attributes;
  std::shared_ptr<const void> owner;  ///< of all bytes above
};
using DracoResult = std::variant<DracoMesh, DecodeError>;

/// A bitstream, and the mesh that decoders return for it. The order of points and triangles differs
/// from the encoded mesh; points with all values equal may be merged, and a point may be split if
/// the triangles at it have no common edge.
struct EncodedDraco {
  std::span<const std::byte> bytes;
  DracoMesh mesh;
  std::shared_ptr<const void> owner;  ///< owner of `bytes`
};
using DracoEncodeResult = std::variant<EncodedDraco, DecodeError>;

/// `radiance` and `openexr` contain floats; `tiff`, `psd`, `dds` and `pnm` may. `avif` and the
/// formats from `bmp` on need optional decoders.
enum class ImageFormat : std::uint8_t {
  png,
  jpeg,
  webp,
  avif,
  ktx2,
  radiance,
  openexr,
  bmp,
  tga,
  gif,
  tiff,
  psd,
  dds,
  jpeg2000,
  pnm,
};
/// Whether the decoder is OpenImageIO.
constexpr bool is_foreign(ImageFormat format) { return format >= ImageFormat::bmp; }
constexpr bool holds_floats(ImageFormat format) {
  return format == ImageFormat::radiance || format == ImageFormat::openexr;
}

/// An image to decode. The format is the declared one: content is never sniffed.
struct ImageRequest {
  std::span<const std::byte> bytes;
  ImageFormat format = ImageFormat::png;
  std::uint32_t level = 0;  ///< KTX2: number of the mipmap, the largest first
  std::uint64_t max_pixels = std::uint64_t{1} << 28U;
  /// Greatest number of times that both sides may be halved, up to three, if that is faster: JPEG.
  std::uint32_t halvings = 0;
  bool pixels = false;   ///< return the pixels
  bool normals = false;  ///< check the first three channels as a normal map
  Origin origin = {};
  /// Whether floats are accepted in formats that may contain them; otherwise they are `malformed`.
  bool floats = false;
  Resize resize = {};  ///< size of the pixels; statistics are those of the resized image
};

/// One channel over all texels. Values are 0 to 255, or 0 to 65535 if `Image::bits` is 16.
struct ChannelStatistics {
  std::uint32_t least = 0;
  std::uint32_t greatest = 0;
  std::uint64_t zeros = 0;  ///< texels with 0
  std::uint64_t fulls = 0;  ///< texels with the greatest value of the bit depth
  bool constant() const { return least == greatest; }
};

/// The first three channels as vectors 2c - 1 with c from 0 to 1 (specification section 3.9.3).
/// Grey texels are not vectors but padding between charts: they are left out.
struct NormalStatistics {
  std::uint64_t vectors = 0;   ///< texels that are not grey
  std::uint64_t not_unit = 0;  ///< texels whose length is not within 0.1 of 1
  std::uint64_t far_off = 0;   ///< the same with 0.3: more than rounding or lossy coding
  std::uint64_t inward = 0;    ///< texels with z below -2/255
  double mean_length = 0;
  double steepest = 0;  ///< greatest |x| or |y|: about 1/255 in a flat map
};

/// A decoded image: alpha is not premultiplied; palettes and transparent colours are resolved; no
/// colour conversion. The first frame of an animation.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;                     ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  std::uint32_t bits = 8;                         ///< per channel: 8 or 16; 32 are floats
  std::array<ChannelStatistics, 4> statistics{};  ///< for the first `channels`; not for floats
  bool grey = true;                               ///< the colour channels are equal in all texels
  /// Problem that the decoder reported but continued after, such as an early end; otherwise empty.
  /// One line, the decoder's own text.
  std::string doubt;
  NormalStatistics normals;  ///< if requested, with at least three channels
  /// Rows from the top, packed, `channels` numbers per texel in the machine's byte order; empty
  /// unless requested.
  std::span<const std::byte> pixels;
  std::shared_ptr<const void> owner;  ///< owner of `pixels`

  std::uint64_t texels() const { return std::uint64_t{width} * height; }
  std::uint32_t full() const { return bits == 16 ? 65535 : 255; }
  bool has_alpha() const { return channels == 2 || channels == 4; }
  /// Statistics of alpha. Precondition: has_alpha().
  const ChannelStatistics& alpha() const { return statistics[channels - 1]; }
  /// Whether all values of a channel are 0 or full. This does not depend on the colour space.
  bool binary(std::size_t channel) const {
    return statistics[channel].zeros + statistics[channel].fulls == texels();
  }
};
using ImageResult = std::variant<Image, DecodeError>;

/// Texels in rows from the top, packed, `channels` numbers each in the machine's byte order.
struct Raster {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 4;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; straight alpha
  std::uint32_t bits = 8;      ///< per channel: 8 or 16; 32 are floats
  bool operator==(const Raster&) const = default;
};

/// An image to encode. PNG supports 8 and 16 bits; JPEG 8 bits with 1 or 3 channels; WebP 8 bits,
/// with grey as RGB, and animations; EXR floats. Only transcoding supports KTX2 and AVIF.
struct EncodeRequest {
  EncodedFormat format = EncodedFormat::png;
  Raster raster;
  /// JPEG: 1 to 100. WebP: the same, and 0 for lossless. The other formats are lossless.
  std::uint32_t quality = 90;
  std::span<const std::byte> pixels;  ///< exactly the size of `raster`
  Origin origin = {};                 ///< origin of the asset with the image
  EncodeOptions options = {};
};

/// An image file to decode, resize and encode again: its pixels stay in the worker, unless the
/// format is AVIF. For KTX2, `image.resize` says how mipmap levels are made, and sides become
/// multiples of 4, at least 4 and otherwise at most `max_side`.
struct TranscodeRequest {
  ImageRequest image;  ///< `pixels`, `normals`, `level` and `halvings` are ignored
  EncodedFormat format = EncodedFormat::png;
  std::uint32_t quality = 0;  ///< as in EncodeRequest
  EncodeOptions options = {};
};

/// The bytes of an image file: the same for the same request, independent of time and load.
/// Independent of the client.
struct EncodedImage {
  std::uint64_t size = 0;
  std::span<const std::byte> bytes;  ///< `size` bytes
  std::shared_ptr<const void> owner;
  Raster source = {};  ///< after decoding, or as given
  Raster raster = {};  ///< in the file
  /// Of the file from the resized source, if they were compared and may differ.
  std::optional<ImageDistance> distance = {};
};
using EncodeResult = std::variant<EncodedImage, DecodeError>;

struct Settings {
  /// Folder of the worker programs; empty: the folder in the environment variable
  /// GLTFX_CODEC_WORKERS, or else the folder of the running program, or else the installation
  /// folder.
  std::string folder;
  /// Maximum number of processes of each kind; 0: the number of processors.
  unsigned workers = 0;
  /// Least memory limit of a request; it grows with the size of the payload. The libraries for
  /// decoding images take a hundred megabytes in addition.
  std::uint64_t mesh_memory_bytes = std::uint64_t{192} << 20U;
  std::uint64_t image_memory_bytes = std::uint64_t{96} << 20U;
  /// Least limit of processor time of the worker, not of wall-clock time; it grows with bytes and
  /// pixels.
  double seconds = 1;
  /// A worker is stopped if it uses no processor time and does not answer for this time.
  double standstill_seconds = 30;
};

/// Keeps workers until it is destroyed; no worker gets bytes of two origins. A worker without a
/// filter of system calls is refused, unless <gltfx/decoders.hpp> permits it. Any number of threads
/// may call; each call is one request to one worker, and waits while all are busy. A worker that
/// dies, runs out of time or breaks the protocol is stopped, and the next call starts another one.
/// Throws only std::bad_alloc, if this process has no memory left.
class Client {
 public:
  explicit Client(Settings settings = {});
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Decodes a Draco bitstream (version 2.2) with a triangle mesh.
  DracoResult decode_draco(std::span<const std::byte> bytes, const Origin& origin = {});
  /// Encodes triangles (edgebreaker, bitstream version 2.2) without loss: the result is decoded
  /// again and compared bit for bit. Attributes keep id, type and `normalized`; `quantization_step`
  /// is ignored. A DecodeError of kind `malformed` if the mesh is inconsistent: no triangles, an
  /// index out of range, a triangle that repeats a vertex, which Draco omits, values with a wrong
  /// size, repeated ids, or not exactly one position.
  DracoEncodeResult encode_draco(const DracoMesh& mesh, const Origin& origin = {});
  ImageResult decode_image(const ImageRequest& request);
  /// A DecodeError of kind `unsupported` if the format does not support such an image.
  EncodeResult encode_image(const EncodeRequest& request);
  /// Gives the same bytes for the same request. The file is decoded and compared with the resized
  /// source; PNG, EXR and lossless WebP must have the same texels. `malformed` if the source has a
  /// `doubt`. `unsupported` if the format does not support the image: JPEG an alpha other than 1,
  /// WebP without loss 16 bits, and others floats. With `quality` or less than lossless, 16 bits
  /// become 8, as in KTX2. `unavailable` for AVIF if gltfx was built without libavif.
  EncodeResult transcode_image(const TranscodeRequest& request);
  /// Starts to load the decoders of images without waiting, because that takes longer than decoding
  /// most images.
  void prepare_images();

  /// The shared client of this process. Its workers end with the process.
  static Client& shared();

 private:
  ImageResult resize_elsewhere(const ImageRequest& request);
  ImageResult resize_pixels(const Image& image, const ImageRequest& request);
  EncodeResult transcode_to_avif(const TranscodeRequest& request);

  struct State;
  std::unique_ptr<State> state_;
};

/// Number of times since the start of this process that a worker had no result for a reason other
/// than the bytes alone: missing memory or time, a crash, no worker. Results from that time may
/// differ on another machine. Thread-safe.
std::uint64_t transient_errors();

}  // namespace gltfx::codec
