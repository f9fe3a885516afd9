// SPDX-License-Identifier: Apache-2.0
/// The life of a decoder program: what its main() calls.
#pragma once

#include <functional>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Runs `prepare`, which loads and touches all that decoding will need; then forks a worker for
/// each time that the client asks for one, until the client closes its socket. A worker locks
/// itself in, greets, and serves jobs. Gives the exit code.
int serve(const std::function<void()>& prepare, const Decode& decode);

}  // namespace gltfx::codec
