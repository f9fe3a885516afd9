// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where the programs lie that decode and encode images and decode Draco. They are looked for in
/// the folder that the environment variable GLTFX_CODEC_WORKERS names, in that of
/// set_codec_folder(), beside the running program, in ../libexec/gltfx from there, in the package
/// that the program was built against, and where gltfx was configured to be installed.
#pragma once

#include <string>

namespace gltfx {

/// Names the folder of `gltfx-codec-image` and `gltfx-codec-draco` for this process, such as one
/// that your program brings along; empty: none. Call it before anything is decoded. Thread-safe.
void set_codec_folder(const std::string& folder);

#ifdef GLTFX_PACKAGE
// The packages for CMake and pkg-config define it: the decoders lie beside this header.
namespace detail {
void set_package_header(const char* path);
inline const bool kPackageHeaderIsSet = (set_package_header(__FILE__), true);
}  // namespace detail
#endif

}  // namespace gltfx
