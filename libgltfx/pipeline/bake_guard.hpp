// SPDX-License-Identifier: Apache-2.0
/// What becomes of a file that cannot be drawn at all.
#pragma once

#include <gltfx/bake.hpp>

#include <functional>
#include <string>

namespace gltfx {

/// The report on a file that could not be read.
BakeReport unreadable(const std::string& path, std::string why);

/// What `work` says of the file; the library does not throw.
BakeReport guarded(const std::string& path, const std::function<BakeReport()>& work);

}  // namespace gltfx
