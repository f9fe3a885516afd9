// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>

#include "cases.hpp"

namespace gltfx::ground_truth {
namespace {

// Numbers without a pattern, the same in each run.
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state_ >> 11U) * 0x1p-53;
  }
  Rgb color() { return {next(), next(), next()}; }
  Vec3d direction() {
    const double z = 2 * next() - 1;
    const double phi = 6.283185307179586 * next();
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(phi), radius * std::sin(phi), z};
  }
  Material material() {
    Material m;
    m.base_color = color();
    m.metallic = next();
    m.roughness = 0.1 + 0.9 * next();
    m.ior = 1 + next();
    m.specular = next();
    m.specular_color = color();
    m.transmission = next();
    m.diffuse_transmission = next();
    m.diffuse_transmission_color = color();
    return m;
  }
  Random3 random() { return {next(), next(), next()}; }

 private:
  std::uint64_t state_ = 1;
};

constexpr int kTrials = 2000;
constexpr ShaderOptions kConserving{};

bool same_path(const Material& a, const Material& b, const Vec3d& v, const Random3& random,
               const ShaderOptions& options) {
  const auto x = sample(a, v, random, options);
  const auto y = sample(b, v, random, options);
  if (!x || !y) return x.has_value() == y.has_value();
  return x->l == y->l && x->weight == y->weight && x->pdf == y->pdf && x->delta == y->delta;
}

// Bit for bit the same material, so that pictures with equal seeds are the same bytes.
template <class Make>
bool always_equal(const Make& make) {
  Numbers numbers;
  for (int i = 0; i < kTrials; ++i) {
    const auto [a, b] = make(numbers);
    const Vec3d v = numbers.direction();
    const Vec3d l = numbers.direction();
    const Random3 random = numbers.random();
    for (const ShaderOptions& options : {kSpec, kConserving}) {
      if (evaluate(a, v, l, options) != evaluate(b, v, l, options)) return false;
      if (pdf(a, v, l, options) != pdf(b, v, l, options)) return false;
      if (!same_path(a, b, v, random, options)) return false;
    }
  }
  return true;
}

struct Two {
  Material a, b;
};

bool factor_0_is_core() {
  return always_equal([](Numbers& numbers) {
    Two two{numbers.material(), {}};
    two.a.diffuse_transmission = 0;
    two.b = two.a;
    two.b.diffuse_transmission_color = Rgb(1);
    return two;
  });
}

bool transmission_hides_diffuse() {
  return always_equal([](Numbers& numbers) {
    Two two{numbers.material(), {}};
    two.a.transmission = 1;
    two.b = two.a;
    two.b.diffuse_transmission = 0;
    return two;
  });
}

bool translucency_is_its_upgrade() {
  return always_equal([](Numbers& numbers) {
    Two two{numbers.material(), {}};
    two.b = two.a;
    add_translucency(two.a, two.a.diffuse_transmission);
    two.b.diffuse_transmission_color = two.b.base_color;
    return two;
  });
}

bool metal_transmits_nothing() {
  return always_equal([](Numbers& numbers) {
    Two two{numbers.material(), {}};
    two.a.metallic = 1;
    two.b = two.a;
    two.b.diffuse_transmission = 0;
    two.b.transmission = 0;
    return two;
  });
}

bool furnace_knows_no_factor() {
  Numbers numbers;
  for (int i = 0; i < 20; ++i) {
    Material m = numbers.material();
    m.metallic = 0;
    m.transmission = 0;
    m.diffuse_transmission_color = m.base_color;
    const Vec3d v = direction_of_cosine(0.1 + 0.9 * numbers.next());
    const Rgb some = integrate(m, v, kSpec, 64).total;
    m.diffuse_transmission = 0;
    if (max_value(some - integrate(m, v, kSpec, 64).total) > 1e-5) return false;
  }
  return true;
}

bool is_reciprocal() {
  Numbers numbers;
  for (int i = 0; i < kTrials; ++i) {
    const Material m = numbers.material();
    const Vec3d v = numbers.direction();
    const Vec3d l = numbers.direction();
    for (const ShaderOptions& options : {kSpec, kConserving}) {
      const Rgb there = evaluate(m, v, l, options);
      const Rgb back = evaluate(m, l, v, options);
      if (max_value(there - back) > 1e-4 * max_value(there)) return false;
      if (max_value(back - there) > 1e-4 * max_value(there)) return false;
    }
  }
  return true;
}

bool specular_glossiness_is_ior_0() {
  const bool same = always_equal([](Numbers& numbers) {
    const Rgb diffuse = numbers.color();
    const Rgb specular = numbers.color();
    const double glossiness = 0.9 * numbers.next();
    Two two{specular_glossiness(diffuse, specular, glossiness), {}};
    two.b.base_color = diffuse;
    two.b.metallic = 0;
    two.b.roughness = 1 - glossiness;
    two.b.ior = 0;
    two.b.specular_color = specular;
    return two;
  });
  // A specular colour of 1 leaves nothing to the layers below, at any angle.
  Numbers numbers;
  for (int i = 0; same && i < kTrials; ++i) {
    Material white = specular_glossiness(numbers.color(), Rgb(1), 0.5);
    const Vec3d v = numbers.direction();
    const Vec3d l = numbers.direction();
    const Rgb colored = evaluate(white, v, l, kSpec);
    white.base_color = {};
    if (max_value(colored - evaluate(white, v, l, kSpec)) > 1e-5) return false;
  }
  return same;
}

bool unlit_is_its_color() {
  Numbers numbers;
  for (int i = 0; i < kTrials; ++i) {
    Material m = numbers.material();
    m.unlit = true;
    m.clearcoat = numbers.next();
    const Vec3d v = numbers.direction();
    if (emitted(m, v) != m.base_color) return false;
    if (evaluate(m, v, numbers.direction()) != Rgb() || sample(m, v, numbers.random()))
      return false;
  }
  return true;
}

struct Claim {
  std::string_view part;  // of the statement
  bool (*holds)();
};

constexpr Claim kClaims[] = {
    {"DT factor 0 ==", factor_0_is_core},
    {"transmission=1 + diffuseTransmission", transmission_hides_diffuse},
    {"translucency{", translucency_is_its_upgrade},
    {"baseColor==diffuseTransmissionColor", furnace_knows_no_factor},
    {"metallic=1", metal_transmits_nothing},
    {"f(V,L)==f(L,V)", is_reciprocal},
    {"SpecularGlossiness{", specular_glossiness_is_ior_0},
    {"unlit", unlit_is_its_color},
};

}  // namespace

Value identity(Inputs& inputs, const Value& expected) {
  const std::string statement = inputs.text("statement");
  for (const Claim& claim : kClaims) {
    if (statement.find(claim.part) == std::string::npos) continue;
    const bool holds = claim.holds();
    return for_each_key(expected, [&](const std::string& key, const Value& wanted) -> Value {
      if (key != "relation") return {};
      return holds ? wanted : Value(std::string("it does not hold"));
    });
  }
  return {};
}

}  // namespace gltfx::ground_truth
