// SPDX-License-Identifier: Apache-2.0
/// Words that stand for the values of options: what the command line reads, completion offers.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// A word of the command line and what it stands for.
template <class T>
struct Word {
  std::string_view name;
  T value;
};

inline constexpr std::array<Word<ColorMode>, 3> kColorWords{
    {{"auto", ColorMode::automatic}, {"always", ColorMode::always}, {"never", ColorMode::never}}};
inline constexpr std::array<Word<TableFormat>, 2> kTableFormatWords{
    {{"text", TableFormat::text}, {"json", TableFormat::json}}};
inline constexpr std::array<Word<MatrixFormat>, 3> kMatrixFormatWords{
    {{"text", MatrixFormat::text},
     {"json", MatrixFormat::json},
     {"markdown", MatrixFormat::markdown}}};
inline constexpr std::array<Word<schema::Status>, 7> kStatusWords{
    {{"ratified", schema::Status::ratified},
     {"release-candidate", schema::Status::release_candidate},
     {"draft", schema::Status::draft},
     {"legacy", schema::Status::legacy},
     {"archived", schema::Status::archived},
     {"registered-vendor", schema::Status::registered_vendor},
     {"vendor", schema::Status::vendor}}};
inline constexpr std::array<Word<Profile>, 3> kProfileWords{
    {{"default", Profile::standard}, {"khronos", Profile::khronos}, {"strict", Profile::strict}}};
inline constexpr std::array<Word<std::optional<PixelLevel>>, 3> kPixelWords{
    {{"headers", PixelLevel::headers}, {"needed", PixelLevel::needed}, {"all", PixelLevel::all}}};
inline constexpr std::array<Word<LfsPolicy>, 2> kLfsWords{
    {{"skip", LfsPolicy::skip}, {"error", LfsPolicy::error}}};
inline constexpr std::array<Word<std::optional<Severity>>, 4> kFailOnWords{
    {{"error", Severity::error},
     {"warning", Severity::warning},
     {"info", Severity::info},
     {"never", std::nullopt}}};
inline constexpr std::array<Word<std::optional<Severity>>, 4> kMinSeverityWords{
    {{"error", Severity::error},
     {"warning", Severity::warning},
     {"info", Severity::info},
     {"hint", Severity::hint}}};
inline constexpr std::array<Word<TextLayout>, 2> kGroupByWords{
    {{"finding", TextLayout::findings}, {"rule", TextLayout::by_rule}}};
inline constexpr std::array<Word<BakeLights>, 3> kLightWords{
    {{"asset", BakeLights::asset}, {"studio", BakeLights::studio}, {"both", BakeLights::both}}};
inline constexpr std::array<Word<BakeLayer>, 4> kLayerWords{{{"albedo", BakeLayer::albedo},
                                                             {"normal", BakeLayer::normal},
                                                             {"depth", BakeLayer::depth},
                                                             {"material", BakeLayer::material}}};
inline constexpr std::array<Word<BakeQuality>, 3> kQualityWords{
    {{"draft", BakeQuality::draft},
     {"standard", BakeQuality::standard},
     {"final", BakeQuality::final}}};
inline constexpr std::array<Word<BakeProjection>, 2> kProjectionWords{
    {{"perspective", BakeProjection::perspective}, {"orthographic", BakeProjection::orthographic}}};
inline constexpr std::array<Word<BakeInterior>, 3> kInteriorWords{
    {{"auto", BakeInterior::automatic}, {"on", BakeInterior::on}, {"off", BakeInterior::off}}};
inline constexpr std::array<Word<bool>, 2> kDenoiseWords{{{"on", true}, {"off", false}}};
/// Whether the shader is the literal one.
inline constexpr std::array<Word<bool>, 2> kShaderWords{{{"spec", true}, {"conserving", false}}};
inline constexpr std::array<std::string_view, 5> kPictureFormats{"png", "webp", "jpeg", "jpg",
                                                                 "exr"};

template <class T>
std::vector<std::string_view> word_names(std::span<const Word<T>> words) {
  std::vector<std::string_view> names;
  for (const Word<T>& word : words) names.push_back(word.name);
  return names;
}

/// "--lfs: 'skp' is none of skip, error. Did you mean 'skip'?"
Error unknown_word(std::string_view option, std::string_view text,
                   std::span<const std::string_view> names);

/// The value of the word; an Error as above.
template <class T>
Result<T> parse_word(std::string_view option, std::string_view text,
                     std::span<const Word<T>> words) {
  for (const Word<T>& word : words) {
    if (word.name == text) return word.value;
  }
  return unknown_word(option, text, word_names(words));
}

}  // namespace gltfx::tool
