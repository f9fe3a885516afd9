// SPDX-License-Identifier: Apache-2.0
/// Lets each allocation of a call fail, one in each run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gltfx::test {

/// Calls `work` again and again with another allocation failing (std::bad_alloc): it must not
/// throw, and either give the usual result or report that there is not enough memory. Before each
/// call `folder`/out is removed. GLTFX_ALLOCATION_STRIDE (1: all of them) sets how many are tried
/// of those that make many.
void let_each_fail(const std::function<std::string()>& work,
                   const std::filesystem::path& folder = {});

/// For the test's own work at the end of a call: no allocation fails from here on, or again.
void count_allocations(bool on);

inline std::string fixture(const std::string& name) {
  return (std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures" / name).native();
}

}  // namespace gltfx::test
