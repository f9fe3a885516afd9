// SPDX-License-Identifier: Apache-2.0
#include "measure/measured.hpp"

#include <gtest/gtest.h>

#include "container/container.hpp"
#include "container/glb_builder.hpp"
#include "container/resolver.hpp"
#include "model/opened_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx::measure::test {

Measurements measured(const std::string& asset, const Request& request) {
  const bool glb = asset.starts_with("glTF");
  const std::string name = glb ? "example.glb" : "example.gltf";
  const model::OpenedAsset opened(
      name, container::open_bytes(container::Bytes::from_string(asset), name), {});
  if (opened.document().empty()) {
    ADD_FAILURE() << "no document";
    return {};
  }
  const model::Asset objects(opened.document());
  container::OpenedFiles files(opened.resolver());
  const auto loaded = model::load_resources(opened.container(), files, objects, opened.views(), 1);
  const auto schemas = schema::builtin_set();
  const Source source({opened.name(), opened.container(), files, objects, opened.views(),
                       loaded.data, *schemas, 1});
  return take(source, request);
}

Measurements measured(const gltfx::test::AssetBuilder& asset, const Request& request) {
  using namespace gltfx::container::test;
  return measured(
      glb(chunk(container::kChunkJson, asset.text()) + chunk(container::kChunkBin, asset.bytes)),
      request);
}

nlohmann::json value(const Measurements& measurements, MeasureScope on, std::string_view name,
                     std::size_t element) {
  const MeasureColumn* column = measurements.find(on, name);
  if (column == nullptr || element >= column->values.size()) return nullptr;
  return std::visit(
      [](const auto& each) -> nlohmann::json {
        using Value = std::decay_t<decltype(each)>;
        if constexpr (std::is_same_v<Value, NotMeasured>) {
          return nullptr;
        } else {
          return each;
        }
      },
      column->values[element]);
}

}  // namespace gltfx::measure::test
