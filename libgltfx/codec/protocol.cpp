// SPDX-License-Identifier: Apache-2.0
#include "codec/protocol.hpp"

#include <algorithm>
#include <cmath>

#include "base/checked.hpp"
#include "codec/fields.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint32_t kMagic = 0x36435847;  // "GXC6": the last character is the version

enum class Kind : std::uint8_t { hello, job, mesh, image, encoded, error };

FieldWriter begin(Kind kind) {
  FieldWriter out;
  out.number(kMagic);
  out.name(kind);
  return out;
}

// The kind of a frame, from its first bytes.
std::optional<Kind> read_kind(FieldReader& in) {
  const bool ours = in.number<std::uint32_t>() == kMagic;
  const Kind kind = in.name(Kind::error);
  return ours && in.sound() ? std::optional(kind) : std::nullopt;
}

void write(FieldWriter& out, const DracoAttribute& attribute) {
  out.number(attribute.id);
  out.name(attribute.use);
  out.name(attribute.component);
  out.number(attribute.components);
  out.number(static_cast<std::uint8_t>(attribute.normalized));
  out.number(attribute.quantization_step);
}

DracoAttribute read_attribute(FieldReader& in) {
  DracoAttribute attribute;
  attribute.id = in.number<std::uint32_t>();
  attribute.use = in.name(DracoUse::generic);
  attribute.component = in.name(Component::other);
  attribute.components = in.check_at_most(in.number<std::uint32_t>(), 255U);
  attribute.normalized = in.flag();
  attribute.quantization_step = in.number<double>();
  in.require(attribute.components > 0);
  in.require(std::isfinite(attribute.quantization_step) && attribute.quantization_step >= 0);
  return attribute;
}

Frame write_mesh(const DracoMesh& mesh) {
  FieldWriter out = begin(Kind::mesh);
  out.number(mesh.points);
  out.number(mesh.faces);
  const std::size_t count = std::min(mesh.attributes.size(), kMostAttributes);
  out.number(static_cast<std::uint32_t>(count));
  for (std::size_t i = 0; i < count; ++i) write(out, mesh.attributes[i]);
  return out.take();
}

DracoMesh read_mesh(FieldReader& in) {
  DracoMesh mesh;
  mesh.points = in.number<std::uint32_t>();
  mesh.faces = in.number<std::uint32_t>();
  const auto count = in.number<std::uint32_t>();
  in.require(count <= kMostAttributes);
  for (std::uint32_t i = 0; i < count && in.sound(); ++i) {
    mesh.attributes.push_back(read_attribute(in));
  }
  in.require(result_size(mesh).has_value());
  return mesh;
}

void write(FieldWriter& out, const ChannelStatistics& channel) {
  out.number(channel.least);
  out.number(channel.greatest);
  out.number(channel.zeros);
  out.number(channel.fulls);
}

ChannelStatistics read_channel(FieldReader& in, const Image& image) {
  ChannelStatistics channel;
  channel.least = in.number<std::uint32_t>();
  channel.greatest = in.number<std::uint32_t>();
  channel.zeros = in.number<std::uint64_t>();
  channel.fulls = in.number<std::uint64_t>();
  in.require(channel.least <= channel.greatest && channel.greatest <= image.full());
  in.require(channel.zeros <= image.texels() && channel.fulls <= image.texels() - channel.zeros);
  return channel;
}

void write(FieldWriter& out, const NormalStatistics& normals) {
  out.number(normals.vectors);
  out.number(normals.not_unit);
  out.number(normals.far_off);
  out.number(normals.inward);
  out.number(normals.mean_length);
  out.number(normals.steepest);
}

NormalStatistics read_normals(FieldReader& in, const Image& image) {
  NormalStatistics normals;
  normals.vectors = in.check_at_most(in.number<std::uint64_t>(), image.texels());
  normals.not_unit = in.check_at_most(in.number<std::uint64_t>(), normals.vectors);
  normals.far_off = in.check_at_most(in.number<std::uint64_t>(), normals.not_unit);
  normals.inward = in.check_at_most(in.number<std::uint64_t>(), normals.vectors);
  normals.mean_length = in.number<double>();
  normals.steepest = in.number<double>();
  in.require(normals.mean_length >= 0 && normals.mean_length <= 2);
  in.require(normals.steepest >= 0 && normals.steepest <= 1);
  return normals;
}

Frame write_image(const Image& image) {
  FieldWriter out = begin(Kind::image);
  out.number(image.width);
  out.number(image.height);
  out.number(image.channels);
  out.number(image.bits);
  for (const ChannelStatistics& channel : image.statistics) write(out, channel);
  out.number(static_cast<std::uint8_t>(image.grey));
  write(out, image.normals);
  out.text(std::string_view(image.doubt).substr(0, kMostMessageBytes));
  return out.take();
}

