// SPDX-License-Identifier: Apache-2.0
// A furnished room whose walls are single-sided, as in scans of flats and hotels: the camera looks
// in through the walls that turn their backs to it, and light comes in there.
#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

// An axis-aligned box from one corner to the other; fronts outside, or inside for a room.
bake::Mesh box(const bake::Float3& from, const bake::Float3& to, bool inside = false) {
  bake::Mesh mesh = bake::cube();
  for (bake::Float3& p : mesh.positions) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = p[i] < 0 ? from[i] : to[i];
  }
  if (!inside) return mesh;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (bake::Float3& normal : mesh.normals) {
    for (float& component : normal) component = -component;
  }
  return mesh;
}

// A bed, a wardrobe, a table with a ball on it, a carpet.
void furnish(AssetText& asset) {
  asset.draw(box({-1.4F, 0, -1.9F}, {0.2F, 0.5F, 0.2F}), dielectric({0.8, 0.8, 0.75, 1}, 0.8));
  asset.draw(box({-1.4F, 0.5F, -1.9F}, {0.2F, 0.65F, -1.3F}), dielectric({0.6, 0.2, 0.2, 1}, 0.8));
  asset.draw(box({1.3F, 0, -1.9F}, {2.3F, 2, -1.3F}), dielectric({0.4, 0.25, 0.15, 1}, 0.4));
  asset.draw(box({0.9F, 0.7F, 0.3F}, {2.1F, 0.75F, 1.2F}), dielectric({0.5, 0.35, 0.2, 1}, 0.3));
  for (const float x : {0.95F, 2.0F}) {
    for (const float z : {0.35F, 1.1F}) {
      asset.draw(box({x, 0, z}, {x + 0.06F, 0.7F, z + 0.06F}), dielectric({0.3, 0.2, 0.1, 1}, 0.5));
    }
  }
  asset.draw(bake::sphere(0.2F, 16), dielectric({0.2, 0.4, 0.8, 1}, 0.2),
             {{"translation", {1.5, 0.95, 0.7}}});
  asset.draw(box({-1.8F, 0, 0.4F}, {0.5F, 0.02F, 1.8F}), dielectric({0.3, 0.35, 0.5, 1}, 1));
}

AssetText room(bool double_sided, bool furnished = true) {
  AssetText asset;
  Json wall = dielectric({0.85, 0.8, 0.7, 1}, 0.9);
  wall["doubleSided"] = double_sided;
  asset.draw(box({-2.5F, 0, -2}, {2.5F, 2.6F, 2}, true), wall);
  if (furnished) furnish(asset);
  return asset;
}

class Room : public Baking {
 protected:
  Room() {
    options.camera.clear();
    options.sizes = {{24, 24}};
    options.samples = 32;
  }

  // The mean of what is seen of the scene, as numbers of a picture for the screen.
  double brightness(AssetText asset) {
    options.transparent = true;
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    double sum = 0;
    double covered = 0;
    for (std::size_t i = 0; i + 3 < done.pixels.bytes.size(); i += 4) {
      if (done.pixels.bytes[i + 3] < 255) continue;
      for (std::size_t c = 0; c < 3; ++c) sum += done.pixels.bytes[i + c] / 3.0;
      ++covered;
    }
    EXPECT_GT(covered, 100);
    return sum / covered;
  }
};

TEST_F(Room, IsLitThroughTheWallsThatTheCameraLooksThrough) {
  EXPECT_GT(brightness(room(false)), 100);
  EXPECT_GT(brightness(room(false, false)), 110);
  for (const char* angles : {"0,0", "120,30", "250,5", "45,80"}) {
    options.camera = angles;
    EXPECT_GT(brightness(room(false)), 90) << angles;
  }
}

TEST_F(Room, IsLitAroundACameraInside) {
  AssetText asset = room(false);
  asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.01}}}},
               {{"translation", {-1, 1.5, 1.8}}});
  options.camera = "0";
  EXPECT_GT(brightness(std::move(asset)), 100);
}

// What stands in the light throws a shadow onto the floor, be it single-sided.
TEST_F(Room, FurnitureThrowsShadows) {
  surround(1);
  options.samples = 64;
  const auto under_the_table = [&](bool with_table) {
    AssetText asset = room(false, false);
    if (with_table) {
      asset.draw(box({-1, 0.5F, -1}, {1, 0.55F, 1}), dielectric({0.5, 0.5, 0.5, 1}, 1));
    }
    asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 0.1}, {"znear", 0.01}}}},
                 {{"translation", {0, 0.3, 1.9}}, {"rotation", {-0.0784591, 0, 0, 0.9969173}}});
    options.camera = "0";
    return bake(asset).mean(1);
  };
  EXPECT_LT(under_the_table(true), 0.7 * under_the_table(false));
}

}  // namespace
}  // namespace gltfx::test
