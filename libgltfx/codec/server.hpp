// SPDX-License-Identifier: Apache-2.0
/// The main loop of a decoder program, called by its main().
#pragma once

#include <functional>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Runs `prepare`, which loads and touches all code and data for decoding; then forks a worker for
/// each request of the client, until the client closes its socket. A worker enters its sandbox,
/// sends a Hello, and does jobs. Returns the exit code.
int serve(const std::function<void()>& prepare, const Decode& decode);

}  // namespace gltfx::codec
