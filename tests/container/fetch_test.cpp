// SPDX-License-Identifier: Apache-2.0
// The bytes of a URI, or a sentence with the reason why there are none.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/opened_files.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container {
namespace {

using testing::HasSubstr;

TEST(Fetch, DataIsDecodedAndFilesAreOpened) {
  const test::TempFolder folder;
  folder.write("a b.bin", "bytes");
  const Resolver resolver(folder.path(), folder.path());
  const auto data = fetch(resolver, "data:application/octet-stream;base64,QUJD");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->text(), "ABC");
  const auto file = fetch(resolver, "a%20b.bin");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->text(), "bytes");
  ResolveError error = ResolveError::none;
  EXPECT_FALSE(fetch(resolver, "away.bin", &error));
  EXPECT_EQ(error, ResolveError::not_found);
}

TEST(Fetch, WhatCannotBeHadIsNamed) {
  const test::TempFolder folder;
  folder.write("lfs.bin",
               "version https://git-lfs.github.com/spec/v1\noid sha256:"
               "4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 12345\n");
  const Resolver resolver(folder.path(), folder.path());
  const auto why = [&](std::string_view uri) {
    const auto bytes = fetch(resolver, uri);
    return bytes ? std::string("it is there") : bytes.error().message;
  };
  EXPECT_THAT(why("away.bin"), HasSubstr("away.bin"));
  EXPECT_THAT(why("../up.bin"), HasSubstr("up.bin"));
  EXPECT_THAT(why("lfs.bin"), HasSubstr("Git LFS"));
  EXPECT_THAT(why("https://example.com/a.bin"), HasSubstr("not a relative path"));
  EXPECT_NE(why("data:;base64,!"), "it is there");
  EXPECT_NE(why("data:no comma"), "it is there");
}

TEST(OpenedFiles, OneFileIsOpenedOnceHoweverOftenItIsNamed) {
  const test::TempFolder folder;
  folder.write("a.bin", "bytes");
  Resolver resolver(folder.path(), folder.path());
  const auto log = std::make_shared<LookupLog>();
  resolver.record(log);
  OpenedFiles files(resolver);
  for (const std::string_view uri : {"a.bin", "away.bin", "./a.bin", "%61.bin", "away.bin"}) {
    const auto bytes = fetch(files, uri);
    EXPECT_EQ(bytes ? bytes->text() : "nothing", uri == "away.bin" ? "nothing" : "bytes") << uri;
  }
  EXPECT_EQ(log->lookups().size(), 2U);
}

}  // namespace
}  // namespace gltfx::container
