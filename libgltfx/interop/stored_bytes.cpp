// SPDX-License-Identifier: Apache-2.0
#include "interop/stored_bytes.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "base/text.hpp"
#include "container/base64.hpp"
#include "container/uri.hpp"
#include "interop/image_data.hpp"
#include "report/file_uri.hpp"

namespace gltfx::interop {
namespace {

constexpr std::string_view kBytes = "application/octet-stream";

std::string_view text_of(const std::vector<unsigned char>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// "a/wood.jpg" as "a/wood.png": readers use the ending.
std::string with_ending(const std::string& uri, std::string_view media_type) {
  const std::string ending = media_type == "image/webp" ? ".webp" : ".png";
  const std::size_t dot = uri.rfind('.');
  const std::size_t slash = uri.rfind('/');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return uri + ending;
  return uri.substr(0, dot) + ending;
}

}  // namespace

StoredBytes::StoredBytes(const tinygltf::Model& model, const StorageForm& form, Notes& notes)
    : form_(form), notes_(notes) {
  for (std::size_t i = 0; i < model.buffers.size(); ++i) place_buffer(model, i);
  for (std::size_t i = 0; i < model.images.size(); ++i) place_image(model, i);
}

void StoredBytes::place_buffer(const tinygltf::Model& model, std::size_t index) {
  const tinygltf::Buffer& buffer = model.buffers[index];
  Storage& storage = buffers_.emplace_back();
  const std::string_view bytes = text_of(buffer.data);
  if (form_.glb && index == 0 && buffer.uri.empty()) {
    bin_ = bytes;
    return;
  }
  const std::string wanted = buffer.uri.empty() ? own_name(index, ".bin") : buffer.uri;
  storage.uri = keep(wanted, kBytes, bytes, fmt::format("/buffers/{}", index));
}

void StoredBytes::place_image(const tinygltf::Model& model, std::size_t index) {
  const tinygltf::Image& image = model.images[index];
  Storage& storage = images_.emplace_back(Storage{image.uri, image.mimeType});
  if (image.bufferView >= 0) {
    storage.uri.clear();
    return;
  }
  const Path root;
  const Path list(root, "images");
  const Path path(list, index);
  const auto file = image_file(image, path, notes_);
  if (!file) return;
  std::string wanted = image.uri;
  if (!image.as_is && !wanted.empty()) wanted = with_ending(wanted, file->media_type);
  if (wanted != image.uri) {
    notes_.changed(path, fmt::format("is stored as {}", gltfx::quoted(wanted)));
  }
  if (!storage.media_type.empty()) storage.media_type = file->media_type;
  storage.uri = keep(wanted, file->media_type, file->bytes, path.pointer());
}

std::string StoredBytes::own_name(std::size_t index, std::string_view ending) const {
  const std::string stem = std::filesystem::path(form_.name).stem().native();
  const std::string number = index == 0 ? std::string() : fmt::format("-{}", index);
  return report::file_uri(fmt::format("{}{}{}", stem, number, ending), {}).text;
}

std::string StoredBytes::keep(std::string_view wanted, std::string_view media_type,
                              std::string_view bytes, const std::string& pointer) {
  if (form_.embed || wanted.empty()) return container::data_uri(media_type, bytes);
  const container::Uri uri = container::classify_uri(wanted);
  const bool inside = uri.kind == container::UriKind::relative_path && !uri.path.empty() &&
                      !container::leads_out(uri.path);
  if (!inside) {
    if (uri.kind != container::UriKind::data) {
      notes_.changed(pointer + "/uri", "is outside the asset's folder: the bytes are embedded");
    }
    return container::data_uri(media_type, bytes);
  }
  add_file(uri.path, bytes, pointer);
  return std::string(wanted);
}

void StoredBytes::add_file(const std::string& path, std::string_view bytes,
                           const std::string& pointer) {
  std::string& file = files_[path];
  if (bytes.starts_with(file)) {
    file = bytes;
  } else if (!std::string_view(file).starts_with(bytes)) {
    notes_.fail(fmt::format("{} and something else have different bytes for one file", pointer));
  }
}

}  // namespace gltfx::interop
