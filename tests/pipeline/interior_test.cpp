// SPDX-License-Identifier: Apache-2.0
// Which assets are shown from inside, and that they can be made out there.
#include <numbers>
#include <set>

#include <gmock/gmock.h>

#include "pipeline/rooms.hpp"

namespace gltfx::test {
namespace {

using testing::HasSubstr;

// A profile (radius, height) from below to above, turned around the y axis; fronts outside.
render::Mesh turned(const std::vector<Float2>& profile) {
  constexpr std::uint32_t kSides = 24;
  render::Mesh mesh;
  for (const auto& [radius, height] : profile) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSides;
      mesh.positions.push_back({radius * std::sin(turn), height, radius * std::cos(turn)});
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = ring * kSides + i;
      const std::uint32_t b = ring * kSides + (i + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  return mesh;
}

render::Mesh inside_out(render::Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

Json paint(double red, bool double_sided = false) {
  Json material = dielectric({red, 0.4, 0.3, 1}, 0.6);
  material["doubleSided"] = double_sided;
  return material;
}

// Walls of 20 cm, floor and ceiling.
AssetText room_of_thick_walls() {
  AssetText asset;
  const int wall = asset.material(dielectric({0.85, 0.8, 0.7, 1}, 0.9));
  for (const render::Mesh& each :
       {box({-2.7F, -0.2F, -2.2F}, {2.7F, 0, 2.2F}), box({-2.7F, 2.6F, -2.2F}, {2.7F, 2.8F, 2.2F}),
        box({-2.7F, 0, -2.2F}, {-2.5F, 2.6F, 2.2F}), box({2.5F, 0, -2.2F}, {2.7F, 2.6F, 2.2F}),
        box({-2.5F, 0, -2.2F}, {2.5F, 2.6F, -2}), box({-2.5F, 0, 2}, {2.5F, 2.6F, 2.2F})}) {
    asset.node({{"mesh", asset.mesh(each, wall)}});
  }
  furnish(asset);
  return asset;
}

// With windows, open or of glass, in two walls; their frames are of another material.
AssetText room_with_windows(bool glazed, bool furnished = true) {
  AssetText asset;
  const int wall = asset.material(dielectric({0.9, 0.88, 0.85, 1}, 0.9));
  const int frame = asset.material(dielectric({1, 1, 1, 1}, 0.4));
  const int pane = asset.material(
      dielectric({1, 1, 1, 1}, 0, {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}));
  const auto add = [&asset](const Float3& from, const Float3& to, int material) {
    asset.node({{"mesh", asset.mesh(box(from, to), material)}});
  };
  add({-2.7F, -0.2F, -2.2F}, {2.7F, 0, 2.2F}, wall);
  add({-2.7F, 2.6F, -2.2F}, {2.7F, 2.8F, 2.2F}, wall);
  add({2.5F, 0, -2.2F}, {2.7F, 2.6F, 2.2F}, wall);
  add({-2.7F, 0, -2.2F}, {-2.5F, 2.6F, 2.2F}, wall);
  for (const float z : {-2.2F, 2.0F}) {
    add({-2.5F, 0, z}, {-0.7F, 2.6F, z + 0.2F}, wall);
    add({0.7F, 0, z}, {2.5F, 2.6F, z + 0.2F}, wall);
    add({-0.7F, 0, z}, {0.7F, 0.9F, z + 0.2F}, wall);
    add({-0.7F, 2.2F, z}, {0.7F, 2.6F, z + 0.2F}, wall);
    for (const float x : {-0.7F, -0.03F, 0.64F}) {
      add({x, 0.9F, z - 0.02F}, {x + 0.06F, 2.2F, z + 0.22F}, frame);
    }
    if (glazed) add({-0.7F, 0.9F, z + 0.09F}, {0.7F, 2.2F, z + 0.1F}, pane);
  }
  if (furnished) furnish(asset);
  return asset;
}

// A bottle of glass with a label and a cap, and something in it; its height is 0.3.
AssetText bottle() {
  AssetText asset;
  const std::vector<Float2> shape{{0, 0},          {0.04F, 0},      {0.04F, 0.18F},
                                  {0.015F, 0.22F}, {0.015F, 0.28F}, {0, 0.28F}};
  std::vector<Float2> inner = shape;
  for (Float2& each : inner) each[0] *= 0.9F;
  const Json glass =
      dielectric({1, 1, 1, 1}, 0.05, {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}});
  asset.draw(turned(shape), glass);
  asset.draw(inside_out(turned(inner)), glass);
  asset.draw(turned({{0, 0.01F}, {0.03F, 0.01F}, {0.03F, 0.15F}, {0, 0.15F}}), paint(0.9));
  asset.draw(turned({{0.041F, 0.05F}, {0.041F, 0.12F}}), paint(0.7, true));
  asset.draw(turned({{0, 0.27F}, {0.018F, 0.27F}, {0.018F, 0.3F}, {0, 0.3F}}), paint(0.2));
  return asset;
}

// A body with a lining, seats, wheels and a windscreen; 4.2 long.
AssetText car() {
  AssetText asset;
  const render::Mesh lower = box({-0.85F, 0.3F, -2.1F}, {0.85F, 0.9F, 2.1F});
  const render::Mesh cabin = box({-0.75F, 0.9F, -1.5F}, {0.75F, 1.45F, 0.7F});
  asset.draw(lower, paint(0.8, true));
  asset.draw(cabin, paint(0.8, true));
  asset.draw(box({-0.7F, 0.4F, -1.45F}, {0.7F, 1.4F, 0.65F}, true), paint(0.2, true));
  asset.draw(
      box({-0.7F, 0.92F, 0.7F}, {0.7F, 1.4F, 0.72F}),
      dielectric({1, 1, 1, 1}, 0, {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}));
  for (const float x : {-0.6F, 0.1F}) {
    for (const float z : {-1.2F, -0.2F}) {
      asset.draw(box({x, 0.45F, z}, {x + 0.5F, 0.9F, z + 0.5F}), paint(0.3));
    }
  }
  for (const float x : {-0.9F, 0.7F}) {
    for (const float z : {-1.5F, 1.2F}) {
      asset.draw(box({x, 0, z}, {x + 0.2F, 0.6F, z + 0.6F}), paint(0.05));
    }
  }
  return asset;
}

// In another unit of length, as in files whose numbers are centimetres.
AssetText in_unit(AssetText asset, double scale) {
  Json& nodes = asset.json()["scenes"][0]["nodes"];
  const int root = asset.add("nodes", {{"children", nodes}, {"scale", {scale, scale, scale}}});
  asset.json()["scenes"][0]["nodes"] = {root};
  return asset;
}

// The same under a roof, whose ridge is as long as the house.
AssetText house() {
  AssetText asset = room_of_thick_walls();
  render::Mesh roof;
  roof.positions = {{-2.7F, 2.8F, -2.2F}, {2.7F, 2.8F, -2.2F}, {2.7F, 2.8F, 2.2F},
                    {-2.7F, 2.8F, 2.2F},  {-2.7F, 4.5F, 0},    {2.7F, 4.5F, 0}};
  roof.triangles = {{0, 4, 5}, {0, 5, 1}, {3, 2, 5}, {3, 5, 4}, {0, 3, 4}, {1, 5, 2}};
  asset.draw(roof, paint(0.5));
  return asset;
}

class Interior : public Baking {
 protected:
  Interior() {
    options.cameras.clear();
    options.sizes = {{24, 24}};
    options.samples = 8;
  }

  std::vector<std::uint8_t> picture(AssetText& asset, BakeInterior interior) {
    options.interior = interior;
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    return done.pixels.bytes;
  }
  // Whether `automatic` shows the inside.
  bool goes_inside(AssetText asset) {
    const auto chosen = picture(asset, BakeInterior::automatic);
    const auto inside = picture(asset, BakeInterior::on);
    const auto outside = picture(asset, BakeInterior::off);
    EXPECT_NE(inside, outside);
    EXPECT_TRUE(chosen == inside || chosen == outside);
    return chosen == inside;
  }
};

TEST_F(Interior, ClosedRoomsAreShownFromInside) {
  EXPECT_TRUE(goes_inside(room(true)));
  EXPECT_TRUE(goes_inside(room(true, false))) << "empty";
  EXPECT_TRUE(goes_inside(room_of_thick_walls()));
  EXPECT_TRUE(goes_inside(in_unit(room_of_thick_walls(), 100)));
  EXPECT_TRUE(goes_inside(in_unit(room(true), 2.5)));
  EXPECT_TRUE(goes_inside(room_with_windows(true)));
  EXPECT_TRUE(goes_inside(room_with_windows(false)));
}

TEST_F(Interior, RoomsThatOpenToTheCameraAreNot) {
  EXPECT_FALSE(goes_inside(room(false)));
  EXPECT_FALSE(goes_inside(room(false, false)));
}

TEST_F(Interior, ThingsAreShownFromOutside) {
  const auto block = [](bool double_sided) {
    AssetText asset;
    asset.draw(box({0, 0, 0}, {4, 3, 4}), paint(0.5, double_sided));
    return asset;
  };
  EXPECT_FALSE(goes_inside(block(false)));
  EXPECT_FALSE(goes_inside(block(true)));
  AssetText hollow = block(true);
  hollow.draw(box({0.1F, 0.1F, 0.1F}, {3.9F, 2.9F, 3.9F}, true), paint(0.5));
  EXPECT_FALSE(goes_inside(std::move(hollow))) << "with nothing in it";
  EXPECT_FALSE(goes_inside(in_unit(room_of_thick_walls(), 0.1))) << "a dolls' house";
  for (const double scale : {1.0, 100.0}) {
    EXPECT_FALSE(goes_inside(in_unit(bottle(), scale))) << scale;
    EXPECT_FALSE(goes_inside(in_unit(car(), scale))) << scale;
  }
  EXPECT_FALSE(goes_inside(in_unit(car(), 1.5))) << "a van";
  EXPECT_FALSE(goes_inside(house()));
  EXPECT_FALSE(goes_inside(room_with_windows(true, false))) << "a model of a house, empty";
}

// Bright, nowhere black, and several things are seen.
TEST_F(Interior, IsReadable) {
  options.samples = 32;
  options.layers = {BakeLayer::material};
  options.sizes = {{48, 36}};
  for (AssetText asset : {room(true), room(false), room_of_thick_walls()}) {
    options.output = (folder.path() / "a.exr").native();
    const auto bytes = picture(asset, BakeInterior::on);
    double sum = 0;
    for (const std::uint8_t byte : bytes) sum += byte;
    const double mean = sum / static_cast<double>(bytes.size());
    EXPECT_GT(mean, 100);
    EXPECT_LT(mean, 230);
    std::size_t dark = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 3) dark += bytes[i + 1] < 10 ? 1 : 0;
    EXPECT_LT(dark, bytes.size() / 3 / 50);
    const Numbers materials = read_numbers(folder.path() / "a-material.exr");
    EXPECT_GE(std::set<float>(materials.values.begin(), materials.values.end()).size(), 5U);
  }
}

TEST_F(Interior, StaysWithTheViewThatIsAskedFor) {
  AssetText asset = room(true);
  for (const char* camera : {"front", "30,20"}) {
    options.cameras = {camera};
    EXPECT_FALSE(goes_inside(room(true))) << camera;
  }
  options.cameras = {"front"};
  const auto front = picture(asset, BakeInterior::on);
  options.cameras = {"back"};
  EXPECT_NE(picture(asset, BakeInterior::on), front) << "the other half of the room";
  options.cameras.clear();
  options.turntable = 2;
  EXPECT_FALSE(goes_inside(room(true)));
}

// It is as dark in there as its lamps leave it, unless asked.
TEST_F(Interior, LightComesToACameraOfTheAsset) {
  AssetText asset = room(true);
  asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.01}}}},
               {{"translation", {-1, 1.5, 1.8}}});
  options.cameras = {"0"};
  const auto mean = [&](BakeInterior interior) {
    double sum = 0;
    for (const std::uint8_t byte : picture(asset, interior)) sum += byte;
    return sum / (24 * 24 * 3);
  };
  EXPECT_LT(mean(BakeInterior::automatic), 20);
  EXPECT_GT(mean(BakeInterior::on), 100);
}

TEST_F(Interior, WhatACameraInsideCannotDoIsSaid) {
  AssetText asset = room(true);
  options.interior = BakeInterior::on;
  options.projection = BakeProjection::orthographic;
  EXPECT_THAT(report(asset).error, HasSubstr("needs a perspective camera"));
  options.projection = BakeProjection::perspective;
  options.frame = "0";
  EXPECT_THAT(report(asset).error, HasSubstr("no node can be framed"));
}

}  // namespace
}  // namespace gltfx::test
