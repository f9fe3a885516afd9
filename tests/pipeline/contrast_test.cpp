// SPDX-License-Identifier: Apache-2.0
// What has no color of its own is made out by its light: sides of a cube, squares on the backdrop.
#include "pipeline/baking.hpp"
#include "render/tonemap.hpp"
#include "sanitized.hpp"

namespace gltfx::test {
namespace {

class Contrast : public Baking {
 protected:
  Contrast() {
    options.cameras.clear();
    options.sizes = {{64, 64}};
    options.samples = kSanitized ? 8 : 32;
    options.denoise = true;
  }

  // CIE L* around a point of the picture, x and y from 0 to 1.
  static double lightness(const BakedPixels& pixels, double x, double y) {
    double sum = 0;
    const auto column = static_cast<std::size_t>(x * pixels.width);
    const auto row = static_cast<std::size_t>(y * pixels.height);
    for (std::size_t v = row - 1; v <= row + 1; ++v) {
      for (std::size_t u = column - 1; u <= column + 1; ++u) {
        const std::uint8_t* p = &pixels.bytes[(v * pixels.width + u) * 3];
        sum += 0.2126 * static_cast<double>(render::srgb_decode_byte(p[0])) +
               0.7152 * static_cast<double>(render::srgb_decode_byte(p[1])) +
               0.0722 * static_cast<double>(render::srgb_decode_byte(p[2]));
      }
    }
    const double luminance = sum / 9;
    return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
  }

  void expect_apart(AssetText& asset, const std::vector<std::pair<double, double>>& points,
                    double least) {
    const BakeReport done = report(asset);
    ASSERT_EQ(done.problem, BakeProblem::none) << done.error;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double a = lightness(done.pixels, points[i].first, points[i].second);
        const double b = lightness(done.pixels, points[k].first, points[k].second);
        EXPECT_GT(std::fabs(a - b), least) << a << " and " << b << ", " << options.cameras.front();
      }
    }
  }
};

TEST_F(Contrast, SidesOfACubeOfTheDefaultMaterialDiffer) {
  AssetText asset;
  asset.node({{"mesh", asset.mesh(render::cube(), -1)}});
  expect_apart(asset, {{0.35, 0.55}, {0.8, 0.5}, {0.55, 0.13}}, 10);
  for (const char* camera : {"iso", "-135,35"}) {
    options.cameras = {camera};
    expect_apart(asset, {{0.3, 0.6}, {0.7, 0.6}, {0.5, 0.25}}, 10);
  }
}

TEST_F(Contrast, SidesOfAWhiteCubeDiffer) {
  AssetText asset;
  asset.draw(render::cube(), dielectric({1, 1, 1, 1}, 1));
  expect_apart(asset, {{0.35, 0.55}, {0.8, 0.5}, {0.55, 0.13}}, 6);
}

// Also where another camera comes first, for which the backdrop is bright.
TEST_F(Contrast, EachCameraHasTheBackdropThatItNeeds) {
  AssetText asset;
  render::Mesh square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  Json material = dielectric({1, 1, 1, 1}, 1);
  material["doubleSided"] = true;
  asset.draw(square, material);
  options.samples = 4;
  options.sizes = {{32, 32}};
  std::map<std::string, std::string> alone;
  const std::vector<std::string> cameras{"front", "60,0", "30,60"};
  for (const std::string& camera : cameras) {
    options.cameras = {camera};
    options.output = (folder.path() / "alone.png").native();
    EXPECT_EQ(report(asset).problem, BakeProblem::none);
    alone[camera] = file_content(options.output);
  }
  for (const std::string& first : cameras) {
    for (const std::string& second : cameras) {
      if (first == second) continue;
      options.cameras = {first, second};
      const BakeReport done = report(asset);
      ASSERT_EQ(done.written.size(), 2U) << done.error;
      EXPECT_TRUE(file_content(done.written[0]) == alone[first]) << first << ", " << second;
      EXPECT_TRUE(file_content(done.written[1]) == alone[second]) << first << ", " << second;
    }
  }
}

TEST_F(Contrast, FlatSquaresStandOutFromTheBackdrop) {
  for (const double grey : {1.0, 0.75, 0.6, 0.5, 0.2, 0.0}) {
    for (const bool level : {false, true}) {
      AssetText asset;
      render::Mesh square;
      square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
      square.triangles = {{0, 1, 2}, {0, 2, 3}};
      const Json turned = {{"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}};
      asset.draw(square, dielectric({grey, grey, grey, 1}, 1), level ? turned : Json::object());
      SCOPED_TRACE(grey);
      expect_apart(asset, {{0.5, 0.5}, {0.5, 0.03}}, 12);
    }
  }
}

// Both pictures have the backdrop of the first asset: only the squares differ.
TEST_F(Contrast, ComparedPicturesHaveOneBackdrop) {
  const auto square = [](double grey) {
    AssetText asset;
    render::Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    asset.draw(mesh, dielectric({grey, grey, grey, 1}, 1));
    return asset.text();
  };
  const auto compared = bake_comparison(folder.write("white.gltf", square(1)).native(),
                                        folder.write("black.gltf", square(0)).native(), options);
  EXPECT_NEAR(lightness(compared.first.pixels, 0.5, 0.03),
              lightness(compared.second.pixels, 0.5, 0.03), 1);
}

}  // namespace
}  // namespace gltfx::test
