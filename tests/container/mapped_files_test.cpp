// SPDX-License-Identifier: Apache-2.0
#include "container/mapped_files.hpp"

#include <gltfx/mapping.hpp>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "container/file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container::test {
namespace {

void repair(int signal, siginfo_t* info, void*) {
  if (!repair_mapping(info->si_addr)) static_cast<void>(std::signal(signal, SIG_DFL));
}

// Repairs mappings as long as it lives.
class Guard {
 public:
  Guard() {
    struct sigaction action {};
    action.sa_sigaction = repair;
    action.sa_flags = SA_SIGINFO;
    ::sigaction(SIGBUS, &action, &before_);
  }
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;
  ~Guard() { ::sigaction(SIGBUS, &before_, nullptr); }

 private:
  struct sigaction before_ {};
};

TEST(Mapping, WhatIsCutOffReadsAsZerosAndIsKnown) {
  const Guard guard;
  const TempFolder folder;
  const auto path = folder.write("big", std::string(1U << 20U, 'x'));
  const Loaded loaded = load_file(open_regular(AT_FDCWD, path.c_str()));
  const std::string_view text = loaded.bytes.text();
  EXPECT_EQ(text[900000], 'x');
  EXPECT_FALSE(is_truncated(loaded.bytes));
  std::filesystem::resize_file(path, 8192);
  EXPECT_EQ(text[4096], 'x');
  EXPECT_EQ(text[800000], '\0');
  EXPECT_TRUE(is_truncated(loaded.bytes));
  EXPECT_TRUE(is_truncated(loaded.bytes.part(100, 10)));
}

TEST(Mapping, OtherMemoryIsNotTouched) {
  const std::string text(100, 'x');
  EXPECT_FALSE(repair_mapping(text.data()));
  EXPECT_FALSE(repair_mapping(nullptr));
  EXPECT_FALSE(is_truncated(Bytes::from_string(text)));
}

TEST(Mapping, SeveralAreKeptApart) {
  const Guard guard;
  const TempFolder folder;
  const auto path = folder.write("cut", std::string(1U << 20U, 'x'));
  const auto other = folder.write("whole", std::string(1U << 20U, 'y'));
  const Loaded whole = load_file(open_regular(AT_FDCWD, other.c_str()));
  const Loaded cut = load_file(open_regular(AT_FDCWD, path.c_str()));
  const Loaded last = load_file(open_regular(AT_FDCWD, other.c_str()));
  std::filesystem::resize_file(path, 4096);
  EXPECT_EQ(cut.bytes.text().back(), '\0');
  EXPECT_TRUE(is_truncated(cut.bytes));
  EXPECT_FALSE(is_truncated(whole.bytes));
  EXPECT_FALSE(is_truncated(last.bytes));
  EXPECT_FALSE(is_truncated(Bytes::from_string("elsewhere")));
  EXPECT_FALSE(repair_mapping(nullptr));
  EXPECT_FALSE(repair_mapping(reinterpret_cast<const void*>(UINTPTR_MAX)));
}

TEST(Mapping, AMappingThatIsGoneIsForgotten) {
  const TempFolder folder;
  const auto path = folder.write("big", std::string(1U << 20U, 'x'));
  const void* address = nullptr;
  {
    const Loaded loaded = load_file(open_regular(AT_FDCWD, path.c_str()));
    address = loaded.bytes.view().data();
  }
  EXPECT_FALSE(repair_mapping(address));
  const Loaded again = load_file(open_regular(AT_FDCWD, path.c_str()));
  EXPECT_FALSE(is_truncated(again.bytes));
}

long resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("RssFile:")) return std::stol(line.substr(8));
  }
  return 0;
}

TEST(Mapping, AReaderWithAMeterKeepsFewPagesResident) {
  const TempFolder folder;
  const auto path = folder.write("big", "x");
  std::filesystem::resize_file(path, std::size_t{96} << 20U);
  const Loaded loaded = load_file(open_regular(AT_FDCWD, path.c_str()));
  const ReadMeter meter(loaded.bytes.part(4096, 4096));
  constexpr std::size_t kStep = 65536;
  const long before = resident_kib();
  long most = 0;
  std::size_t zeros = 0;
  for (std::size_t at = 0; at < loaded.bytes.size(); at += kStep) {
    const std::string_view step = loaded.bytes.text().substr(at, kStep);
    zeros += static_cast<std::size_t>(std::count(step.begin(), step.end(), '\0'));
    meter.add(step.size());
    if (at % (kStep * 64) == 0) most = std::max(most, resident_kib() - before);
  }
  EXPECT_EQ(zeros, loaded.bytes.size() - 1);
  EXPECT_LT(most, 32 << 10);
  EXPECT_EQ(loaded.bytes.text().front(), 'x');
  const std::string text(100, 'y');
  const Bytes own = Bytes::from_string(text);
  ReadMeter(own).add(std::size_t{1} << 30U);
  EXPECT_EQ(own.text(), text);
}

TEST(Mapping, MetersCountPerFile) {
  const TempFolder folder;
  const auto path = folder.write("big", std::string(1U << 20U, 'x'));
  const Loaded loaded = load_file(open_regular(AT_FDCWD, path.c_str()));
  const Loaded other = load_file(open_regular(AT_FDCWD, path.c_str()));
  ReadMeter(loaded.bytes).add(std::size_t{1} << 30U);
  ReadMeter(other.bytes).add(1);
  EXPECT_EQ(loaded.bytes.text(), other.bytes.text());
  EXPECT_FALSE(is_truncated(loaded.bytes));
}

}  // namespace
}  // namespace gltfx::container::test
