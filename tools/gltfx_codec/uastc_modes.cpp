// SPDX-License-Identifier: Apache-2.0
#include "uastc_modes.hpp"

namespace gltfx::codec {
namespace {

// "UASTC Mode Index encoding": value and length, by mode; the last one is reserved.
constexpr std::array<UastcPrefix, kUastcModes + 1> kPrefixes{
    {{0x01, 4}, {0x35, 6}, {0x1D, 5}, {0x03, 5}, {0x13, 5}, {0x0B, 5}, {0x1B, 5},
     {0x07, 5}, {0x17, 5}, {0x0F, 5}, {0x02, 3}, {0x00, 2}, {0x06, 3}, {0x1F, 5},
     {0x0D, 5}, {0x05, 7}, {0x15, 6}, {0x25, 6}, {0x09, 4}, {0x45, 7}}};

constexpr std::array<UastcModeCode, 128> code_table() {
  std::array<UastcModeCode, 128> table{};
  for (std::size_t mode = 0; mode < kPrefixes.size(); ++mode) {
    const UastcPrefix code = kPrefixes[mode];
    for (std::size_t i = code.value; i < table.size(); i += std::size_t{1} << code.bits) {
      table[i] = {static_cast<std::uint8_t>(mode), code.bits};
    }
  }
  return table;
}
constexpr std::array<UastcModeCode, 128> kModeOfBits = code_table();

// Hints: all for BC1 and ETC1; also those for ETC2.
constexpr std::uint8_t kHints = 15, kAlphaHints = 23, kFewHints = kFewHintBits;

// "Configuration", "Endpoint bits" and "Weights".
constexpr std::array<UastcMode, kUastcModes> kModes{{
    {kHints, 1, 3, 1, 4, 6, Digits::trits, 0, 0},
    {kHints, 1, 3, 1, 2, 8, Digits::none, 0, 0},
    {kHints, 2, 3, 1, 3, 4, Digits::none, 5, 0},
    {kHints, 3, 3, 1, 2, 2, Digits::trits, 4, 0},
    {kHints, 2, 3, 1, 2, 3, Digits::quints, 5, 0},
    {kHints, 1, 3, 1, 3, 8, Digits::none, 0, 0},
    {kHints, 1, 3, 2, 2, 5, Digits::quints, 0, 2},
    {kHints, 2, 3, 1, 2, 3, Digits::quints, 5, 0},
    {},  // one colour
    {kAlphaHints, 2, 4, 1, 2, 4, Digits::none, 5, 0},
    {kFewHints, 1, 4, 1, 4, 4, Digits::trits, 0, 0},
    {kFewHints, 1, 4, 2, 2, 4, Digits::trits, 0, 2},
    {kFewHints, 1, 4, 1, 3, 6, Digits::trits, 0, 0},
    {kAlphaHints, 1, 4, 2, 1, 8, Digits::none, 0, 2},
    {kAlphaHints, 1, 4, 1, 2, 8, Digits::none, 0, 0},
    {kAlphaHints, 1, 2, 1, 4, 8, Digits::none, 0, 0},
    {kAlphaHints, 2, 2, 1, 2, 8, Digits::none, 5, 0},
    {kAlphaHints, 1, 2, 2, 2, 8, Digits::none, 0, 0},
    {kHints, 1, 3, 1, 5, 5, Digits::none, 0, 0},
}};

// "Partition table for 2-subset Mode Indices 2, 4, 9, and 16".
constexpr std::array<UastcPattern, 30> kTwoSubsets{
    0x50505050, 0x40404040, 0x01010101, 0x54505040, 0x05151555, 0x55545450, 0x00010515, 0x01051555,
    0x50400000, 0x00000105, 0x55544000, 0x01155555, 0x00000115, 0x00005555, 0x55555500, 0x00555555,
    0x55551501, 0x40545555, 0x00405054, 0x00004050, 0x15050100, 0x50545555, 0x15050501, 0x00404050,
    0x50545455, 0x14141414, 0x55000055, 0x11111111, 0x00550055, 0x05145041};

// "Partition table for 2-subset Mode Index 7".
constexpr std::array<UastcPattern, 19> kTwoSubsetsOfMode7{
    0x00005500, 0x10101010, 0x00010505, 0x50504000, 0x55005555, 0x04040404, 0x55555040,
    0x50505054, 0x05500005, 0x00005454, 0x15150000, 0x05000005, 0x00005054, 0x55554000,
    0x14555555, 0x01050505, 0x01015555, 0x01051450, 0x00005455};

// "Partition table for 3-subset Mode Index 3".
constexpr std::array<UastcPattern, 11> kThreeSubsets{0xA5A50000, 0xAA005555, 0xAA000055, 0x0000AA55,
                                                     0x25252525, 0x94949494, 0x58585858, 0x56560202,
                                                     0x92929292, 0x55AA0055, 0xA05050A0};

}  // namespace

UastcModeCode uastc_mode_code(std::uint32_t bits) { return kModeOfBits[bits % kModeOfBits.size()]; }

UastcPrefix uastc_prefix(std::size_t mode) { return kPrefixes[mode]; }

const UastcMode& uastc_mode(std::size_t index) { return kModes[index]; }

std::span<const UastcPattern> uastc_patterns(std::size_t mode) {
  if (mode == 3) return kThreeSubsets;
  if (mode == 7) return kTwoSubsetsOfMode7;
  return kTwoSubsets;
}

std::uint8_t unquantized_weight(std::uint32_t value, unsigned bits) {
  std::uint32_t wide = 0;
  unsigned have = 0;
  for (; have < 6; have += bits) wide = wide << bits | value;
  wide >>= have - 6;
  return static_cast<std::uint8_t>(wide > 32 ? wide + 1 : wide);
}

}  // namespace gltfx::codec
