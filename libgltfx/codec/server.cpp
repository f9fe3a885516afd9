// SPDX-License-Identifier: Apache-2.0
#include "codec/server.hpp"

#include <csignal>
#include <exception>
#include <new>

#include <malloc.h>

#include "codec/packet.hpp"
#include "codec/process.hpp"
#include "codec/sandbox.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint64_t kMostResultBytes = std::uint64_t{8} << 30U;

Answer decode_safely(const Decode& decode, const Job& job, const Packet& packet) {
  const Mapping input(packet.descriptors[0].get(), job.input_bytes, Mapping::Access::read);
  if (input.bytes().size() != job.input_bytes) {
    return Fault{FaultKind::out_of_memory, "There is no memory for the payload."};
  }
  Output output(packet.descriptors[1].get());
  try {
    return decode(job, input.bytes(), output);
  } catch (const std::bad_alloc&) {
    return Fault{FaultKind::out_of_memory, "Decoding takes more memory than it may."};
  } catch (const std::exception& fault) {
    return Fault{FaultKind::malformed, fault.what()};
  }
}

// What one payload was decoded in serves for the next: pages that come from the system anew take a
// tenth of the time.
// NOLINTBEGIN(concurrency-mt-unsafe): before there are threads
void keep_memory() {
  ::mallopt(M_ARENA_MAX, 1);  // arenas of threads take address space in advance
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 128 << 20);
}
// NOLINTEND(concurrency-mt-unsafe)

// False when the client has gone or breaks the protocol.
bool serve_one(const Decode& decode, const JobLimits& limits) {
  const auto packet = receive_packet(kSocketDescriptor);
  if (!packet || packet->descriptors.size() != 2) return false;
  const auto job = read_job(packet->bytes);
  if (!job) return false;
  limits.begin(job->memory_bytes, job->milliseconds);
  const Answer answer = decode_safely(decode, *job, *packet);
  JobLimits::end();
  return send_packet(kSocketDescriptor, write_answer(answer), {});
}

}  // namespace

std::span<std::byte> Output::create(std::uint64_t size) {
  mapping_ = Mapping(fd_, size, Mapping::Access::write);
  return mapping_.bytes();
}

int serve(const std::function<void()>& prepare, const Decode& decode) {
  close_descriptors_from(kLifelineDescriptor + 1);
  end_with(kLifelineDescriptor);
  std::signal(SIGINT, SIG_IGN);  // goes to all of a terminal's programs; the client decides
  keep_memory();
  prepare();
  const JobLimits limits;
  const Hello hello{lock_in(kMostResultBytes)};
  if (!send_packet(kSocketDescriptor, write_hello(hello), {})) return 1;
  while (serve_one(decode, limits)) {
  }
  return 0;
}

}  // namespace gltfx::codec
