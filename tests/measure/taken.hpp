// SPDX-License-Identifier: Apache-2.0
/// Measures of small assets.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "container/container.hpp"
#include "container/opened_files.hpp"
#include "json/parse.hpp"
#include "measure/take.hpp"
#include "model/views.hpp"
#include "schema/compile.hpp"

namespace gltfx::test {

/// All measures, those of pixels included.
inline measure::Request with_pixels() {
  measure::Request request;
  request.pixels = true;
  return request;
}

/// Measures of an asset that needs no other file.
class Taken {
 public:
  explicit Taken(std::string bytes, const measure::Request& request = with_pixels()) {
    const container::Container container =
        container::open_bytes(container::Bytes::from_string(std::move(bytes)), "a.gltf");
    const json::Parsed parsed = json::parse(*container.json);
    const model::Asset asset(parsed.document);
    const model::Views views(asset);
    const container::Resolver resolver;
    container::OpenedFiles files(resolver);
    const auto loaded = model::load_resources(container, files, asset, views, 1);
    const std::string name = "a.gltf";
    const measure::Source source(name, container, files, asset, views, loaded.data,
                                 *schema::builtin_set(), 1);
    values_ = measure::take(source, request);
  }

  const MeasureValue& value(MeasureScope on, std::string_view name, std::size_t element = 0) const {
    return values_.find(on, name)->values[element];
  }
  /// A number; fails for anything else.
  double number(std::string_view name, std::size_t element = 0,
                MeasureScope on = MeasureScope::material) const {
    return std::get<double>(value(on, name, element));
  }
  double of_asset(std::string_view name) const { return number(name, 0, MeasureScope::asset); }
  /// Why there is no value; fails if there is one.
  const MeasureReason& reason(std::string_view name, std::size_t element = 0,
                              MeasureScope on = MeasureScope::material) const {
    return values_.reasons[std::get<NotMeasured>(value(on, name, element)).reason];
  }
  const Measurements& all() const { return values_; }

 private:
  Measurements values_;
};

}  // namespace gltfx::test
