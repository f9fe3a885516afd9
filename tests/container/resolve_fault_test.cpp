// SPDX-License-Identifier: Apache-2.0
#include "container/resolve_fault.hpp"

#include <array>
#include <cerrno>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::container {
namespace {

using testing::HasSubstr;

constexpr std::array kFaults{ResolveFault::not_found,   ResolveFault::outside_root,
                             ResolveFault::not_regular, ResolveFault::no_permission,
                             ResolveFault::no_root,     ResolveFault::io_error,
                             ResolveFault::truncated,   ResolveFault::too_large};

TEST(ResolveFault, EachHasASentenceAndAHelpOfItsOwn) {
  std::set<std::string> sentences;
  std::set<std::string_view> helps;
  for (const ResolveFault fault : kFaults) {
    EXPECT_EQ(describe(fault, "a.bin").back(), '.');
    EXPECT_NE(help(fault).back(), '.');
    sentences.insert(describe(fault, "a.bin"));
    helps.insert(help(fault));
  }
  EXPECT_EQ(sentences.size(), kFaults.size());
  EXPECT_EQ(helps.size(), kFaults.size());
  EXPECT_EQ(help(ResolveFault::none), "");
}

TEST(ResolveFault, SentencesNameThePathAndTheProblem) {
  EXPECT_EQ(describe(ResolveFault::not_found, "x/a.bin"), "'x/a.bin' does not exist.");
  EXPECT_EQ(describe(ResolveFault::not_regular, "x", "it is a folder"),
            "'x' is not a regular file: it is a folder.");
}

TEST(ResolveFault, NothingFromOutsideIsPrintedRaw) {
  const std::string text = describe(ResolveFault::io_error, "a\x1b[2J", "b\n::error");
  EXPECT_THAT(text, testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(text, testing::Not(HasSubstr("\n")));
}

TEST(ResolveFault, SystemErrorsAreSorted) {
  EXPECT_EQ(fault_of_errno(0), ResolveFault::none);
  EXPECT_EQ(fault_of_errno(ENOENT), ResolveFault::not_found);
  EXPECT_EQ(fault_of_errno(ENOTDIR), ResolveFault::not_found);
  EXPECT_EQ(fault_of_errno(EXDEV), ResolveFault::outside_root);
  EXPECT_EQ(fault_of_errno(ENXIO), ResolveFault::not_regular);
  EXPECT_EQ(fault_of_errno(ENAMETOOLONG), ResolveFault::not_found);
  EXPECT_EQ(fault_of_errno(EISDIR), ResolveFault::not_regular);
  EXPECT_EQ(fault_of_errno(EACCES), ResolveFault::no_permission);
  EXPECT_EQ(fault_of_errno(EPERM), ResolveFault::no_permission);
  EXPECT_EQ(fault_of_errno(EFBIG), ResolveFault::too_large);
  EXPECT_EQ(fault_of_errno(EOVERFLOW), ResolveFault::too_large);
  EXPECT_EQ(fault_of_errno(ENOMEM), ResolveFault::too_large);
  EXPECT_EQ(fault_of_errno(ELOOP), ResolveFault::io_error);
  EXPECT_EQ(fault_of_errno(EIO), ResolveFault::io_error);
}

}  // namespace
}  // namespace gltfx::container
