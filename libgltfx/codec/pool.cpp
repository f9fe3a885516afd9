// SPDX-License-Identifier: Apache-2.0
#include "codec/pool.hpp"

#include <gltfx/decoders.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <csignal>
#include <exception>

#include <fmt/format.h>

#include "base/fork.hpp"
#include "base/parallel.hpp"

namespace gltfx {
namespace {

std::atomic<bool> unfiltered_permitted = false;

}  // namespace

void permit_unsandboxed_decoders(bool permitted) { unfiltered_permitted = permitted; }

namespace codec {
namespace {

// Loading libraries takes a second at most: a program that takes much longer will not finish.
constexpr std::chrono::minutes kStartTime{2};

// An asset may have a hundred thousand images, and each would start a failing program.
constexpr int kMostFailures = 3;

constexpr const char* kWrongGreeting = "it has a different protocol version";
constexpr const char* kSilent = "it does not respond";
constexpr const char* kUnfiltered =
    "its system calls are not filtered (use --unsandboxed-decoders to allow that)";

}  // namespace

Worker::~Worker() {
  try {
    end();
  } catch (const std::exception&) {  // closing the lifeline ends the process
  }
}

DecodeError Launcher::not_started(const std::string& why) const {
  return {ErrorKind::unavailable,
          fmt::format("The decoder {} could not be started: {}.", program_, why)};
}

void Launcher::prepare() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || process_ || final_) return;
  process_ = std::make_unique<Process>(program_);
  ready_ = false;
  if (!process_->started()) process_.reset();
}

// Starts the launcher unless it runs, and waits for its greeting.
Launcher::Trouble Launcher::launch() {
  if (final_) return final_;
  if (process_ && ready_) return std::nullopt;
  if (!process_) process_ = std::make_unique<Process>(program_);
  Trouble trouble = process_->started() ? greet() : Trouble(process_->start_error());
  ready_ = !trouble;
  if (ready_) {
    failures_ = 0;
  } else if (!process_->lacked_resources() && ++failures_ == kMostFailures) {
    final_ = trouble;
  }
  if (trouble) process_.reset();
  return trouble;
}

Launcher::Trouble Launcher::greet() {
  const Watch watched = watch(process_->socket(), process_->id(), {kStartTime, standstill_});
  if (watched != Watch::ready) return final_ = kSilent;
  const auto packet = receive_packet(process_->socket());
  if (!packet) return process_->end();
  return read_control(packet->bytes) == Control{} ? Trouble() : Trouble(kWrongGreeting);
}

Launcher::Trouble Launcher::greet(Worker& worker) {
  const Watch watched = watch(worker.socket(), worker.id(), {kStartTime, standstill_});
  if (watched != Watch::ready) return kSilent;
  const auto packet = receive_packet(worker.socket());
  const auto hello = packet ? read_hello(packet->bytes) : std::nullopt;
  if (!hello) return kWrongGreeting;
  if (!hello->filtered) unfiltered_ = true;
  return hello->filtered || unfiltered_permitted ? Trouble() : Trouble(kUnfiltered);
}

// The answer to a message. Nothing if the launcher has ended or breaks the protocol: it is then
// removed.
std::optional<Control> Launcher::ask(const Control& control, std::span<const int> descriptors) {
  std::unique_ptr<Process> process = std::move(process_);
  const int socket = process->socket();
  if (!send_packet(socket, write_control(control), descriptors)) return std::nullopt;
  if (watch(socket, process->id(), {kStartTime, standstill_}) != Watch::ready) return std::nullopt;
  const auto packet = receive_packet(socket);
  const auto answer = packet ? read_control(packet->bytes) : std::nullopt;
  if (answer) process_ = std::move(process);
  return answer;
}

std::variant<std::unique_ptr<Worker>, DecodeError> Launcher::start(std::uint64_t memory_bytes) {
  if (unfiltered_ && !unfiltered_permitted) return not_started(kUnfiltered);
  Ends ends = Ends::create();
  if (!ends.complete()) return not_started("no file descriptors left");
  const std::array<int, 2> descriptors{ends.worker_socket.get(), ends.worker_lifeline.get()};
  std::unique_lock lock(mutex_);
  std::optional<Control> started;
  // A launcher that has died in the meantime is replaced.
  for (int attempt = 0; attempt < 2 && !started; ++attempt) {
    if (const Trouble trouble = launch()) return not_started(*trouble);
    started = ask({Control::Kind::start, memory_bytes}, descriptors);
  }
  if (!started || started->kind != Control::Kind::started) return not_started(kWrongGreeting);
  if (started->value == 0) return not_started("no processes left");
  lock.unlock();
  // Without a copy here, the socket closes when the worker ends.
  ends.worker_socket = OwnDescriptor();
  ends.worker_lifeline = OwnDescriptor();
  auto worker = std::make_unique<Worker>(*this, static_cast<pid_t>(started->value), std::move(ends),
                                         memory_bytes);
  if (const Trouble trouble = greet(*worker)) return not_started(*trouble);
  return worker;
}

int Launcher::finish(pid_t worker) {
  const std::lock_guard lock(mutex_);
  if (!process_ || !ready_) return 0;  // without the launcher, the lifeline ends the worker
  const auto ended = ask({Control::Kind::finish, static_cast<std::uint64_t>(worker)}, {});
  return ended && ended->kind == Control::Kind::ended ? static_cast<int>(ended->value) : 0;
}

}  // namespace codec

}  // namespace gltfx

namespace gltfx::codec {
namespace {

// Least memory limit of a worker for any job, so that a worker with small jobs can also do a large
// one.
constexpr std::uint64_t kWorkerMemory = std::uint64_t{4} << 30U;
// A worker stops itself at its time limit. If it does not, it is stopped a little later.
constexpr std::chrono::milliseconds kGrace{1000};

Reply error(ErrorKind kind, std::string message) {
  return {DecodeError{kind, std::move(message)}, {}};
}

Reply overrun(const Job& job) {
  return error(
      ErrorKind::timed_out,
      fmt::format("{} exceeds {} ms of processor time, the limit for {} bytes.",
                  encodes(job.task) ? "Encoding" : "Decoding", job.milliseconds, job.input_bytes));
}

// The reply for a worker that did not answer.
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
  if (encodes(job.task)) return std::holds_alternative<EncodedImage>(answer);
  const auto* image = std::get_if<Image>(&answer);
  return image != nullptr && image->texels() <= job.max_pixels;
}

// Points a result into the memory that the worker has filled. False if memory is missing.
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

// Whether a worker can be used again after an answer.
bool is_fresh(const Answer& answer) {
  const auto* error = std::get_if<DecodeError>(&answer);
  return error == nullptr || depends_on_bytes_alone(*error);
}

}  // namespace

Pool::Pool(std::string program, unsigned most, std::chrono::milliseconds standstill)
    : standstill_(standstill),
      most_(most == 0 ? default_jobs() : most),
      launcher_(std::move(program), standstill) {
  idle_.reserve(most_);
}

// The permission to use a worker.
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
  Kept worker;     ///< null: no suitable idle worker
  Kept displaced;  ///< removed to make room for another
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
  // A worker that has died in the meantime is replaced.
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

// Returns the worker in `sound` if it can be used again.
Reply Pool::answer_of(Kept worker, const Job& job, int result, Kept& sound) const {
  const Watch watched = watch(worker->socket(), worker->id(),
                              {std::chrono::milliseconds(job.milliseconds) + kGrace, standstill_});
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
