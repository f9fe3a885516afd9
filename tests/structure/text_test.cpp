// SPDX-License-Identifier: Apache-2.0
/// Texts of files: licence, leftovers, places outside the project, output of the library.
#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kEverything{"libgltfx",
                                           "tools",
                                           "tests/structure",
                                           "tests/program",
                                           "tests/pipeline",
                                           "tests/rules",
                                           "tests/report",
                                           "tests/inspect",
                                           "tests/page",
                                           "tests/slurm",
                                           "tests/packaging",
                                           "tests/schema",
                                           "tests/json",
                                           "tests/container",
                                           "tests/model",
                                           "tests/base",
                                           "schema",
                                           "fixtures",
                                           "CMakeLists.txt",
                                           "libgltfx/CMakeLists.txt",
                                           "tests/CMakeLists.txt",
                                           "CMakePresets.json",
                                           "README.md",
                                           "HACKING.md",
                                           "docs",
                                           "CHANGELOG.md",
                                           "SECURITY.md",
                                           ".ci",
                                           ".pre-commit-hooks.yaml",
                                           "Dockerfile",
                                           "action.yml"};

// Hosts that the project may link to, and those in examples.
const std::vector<std::string_view> kHosts{"json-schema.org",
                                           "github.com",
                                           "git-lfs.github.com",
                                           "docs.github.com",
                                           "docs.gitlab.com",
                                           "docs.oasis-open.org",
                                           "www.apache.org",
                                           "www.debian.org",
                                           "www.khronos.org",
                                           "registry.khronos.org",
                                           "semver.org",
                                           "keepachangelog.com",
                                           "pre-commit.com",
                                           "www.w3.org",
                                           "purl.org",
                                           "vrm.dev",
                                           "iolite-engine.com",
                                           "www.freedesktop.org",
                                           "no-color.org",
                                           "example.com",
                                           "example.org",
                                           "h",
                                           "a"};

bool is_script(const Source& source) {
  return source.text.starts_with("#!") || source.path.ends_with("CMakeLists.txt") ||
         source.path.ends_with(".cmake");
}

bool is_cpp(const Source& source) {
  return source.path.ends_with(".cpp") || source.path.ends_with(".hpp");
}

Problems check_licence(const Source& source) {
  if (!is_cpp(source) && !is_script(source)) return {};
  const std::size_t found = source.text.find("SPDX-License-Identifier: Apache-2.0");
  if (found != std::string::npos && line_of(source.text, found) <= 2) return {};
  return {problem(source, 1, "has no SPDX-License-Identifier line at its head")};
}

void find_all(const Source& source, std::string_view word, std::string_view why,
              Problems& problems) {
  for (std::size_t at = source.text.find(word); at != std::string::npos;
       at = source.text.find(word, at + 1)) {
    problems.push_back(problem(source, line_of(source.text, at), why));
  }
}

// Words are put together here so that this file does not find itself.
Problems check_leftovers(const Source& source) {
  Problems problems;
  for (const std::string word : {"TO", "FIX"}) {
    const std::string whole = word + (word == "TO" ? "DO" : "ME");
    find_all(source, whole, "says " + whole, problems);
  }
  find_all(source, std::string("/wo") + "rk/", "names a folder of one machine", problems);
  find_all(source, std::string("/ro") + "ot/", "names a folder of one machine", problems);
  return problems;
}

Problems check_hosts(const Source& source) {
  // The sources of presets are the pages of the platforms.
  if (source.path.starts_with("schema/presets/") || source.path == "docs/reference/presets.md") {
    return {};
  }
  Problems problems;
  for (const std::string_view scheme : {"http://", "https://"}) {
    for (std::size_t at = source.text.find(scheme); at != std::string::npos;
         at = source.text.find(scheme, at + 1)) {
      std::size_t end = at + scheme.size();
      while (end < source.text.size() &&
             (std::isalnum(static_cast<unsigned char>(source.text[end])) != 0 ||
              source.text[end] == '.' || source.text[end] == '-')) {
        ++end;
      }
      const std::string host = source.text.substr(at + scheme.size(), end - at - scheme.size());
      const bool known = std::find(kHosts.begin(), kHosts.end(), host) != kHosts.end();
      if (!known && !host.empty()) {
        problems.push_back(problem(source, line_of(source.text, at), "points to " + host));
      }
    }
  }
  return problems;
}

bool is_call(std::string_view code, std::size_t at, std::string_view name) {
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '>';
  };
  if (at > 0 && is_word(code[at - 1])) return false;
  const std::size_t next = at + name.size();
  return next < code.size() && code[next] == '(';
}

