// SPDX-License-Identifier: Apache-2.0
// Pictures of few samples, with the noise taken out, against those of many.
#include <gltfx/pipeline.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sanitized.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

BakedPixels draw(const std::string& figure, std::uint32_t samples, bool denoise,
                 bool transparent = false) {
  BakeOptions options;
  options.sizes = {{64, 64}};
  options.samples = samples;
  options.seed = samples;  // no picture is part of another one
  options.denoise = denoise;
  if (transparent) options.background = {BakeBackground::Kind::transparent};
  const fs::path file = fs::path(GLTFX_SOURCE_DIR) / "fixtures/figures" / figure;
  BakeReport report = bake_file(file.native(), options);
  EXPECT_EQ(report.problem, BakeProblem::none) << report.error;
  return report.pixels;
}

// Decibels, where `mask` shows something of the asset.
double likeness(const BakedPixels& a, const BakedPixels& b, const BakedPixels& mask) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < std::size_t{a.width} * a.height; ++i) {
    if (mask.bytes[i * 4 + 3] == 0) continue;
    for (std::size_t c = i * 3; c < i * 3 + 3; ++c) {
      const double apart = static_cast<double>(a.bytes[c]) - b.bytes[c];
      sum += apart * apart;
      ++count;
    }
  }
  return 10 * std::log10(255.0 * 255.0 * count / sum);
}

struct Subject {
  const char* figure;
  double least;  // decibels: one less than there were when this was written
};

void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.figure; }

class Denoised : public testing::TestWithParam<Subject> {};

TEST_P(Denoised, FewSamplesComeNearMany) {
  const auto [figure, least] = GetParam();
  const BakedPixels mask = draw(figure, 1, false, true);
  const BakedPixels many = draw(figure, 128, false);
  const double smooth = likeness(draw(figure, 16, true), many, mask);
  const double noisy = likeness(draw(figure, 16, false), many, mask);
  EXPECT_GT(smooth, least);
  EXPECT_GT(smooth, noisy + 5);
}

// Under sanitizers one of them.
std::vector<Subject> subjects() {
  std::vector<Subject> all{{"rough-glass.gltf", 30.8}};
  if (!kSanitized)
    all.insert(all.end(), {{"backlit-color.gltf", 39}, {"metallic-sweep.gltf", 30.5}});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Figures, Denoised, testing::ValuesIn(subjects()), [](const auto& subject) {
  std::string name = subject.param.figure;
  name.resize(name.find('.'));
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace gltfx
