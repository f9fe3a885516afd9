// SPDX-License-Identifier: Apache-2.0
/// 4 internal > 2 usage > 3 unreadable > 1 findings > 0, in every combination that can occur.
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;

class ExitCode : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("sound.gltf", kSound);
    folder_.write("info.gltf", kInfo);
    folder_.write("warning.gltf", kWarning);
    folder_.write("faulty.gltf", kFaulty);
  }
  int code(const std::string& arguments) const {
    return bash("\"$GLTFX\" validate " + arguments, {folder_.path().native(), {}, {}}).code;
  }

  TempFolder folder_;
};

TEST_F(ExitCode, FollowsFailOn) {
  struct Row {
    const char* file;
    int never, error, warning, info;
  };
  for (const Row& row : {Row{"sound.gltf", 0, 0, 0, 0}, Row{"info.gltf", 0, 0, 0, 1},
                         Row{"warning.gltf", 0, 0, 1, 1}, Row{"faulty.gltf", 0, 1, 1, 1}}) {
    const std::string file = row.file;
    EXPECT_EQ(code(file + " --fail-on never"), row.never) << file;
    EXPECT_EQ(code(file + " --fail-on error"), row.error) << file;
    EXPECT_EQ(code(file), row.error) << file << ": error is the default";
    EXPECT_EQ(code(file + " --fail-on warning"), row.warning) << file;
    EXPECT_EQ(code(file + " --fail-on info"), row.info) << file;
  }
}

TEST_F(ExitCode, OneFaultyFileAmongMany) {
  EXPECT_EQ(code("sound.gltf faulty.gltf info.gltf"), 1);
  EXPECT_EQ(code("."), 1);
}

TEST_F(ExitCode, UnreadableOutranksFindings) {
  EXPECT_EQ(code("missing.gltf"), 3);
  EXPECT_EQ(code("faulty.gltf missing.gltf"), 3);
  EXPECT_EQ(code("missing.gltf faulty.gltf"), 3);
  EXPECT_EQ(code("missing.gltf --fail-on never"), 3);
}

TEST_F(ExitCode, UsageOutranksUnreadable) {
  EXPECT_EQ(code("missing.gltf --format nonsense"), 2);
  EXPECT_EQ(code("missing.gltf faulty.gltf --schema missing.schema.json"), 2);
  EXPECT_EQ(code("missing.gltf --baseline missing.json"), 2);
}

TEST_F(ExitCode, OutputThatCannotBeWrittenOutranksAll) {
  EXPECT_EQ(code("sound.gltf > /dev/full"), 4);
  EXPECT_EQ(code("faulty.gltf missing.gltf > /dev/full"), 4);
  EXPECT_EQ(code("sound.gltf --format json=/dev/full"), 4);
  EXPECT_EQ(code("sound.gltf --format json=/no/such/folder/x"), 4);
  EXPECT_EQ(code("sound.gltf --write-baseline /no/such/folder/x"), 4);
}

TEST_F(ExitCode, OfTheOtherVerbs) {
  EXPECT_EQ(gltfx({"--help"}).code, 0);
  EXPECT_EQ(gltfx({"--version"}).code, 0);
  EXPECT_EQ(gltfx({"rules"}).code, 0);
  EXPECT_EQ(gltfx({"schema"}).code, 0);
  EXPECT_EQ(gltfx({"explain", "TYPE_MISMATCH"}).code, 0);
  EXPECT_EQ(gltfx({"explain", "NO_SUCH_RULE"}).code, 2);
  EXPECT_EQ(gltfx({"explain", "TYPE_MISMATCH", "NO_SUCH_RULE"}).code, 2);
  EXPECT_EQ(gltfx({"schema", "NO_such_extension"}).code, 2);
  EXPECT_EQ(bash("\"$GLTFX\" rules > /dev/full").code, 4);
  EXPECT_EQ(bash("\"$GLTFX\" --help > /dev/full").code, 4);
}

}  // namespace
}  // namespace gltfx::program
