// SPDX-License-Identifier: Apache-2.0
#include "container/uri.hpp"

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::container {
namespace {

using testing::HasSubstr;

struct Relative {
  std::string_view uri;
  std::string_view path;
  std::string_view normalized;
};

class RelativeUri : public testing::TestWithParam<Relative> {};

TEST_P(RelativeUri, HasItsPathAndItsPrintedForm) {
  const Uri uri = classify_uri(GetParam().uri);
  EXPECT_EQ(uri.kind, UriKind::relative_path);
  EXPECT_EQ(uri.path, GetParam().path);
  EXPECT_EQ(uri.normalized, GetParam().normalized);
  EXPECT_EQ(uri.problem, "");
  EXPECT_FALSE(uri.lenient_path);
}

INSTANTIATE_TEST_SUITE_P(
    Table, RelativeUri,
    testing::Values(
        Relative{"a.bin", "a.bin", "a.bin"}, Relative{"x/a.bin", "x/a.bin", "x/a.bin"},
        Relative{"", "", ""}, Relative{"a b", "a b", "a%20b"}, Relative{"a%20b", "a b", "a%20b"},
        Relative{"\xC3\xA4", "\xC3\xA4", "%C3%A4"}, Relative{"%c3%a4", "\xC3\xA4", "%C3%A4"},
        Relative{"%41%7e%2D", "A~-", "A~-"}, Relative{"a%25b", "a%b", "a%25b"},
        Relative{"a%2541", "a%41", "a%2541"}, Relative{"a%3fb%23", "a?b#", "a%3Fb%23"},
        Relative{"<[{|^`\"}]>", "<[{|^`\"}]>", "%3C%5B%7B%7C%5E%60%22%7D%5D%3E"},
        Relative{"a!$&'()*+,;=@b", "a!$&'()*+,;=@b", "a!$&'()*+,;=@b"},
        Relative{"../a", "../a", "../a"}, Relative{"../../a", "../../a", "../../a"},
        Relative{"./a", "a", "a"}, Relative{"x/./a", "x/a", "x/a"}, Relative{"x/../a", "a", "a"},
        Relative{"x/../../a", "../a", "../a"}, Relative{"x/y/../../../a", "../a", "../a"},
        Relative{"../x/../a", "../a", "../a"}, Relative{"..", "../", "../"},
        Relative{".", "./", "./"}, Relative{"./", "./", "./"}, Relative{".//", "./", "./"},
        Relative{"x/..", "./", "./"}, Relative{"x/", "x/", "x/"}, Relative{"x//a", "x//a", "x//a"},
        Relative{".//a", "a", "a"}, Relative{"%2e%2e/a", "../a", "../a"},
        Relative{"%2E%2E%2Fa", "../a", "..%2Fa"}, Relative{"..%2fa", "../a", "..%2Fa"},
        Relative{"x/..%2f..%2fa", "../a", "x/..%2F..%2Fa"}, Relative{"%2fetc", "/etc", "%2Fetc"},
        Relative{"%2f..%2f..%2fa", "../a", "%2F..%2F..%2Fa"}, Relative{"%2f..", "/", "%2F.."},
        Relative{"%2fx%2f..%2f..%2fa", "/a", "%2Fx%2F..%2F..%2Fa"},
        Relative{"x%2fy/../a", "a", "a"}, Relative{"...", "...", "..."},
        Relative{"x/a:b", "x/a:b", "x/a:b"}, Relative{"./a:b:c", "a:b:c", "a%3Ab%3Ac"},
        Relative{"a%3ab", "a:b", "a%3Ab"}, Relative{"a%5cb", "a\\b", "a%5Cb"},
        Relative{"./:a", ":a", "%3Aa"}, Relative{"a_b", "a_b", "a_b"},
        Relative{"data", "data", "data"}));

TEST(Uri, DataIsKnownByItsSchemeAlone) {
  EXPECT_EQ(classify_uri("data:").kind, UriKind::data);
  EXPECT_EQ(classify_uri("DATA:a/b,%zz").kind, UriKind::data);
  EXPECT_EQ(classify_uri("dat:").kind, UriKind::non_relative);
}

TEST(Uri, WhatLeadsElsewhereIsNonRelative) {
  for (const char* uri :
       {"http://h/a", "file:///a", "C:\\a\\b", "c:/a", "a:b", "a+b-1.c:x", "//h/a", "/a", "/",
        "\\a", "\\\\h\\a", "a?q", "a?", "?", "a#f", "#", "x/a:b?c", "/a%zz"}) {
    EXPECT_EQ(classify_uri(uri).kind, UriKind::non_relative) << uri;
    EXPECT_EQ(classify_uri(uri).path, "") << uri;
  }
}

// Readers decode, merge slashes and follow dots in different orders: none may be led out unseen.
TEST(Uri, WaysOutOfTheFolderAreSeenInAnySpelling) {
  for (const char* uri : {"../x", "%2e%2e/x", "%2E./x", "..%2fx", "..%2Fx", "a/../../x", "./../x",
                          "a//../../x", "a/%2e%2e//../x", "..%5cx", "a%5c..%5c..%5cx", ".//..//x",
                          "a/..%2f..%2fx", "..\\x", "a%2f..%2f../x", "../"}) {
    const Uri found = classify_uri(uri);
    EXPECT_EQ(found.path.substr(0, 3), "../") << uri << " " << found.path;
  }
  for (const char* uri : {"/x", "%2fx", "%2Fetc/passwd", "%5cetc%5cpasswd", "./%5cx"}) {
    const Uri found = classify_uri(uri);
    EXPECT_TRUE(found.local || found.path.substr(0, 1) == "/") << uri << " " << found.path;
  }
  for (const char* uri :
       {"///x", "\\\\host\\x", "../x?y", "a/../../x#y", "%2e%2e/x?", "C:/x", "FILE:///x"}) {
    EXPECT_TRUE(classify_uri(uri).local) << uri;
  }
  for (const char* uri : {"x?y", "a/../x#y", "https://h/../x", "//h/x"}) {
    EXPECT_FALSE(classify_uri(uri).local) << uri;
  }
  for (const char* uri : {"a/../x", "a//x", "...", ".../x", "..x", "a..", "a%5cx"}) {
    EXPECT_NE(classify_uri(uri).path.substr(0, 3), "../") << uri;
  }
}

TEST(Uri, NonRelativeOnesArePrintedNormalizedToo) {
  EXPECT_EQ(classify_uri("HTTP://h/a b?c#d").normalized, "http://h/a%20b?c#d");
  EXPECT_EQ(classify_uri("C:\\x").normalized, "c:/x");
}

TEST(Uri, AColonInTheFirstSegmentNeedsAScheme) {
  for (const char* uri : {":a", "1:2", "-a:b", " data:,x", "a b:c", "\xC3\xA4:b"}) {
    const Uri parsed = classify_uri(uri);
    EXPECT_EQ(parsed.kind, UriKind::invalid) << uri;
    EXPECT_THAT(parsed.problem, HasSubstr("':'")) << uri;
    EXPECT_FALSE(parsed.lenient_path) << uri;
  }
}

TEST(Uri, BadEscapesAreInvalidAndNamedByTheirByte) {
  for (const char* uri : {"a%", "a%4", "a%zz", "a%4g", "a%g4", "a%%41"}) {
    const Uri parsed = classify_uri(uri);
    EXPECT_EQ(parsed.kind, UriKind::invalid) << uri;
    EXPECT_THAT(parsed.problem, HasSubstr("a '%' at byte 1 ")) << uri;
  }
  EXPECT_EQ(classify_uri("a%zz").path, "a%zz");
  EXPECT_EQ(classify_uri("a%zz").normalized, "a%25zz");
  EXPECT_TRUE(classify_uri("a%zz").lenient_path);
}

TEST(Uri, BackslashesAreInvalidButCanBeGuessed) {
  const Uri uri = classify_uri("..\\x\\a b");
  EXPECT_EQ(uri.kind, UriKind::invalid);
  EXPECT_THAT(uri.problem, HasSubstr("backslash at byte 2"));
  EXPECT_TRUE(uri.lenient_path);
  EXPECT_EQ(uri.path, "../x/a b");
  EXPECT_EQ(uri.normalized, "../x/a%20b");
}

TEST(Uri, ControlCharactersAreInvalidHoweverTheyAreWritten) {
  for (const char* uri : {"a\tb", "a\nb", "a\x1f", "a\x7f", "a%0ab", "a%1F", "a%7f", "a%00"}) {
    EXPECT_EQ(classify_uri(uri).kind, UriKind::invalid) << uri;
    EXPECT_THAT(classify_uri(uri).problem, HasSubstr("at byte 1")) << uri;
  }
  EXPECT_EQ(classify_uri("a\x20").kind, UriKind::relative_path);
}

TEST(Uri, NoPathEverHoldsANul) {
  for (const std::string_view uri : {std::string_view("a\0b", 3), std::string_view("a%00b")}) {
    EXPECT_EQ(classify_uri(uri).kind, UriKind::invalid);
    EXPECT_EQ(classify_uri(uri).path, "");
    EXPECT_FALSE(classify_uri(uri).lenient_path);
  }
}

TEST(Uri, ProblemsArePrintable) {
  EXPECT_THAT(classify_uri("a\x1b[31m").problem, testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(classify_uri("\x1b[31m:a").problem, testing::Not(HasSubstr("\x1b")));
}

TEST(PercentDecode, LeavesStrayPercentSignsAlone) {
  EXPECT_EQ(percent_decode("%41%4%%42%"), "A%4%B%");
}

}  // namespace
}  // namespace gltfx::container
