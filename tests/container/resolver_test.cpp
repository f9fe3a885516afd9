// SPDX-License-Identifier: Apache-2.0
#include "container/resolver.hpp"

#include <memory>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "container/file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container::test {
namespace {

constexpr std::string_view kSecret = "not for you";

/// outside/secret, inside/... with every kind of thing a path may lead to.
class ResolverTest : public testing::TestWithParam<Confinement> {
 protected:
  ResolverTest() {
    folder_.write("outside/secret", kSecret);
    folder_.write("inside/a.bin", "content of a");
    folder_.write("inside/sub/deep/b.bin", "content of b");
  }

  Resolved open(std::string_view path, std::string_view base = "inside") const {
    return Resolver(root(), folder_.path() / base, GetParam()).open(path);
  }
  /// The content, or the error as "fault N".
  std::string read(std::string_view path, std::string_view base = "inside") const {
    const Resolver resolver(root(), folder_.path() / base, GetParam());
    const Resolved resolved = resolver.open(path);
    std::uint64_t size = 0;
    EXPECT_EQ(resolver.stat(path, size), resolved.error) << path;
    if (resolved.error != ResolveError::none) return error(resolved.error);
    EXPECT_EQ(size, resolved.bytes.size()) << path;
    return std::string(resolved.bytes.text());
  }
  static std::string error(ResolveError error) {
    return "fault " + std::to_string(static_cast<int>(error));
  }
  std::filesystem::path root() const { return folder_.path() / "inside"; }

