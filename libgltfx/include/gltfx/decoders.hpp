// SPDX-License-Identifier: Apache-2.0
/// @file
/// The programs that decode and encode images and decode Draco meshes: separate processes that
/// cannot open files, start programs or use the network, because the kernel filters their system
/// calls. They are searched for in the folder that the environment variable GLTFX_CODEC_WORKERS
/// names, in that of set_codec_folder(), beside the running program, in ../libexec/gltfx from
/// there, in the package that the program was built against, and where gltfx was configured to be
/// installed.
#pragma once

#include <string>

namespace gltfx {

/// Names the folder of `gltfx-codec-image` and `gltfx-codec-draco` for this process, such as one
/// that your program ships; empty: none. Call it before anything is decoded. Thread-safe.
void set_codec_folder(const std::string& folder);

/// Whether decoders are used that the system does not filter: on processors other than x86-64 and
/// 64-bit ARM, and where a container forbids such filters. By default they are refused, and their
/// payloads count as not checked. Applies to the whole process, from the next start of a decoder
/// on; the limits on memory and time stay. Thread-safe.
void permit_unsandboxed_decoders(bool permitted);

#ifdef GLTFX_PACKAGE
// The packages for CMake and pkg-config define it: the decoders are beside this header.
namespace detail {
void set_package_header(const char* path);
inline const bool kPackageHeaderIsSet = (set_package_header(__FILE__), true);
}  // namespace detail
#endif

}  // namespace gltfx
