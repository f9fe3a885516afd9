// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/uri.hpp"

namespace gltfx::container {
namespace {

using testing::HasSubstr;

std::string error_of(std::string_view uri) {
  const auto data = split_data_uri(uri);
  return data ? "no error" : data.error().message;
}

std::string payload_of(std::string_view uri) {
  const auto data = split_data_uri(uri);
  if (!data) return data.error().message;
  const auto bytes = decode_payload(*data);
  return bytes ? *bytes : bytes.error().message;
}

TEST(DataUri, IsSplitIntoTypeEncodingAndPayload) {
  const std::string_view uri = "data:application/octet-stream;base64,QUJD";
  const auto data = split_data_uri(uri);
  ASSERT_TRUE(data);
  EXPECT_EQ(data->media_type, "application/octet-stream");
  EXPECT_TRUE(data->base64);
  EXPECT_EQ(data->payload, "QUJD");
  EXPECT_EQ(data->payload.data(), uri.data() + uri.find(',') + 1);
}

TEST(DataUri, SchemeAndTypeDoNotMindCase) {
  const auto data = split_data_uri("DaTa:Image/PNG,x");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->media_type, "image/png");
  EXPECT_FALSE(data->base64);
}

TEST(DataUri, WithoutATypeItIsPlainText) {
  EXPECT_EQ(split_data_uri("data:,x")->media_type, "text/plain");
  EXPECT_EQ(split_data_uri("data:;base64,AAAA")->media_type, "text/plain");
  EXPECT_TRUE(split_data_uri("data:;base64,AAAA")->base64);
  EXPECT_EQ(split_data_uri("data:;charset=utf-8,x")->media_type, "text/plain");
}

TEST(DataUri, ParametersAreNoPartOfTheType) {
  const auto data = split_data_uri("data:image/png;a=b;c=d;base64,AAAA");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->media_type, "image/png");
  EXPECT_TRUE(data->base64);
}

TEST(DataUri, OnlyTheFirstCommaSeparates) { EXPECT_EQ(payload_of("data:text/plain,a,b"), "a,b"); }

TEST(DataUri, EachMistakeIsNamed) {
  EXPECT_THAT(error_of("http://a"), HasSubstr("does not start with 'data:'"));
  EXPECT_THAT(error_of("data"), HasSubstr("does not start with 'data:'"));
  EXPECT_THAT(error_of("data:image/png;base64"), HasSubstr("no comma"));
  EXPECT_THAT(error_of("data:base64,AAAA"), HasSubstr("'base64' is not a media type"));
  EXPECT_THAT(error_of("data:image/png;x,AAAA"),
              HasSubstr("parameter 'x' of the data URI has no value"));
  EXPECT_THAT(error_of("data:image/png;,AAAA"),
              HasSubstr("parameter '' of the data URI has no value"));
  EXPECT_THAT(error_of("data:image/png;BASE64,AAAA"), HasSubstr("lower case"));
  EXPECT_THAT(error_of("data:image/png;base64;a=b,AAAA"), HasSubstr("directly before the comma"));
}

TEST(DataUri, PayloadsAreDecodedAsTheySay) {
  EXPECT_EQ(payload_of("data:a/b;base64,QUJD"), "ABC");
  EXPECT_EQ(payload_of("data:a/b,QUJD"), "QUJD");
  EXPECT_EQ(payload_of("data:a/b,%00%fF+%41"), std::string("\0\xff+A", 4));
  EXPECT_EQ(payload_of("data:a/b;base64,"), "");
}

TEST(DataUri, BadPayloadsNameTheFirstBadByte) {
  EXPECT_THAT(payload_of("data:a/b;base64,AA A"), HasSubstr("Character 3"));
  EXPECT_THAT(payload_of("data:a/b,ab%4"), HasSubstr("Byte 3 of the data is a '%'"));
  EXPECT_THAT(payload_of("data:a/b,%41%zz%"), HasSubstr("Byte 4 of the data is a '%'"));
}

}  // namespace
}  // namespace gltfx::container
