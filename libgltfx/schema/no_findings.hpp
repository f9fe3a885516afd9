// SPDX-License-Identifier: Apache-2.0
/// For walks of which only what they learn is wanted.
#pragma once

#include "base/sink.hpp"

namespace gltfx::schema {

class NoFindings final : public Sink {
 public:
  void report(const Path& path, Finding finding) override {
    static_cast<void>(path);
    static_cast<void>(finding);
  }
};

}  // namespace gltfx::schema
