// SPDX-License-Identifier: Apache-2.0
/// Reports on external assets that several assets have: each is made once.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/fork.hpp"
#include "container/resolver.hpp"
#include "model/external_assets.hpp"
#include "rules/external_assets.hpp"

namespace gltfx::validate {

/// An external asset of the named one.
struct SharedChild {
  const model::OpenedAsset& named;
  const model::AssetInTree& asset;
  const ExternalLinks& links;  ///< of the external asset
};

/// Of validations during which no file changes. Holds at most 64 MiB. Safe to use from several
/// threads.
class SharedReports {
 public:
  /// The report that `make` gives, which must not ask for another one; or that of an earlier call,
  /// if nothing that it depends on differs. A call that makes the same report at this time is
  /// waited for. `options`: those for the external asset.
  FileReport get(const ValidateOptions& options, const SharedChild& child,
                 const std::function<FileReport()>& make);

 private:
  class Making;
  struct Kept {
    std::string report;                                  ///< packed
    std::vector<container::LookupLog::Lookup> look_ups;  ///< that making it took
  };
  struct Entry {
    bool is_made = false;  ///< by a thread, at this time
    std::optional<Kept> kept;
  };

  /// What is kept; if there is nothing yet, nothing, and the caller keeps it or gives up.
  std::optional<Kept> find(const std::string& key);
  void keep(const std::string& key, Kept kept);
  void give_up(const std::string& key);

  const std::uint64_t generation_ = fork_generation();
  std::mutex mutex_;
  std::condition_variable made_;
  std::map<std::string, Entry> entries_;
  std::size_t bytes_ = 0;
};

}  // namespace gltfx::validate
