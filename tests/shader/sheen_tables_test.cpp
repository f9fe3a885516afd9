// SPDX-License-Identifier: Apache-2.0
/// The tables of sheens in the conserving mode. With GLTFX_UPDATE_TABLES set in the environment
/// they are rewritten: those of sheens first, and, when the tests are built again, those of what is
/// below.
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "sheen_integrals.hpp"
#include "table_file.hpp"

namespace gltfx::shader {
namespace {

bool updates_tables() { return std::getenv("GLTFX_UPDATE_TABLES") != nullptr; }

TEST(SheenTables, OfSheensAreWrittenWhenAskedFor) {
  if (!updates_tables()) GTEST_SKIP();
  TableFile albedo("held_sheen_albedo");
  TableFile scale("held_sheen_scale");
  for (int r = 0; r < kHeldSheenRows; ++r) {
    const HeldSheenRow row = balance_sheen(held_sheen_roughness(r, kHeldSheenRows), 200);
    albedo.row(row.albedo);
    scale.row(row.scale);
  }
}

TEST(SheenTables, OfWhatIsBelowAreWrittenWhenAskedFor) {
  if (!updates_tables()) GTEST_SKIP();
  std::vector<GlossLights> bases;
  for (int b = 0; b < kBelowBaseRows; ++b)
    bases.push_back(gloss_lights(below_base_roughness(b), 80));
  TableFile file("below_sheen");
  for (int r = 0; r < kBelowSheenRows; ++r) {
    const HeldSheen sheen(held_sheen_roughness(r, kBelowSheenRows));
    file.open();
    for (const GlossLights& base : bases) {
      file.open();
      for (int s = 0; s < kBelowStrengths; ++s)
        file.row(balance_below(base, sheen, (s + 1.0) / kBelowStrengths));
      file.close();
    }
    file.close();
  }
}

}  // namespace
}  // namespace gltfx::shader