  const std::string not_found_ = error(ResolveError::not_found);
  const std::string outside_ = error(ResolveError::outside_root);
  const std::string not_regular_ = error(ResolveError::not_regular);
  const std::string io_error_ = error(ResolveError::io_error);
  const TempFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Both, ResolverTest,
                         testing::Values(Confinement::automatic, Confinement::by_hand),
                         [](const auto& parameter) {
                           return parameter.param == Confinement::automatic ? "automatic"
                                                                            : "by_hand";
                         });

TEST_P(ResolverTest, FilesInsideAreRead) {
  EXPECT_EQ(read("a.bin"), "content of a");
  EXPECT_EQ(read("./a.bin"), "content of a");
  EXPECT_EQ(read("sub/deep/b.bin"), "content of b");
  EXPECT_EQ(read("sub//deep/./b.bin"), "content of b");
}

TEST_P(ResolverTest, NamesMayHoldAnyCharacter) {
  for (const char* name : {"with space.bin", "\xC3\xA4\xF0\x9F\x8C\xBF.bin", "a%20b", "a\\b", "-",
                           "\xFF.bin", "...", "q?#"}) {
    folder_.write(std::filesystem::path("inside") / name, name);
    EXPECT_EQ(read(name), name);
  }
}

TEST_P(ResolverTest, WhatIsMissingIsNotFound) {
  EXPECT_EQ(read("none.bin"), not_found_);
  EXPECT_EQ(read("none/a.bin"), not_found_);
  EXPECT_EQ(read("a.bin/"), not_found_);
  EXPECT_EQ(read("a.bin/."), not_found_);
  EXPECT_EQ(read("a.bin/x"), not_found_);
  EXPECT_EQ(read("none/../a.bin"), not_found_);
  EXPECT_EQ(read(std::string("a.bin\0x", 7)), not_found_);
  EXPECT_EQ(read(std::string(300, 'x')), not_found_);
  EXPECT_EQ(read(std::string(5000, 'x')), not_found_);
}

TEST_P(ResolverTest, ParentFoldersMayBeUsedInsideTheRoot) {
  EXPECT_EQ(read("sub/../a.bin"), "content of a");
  EXPECT_EQ(read("../a.bin", "inside/sub"), "content of a");
  EXPECT_EQ(read("../../a.bin", "inside/sub/deep"), "content of a");
  EXPECT_EQ(read("b.bin", "inside/sub/deep"), "content of b");
}

TEST_P(ResolverTest, ParentFoldersNeverLeadOut) {
  EXPECT_EQ(read("../outside/secret"), outside_);
  EXPECT_EQ(read("sub/../../outside/secret"), outside_);
  EXPECT_EQ(read("../../outside/secret", "inside/sub"), outside_);
  EXPECT_EQ(read(".."), outside_);
}

TEST_P(ResolverTest, AWayOutThatNamesTheWayBackInStaysInside) {
  EXPECT_EQ(read("../inside/a.bin"), "content of a");
  EXPECT_EQ(read("..//inside/./sub/../a.bin"), "content of a");
  EXPECT_EQ(read("../../inside/a.bin", "inside/sub"), "content of a");
  const std::string parent = folder_.path().filename().native();
  EXPECT_EQ(read("../../" + parent + "/inside/a.bin"), "content of a");
  EXPECT_EQ(read("../../" + parent + "/outside/secret"), outside_);
  EXPECT_EQ(read("../inside/../outside/secret"), outside_);
  EXPECT_EQ(read("../inside/"), error(ResolveError::not_regular));
  EXPECT_EQ(read("../insid/a.bin"), outside_);
  EXPECT_EQ(read("../insidee/a.bin"), outside_);
}

TEST_P(ResolverTest, LinksOnTheWayBackInStillLeadNowhereElse) {
  folder_.link("inside/out", "../outside/secret");
  EXPECT_EQ(read("../inside/out"), outside_);
  // The names of links to the root are not those of the root.
  folder_.link("alias", "inside");
  EXPECT_EQ(read("../alias/a.bin"), outside_);
}

TEST_P(ResolverTest, AbsolutePathsAreOutside) {
  EXPECT_EQ(read("/etc/passwd"), outside_);
  EXPECT_EQ(read(root().native() + "/a.bin"), outside_);
}

TEST_P(ResolverTest, RelativeLinksAreFollowedInside) {
  folder_.link("inside/link", "sub/deep/b.bin");
  folder_.link("inside/sub/up", "../a.bin");
  folder_.link("inside/folder", "sub");
  EXPECT_EQ(read("link"), "content of b");
  EXPECT_EQ(read("sub/up"), "content of a");
  EXPECT_EQ(read("folder/deep/b.bin"), "content of b");
  EXPECT_EQ(read("folder/up"), "content of a");
  EXPECT_EQ(read("link/"), not_found_);
}

TEST_P(ResolverTest, TheParentOfALinkedFolderIsThatOfItsTarget) {
  folder_.link("inside/jump", "sub/deep");
  folder_.write("inside/sub/c.bin", "content of c");
  EXPECT_EQ(read("jump/../c.bin"), "content of c");
}

TEST_P(ResolverTest, RelativeLinksThatLeadOutAreOutside) {
  folder_.link("inside/out", "../outside/secret");
  folder_.link("inside/outfolder", "../outside");
  folder_.link("inside/sub/chain", "../out");
  folder_.link("inside/missing", "../outside/none");
  EXPECT_EQ(read("out"), outside_);
  EXPECT_EQ(read("outfolder/secret"), outside_);
  EXPECT_EQ(read("sub/chain"), outside_);
  EXPECT_EQ(read("missing"), outside_);
}

TEST_P(ResolverTest, AbsoluteLinksAreFollowedOnlyWhenTheyLeadBackInside) {
  folder_.link("inside/back", root() / "sub/deep/b.bin");
  folder_.link("inside/backfolder", root() / "sub");
  folder_.link("inside/toroot", root());
  folder_.link("inside/out", folder_.path() / "outside/secret");
  folder_.link("inside/outfolder", folder_.path() / "outside");
  folder_.link("inside/missing", folder_.path() / "outside/none");
  folder_.link("inside/gone", root() / "none");
  EXPECT_EQ(read("back"), "content of b");
  EXPECT_EQ(read("backfolder/deep/b.bin"), "content of b");
  EXPECT_EQ(read("backfolder/../a.bin"), "content of a");
  EXPECT_EQ(read("toroot/a.bin"), "content of a");
  EXPECT_EQ(read("toroot/../outside/secret"), outside_);
  EXPECT_EQ(read("out"), outside_);
  EXPECT_EQ(read("outfolder/secret"), outside_);
  EXPECT_EQ(read("outfolder"), outside_);
  EXPECT_EQ(read("outfolder/.."), outside_);
  EXPECT_EQ(read("missing"), outside_);
  EXPECT_EQ(read("gone"), not_found_);
}

TEST_P(ResolverTest, AbsoluteLinksMayPassThroughLinksOnTheirWayBack) {
  folder_.link("alias", "inside");
  folder_.link("inside/back", folder_.path() / "alias/a.bin");
  EXPECT_EQ(read("back"), "content of a");
}

TEST_P(ResolverTest, AbsoluteLinksDoNotPassThroughFoldersBesideTheRoot) {
  folder_.link("inside/detour", folder_.path() / "outside/../inside/a.bin");
  EXPECT_EQ(read("detour"), outside_);
}

TEST_P(ResolverTest, AbsoluteLinksMayStepUpOnTheirWayBack) {
  folder_.link("inside/above", "/.." + (root() / "a.bin").native());
  folder_.link("inside/twice", folder_.path() / "inside/../inside/a.bin");
  folder_.link("inside/slash", "/");
  EXPECT_EQ(read("above"), "content of a");
  EXPECT_EQ(read("twice"), outside_) << "inside the root '..' leads out";
  EXPECT_EQ(read("slash"), outside_);
  folder_.link("inside/around", folder_.path().parent_path() / "../" /
                                    folder_.path().relative_path() / "inside/a.bin");
  EXPECT_EQ(read("around"), "content of a");
}

TEST_P(ResolverTest, AnAbsolutePathIsOpenedWhereItLeadsBackInside) {
  const UniqueFd fd(::open(root().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  EXPECT_EQ(open_beneath(fd.get(), root() / "a.bin", GetParam()).size, 12U);
  EXPECT_EQ(open_beneath(fd.get(), folder_.path() / "outside/secret", GetParam()).error,
            ResolveError::outside_root);
}

TEST_P(ResolverTest, TheBaseMayBeAnotherNameOfTheRoot) {
  EXPECT_EQ(read("a.bin", "inside/sub/.."), "content of a");
}

TEST_P(ResolverTest, BytesThatAreAddedStandInTheirPlace) {
  Resolver resolver(root(), root(), GetParam());
  const auto log = std::make_shared<LookupLog>();
  resolver.record(log);
  resolver.add("a.bin", Bytes::from_string("added"));
  std::uint64_t size = 0;
  EXPECT_EQ(resolver.open("a.bin").bytes.text(), "added");
  EXPECT_EQ(resolver.stat("a.bin", size), ResolveError::none);
  EXPECT_EQ(size, 5U);
  EXPECT_TRUE(log->lookups().empty());
  EXPECT_EQ(resolver.stat("none", size), ResolveError::not_found);
  ASSERT_EQ(log->lookups().size(), 1U);
  EXPECT_EQ(log->lookups().front().path, "none");
}

TEST_P(ResolverTest, DevicesBehindLinksAreNotOpened) {
  folder_.link("inside/zero", "/dev/zero");
  folder_.link("inside/self", "/proc/self/cwd");
  EXPECT_EQ(read("zero"), outside_);
  EXPECT_EQ(read("self"), outside_);
}

TEST_P(ResolverTest, LinkLoopsEnd) {
  folder_.link("inside/loop", "loop");
  folder_.link("inside/ping", "pong");
  folder_.link("inside/pong", "ping");
  folder_.link("inside/spin", root() / "spin");
  EXPECT_EQ(read("loop"), io_error_);
  EXPECT_EQ(read("ping"), io_error_);
  EXPECT_EQ(read("loop/a.bin"), io_error_);
  EXPECT_EQ(read("spin"), io_error_);
}

TEST_P(ResolverTest, FortyLinksAreFollowedAndNoMore) {
  folder_.link("inside/1", "a.bin");
  for (int i = 2; i <= 41; ++i) {
    folder_.link("inside/" + std::to_string(i), std::to_string(i - 1));
  }
  EXPECT_EQ(read("40"), "content of a");
  EXPECT_EQ(read("41"), io_error_);
}

TEST_P(ResolverTest, DanglingLinksAreNotFound) {
  folder_.link("inside/dangling", "none");
  folder_.link("inside/deeper", "none/a.bin");
  EXPECT_EQ(read("dangling"), not_found_);
  EXPECT_EQ(read("deeper"), not_found_);
}

TEST_P(ResolverTest, FoldersAreNotFiles) {
  for (const char* path : {"sub", "sub/", "", ".", "sub/.", "sub/.."}) {
    EXPECT_EQ(read(path), not_regular_) << path;
  }
  EXPECT_EQ(open("sub").problem, "it is a folder");
}

TEST_P(ResolverTest, AFifoIsRefusedWithoutWaiting) {
  ASSERT_EQ(::mkfifo((root() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read("pipe"), not_regular_);
  EXPECT_EQ(open("pipe").problem, "it is a pipe");
}

TEST_P(ResolverTest, WithoutPermissionItIsSaidSo) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  std::filesystem::permissions(root() / "a.bin", std::filesystem::perms::none);
  EXPECT_EQ(read("a.bin"), error(ResolveError::no_permission));
}

TEST_P(ResolverTest, LargeFilesAreMappedAndOutliveTheResolver) {
  const std::string content(300000, 'm');
  folder_.write("inside/large.bin", content);
  const Resolved resolved = open("large.bin");
  EXPECT_EQ(resolved.error, ResolveError::none);
  EXPECT_TRUE(resolved.bytes.text() == content);
}

TEST_P(ResolverTest, EmptyFilesAreFiles) {
  folder_.write("inside/empty.bin", "");
  EXPECT_EQ(read("empty.bin"), "");
}

TEST_P(ResolverTest, GitLfsPointersAreNamed) {
  folder_.write("inside/p.bin",
                "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n");
  EXPECT_TRUE(open("p.bin").git_lfs_pointer);
  EXPECT_FALSE(open("a.bin").git_lfs_pointer);
}

TEST_P(ResolverTest, TheRootMayItselfBeNamedThroughALink) {
  folder_.link("alias", "inside");
  const Resolver resolver(folder_.path() / "alias", folder_.path() / "inside/sub", GetParam());
  EXPECT_EQ(resolver.open("../a.bin").bytes.text(), "content of a");
  folder_.link("inside/back", folder_.path() / "alias/a.bin");
  EXPECT_EQ(resolver.open("../back").bytes.text(), "content of a");
}

TEST_P(ResolverTest, TheWholeFileSystemMayBeTheRoot) {
  folder_.link("inside/out", folder_.path() / "outside/secret");
  const Resolver resolver("/", root(), GetParam());
  EXPECT_EQ(resolver.open("a.bin").bytes.text(), "content of a");
  EXPECT_EQ(resolver.open("out").bytes.text(), kSecret);
  EXPECT_EQ(resolver.open("../outside/secret").bytes.text(), kSecret);
}

TEST_P(ResolverTest, ABaseOutsideTheRootReadsNothing) {
  EXPECT_EQ(read("secret", "outside"), outside_);
  EXPECT_EQ(read("../inside/a.bin", "outside"), outside_);
  folder_.write("inside2/x", "x");  // a name that only begins like the root's
  EXPECT_EQ(read("x", "inside2"), outside_);
}

TEST_P(ResolverTest, AMissingRootOrBaseReadsNothing) {
  EXPECT_EQ(read("a.bin", "inside/none"), not_found_);
  const Resolver resolver(folder_.path() / "none", folder_.path() / "none", GetParam());
  EXPECT_EQ(resolver.open("a.bin").error, ResolveError::not_found);
}

TEST_P(ResolverTest, TheRootStaysWhatItWasWhenItsNameIsTakenOver) {
  const Resolver resolver(root(), root(), GetParam());
  std::filesystem::rename(root(), folder_.path() / "moved");
  folder_.link("inside", "outside");
  EXPECT_EQ(resolver.open("a.bin").bytes.text(), "content of a");
  EXPECT_EQ(resolver.open("secret").error, ResolveError::not_found);
}

TEST(Resolver, WithoutARootNothingIsLookedUp) {
  std::uint64_t size = 7;
  EXPECT_EQ(Resolver().open("a.bin").error, ResolveError::no_root);
  EXPECT_EQ(Resolver().stat("a.bin", size), ResolveError::no_root);
  EXPECT_EQ(size, 0U);
}

TEST(Resolver, AFolderThatIsGoneHasNoName) {
  const UniqueFd back(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC));
  {
    const TempFolder folder;
    ASSERT_EQ(::chdir(folder.path().c_str()), 0);
  }
  const Resolver resolver(".", "sub");
  ASSERT_EQ(::fchdir(back.get()), 0);
  EXPECT_EQ(resolver.open("a.bin").error, ResolveError::not_found);
}

TEST(Resolver, AnEmptyPathMeansTheCurrentFolder) {
  std::uint64_t size = 0;
  EXPECT_EQ(Resolver("", "").stat(".", size), ResolveError::not_regular);
}

}  // namespace
}  // namespace gltfx::container::test
