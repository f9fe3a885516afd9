// SPDX-License-Identifier: Apache-2.0
/// What another run need not see.
#pragma once

#include <cstdint>

namespace gltfx::codec {

/// How often, since this process began, a worker had no result for a reason that does not lie in
/// the bytes alone: missing memory or time, a crash, no worker. What was made meanwhile might be
/// another thing on another machine. Any number of threads may call.
std::uint64_t errors_by_chance();

}  // namespace gltfx::codec
