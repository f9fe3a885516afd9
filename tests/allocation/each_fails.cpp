// SPDX-License-Identifier: Apache-2.0
#include "each_fails.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};
std::atomic<long> fail_at{0};

void* take(std::size_t size) {
  if (counting && allocations.fetch_add(1) + 1 == fail_at) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}

void* take_or_throw(std::size_t size) {
  void* memory = take(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return take_or_throw(size); }
void* operator new[](std::size_t size) { return take_or_throw(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return take(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return take(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;

constexpr long kFew = 200;  // of which all are tried

long stride() {
  const char* text = std::getenv("GLTFX_ALLOCATION_STRIDE");
  return text == nullptr ? 13 : std::max(1L, std::atol(text));
}

/// Calls with the allocation of that number failing. Empty when it threw.
std::string call(const std::function<std::string()>& work, long number) {
  allocations = 0;
  fail_at = number;
  counting = true;
  std::string said;
  try {
    said = work();
  } catch (const std::exception&) {
    said.clear();
  }
  counting = false;
  return said;
}

}  // namespace

void count_allocations(bool on) { counting = on; }

void let_each_fail(const std::function<std::string()>& work, const fs::path& folder) {
  call(work, 0);  // makes everything that is built once and kept
  if (!folder.empty()) fs::remove_all(folder / "out");
  const std::string sound = call(work, 0);
  const long all = allocations;
  const long step = all < kFew ? 1 : stride();
  std::set<std::string> errors;
  for (long number = 1; number <= all; number += step) {
    if (!folder.empty()) fs::remove_all(folder / "out");
    const std::string said = call(work, number);
    if (said == sound || said.find("not enough memory") != std::string::npos) continue;
    errors.insert(std::to_string(number) + (said.empty() ? " throws" : " says " + said));
    if (errors.size() > 5) break;
  }
  EXPECT_THAT(errors, testing::IsEmpty()) << all << " allocations";
  testing::Test::RecordProperty("allocations", std::to_string(all));
}

}  // namespace gltfx::test
