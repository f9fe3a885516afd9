// SPDX-License-Identifier: Apache-2.0
#include "codec/launcher.hpp"

#include <gltfx/decoders.hpp>

#include <array>
#include <atomic>
#include <exception>

#include <fmt/format.h>

#include "codec/packet.hpp"
#include "codec/protocol.hpp"
#include "codec/watch.hpp"

namespace gltfx {
namespace {

std::atomic<bool> unfiltered_permitted = false;

}  // namespace

void permit_unsandboxed_decoders(bool permitted) { unfiltered_permitted = permitted; }

namespace codec {
namespace {

// Loading libraries takes a second at most: a program that takes longer is in an endless loop.
constexpr std::chrono::minutes kStartTime{2};

constexpr const char* kWrongGreeting = "it has a different protocol version";
constexpr const char* kSilent = "it does not respond";
constexpr const char* kUnfiltered =
    "its system calls are not filtered (use --unsandboxed-decoders to allow that)";

}  // namespace

Worker::~Worker() {
  try {
    end();
  } catch (const std::exception&) {  // the end of the lifeline ends the process
  }
}

DecodeError Launcher::not_started(const std::string& why) const {
  return {ErrorKind::unavailable,
          fmt::format("The decoder {} could not be started: {}.", program_, why)};
}

void Launcher::prepare() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || process_ || silent_) return;
  process_ = std::make_unique<Process>(program_);
  ready_ = false;
  if (!process_->started()) process_.reset();
}

// Sees to it that there is a launcher that has greeted.
Launcher::Trouble Launcher::launch() {
  if (silent_) return kSilent;
  if (process_ && ready_) return std::nullopt;
  if (!process_) process_ = std::make_unique<Process>(program_);
  Trouble trouble = process_->started() ? greet() : Trouble(process_->start_error());
  ready_ = !trouble;
  if (trouble) process_.reset();
  return trouble;
}

Launcher::Trouble Launcher::greet() {
  const Watch watched = watch(process_->socket(), process_->id(), {kStartTime, standstill_});
  silent_ = watched != Watch::ready;
  if (silent_) return kSilent;
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
  return hello->filtered || unfiltered_permitted ? Trouble() : Trouble(kUnfiltered);
}

// The answer to a message. Nothing when the launcher has ended or breaks the protocol: then there
// is none any more.
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
  Ends ends = Ends::create();
  if (!ends.complete()) return not_started("no file descriptors left");
  const std::array<int, 2> descriptors{ends.worker_socket.get(), ends.worker_lifeline.get()};
  std::unique_lock lock(mutex_);
  std::optional<Control> started;
  // One that has died meanwhile is replaced.
  for (int attempt = 0; attempt < 2 && !started; ++attempt) {
    if (const Trouble trouble = launch()) return not_started(*trouble);
    started = ask({Control::Kind::start, memory_bytes}, descriptors);
  }
  if (!started || started->kind != Control::Kind::started) return not_started(kWrongGreeting);
  if (started->value == 0) return not_started("no processes left");
  lock.unlock();
  // With no copy here, its end closes the socket.
  ends.worker_socket = UniqueFd();
  ends.worker_lifeline = UniqueFd();
  auto worker = std::make_unique<Worker>(*this, static_cast<pid_t>(started->value), std::move(ends),
                                         memory_bytes);
  if (const Trouble trouble = greet(*worker)) return not_started(*trouble);
  return worker;
}

int Launcher::finish(pid_t worker) {
  const std::lock_guard lock(mutex_);
  if (!process_ || !ready_) return 0;  // with the launcher gone, the lifeline ends the worker
  const auto ended = ask({Control::Kind::finish, static_cast<std::uint64_t>(worker)}, {});
  return ended && ended->kind == Control::Kind::ended ? static_cast<int>(ended->value) : 0;
}

}  // namespace codec
}  // namespace gltfx
