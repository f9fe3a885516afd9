// SPDX-License-Identifier: Apache-2.0
// Drafts are written completely, files before the assets that refer to them, or not at all.
#include "change/commit.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "change/apply.hpp"
#include "change/backup.hpp"
#include "container/glb_builder.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using container::test::TempFolder;
using testing::HasSubstr;
using testing::IsEmpty;

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

model::OpenedAsset open(const std::filesystem::path& path) {
  return {path, *container::open_file(path), {path.parent_path(), path.parent_path()}};
}

/// An asset on the disk, a change of it, and the draft.
struct Edited {
  Edited(const std::filesystem::path& path, Change what)
      : old(open(path)), state(*file_state(path)), change(std::move(what)) {
    auto made = apply(old, change);
    EXPECT_TRUE(made);
    if (made) draft.emplace(*std::move(made));
  }
  AssetWrite write(const EditOptions& options) const {
    return {old, state, options, &draft->container(), change.files, change.replaced};
  }

  model::OpenedAsset old;
  FileState state;
  Change change;
  std::optional<model::OpenedAsset> draft;
};

const std::string kText = R"({"buffers":[{"uri":"a.bin"}]})";
const std::string kNewText = R"({"images":[{"uri":"a.bin"}]})";
EditOptions in_place(bool backup) {
  EditOptions options;
  options.in_place = true;
  options.backup = backup;
  return options;
}

// New text, new bytes for a.bin, and a new file.
Change change_of(const TempFolder& folder) {
  Change change;
  change.edits = {{{2, 9}, "images"}};
  change.replaced = {{"a.bin", *file_state(folder.path() / "a.bin"), Bytes::from_string("old"),
                      Bytes::from_string("new")}};
  change.files = {{"b.png", {container::Bytes::from_string("png")}}};
  return change;
}

std::string first_error(const std::vector<std::optional<WriteFailure>>& failures) {
  return failures.front() ? failures.front()->error : std::string();
}

TEST(Commit, ReplacesTheAssetAndItsFiles) {
  const TempFolder folder;
  folder.write("a.bin", "old");
  const auto path = folder.write("a.gltf", kText);
  const Edited edited(path, change_of(folder));
  const EditOptions options = in_place(true);
  EXPECT_EQ(first_error(commit({edited.write(options)})), "");
  EXPECT_EQ(read(path), kNewText);
  EXPECT_EQ(read(folder.path() / "a.bin"), "new");
  EXPECT_EQ(read(folder.path() / "b.png"), "png");
  EXPECT_EQ(read(backup_of(path)), kText);
  EXPECT_EQ(restore(path), std::nullopt);
  EXPECT_EQ(read(path), kText);
  EXPECT_EQ(read(folder.path() / "a.bin"), "old");
}

TEST(Commit, WritesACopyWithAllThatItRefersTo) {
  const TempFolder folder;
  folder.write("a.bin", "old");
  const auto path = folder.write("a.gltf", kText);
  const Edited edited(path, change_of(folder));
  const auto copy = folder.path() / "other" / "b.gltf";
  EditOptions options;
  options.output = copy;
  EXPECT_EQ(first_error(commit({edited.write(options)})), "");
  EXPECT_EQ(read(copy), kNewText);
  EXPECT_EQ(read(folder.path() / "other/a.bin"), "new");
  EXPECT_EQ(read(folder.path() / "other/b.png"), "png");
  EXPECT_EQ(read(path), kText);
  EXPECT_EQ(read(folder.path() / "a.bin"), "old");
}

TEST(Commit, LeavesAllAssetsAsTheyAreWhereOneCannotBeWritten) {
  const TempFolder folder;
  folder.write("a.bin", "old");
  const auto one = folder.write("a.gltf", kText);
  const auto other = folder.write("b.gltf", kText);
  const Edited first(one, change_of(folder));
  const Edited second(other, change_of(folder));
  folder.write("b.gltf", kText + " ");
  const EditOptions options = in_place(false);
  const auto failures = commit({first.write(options), second.write(options)});
  ASSERT_TRUE(failures[0] && failures[1]);
  EXPECT_THAT(failures[0]->error, HasSubstr("which shares files with it, cannot be written"));
  EXPECT_THAT(failures[1]->error, HasSubstr("was changed by another program"));
  EXPECT_EQ(read(one), kText);
  EXPECT_EQ(read(folder.path() / "a.bin"), "old");
}

TEST(Apply, OfAGlbTheBinChunkGrowsAndTheTextIsTheNewOne) {
  const std::string bytes =
      container::test::glb(container::test::chunk(container::kChunkJson, R"({"a":1} )") +
                           container::test::bin_chunk("abcd"));
  const model::OpenedAsset old("a.glb", container::open_bytes(Bytes::from_string(bytes)), {});
  Change change;
  change.edits = {{{5, 6}, "12"}};
  change.bins[1].more = "efgh";
  const auto draft = apply(old, change);
  ASSERT_TRUE(draft);
  const container::Container& now = draft->container();
  EXPECT_EQ(*now.json, R"({"a":12} )");
  EXPECT_EQ(now.bytes.part(now.bin->offset, now.bin->length).text(), "abcdefgh");
  EXPECT_THAT(now.errors, IsEmpty());
}

TEST(Apply, NewAndReplacedFilesAreWhereTheDraftLooksForThem) {
  const TempFolder folder;
  folder.write("a.bin", "old");
  const Edited edited(folder.write("a.gltf", kText), change_of(folder));
  EXPECT_EQ(edited.draft->resolver().open("a.bin").bytes.text(), "new");
  EXPECT_EQ(edited.draft->resolver().open("b.png").bytes.text(), "png");
  EXPECT_EQ(edited.old.resolver().open("a.bin").bytes.text(), "old");
}

}  // namespace
}  // namespace gltfx::change
