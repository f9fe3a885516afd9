// SPDX-License-Identifier: Apache-2.0
/// Images that several assets of a run share are encoded once.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "codec/client.hpp"

namespace gltfx::steps {

/// The results of one run, by content and request. Results of one origin are not given to another.
/// Safe to use from several threads.
class ImageEncodings {
 public:
  /// Greatest number of encoded bytes that are kept.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20U;

  /// codec::Client::transcode_image(), or its result for an equal request. A request that another
  /// thread is working on waits for its result.
  codec::EncodeResult transcode(const codec::TranscodeRequest& request);
  /// The number of results that were made and kept, for tests.
  std::uint64_t encoded() const;

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  struct Entry {
    std::mutex mutex;
    std::optional<codec::EncodeResult> result;
  };
  static Key key_of(const codec::TranscodeRequest& request);
  std::shared_ptr<Entry> entry(const Key& key);
  void keep(const Key& key, const codec::EncodeResult& result);

  mutable std::mutex mutex_;
  std::map<Key, std::shared_ptr<Entry>> entries_;
  std::deque<std::pair<Key, std::uint64_t>> kept_;  ///< with the size, the oldest first
  std::uint64_t bytes_ = 0;                         ///< of `kept_`
  std::uint64_t encoded_ = 0;
};

}  // namespace gltfx::steps
