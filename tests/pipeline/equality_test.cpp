// SPDX-License-Identifier: Apache-2.0
// What an upgraded material scatters is what the legacy one did, by the formulas of both
// extensions: random materials, directions and texture coordinates.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "container/temp_folder.hpp"
#include "pipeline/legacy_scenes.hpp"

namespace gltfx::test {
namespace {

using container::test::TempFolder;

constexpr const char* kOld = "KHR_materials_translucency";
constexpr const char* kNew = "KHR_materials_diffuse_transmission";
using Vec3 = std::array<double, 3>;
using Uv = std::array<double, 2>;

// --- Textures: glTF 2.0 section 3.8.4, KHR_texture_transform ---

double wrapped(double x, int mode) {
  if (mode == 33071) return std::clamp(x, 0.0, 1.0);
  const double period = mode == 33648 ? 2 : 1;
  const double at = x - std::floor(x / period) * period;
  return at > 1 ? 2 - at : at;
}

double decoded_srgb(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// A document with its pictures at hand.
class Shown {
 public:
  explicit Shown(Json json) : json_(std::move(json)) {
    for (const Json& image : json_.value("images", Json::array())) {
      const std::string uri = image["uri"];
      const auto bytes = container::decode_base64(uri.substr(uri.find(',') + 1));
      pictures_.push_back(read_picture(*bytes));
    }
  }
  const Json& json() const { return json_; }
  const Picture& picture_of(std::size_t texture) const {
    const Json& described = json_["textures"][texture];
    const bool plain = described.contains("source");
    return pictures_.at(
        plain ? described["source"].get<std::size_t>()
              : described["extensions"]["EXT_texture_webp"]["source"].get<std::size_t>());
  }

  /// The value of a slot of `object`, white when it has none; between four texels.
  Texel sample(const Json& object, const char* slot, const std::array<Uv, 2>& uvs,
               bool srgb) const {
    if (!object.contains(slot)) return {1, 1, 1, 1};
    const Json& info = object[slot];
    const Json transform =
        info.value("/extensions/KHR_texture_transform"_json_pointer, Json::object());
    const Uv uv = moved(uvs[transform.value("texCoord", info.value("texCoord", 0U))], transform);
    const std::size_t texture = info["index"];
    const Json& described = json_["textures"][texture];
    const Json sampler = described.contains("sampler")
                             ? json_["samplers"][described["sampler"].get<std::size_t>()]
                             : Json::object();
    return between(picture_of(texture), wrapped(uv[0], sampler.value("wrapS", 10497)),
                   wrapped(uv[1], sampler.value("wrapT", 10497)), srgb);
  }

 private:
  static Uv moved(const Uv& uv, const Json& transform) {
    const Uv offset = transform.value("offset", Uv{0, 0});
    const Uv scale = transform.value("scale", Uv{1, 1});
    const double angle = transform.value("rotation", 0.0);
    const double u = uv[0] * scale[0], v = uv[1] * scale[1];
    return {std::cos(angle) * u + std::sin(angle) * v + offset[0],
            -std::sin(angle) * u + std::cos(angle) * v + offset[1]};
  }

  static Texel between(const Picture& picture, double u, double v, bool srgb) {
    const double x = u * (picture.width - 1), y = v * (picture.height - 1);
    const auto left = static_cast<std::uint32_t>(x), top = static_cast<std::uint32_t>(y);
    Texel sum{};
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t column = std::min(left + i % 2, picture.width - 1);
      const std::uint32_t row = std::min(top + i / 2, picture.height - 1);
      const double weight =
          (i % 2 == 0 ? 1 - (x - left) : x - left) * (i / 2 == 0 ? 1 - (y - top) : y - top);
      const Texel& texel = picture.texels[row * picture.width + column];
      for (std::size_t c = 0; c < 4; ++c) {
        sum[c] += weight * (srgb && c < 3 ? decoded_srgb(texel[c]) : texel[c]);
      }
    }
    return sum;
  }

  const Json json_;
  std::vector<Picture> pictures_;
};

// --- Materials: glTF 2.0 appendix B, and the two extensions ---

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Light and viewer around the normal (0, 0, 1), and where on the textures.
struct Situation {
  Vec3 light, view;
  std::array<Uv, 2> uvs;
};

double specular_brdf(double roughness, const Vec3& half, const Vec3& light, const Vec3& view) {
  const double alpha = roughness * roughness;
  const double n = half[2] * half[2] * (alpha * alpha - 1) + 1;
  const double distribution = alpha * alpha / (std::numbers::pi * n * n);
  const auto visible = [&](double cosine) {
    return cosine + std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
  };
  return distribution / (visible(light[2]) * visible(view[2]));
}

Vec3 product(const Json& factor, const Texel& texel) {
  Vec3 color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = factor[c].get<double>() * texel[c];
  return color;
}

/// The part of a material that both extensions share. `through` is the colour of light that passes.
Vec3 bsdf(const Json& material, const Situation& at, double transmission, const Vec3& base,
          const Vec3& through) {
  const Json& pbr = material["pbrMetallicRoughness"];
  const double metallic = pbr.value("metallicFactor", 1.0);
  const bool passes = at.light[2] < 0;
  const Vec3 light{at.light[0], at.light[1], std::abs(at.light[2])};
  const Vec3 half = unit({light[0] + at.view[0], light[1] + at.view[1], light[2] + at.view[2]});
  const double bent = std::pow(1 - std::abs(dot(at.view, half)), 5);
  const double specular =
      passes ? 0 : specular_brdf(pbr.value("roughnessFactor", 1.0), half, light, at.view);
  Vec3 sum{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double diffuse = passes ? transmission * through[c] : (1 - transmission) * base[c];
    const double fresnel = 0.04 + 0.96 * bent;
    const double dielectric = (1 - fresnel) * diffuse / std::numbers::pi + fresnel * specular;
    const double metal = specular * (base[c] + (1 - base[c]) * bent);
    sum[c] = (1 - metallic) * dielectric + metallic * metal;
  }
  return sum;
}

Vec3 base_color(const Shown& shown, const Json& material, const Situation& at) {
  const Json& pbr = material["pbrMetallicRoughness"];
  return product(pbr.value("baseColorFactor", Json{1, 1, 1, 1}),
                 shown.sample(pbr, "baseColorTexture", at.uvs, true));
}

Vec3 legacy_bsdf(const Shown& shown, std::size_t index, const Situation& at, bool first) {
  const Json& material = shown.json()["materials"][index];
  const Json& legacy = material["extensions"][kOld];
  const Vec3 base = base_color(shown, material, at);
  const double strength = legacy.value("translucencyFactor", 0.0) *
                          shown.sample(legacy, "translucencyTexture", at.uvs, false)[first ? 0 : 3];
  const Vec3 own = product(legacy.value("translucencyColorFactor", Json{1, 1, 1}),
                           shown.sample(legacy, "translucencyColorTexture", at.uvs, true));
  return bsdf(material, at, strength, base, first ? base : own);
}

Vec3 upgraded_bsdf(const Shown& shown, std::size_t index, const Situation& at) {
  const Json& material = shown.json()["materials"][index];
  const Json extension =
      material.value(Json::json_pointer(fmt::format("/extensions/{}", kNew)), Json::object());
  const double strength = extension.value("diffuseTransmissionFactor", 0.0) *
                          shown.sample(extension, "diffuseTransmissionTexture", at.uvs, false)[3];
  const Vec3 color =
      product(extension.value("diffuseTransmissionColorFactor", Json{1, 1, 1}),
              shown.sample(extension, "diffuseTransmissionColorTexture", at.uvs, true));
  return bsdf(material, at, strength, base_color(shown, material, at), color);
}

Situation situation(Random& random) {
  const auto direction = [&] {
    return unit({random.between(-1, 1), random.between(-1, 1), random.between(0.05, 1)});
  };
  const auto uv = [&]() -> Uv { return {random.between(-2, 2), random.between(-2, 2)}; };
  Situation at{direction(), direction(), {uv(), uv()}};
  if (!random.one_in(3)) at.light[2] = -at.light[2];
  return at;
}

// The new image of a factor map has in A what the old one had in R, in every texel.
void expect_alpha_is_red(const Shown& before, const Shown& after, std::size_t material) {
  const Json::json_pointer slot(
      fmt::format("/materials/{}/extensions/{}/translucencyTexture/index", material, kOld));
  const Json::json_pointer fresh(
      fmt::format("/materials/{}/extensions/{}/diffuseTransmissionTexture/index", material, kNew));
  if (!after.json().contains(fresh) || !before.json().contains(slot)) return;
  const Picture& old = before.picture_of(before.json()[slot]);
  const Picture& now = after.picture_of(after.json()[fresh]);
  ASSERT_EQ(old.texels.size(), now.texels.size());
  for (std::size_t i = 0; i < old.texels.size(); ++i) {
    ASSERT_EQ(old.texels[i][0], now.texels[i][3]) << material << ", texel " << i;
  }
}

struct GenerationCase {
  const char* generation;
  bool pack;
};

class Equality : public testing::TestWithParam<GenerationCase> {};

TEST_P(Equality, UpgradedMaterialsScatterAsTheLegacyOnesDid) {
  constexpr int kDocuments = 5, kMaterials = 20, kSituations = 120;
  // 300 materials over all generations
  const bool first = std::string_view(GetParam().generation) == "v1";
  Random random(GetParam().pack ? 7 : 3);
  for (int i = 0; i < kDocuments; ++i) {
    LegacyScene scene(random, all_pictures(random), first);
    for (int k = 0; k < kMaterials; ++k) scene.add_material();
    const TempFolder folder;
    const std::string path = folder.write("a.gltf", scene.json().dump(1)).native();
    UpgradeOptions options;
    options.generation = GetParam().generation;
    options.pack = GetParam().pack;
    options.in_place = true;
    const UpgradeReport report = upgrade_file(path, options);
    ASSERT_TRUE(report.written) << report.error;
    for (const UpgradeAction& action : report.actions) {
      EXPECT_EQ(action.outcome, UpgradeOutcome::safe) << action.pointer;
    }
    std::ifstream in(path, std::ios::binary);
    const Shown before(scene.json());
    const Shown after(Json::parse(in));
    for (std::size_t material = 0; material < kMaterials; ++material) {
      if (first) expect_alpha_is_red(before, after, material);
      for (int k = 0; k < kSituations; ++k) {
        const Situation at = situation(random);
        const Vec3 was = legacy_bsdf(before, material, at, first);
        const Vec3 is = upgraded_bsdf(after, material, at);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_NEAR(was[c], is[c], 1e-6) << before.json()["materials"][material] << '\n'
                                           << after.json()["materials"][material];
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Generations, Equality,
                         testing::Values(GenerationCase{"v1", false}, GenerationCase{"v1", true},
                                         GenerationCase{"v2", false}),
                         [](const auto& chosen) {
                           return std::string(chosen.param.generation) +
                                  (chosen.param.pack ? "_packed" : "");
                         });

// The pictures that the test makes are what the decoder reads, so that both sides stand on the same
// ground.
TEST(EqualityPictures, HoldWhatTheySay) {
  Random random(1);
  for (const Picture& picture : all_pictures(random)) {
    const Picture read = read_picture(picture.bytes);
    ASSERT_EQ(read.texels.size(), picture.texels.size());
    for (std::size_t i = 0; i < read.texels.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_DOUBLE_EQ(read.texels[i][c], picture.texels[i][c]) << picture.mime;
      }
    }
  }
}

}  // namespace
}  // namespace gltfx::test
