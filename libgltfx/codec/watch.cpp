// SPDX-License-Identifier: Apache-2.0
#include "codec/watch.hpp"

#include <algorithm>
#include <ctime>

#include "codec/packet.hpp"

namespace gltfx::codec {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

std::optional<nanoseconds> processor_time(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(process, &clock) != 0) return std::nullopt;
  if (::clock_gettime(clock, &time) != 0) return std::nullopt;
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

// Looks are counted, not time: while this process is stopped, so may be the other one.
Watch watch(int socket, pid_t process, const Patience& patience) {
  constexpr milliseconds kLook{250};
  // A process that waits for ever may still use some microseconds now and then.
  constexpr milliseconds kProgress{10};
  const milliseconds look = std::min(kLook, patience.standstill);
  const nanoseconds begin = processor_time(process).value_or(nanoseconds::zero());
  nanoseconds last = begin;
  for (milliseconds still{0}; still < patience.standstill;) {
    if (wait_for_packet(socket, look) == Wait::ready) return Watch::ready;
    const nanoseconds now = processor_time(process).value_or(last);
    if (now - begin > patience.processor_time) return Watch::overrun;
    const bool progress = now - last >= kProgress;
    still = progress ? milliseconds::zero() : still + look;
    if (progress) last = now;
  }
  return Watch::standstill;
}

}  // namespace gltfx::codec
