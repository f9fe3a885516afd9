// SPDX-License-Identifier: Apache-2.0
#include "transport.hpp"

#include <cmath>
#include <numbers>

#include "shader/integration.hpp"

namespace gltfx::ground_truth {
namespace {

using shader::gauss_legendre;
using shader::Node;

// Cosines, crowded towards 0, where all these functions are steep.
std::vector<Node> cosines() {
  std::vector<Node> nodes = gauss_legendre(64);
  for (Node& node : nodes) node = {node.x * node.x, 2 * node.x * node.weight};
  return nodes;
}

const std::vector<Node>& nodes() {
  static const std::vector<Node> kNodes = cosines();
  return kNodes;
}

// 1 / H(mu) from the values at the nodes.
double inverse_h(double albedo, const std::vector<double>& values, double cosine) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += nodes()[i].weight * nodes()[i].x * values[i] / (cosine + nodes()[i].x);
  }
  return std::sqrt(1 - albedo) + albedo / 2 * sum;
}

}  // namespace

SemiInfinite::SemiInfinite(double albedo) : albedo_(albedo), values_(nodes().size(), 1.0) {
  for (int step = 0; step < 3000; ++step) {
    double change = 0;
    std::vector<double> next;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      // The mean of old and new value settles fastest.
      next.push_back((values_[i] + 1 / inverse_h(albedo_, values_, nodes()[i].x)) / 2);
      change = std::fmax(change, std::fabs(next[i] - values_[i]));
    }
    values_ = next;
    if (change < 1e-13) break;
  }
}

double SemiInfinite::h(double cosine) const { return 1 / inverse_h(albedo_, values_, cosine); }

double SemiInfinite::plane_albedo(double cosine) const {
  return 1 - std::sqrt(1 - albedo_) * h(cosine);
}

double SemiInfinite::diffuse_albedo() const {
  double sum = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    sum += nodes()[i].weight * nodes()[i].x * values_[i];
  }
  return 1 - 2 * std::sqrt(1 - albedo_) * sum;
}

double SemiInfinite::radiance(double cosine0, double cosine) const {
  return albedo_ / (4 * std::numbers::pi) * cosine0 / (cosine + cosine0) * h(cosine) * h(cosine0);
}

namespace {

// Chandrasekhar's X and Y functions, grown from a slab without thickness (R. Bellman et al.,
// Invariant Imbedding and Radiative Transfer in Slabs of Finite Thickness, 1963):
// dX/dt = Y s, dY/dt = -Y / mu + X s with s = albedo / 2 * integral of Y / mu.
class GrowingSlab {
 public:
  GrowingSlab(double albedo, double cosine) : albedo_(albedo), cosines_(nodes()) {
    cosines_.push_back({cosine, 0});
    x_.assign(cosines_.size(), 1);
    y_.assign(cosines_.size(), 1);
  }

  // By Heun's method; the decay of Y is taken along exactly.
  void grow(double step) {
    const double s0 = source(y_);
    std::vector<double> y1;
    std::vector<double> x1;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const double decay = std::exp(-step / cosines_[i].x);
      y1.push_back(decay * y_[i] + x_[i] * s0 * cosines_[i].x * (1 - decay));
      x1.push_back(x_[i] + step * y_[i] * s0);
    }
    const double s1 = source(y1);
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const double mu = cosines_[i].x;
      const double decay = std::exp(-step / mu);
      // What is fed in decays from then on.
      const double fed0 = x_[i] * s0;
      const double fed1 = x1[i] * s1;
      const double z = step / mu;
      const double mean0 = z < 1e-4 ? step * (0.5 - z / 3) : mu * ((1 - decay) / z - decay);
      const double mean1 = z < 1e-4 ? step * (0.5 - z / 6) : mu * (1 - (1 - decay) / z);
      const double y = decay * y_[i] + fed0 * mean0 + fed1 * mean1;
      x_[i] += step / 2 * (y_[i] * s0 + y * s1);
      y_[i] = y;
    }
  }

  SlabAlbedo albedo() const {
    double alpha = 0;
    double beta = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      alpha += cosines_[i].weight * x_[i];
      beta += cosines_[i].weight * y_[i];
    }
    const double kept = 1 - albedo_ / 2 * alpha;
    const double lost = albedo_ / 2 * beta;
    return {1 - x_.back() * kept - y_.back() * lost, y_.back() * kept + x_.back() * lost};
  }

 private:
  double source(const std::vector<double>& y) const {
    double sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      sum += cosines_[i].weight * y[i] / cosines_[i].x;
    }
    return albedo_ / 2 * sum;
  }

  double albedo_;
  std::vector<Node> cosines_;  // the last is the requested one
  std::vector<double> x_, y_;
};

}  // namespace

