// SPDX-License-Identifier: Apache-2.0
/// What becomes of a worker that misbehaves, and of the next request.
#include "codec/client.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "container/temp_folder.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define GLTFX_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GLTFX_ADDRESS_SANITIZER
#endif
#endif

namespace gltfx::codec {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

Settings test_settings() {
  Settings settings;
  settings.folder = GLTFX_TEST_WORKERS;
  settings.seconds = 0.2;
  return settings;
}

/// What /proc says of a process.
struct ProcessState {
  char state = 'X';  ///< 'Z': all it had is given back; 'X': it is gone
  long ticks = 0;    ///< processor time so far
};

ProcessState state_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return {};
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  ProcessState found;
  fields >> found.state;
  std::string skipped;
  for (int i = 0; i < 10; ++i) fields >> skipped;
  long user = 0, system = 0;
  fields >> user >> system;
  found.ticks = user + system;
  return found;
}

template <typename Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 30000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

// Gone, or a zombie that nobody has waited for yet.
bool comes_to_an_end(pid_t process) {
  return comes_true([process] {
    const char state = state_of(process).state;
    return state == 'X' || state == 'Z';
  });
}

// Kills `victim` once `process` is amid work: it has used more time than a short answer takes.
void kill_at_work(pid_t process, pid_t victim) {
  const long before = state_of(process).ticks;
  comes_true([&] { return state_of(process).ticks >= before + 5; });
  ::kill(victim, SIGKILL);
}

class Clients : public ::testing::Test {
 protected:
  DracoResult ask(const std::string& what) {
    return client_.decode_draco(std::as_bytes(std::span(what.data(), what.size())));
  }
  Fault fault(const std::string& what) {
    const DracoResult result = ask(what);
    const auto* found = std::get_if<Fault>(&result);
    return found != nullptr ? *found : Fault{FaultKind::unavailable, "decoded"};
  }
  bool decodes() { return std::holds_alternative<DracoMesh>(ask("triangle")); }

  Client client_{test_settings()};
};

TEST_F(Clients, AWorkerIsKept) {
  const std::string first = fault("process").message;
  EXPECT_TRUE(decodes());
  EXPECT_EQ(fault("process").message, first);
}

TEST_F(Clients, AWorkerThatCrashesIsReplaced) {
  const std::string first = fault("process").message;
  const Fault crash = fault("crash");
  EXPECT_EQ(crash.kind, FaultKind::died);
  EXPECT_TRUE(decodes());
  EXPECT_NE(fault("process").message, first);
  EXPECT_EQ(fault("exit").kind, FaultKind::died);
  EXPECT_TRUE(decodes());
}

TEST_F(Clients, AWorkerThatIsKilledBetweenRequestsIsReplaced) {
  const pid_t id = std::stoi(fault("process").message);
  ::kill(id, SIGKILL);
  ASSERT_TRUE(comes_to_an_end(id));
  EXPECT_TRUE(decodes());
}

TEST(Client, AWorkerThatIsKilledAmidDecodingIsOneFault) {
  Settings settings = test_settings();
  settings.seconds = 60;
  Client client(settings);
  const auto ask_it = [&](std::string_view what) {
    return std::get<Fault>(client.decode_draco(std::as_bytes(std::span(what.data(), what.size()))));
  };
  const pid_t id = std::stoi(ask_it("process").message);
  std::thread killer([id] { kill_at_work(id, id); });
  EXPECT_EQ(ask_it("spin").kind, FaultKind::died);
  killer.join();
  EXPECT_NE(ask_it("process").message, std::to_string(id));
}

TEST_F(Clients, EndlessWorkRunsOutOfTime) {
  EXPECT_EQ(fault("spin").kind, FaultKind::timed_out);
  EXPECT_TRUE(decodes());
}

TEST_F(Clients, AWorkerThatStandsStillIsEnded) {
  EXPECT_EQ(fault("sleep").kind, FaultKind::timed_out);
  EXPECT_TRUE(decodes());
}

#ifndef GLTFX_ADDRESS_SANITIZER
TEST_F(Clients, MemoryRunsOutAtTheLimit) {
  EXPECT_EQ(fault("memory").kind, FaultKind::out_of_memory);
  EXPECT_TRUE(decodes());
}
#endif

TEST_F(Clients, AResultOfAnySizeIsNotGiven) {
  const Fault huge = fault("file");
  EXPECT_TRUE(huge.kind == FaultKind::died || huge.message == "refused") << huge.message;
  EXPECT_TRUE(decodes());
}

TEST_F(Clients, AnswersThatLieAreRefused) {
  for (const char* lie : {"garbage", "no result", "wrong index", "image"}) {
    EXPECT_EQ(fault(lie).kind, FaultKind::died) << lie;
    EXPECT_TRUE(decodes()) << lie;
  }
}

TEST_F(Clients, AWorkerHasNothingOpenButItsEnds) {
  // Standard input and outputs, the two ends, payload and result.
  EXPECT_EQ(fault("descriptors").message, "0 1 2 3 4 5 6 ");
}

#if defined(__x86_64__) || defined(__aarch64__)
TEST_F(Clients, AWorkerCanReachNothing) {
  for (const char* call : {"open", "stat", "socket", "kill", "exec", "fork", "code"}) {
    EXPECT_EQ(fault(call).message, std::to_string(EPERM)) << call;
  }
}
#endif

TEST(Client, WithoutAWorkerNothingIsSaidOfTheBytes) {
  Settings settings;
  settings.folder = "/nonexistent";
  Client client(settings);
  const DracoResult result = client.decode_draco({});
  ASSERT_TRUE(std::holds_alternative<Fault>(result));
  EXPECT_EQ(std::get<Fault>(result).kind, FaultKind::unavailable);
  EXPECT_THAT(std::get<Fault>(result).message, HasSubstr("/nonexistent/gltfx-codec-draco"));
}

TEST(Client, AProgramThatIsNoWorkerIsNotOne) {
  const container::test::TempFolder folder;
  Settings settings;
  settings.folder = folder.path().native();
  folder.link("gltfx-codec-draco", "/bin/true");
  Client client(settings);
  const DracoResult result = client.decode_draco({});
  ASSERT_TRUE(std::holds_alternative<Fault>(result));
  EXPECT_EQ(std::get<Fault>(result).kind, FaultKind::unavailable);
}

TEST(Client, WorkersEndWithTheProcess) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    // The worker is amid endless work when this process is killed.
    Settings settings = test_settings();
    settings.seconds = 60;
    Client client(settings);
    const std::string process = "process", spin = "spin";
    const auto bytes = [](const std::string& text) {
      return std::as_bytes(std::span(text.data(), text.size()));
    };
    const std::string id = std::get<Fault>(client.decode_draco(bytes(process))).message;
    if (::write(ends[1], id.data(), id.size()) < 0) ::_exit(1);
    static_cast<void>(client.decode_draco(bytes(spin)));
    ::_exit(0);
  }
  std::array<char, 32> id{};
  ASSERT_GT(::read(ends[0], id.data(), id.size() - 1), 0);
  const pid_t worker = std::stoi(id.data());
  kill_at_work(worker, child);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(comes_to_an_end(worker));
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace gltfx::codec
