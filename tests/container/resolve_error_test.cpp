// SPDX-License-Identifier: Apache-2.0
#include "container/resolve_error.hpp"

#include <array>
#include <cerrno>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::container {
namespace {

using testing::HasSubstr;

constexpr std::array kErrors{ResolveError::not_found,   ResolveError::outside_root,
                             ResolveError::not_regular, ResolveError::no_permission,
                             ResolveError::no_root,     ResolveError::io_error,
                             ResolveError::truncated,   ResolveError::too_large};

TEST(ResolveError, EachHasASentenceAndAHelpOfItsOwn) {
  std::set<std::string> sentences;
  std::set<std::string_view> helps;
  for (const ResolveError error : kErrors) {
    EXPECT_EQ(describe(error, "a.bin").back(), '.');
    EXPECT_NE(help(error).back(), '.');
    sentences.insert(describe(error, "a.bin"));
    helps.insert(help(error));
  }
  EXPECT_EQ(sentences.size(), kErrors.size());
  EXPECT_EQ(helps.size(), kErrors.size());
  EXPECT_EQ(help(ResolveError::none), "");
}

TEST(ResolveError, SentencesNameThePathAndTheProblem) {
  EXPECT_EQ(describe(ResolveError::not_found, "x/a.bin"), "'x/a.bin' does not exist.");
  EXPECT_EQ(describe(ResolveError::not_regular, "x", "it is a folder"),
            "'x' is not a regular file: it is a folder.");
}

TEST(ResolveError, NothingFromOutsideIsPrintedRaw) {
  const std::string text = describe(ResolveError::io_error, "a\x1b[2J", "b\n::error");
  EXPECT_THAT(text, testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(text, testing::Not(HasSubstr("\n")));
}

TEST(ResolveError, SystemErrorsAreSorted) {
  EXPECT_EQ(error_of_errno(0), ResolveError::none);
  EXPECT_EQ(error_of_errno(ENOENT), ResolveError::not_found);
  EXPECT_EQ(error_of_errno(ENOTDIR), ResolveError::not_found);
  EXPECT_EQ(error_of_errno(EXDEV), ResolveError::outside_root);
  EXPECT_EQ(error_of_errno(ENXIO), ResolveError::not_regular);
  EXPECT_EQ(error_of_errno(ENAMETOOLONG), ResolveError::not_found);
  EXPECT_EQ(error_of_errno(EISDIR), ResolveError::not_regular);
  EXPECT_EQ(error_of_errno(EACCES), ResolveError::no_permission);
  EXPECT_EQ(error_of_errno(EPERM), ResolveError::no_permission);
  EXPECT_EQ(error_of_errno(EFBIG), ResolveError::too_large);
  EXPECT_EQ(error_of_errno(EOVERFLOW), ResolveError::too_large);
  EXPECT_EQ(error_of_errno(ENOMEM), ResolveError::too_large);
  EXPECT_EQ(error_of_errno(ELOOP), ResolveError::io_error);
  EXPECT_EQ(error_of_errno(EIO), ResolveError::io_error);
}

}  // namespace
}  // namespace gltfx::container