Image read_image(FieldReader& in) {
  Image image;
  image.width = in.number<std::uint32_t>();
  image.height = in.number<std::uint32_t>();
  image.channels = in.check_at_most(in.number<std::uint32_t>(), 4U);
  image.bits = in.number<std::uint32_t>();
  in.require(image.width > 0 && image.height > 0 && image.channels > 0);
  in.require(image.bits == 8 || image.bits == 16 || image.bits == 32);
  for (ChannelStatistics& channel : image.statistics) channel = read_channel(in, image);
  image.grey = in.flag();
  image.normals = read_normals(in, image);
  image.doubt = in.text(kMostMessageBytes);
  in.require(result_size(image).has_value());
  return image;
}

void write(FieldWriter& out, const Raster& raster) {
  out.number(raster.width);
  out.number(raster.height);
  out.number(raster.channels);
  out.number(raster.bits);
}

Raster read_raster(FieldReader& in) {
  Raster raster;
  raster.width = in.number<std::uint32_t>();
  raster.height = in.number<std::uint32_t>();
  raster.channels = in.number<std::uint32_t>();
  raster.bits = in.number<std::uint32_t>();
  return raster;
}

Frame write_encoded(const EncodedImage& image) {
  FieldWriter out = begin(Kind::encoded);
  out.number(image.size);
  write(out, image.source);
  write(out, image.raster);
  out.number(static_cast<std::uint8_t>(image.distance.has_value()));
  if (image.distance) {
    out.number(image.distance->greatest);
    out.number(image.distance->mean_square);
    out.number(static_cast<std::uint8_t>(image.distance->angle.has_value()));
    if (image.distance->angle) out.number(*image.distance->angle);
  }
  return out.take();
}

EncodedImage read_encoded(FieldReader& in) {
  EncodedImage image;
  image.size = in.number<std::uint64_t>();
  in.require(image.size > 0);
  image.source = read_raster(in);
  image.raster = read_raster(in);
  if (!in.flag()) return image;
  ImageDistance distance;
  distance.greatest = in.number<double>();
  distance.mean_square = in.number<double>();
  in.require(std::isfinite(distance.greatest) && std::isfinite(distance.mean_square) &&
             distance.greatest >= 0 && distance.mean_square >= 0);
  if (in.flag()) {
    distance.angle = in.number<double>();
    in.require(*distance.angle >= 0 && *distance.angle <= 180);
  }
  image.distance = distance;
  return image;
}

void write(FieldWriter& out, const Resize& resize) {
  out.number(resize.max_side);
  out.name(resize.kind);
  out.number(static_cast<std::uint8_t>(resize.weigh_alpha));
  out.number(resize.alpha_cutoff);
  out.name(resize.wrap_u);
  out.name(resize.wrap_v);
}

Resize read_resize(FieldReader& in) {
  Resize resize;
  resize.max_side = in.number<std::uint32_t>();
  resize.kind = in.name(TexelKind::data);
  resize.weigh_alpha = in.flag();
  resize.alpha_cutoff = in.number<float>();
  resize.wrap_u = in.name(Wrap::mirror);
  resize.wrap_v = in.name(Wrap::mirror);
  return resize;
}

void write(FieldWriter& out, const EncodeOptions& options) {
  out.number(options.near_lossless);
  out.number(static_cast<std::uint8_t>(options.subsampled));
  out.number(static_cast<std::uint8_t>(options.smallest));
  out.number(options.frames);
  out.number(options.frame_microseconds);
}

EncodeOptions read_options(FieldReader& in) {
  EncodeOptions options;
  options.near_lossless = in.check_at_most(in.number<std::uint32_t>(), 100U);
  options.subsampled = in.flag();
  options.smallest = in.flag();
  options.frames = in.number<std::uint32_t>();
  options.frame_microseconds = in.number<std::uint32_t>();
  return options;
}

std::optional<std::uint64_t> size_of(const Raster& raster) {
  return checked_mul(std::uint64_t{raster.width} * raster.height,
                     std::uint64_t{raster.channels} * (raster.bits / 8));
}

Frame write_error(const DecodeError& error) {
  FieldWriter out = begin(Kind::error);
  out.name(error.kind);
  out.text(std::string_view(error.message).substr(0, kMostMessageBytes));
  return out.take();
}

DecodeError read_error(FieldReader& in) {
  DecodeError error;
  error.kind = in.name(ErrorKind::died);
  error.message = in.text(kMostMessageBytes);
  return error;
}

template <typename T>
std::optional<T> whole(const FieldReader& in, T value) {
  return in.complete() ? std::optional<T>(std::move(value)) : std::nullopt;
}

}  // namespace

