// SPDX-License-Identifier: Apache-2.0
#include "version.hpp"

#include <gltfx/version.hpp>

// GLTFX_LIBRARY_VERSIONS and GLTFX_CODEC_VERSIONS ("name 1.2, name 3.4") come from CMake.
namespace gltfx::tool {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

}  // namespace

std::string version_text() {
  std::string text = "gltfx ";
  text.append(version()).append("\nbuilt with " GLTFX_LIBRARY_VERSIONS
                                "\ndecoders built with " GLTFX_CODEC_VERSIONS "\ncompiled by ");
  return text.append(kCompiler).append("\n");
}

}  // namespace gltfx::tool
