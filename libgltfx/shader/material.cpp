// SPDX-License-Identifier: Apache-2.0
#include "shader/material.hpp"

#include <algorithm>

#include "shader/integration.hpp"

namespace gltfx::shader {
namespace {

constexpr double kGrazing = 1e-7;     // cosine below which directions count as the horizon
constexpr double kInfiniteIor = 1e4;  // for ior 0 with refraction

// IOR behind the surface over IOR in front of it.
double relative_ior(const Material& m, int channel) {
  if (m.ior == 0) return kInfiniteIor;
  const bool disperses = m.dispersion > 0 && channel >= 0 && channel < 3;
  const double ior = disperses ? dispersed_ior(m.ior, m.dispersion)[channel] : m.ior;
  return ior / m.outside_ior;
}

Vec3d in_front(const Vec3d& v) { return {v.x, v.y, std::max(std::fabs(v.z), kGrazing)}; }

Prepared prepare(const Material& m, const Vec3d& v, const ShaderOptions& options) {
  const double eta = relative_ior(m, options.channel);
  return {m, in_front(v), v.z >= 0 ? eta : 1 / eta, options.mode};
}

PreparedLayers see_layers(const Material& m, const Vec3d& v, ShaderMode mode) {
  if (v.z >= 0 || m.clearcoat_normal == Vec3d(0, 0, 1)) return {m, in_front(v), mode};
  Material mirror = m;
  mirror.clearcoat_normal.x = -m.clearcoat_normal.x;
  mirror.clearcoat_normal.y = -m.clearcoat_normal.y;
  return {mirror, in_front(v), mode};
}

}  // namespace

// Nodes are small: inlined together they take half the time.
template <class Graph>
[[gnu::flatten]] Evaluation in_one_piece(const Graph& graph, const Directions& d) {
  return graph.evaluate(d, {});
}

Bsdf::Bsdf(const Material& m, const Vec3d& v, const ShaderOptions& options)
    : flipped_(v.z < 0), prepared_(prepare(m, v, options)) {
  if (is_core(m)) {
    core_.emplace(core_graph(m, prepared_));
  } else {
    layers_.emplace(see_layers(m, v, options.mode));
    full_.emplace(material_graph(m, prepared_, *layers_));
  }
}

Evaluation Bsdf::evaluate(const Vec3d& l) const {
  if (std::fabs(l.z) < kGrazing) return {};
  const Directions d(prepared_.v, flipped_ ? mirrored(l) : l);
  return core_ ? in_one_piece(*core_, d) : in_one_piece(*full_, d);
}

Rgb Bsdf::straight_transmittance() const {
  const Directions d(prepared_.v, -prepared_.v, Measure::delta);
  return (core_ ? in_one_piece(*core_, d) : in_one_piece(*full_, d)).f * d.l.z;
}

double Bsdf::reflection_chance() const {
  const auto rest_of = [](const auto& material) {
    return (1 - material.chance) * (1 - material.bsdf0.chance);
  };
  if (core_) return 1 - rest_of(*core_);
  const auto& sheen = full_->base;
  return 1 - (1 - full_->chance) * (1 - sheen.chance) * rest_of(sheen.base);
}

std::optional<BsdfSample> Bsdf::sample(const Random3& random) const {
  return core_ ? sample(*core_, random) : sample(*full_, random);
}

template <class Nodes>
std::optional<BsdfSample> Bsdf::sample(const Nodes& graph, const Random3& random) const {
  const Proposal p = graph.sample(prepared_.v, random);
  if (!p.valid || std::fabs(p.l.z) < kGrazing) return std::nullopt;
  const Directions d(prepared_.v, p.l, p.measure);
  const auto [f, reflected, pdf] = in_one_piece(graph, d);
  if (!(pdf > 0)) return std::nullopt;
  const double scale = d.l.z / pdf;
  if (!(max_value(f * scale) > 0)) return std::nullopt;
  const bool delta = p.measure == Measure::delta;
  return BsdfSample{{flipped_ ? mirrored(p.l) : p.l, f * scale, pdf, delta}, reflected * scale};
}

Albedo Bsdf::integrate(int resolution) const {
  const auto albedo = [&](const auto& graph) {
    Integration integration(graph, prepared_.v, resolution);
    visit_node(graph, integration, 1);
    return integration.albedo();
  };
  return core_ ? albedo(*core_) : albedo(*full_);
}

}  // namespace gltfx::shader

namespace gltfx {

Material specular_glossiness(const Rgb& diffuse, const Rgb& specular, double glossiness) {
  Material m;
  m.base_color = diffuse;
  m.specular_color = specular;
  m.roughness = 1 - glossiness;
  m.metallic = 0;
  m.ior = 0;
  return m;
}

void add_translucency(Material& material, double factor) {
  material.diffuse_transmission = factor;
  material.diffuse_transmission_color = material.base_color;
}

Rgb evaluate(const Material& material, const Vec3d& v, const Vec3d& l,
             const ShaderOptions& options) {
  return material.unlit ? Rgb() : shader::Bsdf(material, v, options).evaluate(l).f;
}

double pdf(const Material& material, const Vec3d& v, const Vec3d& l, const ShaderOptions& options) {
  return material.unlit ? 0 : shader::Bsdf(material, v, options).evaluate(l).pdf;
}

std::optional<MaterialSample> sample(const Material& material, const Vec3d& v,
                                     const Random3& random, const ShaderOptions& options) {
  if (material.unlit) return std::nullopt;
  return shader::Bsdf(material, v, options).sample(random);
}

Albedo integrate(const Material& material, const Vec3d& v, const ShaderOptions& options,
                 int resolution) {
  if (material.unlit) return {};
  return shader::Bsdf(material, v, options).integrate(std::max(resolution, 1));
}

Rgb emitted(const Material& material, const Vec3d& v) {
  if (material.unlit) return material.base_color;
  if (material.clearcoat <= 0) return material.emissive;
  const double cosine = std::fabs(dot(v, material.clearcoat_normal));
  const double coat = material.clearcoat * shader::schlick(shader::f0_of_ior(1.5, 1), cosine);
  return material.emissive * (1 - coat);
}

}  // namespace gltfx
