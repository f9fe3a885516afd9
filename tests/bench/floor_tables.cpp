// SPDX-License-Identifier: Apache-2.0
// Lower bound of a check of property tables: maps a tables.glb of make_assets.py, whose layout is
// fixed, reads everything once and does the comparisons that every check needs (extremes, finite,
// listed, ascending offsets, UTF-8).
//
//   floor_tables FILE.glb
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>

#include <simdjson.h>

#include "mapped.hpp"

namespace {

constexpr std::size_t kBlock = 4096;  // numbers that fit the first cache

bool is_odd(float value) {
  return (std::bit_cast<std::uint32_t>(value) & 0x7f800000U) == 0x7f800000U;
}
bool is_odd(double value) {
  return (std::bit_cast<std::uint64_t>(value) & 0x7ff0000000000000U) == 0x7ff0000000000000U;
}
bool is_odd(std::int16_t) { return false; }

// Extremes of packed elements of N numbers, and finiteness.
template <std::size_t N, typename T>
double numbers(const T* at, std::size_t elements) {
  constexpr std::size_t kLanes = N * 8;
  std::array<T, kLanes> least{}, most{};
  std::size_t odd = 0;
  for (std::size_t begin = 0; begin < elements * N; begin += kBlock / kLanes * kLanes) {
    const std::size_t end = std::min(begin + kBlock / kLanes * kLanes, elements * N);
    for (std::size_t i = begin; i + kLanes <= end; i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        least[lane] = std::min(at[i + lane], least[lane]);
        most[lane] = std::max(at[i + lane], most[lane]);
      }
    }
    for (std::size_t i = begin; i < end; ++i) odd += is_odd(at[i]) ? 1U : 0U;
  }
  return static_cast<double>(least[0]) + static_cast<double>(most[1]) + static_cast<double>(odd);
}

double odd_numbers(const float* at, std::size_t count) {
  std::uint32_t odd = 0;
  for (std::size_t i = 0; i < count; ++i) odd += is_odd(at[i]) ? 1U : 0U;
  return odd;
}

double unlisted(const std::uint8_t* at, std::size_t count, unsigned values) {
  std::uint32_t errors = 0;
  for (std::size_t i = 0; i < count; ++i) errors += at[i] >= values ? 1U : 0U;
  return errors;
}

double descents(const std::uint32_t* at, std::size_t count) {
  std::uint32_t errors = 0;
  for (std::size_t i = 0; i < count; ++i) errors += at[i] > at[i + 1] ? 1U : 0U;
  return errors;
}

double strings(const char* text, const std::uint32_t* offsets, std::size_t count) {
  double errors = 0;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, count);
    errors += descents(offsets + begin, end - begin);
    const std::size_t length = offsets[end] - offsets[begin];
    errors += simdjson::validate_utf8(text + offsets[begin], length) ? 0 : 1;
    for (std::size_t i = begin; i < end; ++i) {
      errors += (static_cast<unsigned char>(text[offsets[i]]) & 0xC0U) == 0x80U ? 1 : 0;
    }
  }
  return errors;
}

std::size_t padded(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

template <typename T>
const T* take(const char*& at, std::size_t count) {
  const T* const first = reinterpret_cast<const T*>(at);
  at += padded(count * sizeof(T));
  return first;
}

std::size_t rows_of(std::string_view json) {
  std::size_t rows = 0;
  std::sscanf(json.substr(json.find("\"count\": ")).data(), "\"count\": %zu", &rows);
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string_view file = gltfx::bench::mapped(argv[1]);
  if (file.size() < 20) return 3;
  std::uint32_t json = 0;
  std::memcpy(&json, file.data() + 12, sizeof(json));
  const std::size_t rows = rows_of(file.substr(20, json));
  const char* at = file.data() + 20 + json + 8;
  double sum = numbers<1>(take<float>(at, rows), rows);
  sum += numbers<1>(take<double>(at, rows), rows);
  sum += numbers<3>(take<float>(at, rows * 3), rows);
  sum += numbers<1>(take<std::int16_t>(at, rows), rows);
  sum += unlisted(take<std::uint8_t>(at, rows), rows, 6);
  const auto* const starts = take<std::uint32_t>(at, rows + 1);
  sum += descents(starts, rows);
  sum += odd_numbers(take<float>(at, starts[rows]), starts[rows]);
  const auto* const ends = take<std::uint32_t>(at, rows + 1);
  sum += strings(at, ends, rows);
  std::printf("%g\n", sum);
  return 0;
}