SlabAlbedo slab_albedo(double albedo, double thickness, double cosine) {
  GrowingSlab slab(albedo, cosine);
  constexpr int kSteps = 4000;
  double reached = 0;
  for (int i = 1; i <= kSteps; ++i) {  // thin slabs change fastest
    const double next = thickness * std::pow(static_cast<double>(i) / kSteps, 3.0);
    slab.grow(next - reached);
    reached = next;
  }
  return slab.albedo();
}

namespace {

// The exponential integral E1.
double exponential_integral(double x) {
  if (x <= 0) return 0;
  if (x < 1) {
    double sum = -0.57721566490153286 - std::log(x);
    double term = -1;
    for (int k = 1; k < 30; ++k) {
      term *= -x / k;
      sum += term / k;
    }
    return sum;
  }
  double fraction = 0;
  for (int k = 60; k > 0; --k) fraction = k / (1 + k / (x + fraction));
  return std::exp(-x) / (x + fraction);
}

// Light at a distance from the centre that reaches it unscattered, averaged over directions.
double unscattered(double r, double radius) {
  double sum = 0;
  for (const Node& node : gauss_legendre(48)) {
    const double cosine = 2 * node.x - 1;
    const double chord = r * cosine + std::sqrt(radius * radius - r * r * (1 - cosine * cosine));
    sum += node.weight * std::exp(-chord);
  }
  return sum;
}

// The mean radiance inside of the sphere, from Peierls' equation
// r J(r) = r J0(r) + albedo / 2 * integral of r' J(r') (E1(|r - r'|) - E1(r + r')), on nodes; where
// the kernel is singular, J is taken out of the integral, whose value is known for J = 1: then
// J0 is what is missing to 1 at albedo 1.
class SphereSource {
 public:
  SphereSource(double albedo, double radius) {
    for (const Node& node : gauss_legendre(kCount)) {
      r_.push_back(node.x * radius);
      first_.push_back(unscattered(r_.back(), radius));
      weight_.push_back(node.weight * radius);
    }
    mean_.assign(r_.size(), 1.0);
    for (int step = 0; step < 20000; ++step) {
      if (relax(albedo) < 1e-12) break;
    }
  }

  double at(double r) const {  // linear in r squared is smooth enough between close nodes
    if (r <= r_.front()) return mean_.front();
    std::size_t i = 1;
    while (i + 1 < r_.size() && r_[i] < r) ++i;
    const double t = (r * r - r_[i - 1] * r_[i - 1]) / (r_[i] * r_[i] - r_[i - 1] * r_[i - 1]);
    return mean_[i - 1] + (mean_[i] - mean_[i - 1]) * std::fmin(t, 1.0);
  }

 private:
  static constexpr int kCount = 160;

  void fill_kernel() {
    for (std::size_t i = 0; i < r_.size(); ++i) {
      for (std::size_t j = 0; j < r_.size(); ++j) {
        const double near = i == j ? 0 : exponential_integral(std::fabs(r_[i] - r_[j]));
        const double far = exponential_integral(r_[i] + r_[j]);
        kernel_.push_back(i == j ? 0 : weight_[j] * r_[j] / r_[i] * (near - far) / 2);
      }
    }
  }

  double relax(double albedo) {
    if (kernel_.empty()) fill_kernel();
    double change = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      double sum = 0;
      double rest = 1 - first_[i];
      for (std::size_t j = 0; j < r_.size(); ++j) {
        const double k = kernel_[i * r_.size() + j];
        sum += k * mean_[j];
        rest -= k;
      }
      const double next = (first_[i] + albedo * sum) / (1 - albedo * rest);
      change = std::fmax(change, std::fabs(next - mean_[i]));
      mean_[i] = next;
    }
    return change;
  }

  std::vector<double> r_, weight_, first_, mean_, kernel_;
};

}  // namespace

SphereRadiance sphere_radiance(double albedo, double radius) {
  const SphereSource source(albedo, radius);
  const auto along = [&](double offset) {
    const double half = std::sqrt(radius * radius - offset * offset);
    double sum = std::exp(-2 * half);
    for (const Node& node : gauss_legendre(96)) {
      const double t = node.x * 2 * half;
      const double r = std::hypot(offset, half - t);
      sum += node.weight * 2 * half * std::exp(-t) * albedo * source.at(r);
    }
    return sum;
  };
  SphereRadiance radiance{along(0), 0};
  for (const Node& node : gauss_legendre(48)) {
    const double share = 1 - node.x * node.x;  // offset squared over radius squared
    radiance.mean += 2 * node.x * node.weight * along(radius * std::sqrt(share));
  }
  return radiance;
}

}  // namespace gltfx::ground_truth
