// SPDX-License-Identifier: Apache-2.0
/// A process forks while its threads are at work, as servers and Python programs do: parent and
/// child find and draw the same as ever.
#include <gltfx/pipeline.hpp>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sanitized.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kHangs = 300;  // seconds: what takes long is no error

#if defined(__has_feature)
constexpr bool kThreadSanitizer = __has_feature(thread_sanitizer);
#else
constexpr bool kThreadSanitizer = false;
#endif

class Fork : public testing::Test {
 protected:
  void SetUp() override {
    if (kThreadSanitizer) GTEST_SKIP() << "ThreadSanitizer ends a child that starts threads";
  }
};

std::vector<std::string> assets() {
  std::vector<std::string> paths;
  for (const char* name : {"good/leaf.gltf", "good/cobble.glb", "good/pebble.gltf",
                           "bad/leaf-unlit.gltf", "good/bowl.glb", "legacy/awning.gltf"}) {
    paths.push_back(std::string(GLTFX_SOURCE_DIR "/fixtures/") + name);
  }
  return paths;
}

// Pool, decoders, schemas and targets take part.
std::string findings() {
  ValidateOptions options;
  options.profile = Profile::strict;
  options.pixels = PixelLevel::all;
  std::string text;
  validate_files(assets(), options, 3, [&](FileReport&& report) {
    for (const Diagnostic& found : report.diagnostics) {
      text += std::string(found.code) + ' ' + found.pointer + ' ' + found.message + '\n';
    }
    text += upgrade_file(report.path).error + '\n';
  });
  return text;
}

std::string pixels() {
  BakeOptions options;
  options.sizes = {{24, 24}};
  options.samples = 1;
  options.jobs = 2;
  const BakeReport report = bake_file(assets().front(), options);
  return report.error + std::string(report.pixels.bytes.begin(), report.pixels.bytes.end());
}

// Everything until the other side closes.
std::string read_all(int from) {
  std::string text;
  char some[4096];
  for (ssize_t got = 0; (got = ::read(from, some, sizeof some)) > 0;) {
    text.append(some, static_cast<std::size_t>(got));
  }
  return text;
}

// What `work` gives in a child, and its wait status.
struct Child {
  std::string result;
  int status = -1;
};
Child forked(const std::function<std::string()>& work, bool plain_exit) {
  std::fflush(nullptr);
  int ends[2];
  if (::pipe(ends) != 0) return {};
  const pid_t id = ::fork();
  if (id == 0) {
    ::alarm(kHangs);
    const std::string text = work();
    const bool written =
        ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    // Objects of the process end with it, those of its parent must not.
    if (plain_exit) std::exit(written ? 0 : 1);
    ::_exit(written ? 0 : 1);
  }
  ::close(ends[1]);
  Child child;
  child.result = read_all(ends[0]);
  ::close(ends[0]);
  ::waitpid(id, &child.status, 0);
  return child;
}

// Threads that do `work` again and again, and note where it gives something else.
class Busy {
 public:
  Busy(unsigned count, const std::function<std::string()>& work) {
    for (unsigned i = 0; i < count; ++i) {
      threads_.emplace_back([this, work] {
        std::string first;
        while (!over_) {
          const std::string text = work();
          if (first.empty()) first = text;
          if (text != first) ++differences_;
        }
      });
    }
  }
  int stop() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
    return differences_;
  }

 private:
  std::atomic<bool> over_ = false;
  std::atomic<int> differences_ = 0;
  std::vector<std::thread> threads_;
};

void fork_often(int count, const std::function<std::string()>& work) {
  if (kSanitized) {
    GTEST_SKIP() << "the allocator of AddressSanitizer stays locked in the child of a fork() that "
                    "comes while another thread allocates (clang before 18)";
  }
  Busy busy(3, work);
  std::mt19937 random(7);
  std::vector<Child> children;
  for (int i = 0; i < count; ++i) {
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 5000));
    children.push_back(forked(work, i % 2 == 0));
    if (WIFSIGNALED(children.back().status)) break;
  }
  EXPECT_EQ(busy.stop(), 0);
  const std::string expected = work();
  for (const Child& child : children) {
    EXPECT_EQ(child.status, 0);
    EXPECT_EQ(child.result, expected);
  }
}

// The first forks come while what is made once is being made.
TEST_F(Fork, AChildFindsWhatItsParentFinds) { fork_often(60, findings); }

TEST_F(Fork, AChildDrawsWhatItsParentDraws) {
  if (can_bake()) fork_often(20, pixels);
}

int sockets() {
  int count = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd", error)) {
    const std::string to = fs::read_symlink(entry.path(), error).native();
    const bool given = std::stoi(entry.path().filename().native()) <= 2;
    count += !given && to.starts_with("socket:") ? 1 : 0;
  }
  return count;
}

// The decoders of the parent would not see its end otherwise.
TEST_F(Fork, AChildHasNoDescriptorsOfTheDecodersOfItsParent) {
  findings();
  EXPECT_GT(sockets(), 0);
  EXPECT_EQ(forked([] { return std::to_string(sockets()); }, false).result, "0");
}

TEST_F(Fork, AChildOfAChildFindsWhatBothFind) {
  const std::string expected = findings();
  const Child child = forked([] { return findings() + forked(findings, false).result; }, false);
  EXPECT_EQ(child.result, expected + expected);
}

}  // namespace
}  // namespace gltfx
