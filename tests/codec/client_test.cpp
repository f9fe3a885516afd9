// SPDX-License-Identifier: Apache-2.0
/// Workers that misbehave, and the requests after them.
#include "codec/client.hpp"

#include <gltfx/decoders.hpp>

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
  settings.seconds = 60;  // only one test needs this much time, on purpose
  return settings;
}

std::span<const std::byte> request_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// The state of a process in /proc.
struct ProcessState {
  char state = 'X';  ///< 'Z': its resources are freed; 'X': it no longer exists
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

// Without a time limit.
template <typename Condition>
void wait_until(Condition condition) {
  while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

// Whether it no longer exists, or is a zombie without a waiter yet.
void wait_for_end(pid_t process) {
  wait_until([process] {
    const char state = state_of(process).state;
    return state == 'X' || state == 'Z';
  });
}

// Kills `victim` when `process` is working: it has used more time than a short answer takes.
void kill_at_work(pid_t process, pid_t victim) {
  const long before = state_of(process).ticks;
  wait_until([&] {
    const ProcessState now = state_of(process);
    return now.state == 'X' || now.state == 'Z' || now.ticks >= before + 5;
  });
  ::kill(victim, SIGKILL);
}

class Clients : public ::testing::Test {
 protected:
  DracoResult ask(const std::string& what, const Origin& origin = {}) {
    return client_.decode_draco(request_bytes(what), origin);
  }
  DecodeError error(const std::string& what) {
    const DracoResult result = ask(what);
    const auto* found = std::get_if<DecodeError>(&result);
    return found != nullptr ? *found : DecodeError{ErrorKind::unavailable, "decoded"};
  }
  bool decodes() { return std::holds_alternative<DracoMesh>(ask("triangle")); }
  // The process that serves an origin.
  std::string process(const Origin& origin = {}) {
    return std::get<DecodeError>(ask("process", origin)).message;
  }

  Client client_{test_settings()};
};

TEST_F(Clients, AWorkerIsKept) {
  const std::string first = error("process").message;
  EXPECT_TRUE(decodes());
  EXPECT_EQ(error("process").message, first);
}

TEST_F(Clients, AWorkerThatCrashesIsReplaced) {
  const std::string first = error("process").message;
  const DecodeError crash = error("crash");
  EXPECT_EQ(crash.kind, ErrorKind::died);
  EXPECT_TRUE(decodes());
  EXPECT_NE(error("process").message, first);
  EXPECT_THAT(crash.message, HasSubstr(std::to_string(SIGSEGV)));
  EXPECT_THAT(error("abort").message, HasSubstr(std::to_string(SIGABRT)));
  EXPECT_EQ(error("exit").kind, ErrorKind::died);
  EXPECT_TRUE(decodes());
}

TEST_F(Clients, AWorkerThatIsKilledBetweenRequestsIsReplaced) {
  const pid_t id = std::stoi(error("process").message);
  ::kill(id, SIGKILL);
  wait_for_end(id);
  EXPECT_TRUE(decodes());
}

TEST(Client, AWorkerThatIsKilledAmidDecodingIsOneError) {
  Settings settings = test_settings();
  settings.seconds = 3600;
  Client client(settings);
  const auto ask_it = [&](std::string_view what) {
    return std::get<DecodeError>(client.decode_draco(request_bytes(what)));
  };
  const pid_t id = std::stoi(ask_it("process").message);
  std::thread killer([id] { kill_at_work(id, id); });
  EXPECT_EQ(ask_it("spin").kind, ErrorKind::died);
  killer.join();
  EXPECT_NE(ask_it("process").message, std::to_string(id));
}

// Also if it has removed the alarm that should end it.
TEST(Client, EndlessWorkRunsOutOfProcessorTime) {
  Settings settings = test_settings();
  settings.seconds = 0.5;
  Client client(settings);
  for (const char* work : {"spin", "disarm"}) {
    const DracoResult result = client.decode_draco(request_bytes(work));
    EXPECT_EQ(std::get<DecodeError>(result).kind, ErrorKind::timed_out) << work;
    const DracoResult next = client.decode_draco(request_bytes("triangle"));
    EXPECT_TRUE(std::holds_alternative<DracoMesh>(next)) << work;
  }
}

// It uses no time, so its limit is not reached: this is not a property of the bytes.
TEST(Client, AWorkerThatStandsStillIsEnded) {
  Settings settings = test_settings();
  settings.standstill_seconds = 10;
  Client client(settings);
  const std::string id =
      std::get<DecodeError>(client.decode_draco(request_bytes("process"))).message;
  const DecodeError error = std::get<DecodeError>(client.decode_draco(request_bytes("sleep")));
  EXPECT_EQ(error.kind, ErrorKind::stalled);
  EXPECT_TRUE(is_costly(error));
  wait_for_end(std::stoi(id));
  EXPECT_TRUE(std::holds_alternative<DracoMesh>(client.decode_draco(request_bytes("triangle"))));
}

#ifndef GLTFX_ADDRESS_SANITIZER
TEST_F(Clients, MemoryRunsOutAtTheLimit) {
  EXPECT_EQ(error("memory").kind, ErrorKind::out_of_memory);
  EXPECT_TRUE(decodes());
}

TEST_F(Clients, LimitsOnlyGoDown) {
  for (const char* limit : {"more memory", "more files"}) {
    EXPECT_EQ(error(limit).message, std::to_string(EPERM)) << limit;
  }
}
#endif

TEST_F(Clients, AResultOfAnySizeIsNotGiven) {
  const DecodeError huge = error("file");
  EXPECT_TRUE(huge.kind == ErrorKind::died || huge.message == "refused") << huge.message;
  EXPECT_TRUE(decodes());
}

TEST_F(Clients, AnswersThatLieAreRefused) {
  for (const char* lie : {"garbage", "no result", "wrong index", "image"}) {
    EXPECT_EQ(error(lie).kind, ErrorKind::died) << lie;
    EXPECT_TRUE(decodes()) << lie;
  }
}

TEST_F(Clients, AWorkerHasNothingOpenButItsEnds) {
  // Standard input, output and error, the two ends, payload and result.
  EXPECT_EQ(error("descriptors").message, "0 1 2 3 4 5 6 ");
}

#if defined(__x86_64__) || defined(__aarch64__)
TEST_F(Clients, AWorkerCanReachNothing) {
  for (const char* call :
       {"open", "stat", "socket", "kill", "signal", "limit", "exec", "fork", "code"}) {
    EXPECT_EQ(error(call).message, std::to_string(EPERM)) << call;
  }
}

TEST_F(Clients, AWorkerReachesItselfOnly) {
  EXPECT_EQ(error("signal itself").message, "0");
  EXPECT_EQ(error("limit by its id").message, std::to_string(EPERM)) << "libraries pass 0";
}
#endif

TEST_F(Clients, AWorkerHasNoEnvironment) {
  ASSERT_NE(environ[0], nullptr);
  EXPECT_EQ(error("environment").message, "empty");
}

TEST_F(Clients, AWorkerServesOneOrigin) {
  const Origin one{1, 1}, other{1, 2};
  const std::string first = process(one);
  EXPECT_EQ(process(one), first);
  const std::string second = process(other);
  EXPECT_NE(second, first);
  EXPECT_EQ(process(other), second);
  EXPECT_NE(process(), first);
  EXPECT_NE(process(), second);
}

// With one worker at a time, the worker of another origin is ended and does not return.
TEST(Client, WorkersOfOtherOriginsEnd) {
  Settings settings = test_settings();
  settings.workers = 1;
  Client client(settings);
  const auto process = [&](const Origin& origin) {
    return std::get<DecodeError>(client.decode_draco(request_bytes("process"), origin)).message;
  };
  const std::string first = process({1, 1});
  const std::string second = process({1, 2});
  wait_for_end(std::stoi(first));
  EXPECT_NE(process({1, 1}), second);
}

TEST(Client, WithoutAWorkerNothingIsSaidOfTheBytes) {
  Settings settings;
  settings.folder = "/nonexistent";
  Client client(settings);
  const DracoResult result = client.decode_draco({});
  ASSERT_TRUE(std::holds_alternative<DecodeError>(result));
  EXPECT_EQ(std::get<DecodeError>(result).kind, ErrorKind::unavailable);
  EXPECT_THAT(std::get<DecodeError>(result).message, HasSubstr("/nonexistent/gltfx-codec-draco"));
  EXPECT_THAT(std::get<DecodeError>(result).message, HasSubstr("No such file"));
}

TEST(Client, AFileThatMayNotBeRunIsNamedAsThat) {
  const container::test::TempFolder folder;
  folder.write("gltfx-codec-draco", "#!/bin/sh\n");
  Settings settings;
  settings.folder = folder.path().native();
  Client client(settings);
  const DracoResult result = client.decode_draco({});
  ASSERT_TRUE(std::holds_alternative<DecodeError>(result));
  EXPECT_THAT(std::get<DecodeError>(result).message, HasSubstr("Permission denied"));
}

TEST(Client, AProgramThatIsNoWorkerIsNotOne) {
  const container::test::TempFolder folder;
  Settings settings;
  settings.folder = folder.path().native();
  folder.link("gltfx-codec-draco", "/bin/true");
  Client client(settings);
  const DracoResult result = client.decode_draco({});
  ASSERT_TRUE(std::holds_alternative<DecodeError>(result));
  EXPECT_EQ(std::get<DecodeError>(result).kind, ErrorKind::unavailable);
  EXPECT_THAT(std::get<DecodeError>(result).message, HasSubstr("exited with code 0"));
}

/// A decoder whose misbehaviour is selected by the name of its folder.
class Decoders : public ::testing::Test {
 protected:
  DecodeError ask(const std::string& kind) {
    const auto folder = folder_.path() / kind;
    if (!std::filesystem::exists(folder)) {
      folder_.link(kind + "/gltfx-codec-draco", GLTFX_TEST_WORKERS "/gltfx-codec-draco");
    }
    Settings settings = test_settings();
    settings.folder = folder.native();
    settings.standstill_seconds = kind == "mute" ? 1 : 30;
    Client client(settings);
    for (int i = 0; i < 5; ++i) static_cast<void>(client.decode_draco(request_bytes("triangle")));
    const DracoResult result = client.decode_draco(request_bytes("triangle"));
    const auto* error = std::get_if<DecodeError>(&result);
    return error != nullptr ? *error : DecodeError{ErrorKind::malformed, "decoded"};
  }

  container::test::TempFolder folder_;
};

TEST_F(Decoders, OneThatEndsIsNamedWithItsExitCode) {
  const DecodeError error = ask("gone");
  EXPECT_EQ(error.kind, ErrorKind::unavailable);
  EXPECT_THAT(error.message, HasSubstr("exited with code 3"));
}

TEST_F(Decoders, OneThatGreetsWronglyIsNamed) {
  const DecodeError error = ask("rude");
  EXPECT_EQ(error.kind, ErrorKind::unavailable);
  EXPECT_THAT(error.message, HasSubstr("different protocol version"));
}

TEST_F(Decoders, SilenceIsWaitedForOnce) {
  const DecodeError error = ask("mute");
  EXPECT_EQ(error.kind, ErrorKind::unavailable);
  EXPECT_THAT(error.message, HasSubstr("does not respond"));
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "mute/starts"), 1U);
}

