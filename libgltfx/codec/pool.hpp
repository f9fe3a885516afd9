// SPDX-License-Identifier: Apache-2.0
/// Workers of one kind, shared by threads: one request a worker at a time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "codec/launcher.hpp"
#include "codec/protocol.hpp"
#include "codec/shared_memory.hpp"

namespace gltfx::codec {

/// An answer with its spans attached, and the memory they lie in.
struct Reply {
  Answer answer;
  Taken memory;
};

/// Thread-safe. Starts a worker when one is needed and fewer than `most` (0: as many as there are
/// processors) are there. A worker is given bytes of one origin only. May throw std::bad_alloc.
class Pool {
 public:
  /// A worker that neither works nor answers for as long as `standstill` is ended.
  Pool(std::string program, unsigned most, std::chrono::milliseconds standstill);
  Reply ask(const Job& job, std::span<const std::byte> bytes, const Origin& origin);
  /// Gets ready to start workers, without waiting for it.
  void prepare() { launcher_.prepare(); }

 private:
  using Kept = std::unique_ptr<Worker>;
  struct Lease;
  Reply ask(Kept& worker, const Job& job, std::span<const std::byte> bytes, const Origin& origin);
  Reply answer_of(Kept worker, const Job& job, int result, Kept& sound) const;

  const std::chrono::milliseconds standstill_;
  const unsigned most_;
  Launcher launcher_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Kept> idle_;  ///< used last at the back
  unsigned leased_ = 0;
};

}  // namespace gltfx::codec
