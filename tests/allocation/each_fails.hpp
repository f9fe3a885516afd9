// SPDX-License-Identifier: Apache-2.0
/// Lets each allocation of a call fail, one in each run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gltfx::test {

/// Calls `work` again and again with another allocation failing (std::bad_alloc): it must not
/// throw, and either give what it always gives or say that there is not enough memory. Before each
/// call `folder`/out is removed. GLTFX_ALLOCATION_STRIDE (1: all of them) says how many are tried
/// of those that make many.
void let_each_fail(const std::function<std::string()>& work,
                   const std::filesystem::path& folder = {});

/// For what a test does itself at the end of a call: no allocation fails from here on, or again.
void count_allocations(bool on);

inline std::string fixture(const std::string& name) {
  return (std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures" / name).native();
}

}  // namespace gltfx::test