// A broken decoder is not started for each of a hundred thousand images.
TEST_F(Decoders, OneThatDoesNotGetToGreetIsStartedThreeTimes) {
  ask("gone");
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "gone/starts"), 3U);
  ask("rude");
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "rude/starts"), 3U);
}

TEST_F(Decoders, OneThatIsNotThereIsLookedForThreeTimes) {
  Settings settings = test_settings();
  settings.folder = folder_.path().native();
  Client client(settings);
  for (int i = 0; i < 3; ++i) static_cast<void>(client.decode_draco(request_bytes("triangle")));
  folder_.link("gltfx-codec-draco", GLTFX_TEST_WORKERS "/gltfx-codec-draco");
  const DracoResult late = client.decode_draco(request_bytes("triangle"));
  ASSERT_TRUE(std::holds_alternative<DecodeError>(late));
  EXPECT_THAT(std::get<DecodeError>(late).message, HasSubstr("No such file"));
}

TEST_F(Decoders, OneWithoutAFilterIsRefusedUnlessPermitted) {
  const DecodeError refused = ask("unfiltered");
  EXPECT_EQ(refused.kind, ErrorKind::unavailable);
  EXPECT_THAT(refused.message, HasSubstr("--unsandboxed-decoders"));
  permit_unsandboxed_decoders(true);
  EXPECT_EQ(ask("unfiltered").message, "decoded");
  permit_unsandboxed_decoders(false);
}

TEST(Client, WorkersEndWithTheProcess) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    // The worker is in an endless loop when this process is killed.
    Settings settings = test_settings();
    settings.seconds = 3600;
    Client client(settings);
    const std::string id =
        std::get<DecodeError>(client.decode_draco(request_bytes("process"))).message;
    if (::write(ends[1], id.data(), id.size()) < 0) ::_exit(1);
    static_cast<void>(client.decode_draco(request_bytes("spin")));
    ::_exit(0);
  }
  std::array<char, 32> id{};
  ASSERT_GT(::read(ends[0], id.data(), id.size() - 1), 0);
  const pid_t worker = std::stoi(id.data());
  kill_at_work(worker, child);
  ::waitpid(child, nullptr, 0);
  wait_for_end(worker);
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace gltfx::codec
