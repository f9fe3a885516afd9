// SPDX-License-Identifier: Apache-2.0
// Roughness is 1 minus glossiness times its factor: a sum, which a factor of metallic-roughness
// cannot express. So the factor is multiplied into a new image, and the factor of roughness
// stays 1.
#include <utility>

#include <fmt/format.h>

#include "steps/upgrade/conversion.hpp"
#include "steps/upgrade/texture_source.hpp"

namespace gltfx::upgrade {
namespace {

constexpr const char* kTexture = "specularGlossinessTexture";
constexpr const char* kRoughness = "pbrMetallicRoughness/roughnessFactor";
constexpr const char* kRoughnessTexture = "pbrMetallicRoughness/metallicRoughnessTexture";

// 1 - 0.9 is 0.1, also if the last bits of the double differ.
std::string complement_json(double share) {
  std::string text = fmt::format("{:.15f}", 1 - share);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

class SpecularGlossiness : public Conversion {
 public:
  Problem prepare(const ConversionContext& context) override {
    if (context.run.options.ior != 0) note_ior(context);
    if (context.is_own_pointed_at("glossinessFactor")) {
      return "its glossinessFactor is animated, but roughness depends on it";
    }
    const auto glossiness = factor_of(context);
    if (!glossiness) return "its glossinessFactor is invalid; see 'gltfx validate'";
    factor_ = *glossiness;
    double constant = factor_;
    if (factor_ > 0 && context.member(kTexture) != json::kNoNode) {
      if (Problem problem = check_texture(context, constant)) return problem;
    }
    if (Problem problem = put(context, kRoughness, job_ ? "1" : complement_json(constant))) {
      return problem;
    }
    return put(context, kRoughnessTexture, {});
  }

  void apply(const ConversionContext& context) override {
    context.drop("glossinessFactor");
    if (!job_) return;
    const std::uint64_t texture = context.run.add_texture(*job_, sampler_);
    context.placements.put(kRoughnessTexture, texture_info(context, texture));
  }

 private:
  // The factor, 1 if it is missing; nothing if it is not between 0 and 1.
  static std::optional<double> factor_of(const ConversionContext& context) {
    const json::Document& document = context.run.document;
    const json::NodeId factor = context.member("glossinessFactor");
    if (factor == json::kNoNode) return 1;
    if (!document.is_number(factor)) return std::nullopt;
    const double value = document.number(factor).value;
    return value >= 0 && value <= 1 ? std::optional(value) : std::nullopt;
  }

  // Glossiness is in A. If it is the same everywhere, `constant` is this value times the factor;
  // otherwise the texture of roughness has 1 minus it in G, and 0 for metallic.
  Problem check_texture(const ConversionContext& context, double& constant) {
    const json::Document& document = context.run.document;
    const json::NodeId index = document.find(context.member(kTexture), "index");
    const std::uint64_t texture = document.unsigned_integer(index).value_or(0);
    TextureSource source;
    source.problem = "the pixels of its image are not available";
    if (context.run.pictures != nullptr) {
      source = texture_source(context.run.asset, texture, *context.run.pictures);
    }
    if (!source.problem.empty()) {
      context.action.outcome = UpgradeOutcome::needs_image;
      context.action.notes.push_back(
          fmt::format("texture {} has glossiness in A, but {}", texture, source.problem));
      return std::nullopt;
    }
    if (!source.note.empty()) {
      context.action.notes.push_back(
          fmt::format("texture {} is read from its fallback ({})", texture, source.note));
    }
    const Picture& picture = context.run.pictures->picture(source.image);
    const codec::ChannelStatistics alpha = picture.statistics(3);
    if (alpha.constant()) {
      constant *= static_cast<double>(alpha.least) / static_cast<double>(picture.image.full());
      return std::nullopt;
    }
    if (context.is_own_pointed_at(kTexture)) {
      return fmt::format("the transform of its {} is animated, but two textures replace it",
                         kTexture);
    }
    context.action.notes.push_back(fmt::format(
        "texture {} has glossiness in A; a new image is created for roughness", texture));
    sampler_ = source.sampler;
    job_ = ImageJob{{ChannelSource::constant(1), ChannelSource::of(source.image, 3, -factor_, 1),
                     ChannelSource::constant(0), ChannelSource::constant(1)}};
    return std::nullopt;
  }

  // The old texture info with another index.
  static std::string texture_info(const ConversionContext& context, std::uint64_t texture) {
    const json::Document& document = context.run.document;
    const json::NodeId info = context.member(kTexture);
    const Span whole = document.span(info);
    const Span index = document.span(document.find(info, "index"));
    std::string text(document.raw(info));
    return text.replace(index.begin - whole.begin, index.end - index.begin,
                        std::to_string(texture));
  }

  static void note_ior(const ConversionContext& context) {
    context.placements.put("extensions/KHR_materials_ior/ior",
                           fmt::format("{}", context.run.options.ior));
    context.action.lossy = true;
    context.action.notes.push_back(
        fmt::format("with an ior of {0} it reflects slightly less light than before; 0 is exact",
                    context.run.options.ior));
  }

  static Problem put(const ConversionContext& context, std::string_view path, std::string json) {
    if (context.is_pointed_at(path)) {
      return fmt::format("an animation targets {}, which has no effect before the upgrade", path);
    }
    return context.placements.put(path, std::move(json));
  }

  double factor_ = 1;
  std::optional<ImageJob> job_;
  std::optional<std::uint64_t> sampler_;
};

}  // namespace

std::unique_ptr<Conversion> make_specular_glossiness() {
  return std::make_unique<SpecularGlossiness>();
}

}  // namespace gltfx::upgrade
