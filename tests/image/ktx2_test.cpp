// SPDX-License-Identifier: Apache-2.0
// Contents and errors of KTX2 files. The offsets are those of KTX 2.0, section 3.
#include "image/ktx2.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "image/ktx2_reading.hpp"

namespace gltfx::image {
namespace {

using test::codes;
using test::Ktx2Builder;
using test::le;
using test::patched;
using test::problems;
using test::read_ktx2_text;

using Codes = std::vector<std::string>;
constexpr std::size_t kTypeSize = 16, kWidth = 20, kHeight = 24, kDepth = 28, kFaces = 36,
                      kLevels = 40, kScheme = 44, kDescriptor = 48, kMetadata = 56, kGlobal = 64,
                      kLevel0 = 80;
// With one level the descriptor begins here, and the metadata where it has one sample.
constexpr std::size_t kBlock = 104, kEntries = 148;

TEST(Ktx2, WhatIsRightIsRead) {
  Ktx2Builder builder;
  builder.width = 8;
  builder.levels = 4;
  builder.metadata = {{"KTXorientation", "rd"}, {"KTXswizzle", "rgba"}, {"KTXwriter", "test"}};
  const Ktx2 file = read_ktx2_text(builder.file());
  EXPECT_TRUE(file.errors.empty()) << file.errors[0].problem;
  EXPECT_TRUE(file.described);
  EXPECT_EQ(file.model, Ktx2Model::uastc);
  EXPECT_EQ(file.contents, Channels::rgb);
  EXPECT_EQ(file.width, 8U);
  EXPECT_EQ(file.levels.size(), 4U);
  EXPECT_EQ(file.full_pyramid(), 4U);
  EXPECT_EQ(file.orientation, "rd");
  EXPECT_EQ(file.swizzle, "rgba");
  EXPECT_TRUE(file.is_2d());
  EXPECT_FALSE(file.premultiplied);
}

TEST(Ktx2, HeadersAreThoseOfOtherImages) {
  const Header color = header_of(read_ktx2_text(Ktx2Builder().file()));
  EXPECT_EQ(color.format, Format::ktx2);
  EXPECT_EQ(color.transfer, Tag::srgb);
  EXPECT_EQ(color.primaries, Tag::srgb);
  const Header data = header_of(read_ktx2_text(Ktx2Builder().linear().file()));
  EXPECT_EQ(data.transfer, Tag::linear);
  EXPECT_EQ(data.primaries, Tag::none);
}

TEST(Ktx2, ChannelsOfBothBasisFormats) {
  const auto etc1s = [](std::vector<std::uint8_t> ids) {
    return read_ktx2_text(Ktx2Builder::etc1s(std::move(ids)).file()).contents;
  };
  EXPECT_EQ(etc1s({0}), Channels::rgb);
  EXPECT_EQ(etc1s({0, 15}), Channels::rgba);
  EXPECT_EQ(etc1s({3}), Channels::red);
  EXPECT_EQ(etc1s({3, 4}), Channels::red_green);
  EXPECT_EQ(etc1s({4}), std::nullopt);
  const auto uastc = [](std::uint8_t id) {
    Ktx2Builder builder;
    builder.channels = {id};
    return read_ktx2_text(builder.file()).contents;
  };
  EXPECT_EQ(uastc(0), Channels::rgb);
  EXPECT_EQ(uastc(3), Channels::rgba);
  EXPECT_EQ(uastc(4), Channels::red);
  EXPECT_EQ(uastc(6), Channels::red_green);
  EXPECT_EQ(uastc(5), std::nullopt);
}

TEST(Ktx2, AllSchemesThatBasisMayHaveAreSound) {
  EXPECT_EQ(codes(Ktx2Builder::etc1s().file()), Codes{});
  EXPECT_EQ(codes(Ktx2Builder::etc1s({0, 15}).file()), Codes{});
  Ktx2Builder zstd;
  zstd.scheme = 2;
  zstd.levels = 3;
  EXPECT_EQ(codes(zstd.file()), Codes{});
}

TEST(Ktx2, EveryCutIsFound) {
  for (const std::string& whole : {Ktx2Builder().file(), Ktx2Builder::etc1s({0, 15}).file()}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_FALSE(codes(whole.substr(0, size)).empty()) << size;
    }
  }
  EXPECT_EQ(codes(Ktx2Builder().file().substr(0, 79)), Codes{"IMAGE_UNEXPECTED_EOS"});
}

TEST(Ktx2, NumbersOfTheHeaderMustGoTogether) {
  const std::string whole = Ktx2Builder().file();
  const auto with = [&](std::size_t offset, std::uint64_t value) {
    const auto found = codes(patched(whole, offset, le(value, 4)));
    return found.empty() ? std::string() : found.front();
  };
  const std::string bad = "KTX2_HEADER_INVALID";
  EXPECT_EQ(with(kTypeSize, 4), bad);
  EXPECT_EQ(with(kWidth, 0), bad);
  EXPECT_EQ(with(kFaces, 0), bad);
  EXPECT_EQ(with(kFaces, 2), bad);
  EXPECT_EQ(with(kLevels, 0), bad) << "blocks cannot be scaled";
  EXPECT_EQ(with(kLevels, 4), bad) << "4 texels have 3 levels";
  EXPECT_EQ(with(kScheme, 4), bad);
  EXPECT_EQ(codes(patched(whole, kHeight, le(0, 4) + le(4, 4))).front(), bad) << "depth alone";
  EXPECT_EQ(codes(patched(patched(whole, kDepth, le(1, 4)), kFaces, le(6, 4))).front(), bad);
}

TEST(Ktx2, PartsLieInsideTheFileInTheirOrder) {
  Ktx2Builder builder;
  builder.metadata = {{"KTXswizzle", "rgba"}};
  const std::string whole = builder.file();
  const auto with = [&](std::size_t offset, const std::string& bytes) {
    const std::vector<std::string> found = codes(patched(whole, offset, bytes));
    return std::set<std::string>(found.begin(), found.end());
  };
  const std::set<std::string> bad{"KTX2_INDEX_INVALID"};
  EXPECT_EQ(with(kDescriptor, le(100000, 4)), bad);
  EXPECT_EQ(with(kDescriptor, le(kBlock + 2, 4)), bad) << "not aligned";
  EXPECT_EQ(with(kMetadata, le(100000, 4)), bad);
  EXPECT_EQ(with(kMetadata + 4, le(0, 4)), bad) << "an offset without bytes";
  EXPECT_EQ(with(kMetadata, le(kBlock, 4)).count("KTX2_INDEX_INVALID"), 1U) << "overlap";
  EXPECT_EQ(with(kGlobal, le(1, 8) + le(UINT64_MAX, 8)), bad);
}

TEST(Ktx2, DescriptorsMustBeBasicBlocks) {
  const std::string whole = Ktx2Builder().file();
  const auto with = [&](std::size_t offset, const std::string& bytes) {
    return codes(patched(whole, offset, bytes));
  };
  const Codes bad{"KTX2_DESCRIPTOR_INVALID"};
  EXPECT_EQ(with(kBlock, le(40, 4)), bad) << "total size";
  EXPECT_EQ(with(kBlock + 4, le(1, 4)), bad) << "vendor";
  EXPECT_EQ(with(kBlock + 8, le(1, 2)), bad) << "version";
  EXPECT_EQ(with(kBlock + 10, le(41, 2)), bad) << "half a sample";
  EXPECT_EQ(with(kBlock + 10, le(56, 2)), bad) << "longer than it is";
  EXPECT_EQ(with(kDescriptor, le(0, 8)), bad) << "none";
  Ktx2Builder empty;
  empty.channels.clear();
  EXPECT_EQ(codes(empty.file()), bad);
  Ktx2Builder wide;
  wide.block = std::string("\7\7\0\0", 4);
  EXPECT_EQ(codes(wide.file()).front(), bad.front());
}

TEST(Ktx2, MetadataIsAListOfSortedKeys) {
  Ktx2Builder builder;
  builder.metadata = {{"KTXswizzle", "rgba"}};
  const std::string whole = builder.file();
  const Codes bad{"KTX2_METADATA_INVALID"};
  EXPECT_EQ(codes(patched(whole, kEntries, le(99, 4))), bad);
  EXPECT_EQ(codes(patched(whole, kEntries, le(0, 4))), bad) << "no key";
  EXPECT_EQ(codes(patched(whole, kEntries + 4, std::string(1, '\0'))), bad) << "an empty key";
  builder.metadata = {{"b", "1"}, {"a", "1"}};
  EXPECT_EQ(codes(builder.file()), bad);
  builder.metadata = {{"a", "1"}, {"a", "1"}};
  EXPECT_EQ(codes(builder.file()), bad);
}

TEST(Ktx2, LevelsLieWhereTheyMust) {
  Ktx2Builder builder;
  builder.width = 8;
  builder.levels = 2;
  const std::string whole = builder.file();
  const auto with = [&](std::size_t offset, std::uint64_t value) {
    return codes(patched(whole, offset, le(value, 8)));
  };
  const Codes bad{"KTX2_LEVEL_INVALID"};
  const Ktx2 file = read_ktx2_text(whole);
  ASSERT_EQ(file.levels.size(), 2U);
  EXPECT_EQ(with(kLevel0, 100000), bad);
  EXPECT_EQ(with(kLevel0, UINT64_MAX), bad);
  EXPECT_EQ(with(kLevel0, 16).front(), bad.front()) << "inside the header";
  EXPECT_EQ(with(kLevel0 + 8, 0), bad) << "no bytes";
  EXPECT_EQ(with(kLevel0 + 8, 16), bad) << "two lengths";
  EXPECT_EQ(with(kLevel0 + 16, 16), bad);
  EXPECT_EQ(codes(patched(whole, kLevel0 + 8, le(16, 8) + le(16, 8))), bad) << "too few blocks";
  EXPECT_EQ(with(kLevel0 + 24, file.levels[0].offset).front(), bad.front()) << "order";
  EXPECT_EQ(with(kLevel0, file.levels[0].offset - 8).front(), bad.front()) << "alignment";
  Ktx2Builder zstd;
  zstd.scheme = 2;
  const std::string packed = zstd.file();
  EXPECT_EQ(codes(patched(packed, packed.size() - 16, "none")), bad);
  const std::string basis = Ktx2Builder::etc1s().file();
  EXPECT_EQ(codes(patched(basis, kLevel0 + 16, le(4, 8))), bad);
}

TEST(Ktx2, GlobalDataDescribesEverySlice) {
  const std::string whole = Ktx2Builder::etc1s({0, 15}).file();
  constexpr std::size_t kTables = 168;  // after a descriptor of two samples, aligned to 8
  const Codes bad{"KTX2_GLOBAL_DATA_INVALID"};
  const auto with = [&](std::size_t offset, std::uint64_t value) {
    return codes(patched(whole, kTables + offset, le(value, 4)));
  };
  EXPECT_EQ(with(4, 1000), bad) << "endpoints";
  EXPECT_EQ(with(4, 0xFFFFFFFF), bad);
  EXPECT_EQ(with(24, 1000), bad) << "a slice after its level";
  EXPECT_EQ(with(28, 0), bad) << "an empty slice";
  EXPECT_EQ(with(36, 0), bad) << "no slice for the second sample";
  EXPECT_EQ(codes(patched(whole, kGlobal, le(0, 16))), bad) << "none";
  EXPECT_EQ(codes(patched(whole, 32, le(0xFFFFFFFF, 4))), bad) << "layers without end";
  EXPECT_EQ(codes(patched(Ktx2Builder::etc1s({0}).file(), kBlock + 4 + 24 + 3, le(0, 1))), Codes{});
}

// --- What readers pass over ---

const std::vector<std::string> kNone;

TEST(Ktx2, TexelBlocksHaveTheirBytes) {
  constexpr std::size_t kPlanes = kBlock + 4 + 16, kSample = kBlock + 4 + 24;
  const auto found = [](const std::string& bytes) {
    return problems(bytes, "KTX2_DESCRIPTOR_INVALID");
  };
  const std::string uastc = Ktx2Builder().file();
  EXPECT_EQ(
      found(patched(uastc, kPlanes, le(8, 1))),
      std::vector<std::string>{"!bytesPlane0 is 8; it must be 16, the size of a texel block."});
  EXPECT_EQ(found(patched(uastc, kPlanes, le(0, 1))).size(), 1U);
  EXPECT_EQ(found(patched(Ktx2Builder::etc1s().file(), kPlanes, le(0, 1))), kNone)
      << "as former editions wanted it";
  EXPECT_EQ(found(patched(uastc, kSample + 2, le(63, 1))),
            std::vector<std::string>{"!The samples are not 128 contiguous bits each."});
  EXPECT_EQ(found(patched(uastc, kSample, le(8, 2))).size(), 1U);
}

TEST(Ktx2, PartsFollowEachOther) {
  const auto gap = [](const Ktx2Builder& builder, std::size_t at) {
    std::string bytes = builder.file();
    bytes.insert(at, std::string(16, '\0'));
    for (std::size_t field : {kDescriptor, kMetadata, kGlobal, kLevel0}) {
      const auto old = static_cast<unsigned char>(bytes[field]);
      if (old >= at) bytes[field] = static_cast<char>(old + 16);
    }
    return problems(bytes, "KTX2_INDEX_INVALID");
  };
  Ktx2Builder builder = Ktx2Builder::etc1s();
  builder.metadata = {{"KTXwriter", "t"}};
  EXPECT_EQ(problems(builder.file(), "KTX2_INDEX_INVALID"), kNone);
  EXPECT_EQ(gap(builder, kBlock),
            std::vector<std::string>{
                "!The data format descriptor is not directly after the level index."});
  EXPECT_EQ(
      gap(builder, kEntries),
      std::vector<std::string>{"!The metadata is not directly after the data format descriptor."});
  EXPECT_EQ(gap(builder, kEntries + 16),
            std::vector<std::string>{
                "!The supercompression global data is not directly after the metadata."});
}

TEST(Ktx2, MetadataHaveTheirValues) {
  const auto found = [](const std::string& key, const std::string& value, Ktx2Builder builder) {
    builder.metadata = {{key, value}};
    return problems(builder.file(), "KTX2_METADATA_INVALID");
  };
  const std::string number(3, 'n');
  EXPECT_EQ(found("KTXglFormat", number, Ktx2Builder()), kNone);
  EXPECT_EQ(found("KTXglFormat", number, Ktx2Builder::astc()),
            std::vector<std::string>{"!KTXglFormat is only allowed if vkFormat is 0."});
  EXPECT_EQ(found("KTXastcDecodeMode", "unorm8", Ktx2Builder::astc()), kNone);
  EXPECT_EQ(found("KTXastcDecodeMode", "unorm16", Ktx2Builder::astc()).size(), 1U);
  Ktx2Builder builder;
  builder.metadata = {{"a", "12"}};
  EXPECT_EQ(
      problems(patched(builder.file(), kMetadata + 4, le(9, 4)), "KTX2_METADATA_INVALID"),
      std::vector<std::string>{"!The metadata does not end with the padding of its last entry."});
  builder.metadata.clear();
  for (int i = 0; i < 1000; ++i) builder.metadata.push_back({"same", ""});
  EXPECT_EQ(codes(builder.file()), Codes{"KTX2_METADATA_INVALID"}) << "said once";
}

TEST(Ktx2, LevelsOfEveryFormatHaveTheirBytes) {
  Ktx2Builder rgb = Ktx2Builder::texels(23, 1, {0, 1, 2}, {8, 8, 8});
  rgb.width = 5;
  rgb.levels = 3;
  const std::string whole = rgb.file();
  EXPECT_EQ(codes(whole), Codes{});
  const Codes bad{"KTX2_LEVEL_INVALID"};
  const std::uint64_t offset = read_ktx2_text(whole).levels[0].offset;
  EXPECT_EQ(codes(patched(whole, kLevel0, le(offset - 4, 8))).front(), bad.front()) << "12 bytes";
  EXPECT_EQ(codes(patched(whole, kLevel0 + 8, le(57, 8) + le(57, 8))), bad);
  Ktx2Builder zlib;
  zlib.scheme = 3;
  const std::string packed = zlib.file();
  EXPECT_EQ(codes(packed), Codes{});
  EXPECT_EQ(codes(patched(packed, packed.size() - 16, "zz")), bad);
  Ktx2Builder line = Ktx2Builder::texels(9, 1, {0}, {8});
  EXPECT_EQ(codes(patched(line.file(), kHeight, le(0, 4))).front(), "KTX2_LEVEL_INVALID");
  EXPECT_EQ(codes(patched(Ktx2Builder().file(), kHeight, le(0, 4))).front(), "KTX2_HEADER_INVALID")
      << "blocks have a height";
}

TEST(Ktx2, GlobalDataHaveNoEmptyTables) {
  constexpr std::size_t kTables = 152;  // after a descriptor of one sample, aligned to 8
  const std::string whole = Ktx2Builder::etc1s().file();
  const Codes bad{"KTX2_GLOBAL_DATA_INVALID"};
  EXPECT_EQ(codes(patched(whole, kTables, le(0, 2))), bad) << "endpoints";
  EXPECT_EQ(codes(patched(whole, kTables + 2, le(0, 2))), bad) << "selectors";
  EXPECT_EQ(codes(patched(whole, kTables + 4, le(0, 4) + le(2, 4))), bad) << "their bytes";
  EXPECT_EQ(codes(patched(whole, kTables + 12, le(0, 4) + le(1, 4))).front(), bad.front())
      << "tables, and data that ETC1S does not know";
  for (const std::uint64_t flags : {1U, 2U, 4U}) {
    EXPECT_EQ(problems(patched(whole, kTables + 20, le(flags, 4)), bad.front()).size(), 1U);
  }
}

TEST(Ktx2, OnlyOneFlatImageIsOfTwoDimensions) {
  const std::string whole = Ktx2Builder().file();
  EXPECT_FALSE(read_ktx2_text(patched(whole, kHeight, le(0, 4))).is_2d());
  EXPECT_FALSE(read_ktx2_text(patched(whole, kDepth, le(4, 4))).is_2d());
  EXPECT_FALSE(read_ktx2_text(patched(whole, 32, le(1, 4))).is_2d());
  EXPECT_FALSE(read_ktx2_text(patched(whole, kFaces, le(6, 4))).is_2d());
}

}  // namespace
}  // namespace gltfx::image
