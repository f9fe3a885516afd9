// SPDX-License-Identifier: Apache-2.0
/// Pictures that an earlier run has drawn, as a ResultCache knows them: not their bytes, but those
/// of the files that they were written to.
#pragma once

#include <gltfx/bake.hpp>

#include <optional>
#include <string>
#include <string_view>

#include "base/hash.hpp"

namespace gltfx {

/// Whether pictures that these options ask for can be taken from an earlier run.
bool can_be_kept(const BakeOptions& options);

/// Of everything in the options that bears on the pictures, the environment included, and of the
/// build of the program. Precondition: there is a cache.
Hash128 picture_key(const BakeOptions& options);

/// What to keep of a file that was drawn; nothing when there is a problem.
std::optional<std::string> pack_pictures(const BakeReport& report, const BakeOptions& options);

/// The report on the file at `path` when all that was kept of it lies where the options want it,
/// unchanged.
std::optional<BakeReport> recall_pictures(std::string_view kept, const std::string& path,
                                          const BakeOptions& options);

}  // namespace gltfx
