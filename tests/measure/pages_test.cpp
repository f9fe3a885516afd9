// SPDX-License-Identifier: Apache-2.0
/// The pages of schema/measures/: each example has the values that the page says.
#include <gltfx/measure.hpp>

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/measured.hpp"

namespace gltfx::measure {
namespace {

using nlohmann::json;

std::size_t element_of(const Measurements& taken, MeasureScope scope, const std::string& key) {
  if (scope == MeasureScope::asset) return 0;
  const std::size_t slash = key.find('/');
  if (slash == std::string::npos) return std::stoul(key);
  const auto mesh = static_cast<std::uint32_t>(std::stoul(key));
  const auto index = static_cast<std::uint32_t>(std::stoul(key.substr(slash + 1)));
  for (std::size_t i = 0; i < taken.primitives.size(); ++i) {
    if (taken.primitives[i].mesh == mesh && taken.primitives[i].index == index) return i;
  }
  return taken.primitives.size();
}

void expect_equal(const json& value, const json& wanted, const std::string& where) {
  if (value.is_number() && wanted.is_number()) {
    EXPECT_NEAR(value.get<double>(), wanted.get<double>(), 1e-6) << where;
  } else {
    EXPECT_EQ(value, wanted) << where;
  }
}

TEST(MeasurePages, ExamplesHaveTheirValues) {
  Request request;
  request.pixels = true;
  request.parameters.product = {1, 1, 1};
  for (const MeasureDescription& measure : measures()) {
    const Measurements taken = test::measured(std::string(measure.example), request);
    const json values = json::parse(measure.values);
    const std::string name(measure.name);
    for (const auto& [scope_name, elements] : values.items()) {
      const auto scope = measure_scope_from_name(scope_name);
      ASSERT_TRUE(scope) << name << ' ' << scope_name;
      EXPECT_EQ(find_measure(*scope, name), &measure) << name << ' ' << scope_name;
      const json by_element = *scope == MeasureScope::asset ? json{{"0", elements}} : elements;
      for (const auto& [key, wanted] : by_element.items()) {
        expect_equal(test::value(taken, *scope, name, element_of(taken, *scope, key)),
                     wanted.at(name), name + ' ' + scope_name + ' ' + key);
      }
    }
  }
}

// Each scope of a page has a value in its example, so that a function without effect is found.
TEST(MeasurePages, ExamplesShowEachScope) {
  for (const MeasureDescription& measure : measures()) {
    const json values = json::parse(measure.values);
    std::size_t numbers = 0;
    for (const auto& [scope, elements] : values.items()) numbers += elements.size();
    EXPECT_GT(numbers, 0U) << measure.name;
    const bool of_asset = measure.is_of_asset();
    EXPECT_EQ(values.contains("asset"), of_asset) << measure.name;
  }
}

TEST(MeasurePages, NamesAreUniqueOnAScope) {
  for (std::size_t scope = 0; scope < kMeasureScopeCount; ++scope) {
    std::set<std::string_view> names;
    for (const MeasureDescription& measure : measures()) {
      if (!measure.is_on(static_cast<MeasureScope>(scope))) continue;
      EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
    }
  }
  std::string_view previous;
  for (const MeasureDescription& measure : measures()) {
    EXPECT_LE(previous, measure.name);
    previous = measure.name;
  }
}

}  // namespace
}  // namespace gltfx::measure
