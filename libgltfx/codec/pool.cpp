// SPDX-License-Identifier: Apache-2.0
#include "codec/pool.hpp"

#include <algorithm>
#include <bit>
#include <csignal>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "codec/packet.hpp"
#include "codec/watch.hpp"

namespace gltfx::codec {
namespace {

using std::chrono::milliseconds;

// What a worker may take at least whatever its job: one that served a small job serves a large one.
constexpr std::uint64_t kWorkerMemory = std::uint64_t{4} << 30U;
// A worker ends itself when its time is over. One that no longer does is ended a little later.
constexpr milliseconds kGrace{1000};

Reply error(ErrorKind kind, std::string message) {
  return {DecodeError{kind, std::move(message)}, {}};
}

Reply overrun(const Job& job) {
  return error(ErrorKind::timed_out,
               fmt::format("{} exceeds {} ms of processor time, the limit for {} bytes.",
                           job.task == Task::encode ? "Encoding" : "Decoding", job.milliseconds,
                           job.input_bytes));
}

// A worker without an answer.
Reply epitaph(Worker& worker, const Job& job) {
  const int signal = worker.end();
  if (signal == SIGPROF || signal == SIGXCPU) return overrun(job);
  return error(ErrorKind::died, signal == 0
                                    ? std::string("The decoder exited without a result.")
                                    : fmt::format("The decoder crashed (signal {}).", signal));
}

bool is_wanted(const Answer& answer, const Job& job) {
  if (const auto* error = std::get_if<DecodeError>(&answer))
    return error->kind != ErrorKind::unavailable;
  if (job.task == Task::draco) return std::holds_alternative<DracoMesh>(answer);
  if (job.task == Task::encode) return std::holds_alternative<EncodedImage>(answer);
  const auto* image = std::get_if<Image>(&answer);
  return image != nullptr && image->texels() <= job.max_pixels;
}

// Points a result into the memory that the worker has filled. False when it is not there.
template <typename T>
bool attach_memory(T& result, Taken& to, const Job& job, int memory) {
  const auto size = result_size(result);
  if (!size || *size > job.memory_bytes) return false;
  auto taken = take_memory(memory, *size);
  if (!taken) return false;
  to = *std::move(taken);
  return attach(result, to.bytes);
}

bool attach_memory(Reply& reply, const Job& job, int memory) {
  const auto attach = [&](auto& result) {
    return attach_memory(result, reply.memory, job, memory);
  };
  if (auto* mesh = std::get_if<DracoMesh>(&reply.answer)) return attach(*mesh);
  if (auto* encoded = std::get_if<EncodedImage>(&reply.answer)) return attach(*encoded);
  auto* image = std::get_if<Image>(&reply.answer);
  return image == nullptr || !job.pixels || attach(*image);
}

// Whether a worker is as good as new after an answer.
bool is_fresh(const Answer& answer) {
  const auto* error = std::get_if<DecodeError>(&answer);
  return error == nullptr || error->kind == ErrorKind::malformed ||
         error->kind == ErrorKind::too_large;
}

}  // namespace

Pool::Pool(std::string program, unsigned most, milliseconds standstill)
    : standstill_(standstill),
      most_(most == 0 ? default_jobs() : most),
      launcher_(std::move(program), standstill) {
  idle_.reserve(most_);
}

// The right to have a worker at work.
struct Pool::Lease {
  Lease(Pool& from, const Origin& origin, std::uint64_t memory_bytes) : pool(from) {
    std::unique_lock lock(pool.mutex_);
    pool.changed_.wait(lock, [&] { return pool.leased_ < pool.most_; });
    ++pool.leased_;
    auto& idle = pool.idle_;
    const auto fit = std::find_if(idle.rbegin(), idle.rend(), [&](const Kept& each) {
      return each->origin == origin && each->memory_bytes() >= memory_bytes;
    });
    if (fit != idle.rend()) {
      worker = std::move(*fit);
      idle.erase(std::next(fit).base());
    } else if (idle.size() + pool.leased_ > pool.most_) {
      displaced = std::move(idle.front());
      idle.erase(idle.begin());
    }
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  ~Lease() {
    const std::lock_guard lock(pool.mutex_);
    --pool.leased_;
    if (worker) pool.idle_.push_back(std::move(worker));
    pool.changed_.notify_one();
  }

  Pool& pool;
  Kept worker;     ///< null: there is none that fits
  Kept displaced;  ///< made room for another
};

Reply Pool::ask(const Job& job, std::span<const std::byte> bytes, const Origin& origin) {
  Lease lease(*this, origin, job.memory_bytes);
  lease.displaced.reset();
  return ask(lease.worker, job, bytes, origin);
}

Reply Pool::ask(Kept& worker, const Job& job, std::span<const std::byte> bytes,
                const Origin& origin) {
  const UniqueFd payload = create_memory();
  const UniqueFd result = create_memory();
  if (!payload || !result || !fill_memory(payload.get(), bytes)) {
    return error(ErrorKind::unavailable, "No memory to share with the decoder.");
  }
  const int descriptors[] = {payload.get(), result.get()};
  const Frame frame = write_job(job);
  // One that has died meanwhile is replaced.
  if (worker && !send_packet(worker->socket(), frame, descriptors)) worker.reset();
  if (!worker) {
    auto started = launcher_.start(std::max(kWorkerMemory, std::bit_ceil(job.memory_bytes)));
    if (auto* trouble = std::get_if<DecodeError>(&started)) return {std::move(*trouble), {}};
    worker = std::move(*std::get_if<Kept>(&started));
    worker->origin = origin;
    if (!send_packet(worker->socket(), frame, descriptors))
      return epitaph(*std::exchange(worker, {}), job);
  }
  return answer_of(std::exchange(worker, nullptr), job, result.get(), worker);
}

// Gives the worker back in `sound` when it has shown to be that.
Reply Pool::answer_of(Kept worker, const Job& job, int result, Kept& sound) const {
  const Watch watched =
      watch(worker->socket(), worker->id(), {milliseconds(job.milliseconds) + kGrace, standstill_});
  if (watched == Watch::overrun) return overrun(job);
  if (watched == Watch::standstill) {
    return error(ErrorKind::stalled, "The decoder stopped responding.");
  }
  const auto packet = receive_packet(worker->socket());
  if (!packet) return epitaph(*worker, job);
  auto answer = read_answer(packet->bytes);
  const auto contradiction = [] {
    return error(ErrorKind::died, "The result of the decoder is inconsistent.");
  };
  if (!answer) return contradiction();
  Reply reply{*std::move(answer), {}};
  if (!is_wanted(reply.answer, job) || !attach_memory(reply, job, result)) return contradiction();
  if (is_fresh(reply.answer)) sound = std::move(worker);
  return reply;
}

}  // namespace gltfx::codec
