// SPDX-License-Identifier: Apache-2.0
// Lower bound of a geometry check: maps a terrain.glb of make_assets.py, whose layout is fixed, and
// does the comparisons that every check needs (extremes, finite, unit length, index, triangle).
//
//   floor_geometry FILE.glb SIDE THREADS
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "mapped.hpp"

namespace {

constexpr std::size_t kBlock = 4096;  // numbers that fit the first cache

std::uint32_t word(float value) { return std::bit_cast<std::uint32_t>(value); }

// Extremes and finiteness of packed elements of N floats, and the length of their first three.
template <std::size_t N, bool Unit>
float floats(const float* at, std::size_t elements) {
  constexpr std::size_t kLanes = N * 8;
  std::array<float, kLanes> least{}, most{};
  std::uint32_t odd = 0, off = 0;
  const std::size_t step = kBlock / kLanes * kLanes;
  for (std::size_t begin = 0; begin < elements * N; begin += step) {
    const std::size_t end = std::min(begin + step, elements * N);
    for (std::size_t i = begin; i + kLanes <= end; i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        least[lane] = std::min(at[i + lane], least[lane]);
        most[lane] = std::max(at[i + lane], most[lane]);
      }
    }
    for (std::size_t i = begin; i < end; ++i) {
      odd += (word(at[i]) & 0x7f800000U) == 0x7f800000U ? 1U : 0U;
    }
    if constexpr (Unit) {
      for (std::size_t i = begin; i < end; i += N) {
        const float square = at[i] * at[i] + at[i + 1] * at[i + 1] + at[i + 2] * at[i + 2];
        off += std::abs(square - 1) > 0.01F ? 1U : 0U;
      }
    }
  }
  return least[0] + most[1] + static_cast<float>(odd + off);
}

float indices(const std::uint32_t* at, std::size_t count) {
  std::uint32_t least = UINT32_MAX, most = 0, flat = 0;
  for (std::size_t begin = 0; begin < count; begin += kBlock / 3 * 3) {
    const std::size_t end = std::min(begin + kBlock / 3 * 3, count);
    for (std::size_t i = begin; i < end; ++i) {
      least = std::min(least, at[i]);
      most = std::max(most, at[i]);
    }
    for (std::size_t i = begin; i < end; i += 3) {
      flat += (at[i] == at[i + 1] ? 1U : 0U) | (at[i + 1] == at[i + 2] ? 1U : 0U) |
              (at[i] == at[i + 2] ? 1U : 0U);
    }
  }
  return static_cast<float>(least + most + flat);
}

float mesh(const float* at, std::size_t side) {
  const std::size_t vertices = side * side;
  const float* const normals = at + 3 * vertices;
  const float* const tangents = normals + 3 * vertices;
  const float* const uvs = tangents + 4 * vertices;
  const auto* const triangles = reinterpret_cast<const std::uint32_t*>(uvs + 2 * vertices);
  return floats<3, false>(at, vertices) + floats<3, true>(normals, vertices) +
         floats<4, true>(tangents, vertices) + floats<2, false>(uvs, vertices) +
         indices(triangles, 6 * (side - 1) * (side - 1));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::string_view file = gltfx::bench::mapped(argv[1]);
  if (file.empty()) return 3;
  const auto side = static_cast<std::size_t>(std::max(2, std::atoi(argv[2])));
  const std::size_t words = 12 * side * side + 6 * (side - 1) * (side - 1);
  const std::size_t meshes = file.size() / (4 * words);
  const auto* const first =
      reinterpret_cast<const float*>(file.data() + file.size()) - meshes * words;
  std::atomic<std::size_t> next{0};
  std::vector<float> results(meshes);
  std::vector<std::thread> threads;
  for (int i = 0; i < std::max(1, std::atoi(argv[3])); ++i) {
    threads.emplace_back([&] {
      for (std::size_t m = next++; m < meshes; m = next++) {
        results[m] = mesh(first + m * words, side);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::printf("%g\n", static_cast<double>(results.at(0)));
  return 0;
}
