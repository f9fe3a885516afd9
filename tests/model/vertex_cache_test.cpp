// SPDX-License-Identifier: Apache-2.0
#include "model/vertex_cache.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace gltfx::model {
namespace {

using Indices = std::vector<std::uint32_t>;

TEST(VertexCache, CountsVerticesThatAreNotAmongTheLatest) {
  EXPECT_EQ(cache_miss_ratio(Indices{0, 1, 2, 0, 2, 3}, 4), 2);
  EXPECT_EQ(cache_miss_ratio(Indices{}, 4), 0);
}

TEST(FetchOverhead, CountsLinesForTheVerticesThatAreUsed) {
  EXPECT_EQ(fetch_overhead(Indices{}, 0, 12), 0);
  // One line for 36 bytes, also if it is read again.
  EXPECT_DOUBLE_EQ(fetch_overhead(Indices{0, 1, 2, 2, 1, 0}, 3, 12), 64.0 / 36);
  // Vertices 0 and 2048 of a whole line each lie in the same place of the cache.
  EXPECT_DOUBLE_EQ(fetch_overhead(Indices{0, 1, 2, 0, 1, 2}, 3, 64), 1);
  EXPECT_DOUBLE_EQ(fetch_overhead(Indices{0, 1, 2048, 0, 1, 2048}, 3, 64), 5.0 / 3);
}

TEST(FetchOverhead, IsThatOfMeshoptimizer) {
  std::mt19937 random(3);
  for (const std::uint64_t size : {1U, 12U, 20U, 64U, 100U, 256U}) {
    for (const std::uint32_t vertices : {3U, 1000U, 30000U}) {
      std::uniform_int_distribution<std::uint32_t> one(0, vertices - 1);
      Indices indices;
      for (int i = 0; i < 30000; ++i) indices.push_back(one(random));
      const auto expected = meshopt_analyzeVertexFetch(indices.data(), indices.size(), vertices,
                                                       static_cast<std::size_t>(size));
      const std::size_t used = std::set<std::uint32_t>(indices.begin(), indices.end()).size();
      EXPECT_FLOAT_EQ(static_cast<float>(fetch_overhead(indices, used, size)), expected.overfetch)
          << size << ' ' << vertices;
    }
  }
}

}  // namespace
}  // namespace gltfx::model