Frame write_hello(const Hello& hello) {
  FieldWriter out = begin(Kind::hello);
  out.number(static_cast<std::uint8_t>(hello.filtered));
  return out.take();
}

std::optional<Hello> read_hello(std::span<const std::byte> frame) {
  FieldReader in(frame);
  if (read_kind(in) != Kind::hello) return std::nullopt;
  const Hello hello{in.flag()};
  return whole(in, hello);
}

Frame write_job(const Job& job) {
  FieldWriter out = begin(Kind::job);
  out.name(job.task);
  out.name(job.format);
  out.number(job.level);
  out.number(static_cast<std::uint8_t>(job.pixels));
  out.number(static_cast<std::uint8_t>(job.normals));
  out.number(job.halvings);
  out.number(static_cast<std::uint8_t>(job.floats));
  write(out, job.resize);
  write(out, job.raster);
  out.name(job.encoded);
  out.number(job.quality);
  write(out, job.options);
  out.number(job.input_bytes);
  out.number(job.max_pixels);
  out.number(job.memory_bytes);
  out.number(job.milliseconds);
  return out.take();
}

std::optional<Job> read_job(std::span<const std::byte> frame) {
  FieldReader in(frame);
  if (read_kind(in) != Kind::job) return std::nullopt;
  Job job;
  job.task = in.name(Task::transcode);
  job.format = in.name(ImageFormat::pnm);
  job.level = in.number<std::uint32_t>();
  job.pixels = in.flag();
  job.normals = in.flag();
  job.halvings = in.check_at_most(in.number<std::uint8_t>(), kMostHalvings);
  job.floats = in.flag();
  job.resize = read_resize(in);
  job.raster = read_raster(in);
  job.encoded = in.name(EncodedFormat::avif);
  job.quality = in.number<std::uint32_t>();
  job.options = read_options(in);
  job.input_bytes = in.number<std::uint64_t>();
  job.max_pixels = in.number<std::uint64_t>();
  job.memory_bytes = in.number<std::uint64_t>();
  job.milliseconds = in.number<std::uint64_t>();
  in.require(is_consistent(job));
  return whole(in, job);
}

Frame write_answer(const Answer& answer) {
  if (const auto* mesh = std::get_if<DracoMesh>(&answer)) return write_mesh(*mesh);
  if (const auto* image = std::get_if<Image>(&answer)) return write_image(*image);
  if (const auto* encoded = std::get_if<EncodedImage>(&answer)) return write_encoded(*encoded);
  return write_error(*std::get_if<DecodeError>(&answer));
}

std::optional<Answer> read_answer(std::span<const std::byte> frame) {
  FieldReader in(frame);
  const auto kind = read_kind(in);
  if (kind == Kind::mesh) return whole(in, Answer(read_mesh(in)));
  if (kind == Kind::image) return whole(in, Answer(read_image(in)));
  if (kind == Kind::encoded) return whole(in, Answer(read_encoded(in)));
  if (kind == Kind::error) return whole(in, Answer(read_error(in)));
  return std::nullopt;
}

bool format_holds(const Job& job, const Raster& raster) {
  switch (job.encoded) {
    case EncodedFormat::png:
      return raster.bits == 8 || raster.bits == 16;
    case EncodedFormat::jpeg:
      return raster.bits == 8 && raster.channels % 2 == 1 && job.quality > 0;
    case EncodedFormat::webp:
      return raster.bits == 8;
    case EncodedFormat::exr:
      return raster.bits == 32;
    case EncodedFormat::ktx2:
      return raster.bits == 8 && job.task == Task::transcode;
    case EncodedFormat::avif:
      return raster.bits == 8 && job.task == Task::transcode && job.quality > 0;
  }
  return false;
}

namespace {

// Whether the raster is as many frames as the options say.
bool has_frames(const Job& job) {
  const std::uint32_t frames = job.options.frames;
  if (frames == 1) return true;
  return frames > 0 && job.task == Task::encode && job.encoded == EncodedFormat::webp &&
         job.raster.height % frames == 0;
}

}  // namespace

bool is_consistent(const Job& job) {
  if (job.quality > 100 || job.options.near_lossless > 100 || !has_frames(job)) return false;
  if (!std::isfinite(job.resize.alpha_cutoff)) return false;
  const Raster& raster = job.raster;
  const bool texels = raster.width != 0 || raster.height != 0;
  if (job.task != Task::encode && !texels) return true;
  if (raster.width == 0 || raster.height == 0) return false;
  if (raster.channels == 0 || raster.channels > 4) return false;
  if (raster.bits != 8 && raster.bits != 16 && raster.bits != 32) return false;
  if (size_of(raster) != job.input_bytes) return false;
  return job.task != Task::encode || format_holds(job, raster);
}

}  // namespace gltfx::codec