// The library reports only by its results. The schema compiler is a program of the build.
Problems check_quiet(const Source& source) {
  Problems problems;
  if (!source.path.starts_with("libgltfx/") ||
      source.path.starts_with("libgltfx/schema/compiler/")) {
    return problems;
  }
  const std::string& code = lex(source.text).code;
  for (const std::string_view name : {"std::cout", "std::cerr", "std::clog", "throw "}) {
    find_all({source.path, code}, name, "uses " + std::string(name), problems);
  }
  for (const std::string_view name :
       {"printf", "fprintf", "puts", "putchar", "exit", "_exit", "abort", "terminate"}) {
    // A forked worker of the decoders is a separate process.
    if (name == "_exit" && source.path == "libgltfx/codec/server.cpp") continue;
    for (std::size_t at = code.find(name); at != std::string::npos; at = code.find(name, at + 1)) {
      if (is_call(code, at, name)) {
        problems.push_back(problem(source, line_of(code, at), "calls " + std::string(name)));
      }
    }
  }
  return problems;
}

// libstdc++ ends the process where such an iterator finds no memory for an entry.
Problems check_directories(const Source& source) {
  Problems problems;
  if (source.path.starts_with("libgltfx/") || source.path.starts_with("tools/")) {
    find_all({source.path, lex(source.text).code}, "directory_iterator",
             "uses directory_iterator; base/directory.hpp survives a lack of memory", problems);
  }
  return problems;
}

// The library for WebAssembly is built every night only, with the libc++ of LLVM 14.
Problems check_headers(const Source& source) {
  Problems problems;
  if (!source.path.starts_with("libgltfx/")) return problems;
  for (const std::string_view name :
       {"execution", "memory_resource", "source_location", "stop_token"}) {
    find_all(source, "#include <" + std::string(name) + ">",
             "includes <" + std::string(name) + ">, which WebAssembly's library lacks", problems);
  }
  return problems;
}

template <class Check>
Problems over_everything(const Check& check) {
  Problems problems;
  for (const Source& source : files_below(kEverything)) {
    const Problems found = check(source);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  return problems;
}

TEST(Text, EverySourceFileNamesItsLicence) {
  EXPECT_THAT(over_everything(check_licence), IsEmpty());
}
TEST(Text, NothingIsLeftToBeDone) { EXPECT_THAT(over_everything(check_leftovers), IsEmpty()); }
TEST(Text, LinksLeadToKnownPlaces) { EXPECT_THAT(over_everything(check_hosts), IsEmpty()); }
TEST(Text, TheLibraryNeverPrintsOrEndsTheProgram) {
  EXPECT_THAT(over_everything(check_quiet), IsEmpty());
}
TEST(Text, DirectoriesAreReadInOneWay) {
  EXPECT_THAT(over_everything(check_directories), IsEmpty());
}

TEST(Text, HeadersAreThereForWebAssembly) {
  EXPECT_THAT(over_everything(check_headers), IsEmpty());
}

TEST(Text, AHeaderThatWebAssemblyLacksIsFound) {
  EXPECT_THAT(check_headers({"libgltfx/json/a.cpp", "#include <memory_resource>\n"}),
              ElementsAre(HasSubstr("<memory_resource>")));
  EXPECT_THAT(check_headers({"libgltfx/json/a.cpp", "#include <memory>\n"}), IsEmpty());
}

TEST(Text, AMissingLicenceIsFound) {
  EXPECT_THAT(check_licence({"a.cpp", "#include <map>\n"}), ElementsAre(HasSubstr("SPDX")));
  EXPECT_THAT(check_licence({"a", "#!/bin/sh\n"}), ElementsAre(HasSubstr("SPDX")));
  EXPECT_THAT(check_licence({"a.json", "{}"}), IsEmpty());
}

TEST(Text, LeftoversAreFound) {
  EXPECT_THAT(check_leftovers({"a.cpp", std::string("\n// TO") + "DO: later\n"}),
              ElementsAre(HasSubstr("a.cpp:2: says TO")));
  EXPECT_THAT(check_leftovers({"a.cpp", std::string("open(\"/wo") + "rk/x\")"}),
              ElementsAre(HasSubstr("one machine")));
}

TEST(Text, ALinkToElsewhereIsFound) {
  EXPECT_THAT(check_hosts({"a.md", std::string("see https:/") + "/packages.internal/simple"}),
              ElementsAre(HasSubstr("points to packages.internal")));
}

TEST(Text, AnotherWayToReadADirectoryIsFound) {
  EXPECT_THAT(check_directories({"tools/a.cpp", "for (fs::directory_iterator at(p); ;) {}"}),
              ElementsAre(HasSubstr("directory.hpp")));
}

TEST(Text, OutputOfTheLibraryIsFound) {
  EXPECT_THAT(check_quiet({"libgltfx/base/a.cpp", "void f() { std::cout << 1; }"}),
              ElementsAre(HasSubstr("std::cout")));
  EXPECT_THAT(check_quiet({"libgltfx/base/a.cpp", "void f() { std::abort(); }"}),
              ElementsAre(HasSubstr("calls abort")));
  EXPECT_THAT(check_quiet({"libgltfx/base/a.cpp", "// abort()\nint exit_code(); snprintf(b);"}),
              IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
