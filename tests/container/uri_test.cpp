// SPDX-License-Identifier: Apache-2.0
#include "container/uri.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/percent.hpp"

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
        Relative{"a b", "a b", "a%20b"}, Relative{"a%20b", "a b", "a%20b"},
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
  for (const char* uri : {"///x", "//host/x", "\\\\host\\x", "../x?y", "a/../../x#y", "%2e%2e/x?",
                          "C:/x", "FILE:///x"}) {
    EXPECT_TRUE(classify_uri(uri).local) << uri;
  }
  for (const char* uri : {"x?y", "a/../x#y", "https://h/../x"}) {
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

// RFC 3986 sections 6.2.2 and 6.2.3.
TEST(Uri, SchemeHostAndPortAreNormalized) {
  for (const auto& [uri, normalized] : std::vector<std::pair<const char*, const char*>>{
           {"HTTP://EXAMPLE.com/a%2f.bin", "http://example.com/a%2F.bin"},
           {"http://example.com:80/", "http://example.com/"},
           {"https://example.com:443/a", "https://example.com/a"},
           {"http://example.com:8080/", "http://example.com:8080/"},
           {"//x:/z", "//x/z"},
           {"//x@Y:1/z", "//x@y:1/z"},
           {"http://[::1]/a", "http://[::1]/a"},
           {"http://[1:2:3:4:5:6:127.0.0.1]/a", "http://[1:2:3:4:5:6:127.0.0.1]/a"},
           {"http://%41/", "http://a/"},
           {"http://example.com/a/../b/./c", "http://example.com/b/c"},
           {"http://example.com/..", "http://example.com/"},
           {"file:a", "file:///a"},
           {"FILE://h/a", "file://h/a"},
           {"a\\b?c\\d", "a/b?c%5Cd"},
           {"a?b?c#d#e", "a?b?c#d%23e"},
           {"x/../a?b", "a?b"},
           {"a?%", "a?%25"},
           {"/\\x", "//x"}}) {
    const Uri found = classify_uri(uri);
    EXPECT_EQ(found.kind, UriKind::non_relative) << uri;
    EXPECT_EQ(found.normalized, normalized) << uri;
  }
}

TEST(Uri, SchemeHostAndPortCanBeInvalid) {
  for (const char* uri : {"http://example.com:ab/", "http://[::1", "http://[x]/", "//[::1/z",
                          "//a[b/z", "//a:b:c/z", "//[1::2::3]/", "//[1:2:3:4:5:6:7]/",
                          "//[1:2:3:4:5:6:7:8:9]/", "//[1:2:3:4:5:6:1.2.3.256]/", "//[::12345]/"}) {
    for (const UriReading reading : {UriReading::strict, UriReading::lenient}) {
      EXPECT_EQ(classify_uri(uri, reading).kind, UriKind::invalid) << uri;
    }
  }
}

TEST(Uri, QueriesAndFragmentsOfRelativePathsAreTold) {
  for (const char* uri : {"a#b.png", "a?b", "a#", "x/y.bin?z=1#f", "#"}) {
    EXPECT_TRUE(classify_uri(uri).suffixed) << uri;
  }
  for (const char* uri : {"a", "http://h/a?b", "/a#b", "C:/a?b", "a%23b"}) {
    EXPECT_FALSE(classify_uri(uri).suffixed) << uri;
  }
}

TEST(Uri, ThatIsEmptyIsInvalid) {
  EXPECT_EQ(classify_uri("").kind, UriKind::invalid);
  EXPECT_FALSE(classify_uri("").lenient_path);
  EXPECT_EQ(classify_uri("", UriReading::lenient).kind, UriKind::relative_path);
  EXPECT_EQ(classify_uri("", UriReading::lenient).normalized, "");
}

// As the Khronos validator reads them.
TEST(LenientUri, IsRepairedWhereItCanBe) {
  for (const auto& [uri, normalized] :
       std::vector<std::pair<std::string, std::string>>{{"100%.bin", "100%25.bin"},
                                                        {"a%2", "a%252"},
                                                        {"%zz", "%25zz"},
                                                        {"a%%41", "a%25A"},
                                                        {"sub\\a.bin", "sub/a.bin"},
                                                        {"a\n.bin", "a%0A.bin"},
                                                        {"a%01.bin", "a%01.bin"},
                                                        {"./c:.bin", "c%3A.bin"},
                                                        {"./a:b:c", "a%3Ab:c"},
                                                        {"./:a", "%3Aa"},
                                                        {"sub//a", "sub//a"},
                                                        {".", "./"},
                                                        {"./", "./"},
                                                        {"a/../", "./"}}) {
    const Uri found = classify_uri(uri, UriReading::lenient);
    EXPECT_EQ(found.kind, UriKind::relative_path) << uri;
    EXPECT_EQ(found.normalized, normalized) << uri;
    EXPECT_EQ(found.problem, "") << uri;
  }
  EXPECT_EQ(classify_uri(".//a", UriReading::lenient).kind, UriKind::non_relative);
  EXPECT_EQ(classify_uri(".//a", UriReading::lenient).normalized, "/a");
}

TEST(UnescapedCharacters, AreThoseThatNoPathHasAsTheyAre) {
  EXPECT_EQ(find_unescaped("a+b;c=d@e,f!g$h&i'j(k)*l~m%20n").characters, "");
  EXPECT_EQ(find_unescaped("grande_sph\xC3\xA8re.png").characters, "");
  EXPECT_EQ(find_unescaped("a b  \"c\"").characters, " \"");
  EXPECT_FALSE(find_unescaped("a b<>^`{|}").reserved);
  EXPECT_TRUE(find_unescaped("a[1] b").reserved);
  EXPECT_EQ(escape_characters("a b\xC3\xA8[1] c%20d", " []"), "a%20b\xC3\xA8%5B1%5D%20c%20d");
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
