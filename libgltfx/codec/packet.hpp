// SPDX-License-Identifier: Apache-2.0
/// Frames and descriptors over a packet socket, and the messages between the client and the
/// launcher of workers: one frame per packet.
///
/// The launcher is the decoder program that the client starts: it loads the decoders, sends `ready`
/// and never gets a payload. For each `start` it forks a worker, which gets the two descriptors of
/// the packet as its ends, and answers `started`. For each `finish` it ends that worker and answers
/// `ended`.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/unique_fd.hpp"

namespace gltfx::codec {

inline constexpr std::size_t kMostDescriptors = 2;

struct Packet {
  std::vector<std::byte> bytes;
  std::vector<UniqueFd> descriptors;  ///< closed on exec
};

/// Sends one packet with copies of up to kMostDescriptors descriptors. False if the other side has
/// closed; raises no signal.
bool send_packet(int socket, std::span<const std::byte> bytes, std::span<const int> descriptors);

/// Waits for one packet. Nothing if the other side has closed, or sent too many descriptors or more
/// bytes than a frame has.
std::optional<Packet> receive_packet(int socket);

enum class Wait { ready, timed_out };
/// Waits until there is a packet, or the other side has closed.
Wait wait_for_packet(int socket, std::chrono::milliseconds time);

struct Control {
  enum class Kind : std::uint8_t {
    ready,
    start,    ///< value: memory limit in bytes for all jobs of the worker
    started,  ///< value: the process id of the worker; 0: none
    finish,   ///< value: a process id
    ended,    ///< value: the signal that ended the worker; 0: another reason
  };
  Kind kind = Kind::ready;
  std::uint64_t value = 0;
  bool operator==(const Control&) const = default;
};

std::vector<std::byte> write_control(const Control& control);
/// Nothing if the frame is of another kind.
std::optional<Control> read_control(std::span<const std::byte> frame);

}  // namespace gltfx::codec
