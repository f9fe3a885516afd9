// SPDX-License-Identifier: Apache-2.0
#include "codec/pool.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "codec/packet.hpp"

namespace gltfx::codec {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStartTime{30000};
// A busy machine gives a worker less than one processor; only one that stands still is ended by
// the clock on the wall.
constexpr std::uint64_t kWallPerProcessorTime = 8;
constexpr milliseconds kWallAtLeast{2000};

Reply fault(FaultKind kind, std::string message) { return {Fault{kind, std::move(message)}, {}}; }

// Its end closes the socket, but where somebody else holds a copy of it nobody hears of that.
bool wait_for_answer(const Process& worker, milliseconds time) {
  constexpr milliseconds kLook{250};
  for (; time > milliseconds::zero(); time -= kLook) {
    if (wait_for_packet(worker.socket(), std::min(time, kLook)) == Wait::ready) return true;
    if (worker.has_ended()) break;
  }
  return wait_for_packet(worker.socket(), milliseconds::zero()) == Wait::ready;
}

bool has_greeted(Process& process) {
  if (process.greeted()) return true;
  if (!process.started() || !wait_for_answer(process, kStartTime)) return false;
  const auto greeting = receive_packet(process.socket());
  if (!greeting || !read_hello(greeting->bytes)) return false;
  process.set_greeted();
  return true;
}

std::unique_ptr<Process> start(const std::string& program) {
  auto process = std::make_unique<Process>(program);
  return has_greeted(*process) ? std::move(process) : nullptr;
}

// A worker without an answer.
Reply epitaph(Process& worker, const Job& job) {
  const int signal = worker.cause_of_death();
  if (signal == SIGPROF || signal == SIGXCPU) {
    return fault(
        FaultKind::timed_out,
        fmt::format("{} takes longer than {} ms of processor time, the limit for {} bytes.",
                    job.task == Task::encode ? "Encoding" : "Decoding", job.milliseconds,
                    job.input_bytes));
  }
  return fault(FaultKind::died, signal == 0
                                    ? std::string("The decoder ended without an answer.")
                                    : fmt::format("The decoder crashed (signal {}).", signal));
}

bool is_wanted(const Answer& answer, const Job& job) {
  if (const auto* fault = std::get_if<Fault>(&answer)) return fault->kind != FaultKind::unavailable;
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
  const auto* fault = std::get_if<Fault>(&answer);
  return fault == nullptr || fault->kind == FaultKind::malformed ||
         fault->kind == FaultKind::too_large;
}

}  // namespace

Pool::Pool(std::string program, unsigned most)
    : program_(std::move(program)), most_(most == 0 ? default_jobs() : most) {}

Pool::Worker Pool::lease() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return leased_ < most_; });
  ++leased_;
  if (idle_.empty()) return nullptr;
  Worker worker = std::move(idle_.back());
  idle_.pop_back();
  return worker;
}

void Pool::give_back(Worker worker) {
  const std::lock_guard lock(mutex_);
  --leased_;
  if (worker) idle_.push_back(std::move(worker));
  changed_.notify_one();
}

void Pool::prepare() {
  const std::lock_guard lock(mutex_);
  if (leased_ > 0 || !idle_.empty()) return;
  auto worker = std::make_unique<Process>(program_);
  if (worker->started()) idle_.push_back(std::move(worker));
}

Reply Pool::ask(const Job& job, std::span<const std::byte> bytes) {
  struct Lease {
    Pool& pool;
    Worker worker;
    ~Lease() { pool.give_back(std::move(worker)); }
  } lease{*this, this->lease()};
  return ask(lease.worker, job, bytes);
}

Reply Pool::ask(Worker& worker, const Job& job, std::span<const std::byte> bytes) {
  const UniqueFd payload = create_memory();
  const UniqueFd result = create_memory();
  if (!payload || !result || !fill_memory(payload.get(), bytes)) {
    return fault(FaultKind::unavailable, "The system gives no memory to share with the decoder.");
  }
  const int descriptors[] = {payload.get(), result.get()};
  const Frame frame = write_job(job);
  // One that has died meanwhile is replaced.
  if (worker && !(has_greeted(*worker) && send_packet(worker->socket(), frame, descriptors))) {
    worker.reset();
  }
  if (!worker) {
    worker = start(program_);
    if (!worker || !send_packet(worker->socket(), frame, descriptors)) {
      worker.reset();
      return fault(FaultKind::unavailable,
                   fmt::format("The decoder {} could not be started.", program_));
    }
  }
  Worker asked = std::move(worker);  // given back when it has shown to be sound
  const milliseconds wall(job.milliseconds * kWallPerProcessorTime);
  if (!wait_for_answer(*asked, wall + kWallAtLeast)) {
    if (asked->has_ended()) return epitaph(*asked, job);
    return fault(FaultKind::timed_out, "The decoder does not come to an end.");
  }
  const auto packet = receive_packet(asked->socket());
  if (!packet) return epitaph(*asked, job);
  auto answer = read_answer(packet->bytes);
  const auto contradiction = [] {
    return fault(FaultKind::died, "The decoder's answer contradicts itself.");
  };
  if (!answer) return contradiction();
  Reply reply{*std::move(answer), {}};
  if (!is_wanted(reply.answer, job) || !attach_memory(reply, job, result.get())) {
    return contradiction();
  }
  if (is_fresh(reply.answer)) worker = std::move(asked);
  return reply;
}

}  // namespace gltfx::codec
