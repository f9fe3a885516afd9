// SPDX-License-Identifier: Apache-2.0
#include "steps/image_encodings.hpp"

#include <bit>
#include <variant>

#include "base/secret_hash.hpp"

namespace gltfx::steps {
namespace {

template <class Value>
std::uint64_t number_of(Value value) {
  return static_cast<std::uint64_t>(value);
}

// Requests are taken apart by name: a new member must be added to the key.
void add(HashParts& parts, const codec::Resize& resize) {
  const auto& [max_side, kind, weigh_alpha, alpha_cutoff, wrap_u, wrap_v] = resize;
  parts.add(std::uint64_t{max_side});
  parts.add(number_of(kind));
  parts.add(number_of(weigh_alpha));
  parts.add(std::uint64_t{std::bit_cast<std::uint32_t>(alpha_cutoff)});
  parts.add(number_of(wrap_u));
  parts.add(number_of(wrap_v));
}

void add(HashParts& parts, const codec::EncodeOptions& options) {
  const auto& [near_lossless, subsampled, smallest, frames, frame_microseconds] = options;
  parts.add(std::uint64_t{frames});
  parts.add(std::uint64_t{frame_microseconds});
  parts.add(std::uint64_t{near_lossless});
  parts.add(number_of(subsampled));
  parts.add(number_of(smallest));
}

}  // namespace

ImageEncodings::Key ImageEncodings::key_of(const codec::TranscodeRequest& request) {
  const auto& [image, format, quality, options] = request;
  const auto& [bytes, source, level, max_pixels, halvings, pixels, normals, origin, floats,
               resize] = image;
  static_cast<void>(level);  // these four have no effect
  static_cast<void>(halvings);
  static_cast<void>(pixels);
  static_cast<void>(normals);
  HashParts parts;
  parts.add(secret_hash().of({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
  parts.add(number_of(source));
  parts.add(max_pixels);
  parts.add(origin.device);
  parts.add(origin.file);
  parts.add(number_of(floats));
  add(parts, resize);
  parts.add(number_of(format));
  parts.add(std::uint64_t{quality});
  add(parts, options);
  const Hash128 key = parts.finish();
  return {key.low, key.high};
}

std::shared_ptr<ImageEncodings::Entry> ImageEncodings::entry(const Key& key) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<Entry>& entry = entries_[key];
  if (!entry) entry = std::make_shared<Entry>();
  return entry;
}

// The oldest results make room.
void ImageEncodings::keep(const Key& key, const codec::EncodeResult& result) {
  const auto* image = std::get_if<codec::EncodedImage>(&result);
  const std::uint64_t size = image == nullptr ? 0 : image->size;
  const std::lock_guard lock(mutex_);
  ++encoded_;
  kept_.emplace_back(key, size);
  bytes_ += size;
  while (bytes_ > kMostBytes) {
    bytes_ -= kept_.front().second;
    entries_.erase(kept_.front().first);
    kept_.pop_front();
  }
}

codec::EncodeResult ImageEncodings::transcode(const codec::TranscodeRequest& request) {
  const Key key = key_of(request);
  const std::shared_ptr<Entry> known = entry(key);
  const std::lock_guard lock(known->mutex);
  if (known->result) return *known->result;
  codec::EncodeResult result = codec::Client::shared().transcode_image(request);
  // Another try may succeed after an error that does not come from the bytes, but not at any cost.
  const auto* error = std::get_if<codec::DecodeError>(&result);
  if (error == nullptr || codec::depends_on_bytes_alone(*error) || codec::is_costly(*error)) {
    known->result = result;
    keep(key, result);
  }
  return result;
}

std::uint64_t ImageEncodings::encoded() const {
  const std::lock_guard lock(mutex_);
  return encoded_;
}

}  // namespace gltfx::steps
