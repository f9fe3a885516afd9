// SPDX-License-Identifier: Apache-2.0
#include "image_encode.hpp"

#include <cstring>
#include <memory>
#include <new>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace gltfx::codec {
namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;

// The name tells OpenImageIO the format; nothing of it is ever opened.
const char* plugin_name(EncodedFormat format) {
  return format == EncodedFormat::exr ? "a.exr" : "a.jpg";
}

ImageSpec describe(const Job& job) {
  const bool floats = job.encoded == EncodedFormat::exr;
  ImageSpec spec(static_cast<int>(job.raster.width), static_cast<int>(job.raster.height),
                 static_cast<int>(job.raster.channels),
                 floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  if (floats) {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // else it is now, and bytes differ by time
    spec.attribute("oiio:UnassociatedAlpha", 1);
  } else {
    spec.attribute("compression", "jpeg:" + std::to_string(job.quality));
  }
  return spec;
}

}  // namespace

Answer hand_over(std::span<const std::byte> file, Output& output) {
  const std::span<std::byte> to = output.create(file.size());
  if (to.size() < file.size() || file.empty()) throw std::bad_alloc();
  std::memcpy(to.data(), file.data(), file.size());
  EncodedImage image;
  image.size = file.size();
  return image;
}

Answer encode_with_plugin(const Job& job, std::span<const std::byte> texels, Output& output) {
  const char* name = plugin_name(job.encoded);
  const std::unique_ptr<ImageOutput> encoder = ImageOutput::create(name);
  if (!encoder) return Fault{FaultKind::out_of_memory, "There is no encoder for the format."};
  OIIO::Filesystem::IOVecOutput file;
  ImageSpec spec = describe(job);
  void* proxy = &file;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  if (!encoder->open(name, spec) || !encoder->write_image(spec.format, texels.data()) ||
      !encoder->close()) {
    return Fault{FaultKind::malformed, encoder->geterror()};
  }
  return hand_over(std::as_bytes(std::span(file.buffer())), output);
}

void prepare_plugins() {
  for (const EncodedFormat format : {EncodedFormat::jpeg, EncodedFormat::exr}) {
    static_cast<void>(ImageOutput::create(plugin_name(format)));
  }
}

}  // namespace gltfx::codec
