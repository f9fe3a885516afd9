// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>

#include "json/oracle.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = gltfx::fuzz::check_json({reinterpret_cast<const char*>(data), size});
  if (!problem.empty()) {
    std::fprintf(stderr, "json: %s\n", problem.c_str());
    std::abort();
  }
  return 0;
}
