// SPDX-License-Identifier: Apache-2.0
/// The messages between client and worker: one frame per packet, numbers in the machine's byte
/// order (both run on one machine). Payloads and results are not in frames but in shared memory,
/// whose descriptors are sent with the frame.
///
/// A worker, started as described in packet.hpp, sends a Hello. The client sends a Job with two
/// descriptors, for the payload and the empty result; the worker fills the result and sends an
/// Answer. Neither side trusts a frame: the functions that read one check that it is complete, in
/// range and without trailing bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::codec {

inline constexpr std::size_t kMostFrameBytes = 65536;
inline constexpr std::size_t kMostAttributes = 1024;
inline constexpr std::size_t kMostMessageBytes = 500;

using Frame = std::vector<std::byte>;

/// The sandbox of a worker.
struct Hello {
  bool filtered = false;  ///< the filter of system calls is active
  bool operator==(const Hello&) const = default;
};

enum class Task : std::uint8_t { draco, image, encode, encode_draco, transcode };
/// Whether the answer is an encoded file.
constexpr bool encodes(Task task) { return task >= Task::encode; }

constexpr std::uint8_t kMostHalvings = 3;

struct Job {
  Task task = Task::draco;
  ImageFormat format = ImageFormat::png;
  std::uint32_t level = 0;
  bool pixels = false;
  bool normals = false;
  std::uint8_t halvings = 0;  ///< for the sides of an image, up to 3
  bool floats = false;
  Resize resize;
  /// Set if the payload is texels and not a file. Always with Task::encode; with Task::image and
  /// Task::transcode if another worker has decoded the file.
  Raster raster;
  EncodedFormat encoded = EncodedFormat::png;
  std::uint32_t quality = 0;
  EncodeOptions options;
  std::uint64_t input_bytes = 0;
  std::uint64_t max_pixels = 0;
  std::uint64_t memory_bytes = 0;  ///< limit, in addition to the use before the first job
  std::uint64_t milliseconds = 0;  ///< limit of processor time
  bool operator==(const Job&) const = default;
};

/// Without spans and owner: attach() sets them.
using Answer = std::variant<DracoMesh, Image, EncodedImage, DecodeError>;

Frame write_hello(const Hello& hello);
Frame write_job(const Job& job);
/// A message is cut to kMostMessageBytes, attributes to kMostAttributes.
Frame write_answer(const Answer& answer);

// Nothing if the frame is of another kind.
std::optional<Hello> read_hello(std::span<const std::byte> frame);
std::optional<Job> read_job(std::span<const std::byte> frame);
std::optional<Answer> read_answer(std::span<const std::byte> frame);

/// Whether a job is possible: the payload of an encoder has the size of its raster, and the format
/// supports such a raster.
bool is_consistent(const Job& job);
/// Whether the requested format of a job supports a raster.
bool format_holds(const Job& job, const Raster& raster);

/// Bytes of one component, 0 for `other`.
unsigned component_size(Component component);
/// Bytes of one value of an attribute, 0 for components of type `other`.
inline std::size_t value_size(const DracoAttribute& attribute) {
  return std::size_t{attribute.components} * component_size(attribute.component);
}

/// Bytes of a result: the indices, then the values of each attribute, each at a multiple of eight.
/// Nothing if the size exceeds 64 bits.
std::optional<std::uint64_t> result_size(const DracoMesh& mesh);
/// Size of the pixels.
std::optional<std::uint64_t> result_size(const Image& image);
std::optional<std::uint64_t> result_size(const EncodedImage& image);

/// Calls `use(offset, size)` for each attribute of a mesh whose result_size() is known.
template <typename Use>
void for_each_values(const DracoMesh& mesh, Use&& use) {
  std::uint64_t offset = (std::uint64_t{mesh.faces} * 12 + 7) / 8 * 8;
  for (const DracoAttribute& attribute : mesh.attributes) {
    const std::uint64_t size = std::uint64_t{mesh.points} * value_size(attribute);
    use(offset, size);
    offset += (size + 7) / 8 * 8;
  }
}

/// Points the spans into `memory`. False if it is too short or an index is out of range.
bool attach(DracoMesh& mesh, std::span<const std::byte> memory);
bool attach(Image& image, std::span<const std::byte> memory);
bool attach(EncodedImage& image, std::span<const std::byte> memory);

}  // namespace gltfx::codec
