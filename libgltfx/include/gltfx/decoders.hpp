// SPDX-License-Identifier: Apache-2.0
/// @file
/// How images and Draco meshes are decoded: in processes of their own, which can open no file,
/// start no program and reach no network, since the system filters what they ask of it.
#pragma once

namespace gltfx {

/// Whether decoders are used that the system does not filter: on processors other than x86-64 and
/// 64-bit ARM, and where a container forbids such filters. By default they are refused, and what
/// they would decode counts as not looked at. Holds for the whole process, from the next start of a
/// decoder on; the limits on memory and time stay. Safe to call from several threads.
void permit_unsandboxed_decoders(bool permitted);

}  // namespace gltfx
