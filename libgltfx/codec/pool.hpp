// SPDX-License-Identifier: Apache-2.0
/// Workers of one kind, shared by threads: one request a worker at a time.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "codec/process.hpp"
#include "codec/protocol.hpp"
#include "codec/shared_memory.hpp"

namespace gltfx::codec {

/// An answer with its spans attached, and the memory they lie in.
struct Reply {
  Answer answer;
  Taken memory;
};

/// Thread-safe. Starts a worker when one is needed and fewer than `most` (0: as many as there are
/// processors) are there. May throw std::bad_alloc.
class Pool {
 public:
  Pool(std::string program, unsigned most);
  Reply ask(const Job& job, std::span<const std::byte> bytes);
  /// Starts one worker, without waiting for it, unless there is one.
  void prepare();

 private:
  using Worker = std::unique_ptr<Process>;
  Worker lease();
  void give_back(Worker worker);
  Reply ask(Worker& worker, const Job& job, std::span<const std::byte> bytes);

  std::string program_;
  unsigned most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Worker> idle_;
  unsigned leased_ = 0;
};

}  // namespace gltfx::codec
