// SPDX-License-Identifier: Apache-2.0
/// Pictures that an earlier run has drawn, as a ResultCache knows them: not their bytes, but those
/// of the files that they were written to.
#pragma once

#include <gltfx/bake.hpp>

#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "base/hash.hpp"

namespace gltfx {

/// The key of all that pictures depend on besides the asset's files. That of options which many
/// files have in common is made once: it takes all bytes of the environment. Any number of threads
/// may call.
class PictureKey {
 public:
  /// Nothing when no earlier run can have what these options ask for. But for output and threads,
  /// they are the same in all calls.
  std::optional<Hash128> of(const BakeOptions& options);

 private:
  std::once_flag once_;
  Hash128 common_;
};

/// The key of options but for output, threads and cache.
Hash128 picture_key(const BakeOptions& options, const ResultCache& cache);

/// What to keep of a file that was drawn; nothing when there is a problem.
std::optional<std::string> pack_pictures(const BakeReport& report, const BakeOptions& options);

/// The report on the file at `path` when all that was kept of it lies where the options want it,
/// unchanged.
std::optional<BakeReport> recall_pictures(std::string_view kept, const std::string& path,
                                          const BakeOptions& options);

}  // namespace gltfx
