// SPDX-License-Identifier: Apache-2.0
// What is stored again.
#include <gtest/gtest.h>

#include "measure/measured.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx::measure {
namespace {

using gltfx::test::AssetBuilder;
using gltfx::test::floats;
using test::measured;
using test::value;

using Json = AssetBuilder::Json;

Json of_asset(const AssetBuilder& asset, std::string_view name) {
  return value(measured(asset), MeasureScope::asset, name);
}

// Two meshes with equal positions, each in bytes of its own.
AssetBuilder twins() {
  AssetBuilder asset;
  for (int i = 0; i < 2; ++i) {
    const auto places = asset.accessor("VEC3", 5126, 1, floats({1, 2, 3}));
    asset.add("meshes", Json{{"primitives", {{{"attributes", {{"POSITION", places}}}}}}});
  }
  return asset;
}

TEST(Duplicates, AreFoundByTheirContent) {
  const AssetBuilder asset = twins();
  EXPECT_EQ(of_asset(asset, "duplicate-accessors"), 1);
  EXPECT_EQ(of_asset(asset, "duplicate-meshes"), 1);
  EXPECT_EQ(of_asset(asset, "duplicate-images"), 0);
}

TEST(Duplicates, OfManyObjectsThatShareBytesAreUnknown) {
  AssetBuilder asset = twins();
  constexpr std::size_t kBytes = 1'200'000;
  asset.accessor("VEC3", 5126, kBytes / 12, std::string(kBytes, '\0'));
  const Json shared = asset.json["accessors"].back();
  for (int i = 0; i < 100; ++i) asset.add("accessors", shared);
  EXPECT_EQ(of_asset(asset, "duplicate-accessors"), nullptr);
  EXPECT_EQ(of_asset(asset, "duplicate-meshes"), nullptr);
  EXPECT_EQ(of_asset(asset, "duplicate-images"), 0) << "no accessor is read for them";
}

TEST(Duplicates, OfOneKindDoNotDependOnWhatElseIsWanted) {
  const AssetBuilder asset = twins();
  for (const Name name : {Name::duplicate_accessors, Name::duplicate_meshes}) {
    Request request;
    request.wanted = {{MeasureScope::asset, name}};
    const Measurements taken = measured(asset, request);
    const auto& column = taken.columns[static_cast<std::size_t>(MeasureScope::asset)].at(0);
    EXPECT_EQ(std::get<double>(column.values.at(0)), 1) << column.measure->name;
  }
}

}  // namespace
}  // namespace gltfx::measure
