// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "base/support/two_at_once.hpp"

namespace gltfx {
namespace {

void nothing(std::size_t) {}

class ParallelOrdered : public testing::TestWithParam<unsigned> {};

INSTANTIATE_TEST_SUITE_P(Jobs, ParallelOrdered, testing::Values(0U, 1U, 2U, 3U, 8U, 5000U));

TEST_P(ParallelOrdered, ConsumesAllInOrderAfterTheyWereProduced) {
  constexpr std::size_t kCount = 2000;
  std::vector<std::atomic<int>> produced(kCount);
  std::vector<std::size_t> consumed;
  parallel_ordered(
      kCount, GetParam(), [&](std::size_t i) { ++produced[i]; },
      [&](std::size_t i) {
        EXPECT_EQ(produced[i], 1);
        consumed.push_back(i);
      });
  std::vector<std::size_t> expected(kCount);
  std::iota(expected.begin(), expected.end(), std::size_t{0});
  EXPECT_EQ(consumed, expected);
}

TEST_P(ParallelOrdered, NothingToDoCallsNothing) {
  bool called = false;
  const auto mark = [&](std::size_t) { called = true; };
  parallel_ordered(0, GetParam(), mark, mark);
  EXPECT_FALSE(called);
}

TEST_P(ParallelOrdered, ConsumesOneAtATime) {
  std::atomic<int> inside = 0;
  int most = 0;
  parallel_ordered(300, GetParam(), nothing, [&](std::size_t) {
    most = std::max(most, ++inside);
    std::this_thread::yield();
    --inside;
  });
  EXPECT_EQ(most, 1);
}

TEST(ParallelOrderedMemory, StaysFlatOverManyItems) {
  std::atomic<std::size_t> waiting = 0;
  std::atomic<std::size_t> most = 0;
  parallel_ordered(
      100000, 2,
      [&](std::size_t) {
        const std::size_t now = ++waiting;
        std::size_t seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
      },
      [&](std::size_t i) {
        if (i % 10000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        --waiting;
      });
  EXPECT_EQ(waiting, 0U);
  EXPECT_LE(most, 8U);
}

TEST(ParallelOrderedThreads, OneJobStaysOnTheCallersThread) {
  const auto here = std::this_thread::get_id();
  const auto check = [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), here); };
  parallel_ordered(50, 1, check, check);
}

TEST(ParallelOrderedThreads, NeverMoreThanAsked) {
  std::atomic<int> inside = 0;
  std::atomic<int> most = 0;
  parallel_ordered(
      200, 2,
      [&](std::size_t) {
        const int now = ++inside;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        --inside;
      },
      nothing);
  EXPECT_LE(most, 2);
}

TEST(ParallelOrderedThreads, TwoJobsRunAtTheSameTimeWhereTheMachineHasTwo) {
  if (default_jobs() < 2) GTEST_SKIP() << "one processor";
  EXPECT_TRUE(test::two_run_at_once());
}

TEST(ParallelOrderedThreads, AnExceptionReachesTheCallerInsteadOfEndingTheProcess) {
  for (const unsigned jobs : {1U, 2U}) {
    const auto fail = [](std::size_t i) {
      if (i == 7) throw std::runtime_error("seven");
    };
    EXPECT_THROW(parallel_ordered(100, jobs, fail, nothing), std::runtime_error);
  }
}

TEST(ParallelOrderedThreads, CallsMayBeNestedAndMadeFromSeveralThreads) {
  std::atomic<int> sum = 0;
  const auto add = [&](std::size_t) { ++sum; };
  const auto nested = [&](std::size_t) { parallel_ordered(10, 0, add, add); };
  const auto all = [&] { parallel_ordered(100, 0, nested, nested); };
  std::thread other(all);
  all();
  other.join();
  EXPECT_EQ(sum, 2 * 100 * 2 * 10 * 2);
}

TEST(ParallelOrderedThreads, AFailureInsideOfAnotherCallReachesItsCaller) {
  const auto fail = [](std::size_t i) {
    if (i == 3) throw std::runtime_error("three");
  };
  std::atomic<int> failed = 0;
  const auto nested = [&](std::size_t) {
    try {
      parallel_ordered(10, 0, nothing, fail);
    } catch (const std::runtime_error&) {
      ++failed;
    }
  };
  parallel_ordered(50, 0, nested, nothing);
  EXPECT_EQ(failed, 50);
}

TEST(DefaultJobs, IsAtLeastOne) { EXPECT_GE(default_jobs(), 1U); }

TEST_P(ParallelOrdered, RunBothCallsEachOnceAndPassesAnExceptionOn) {
  int one = 0, other = 0;
  run_both(
      GetParam(), [&] { ++one; }, [&] { ++other; });
  EXPECT_EQ(one, 1);
  EXPECT_EQ(other, 1);
  EXPECT_THROW(run_both(
                   GetParam(), [] {}, [] { throw std::runtime_error("no"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace gltfx
