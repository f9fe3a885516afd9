// SPDX-License-Identifier: Apache-2.0
/// Frames and descriptors over a socket that keeps packets whole.
#pragma once

#include <chrono>
#include <cstddef>
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

/// Sends one packet with copies of up to kMostDescriptors descriptors. False when nobody is there
/// to take it; raises no signal.
bool send_packet(int socket, std::span<const std::byte> bytes, std::span<const int> descriptors);

/// Waits for one packet. Nothing when the other side has closed, or sent more than fits into a
/// frame or more descriptors than that.
std::optional<Packet> receive_packet(int socket);

enum class Wait { ready, timed_out };
/// Waits until there is a packet, or the other side has closed.
Wait wait_for_packet(int socket, std::chrono::milliseconds time);

}  // namespace gltfx::codec
