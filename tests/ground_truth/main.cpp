// SPDX-License-Identifier: Apache-2.0
/// gltfx_ground_truth FILE.json: runs the cases of a file of expected values through the shader.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "cases.hpp"

namespace gltfx::ground_truth {
namespace {

struct Entry {
  std::string_view name;
  Category run;
};

constexpr Entry kCategories[] = {
    {"bsdf_eval", evaluate_bsdf},
    {"directional_albedo", directional_albedo},
    {"white_furnace", white_furnace},
    {"figure_backlit_plane", backlit_plane},
    {"figure_symmetric", symmetric_lights},
    {"multi_bounce", multi_bounce},
    {"volume_slab", volume_slab},
    {"beer_lambert", beer_lambert},
    {"volume_sphere", volume_sphere},
    {"sss_semi_infinite", sss_semi_infinite},
    {"sss_slab", sss_slab},
    {"sss_sphere", sss_sphere},
    {"sss_parameters", sss_parameters},
    {"model_property", model_property},
    {"iridescence", iridescence},
    {"dispersion", dispersion},
    {"sheen", sheen},
    {"texture_transform", texture_transform},
    {"punctual", punctual},
    {"output", output},
    {"identity", identity},
    {"phase_function", phase_function},
    {"scatter_parameters", scatter_parameters},
    {"scatter_thin", evaluate_bsdf},
};

struct Tally {
  std::string category;
  int passed = 0, failed = 0;
  double worst = 0;  // error over tolerance
  std::string worst_case;
};

std::string text_of(const Value& object, std::string_view key) {
  const Value* value = object.find(key);
  return value == nullptr ? "" : value->text;
}

// The failure of a case; empty: none.
Difference run(const Value& test, const std::string& category) {
  static const Value kNothing;
  const Value* inputs = test.find("inputs");
  const Value* expected = test.find("expected");
  const Value* tolerance = test.find("tolerance");
  const Category of = find_category(category);
  if (of == nullptr) return {0, "the category is not known"};
  if (inputs == nullptr || expected == nullptr) return {0, "inputs or expected values are missing"};
  Inputs reader(*inputs);
  const Value actual = of(reader, *expected);
  const std::vector<std::string> unread = reader.unread();
  if (!unread.empty()) return {0, fmt::format("input {} is not known", unread.front())};
  return compare(*expected, actual, tolerance == nullptr ? kNothing : *tolerance);
}

Tally& tally_of(std::vector<Tally>& tallies, const std::string& category) {
  for (Tally& tally : tallies) {
    if (tally.category == category) return tally;
  }
  tallies.emplace_back();
  tallies.back().category = category;
  return tallies.back();
}

void count(std::vector<Tally>& tallies, const Value& test) {
  const std::string category = text_of(test, "category");
  const std::string name = text_of(test, "name");
  const Difference difference = run(test, category);
  Tally& tally = tally_of(tallies, category);
  if (difference.mismatch.empty()) {
    ++tally.passed;
  } else {
    ++tally.failed;
    fmt::print("failed: {}: {}\n", name, difference.mismatch);
  }
  if (difference.worst <= tally.worst) return;
  tally.worst = difference.worst;
  tally.worst_case = name;
}

int report(const std::vector<Tally>& tallies) {
  int passed = 0;
  int failed = 0;
  fmt::print("{:<22} {:>6} {:>6}  {}\n", "category", "passed", "failed",
             "worst error, as part of its tolerance");
  for (const Tally& tally : tallies) {
    fmt::print("{:<22} {:>6} {:>6}  {:.2g} {}\n", tally.category, tally.passed, tally.failed,
               tally.worst, tally.worst_case);
    passed += tally.passed;
    failed += tally.failed;
  }
  fmt::print("{} passed, {} failed\n", passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}

int run_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  const std::optional<Value> root = parse_json(text.str());
  const Value* cases = root ? root->find("cases") : nullptr;
  if (!file || cases == nullptr) {
    fmt::print(stderr, "{} is not a file of cases\n", path);
    return 2;
  }
  std::vector<Tally> tallies;
  for (const Value& test : cases->items) count(tallies, test);
  return report(tallies);
}

}  // namespace

Category find_category(std::string_view name) {
  const auto* found = std::find_if(std::begin(kCategories), std::end(kCategories),
                                   [&](const Entry& entry) { return entry.name == name; });
  return found == std::end(kCategories) ? nullptr : found->run;
}

}  // namespace gltfx::ground_truth

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: gltfx_ground_truth FILE.json\n");
    return 2;
  }
  return gltfx::ground_truth::run_file(argv[1]);
}
