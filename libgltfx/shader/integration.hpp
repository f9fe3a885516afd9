// SPDX-License-Identifier: Apache-2.0
/// Albedo of a graph of nodes by quadrature.
///
/// Each kind of light is integrated over the directions that the lobes of its kind sample, weighted
/// against the density of all these lobes together. At one azimuth the directions of a lobe are on
/// a curve that the horizon cuts; between the cuts the integrand is smooth, and Gaussian quadrature
/// suffices.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "shader/material.hpp"

namespace gltfx::shader {

struct Node {
  double x, weight;
};

/// Gauss and Legendre over [0, 1]. Nodes by Newton's method.
inline std::vector<Node> gauss_legendre(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p0 = 1;
      double p1 = x;
      for (int k = 2; k <= count; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
      if (std::fabs(p1 / slope) < 1e-15) break;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

/// Sums the densities of the lobes of one kind.
class KindDensity {
 public:
  KindDensity(const Directions& d, Lobes kind) : d_(d), kind_(kind) {}

  template <class Leaf>
  void operator()(const Leaf& leaf, double probability) {
    if ((Leaf::kKinds & kind_) != 0) sum_ += probability * leaf.pdf(d_);
  }
  double sum() const { return sum_; }

 private:
  const Directions& d_;
  Lobes kind_;
  double sum_ = 0;
};

template <class Graph>
class Integration {
 public:
  Integration(const Graph& graph, const Vec3d& v, int resolution)
      : graph_(graph),
        v_(v),
        turns_(resolution),
        nodes_(gauss_legendre(resolution > 8 ? resolution / 2 : 4)) {}

  template <class Leaf>
  void operator()(const Leaf& leaf, double probability) {
    if (leaf.is_delta) {
      add(leaf, leaf.sample(v_, {}), probability);
      return;
    }
    for (int i = 0; i < turns_; ++i) {
      const double turn = (i + 0.5) / turns_;
      along(leaf, turn, probability / turns_);
    }
  }

  Albedo albedo() const {
    Albedo sum = sum_;
    sum.total =
        sum.diffuse_reflect + sum.diffuse_transmit + sum.specular_reflect + sum.specular_transmit;
    return sum;
  }

 private:
  // The side of a curve of directions; 0: neither.
  template <class Leaf>
  int side(const Leaf& leaf, double turn, double u) const {
    const Proposal p = leaf.sample(v_, {0.5, u, turn});
    return !p.valid ? 0 : p.l.z > 0 ? 1 : 2;
  }

  template <class Leaf>
  double cut(const Leaf& leaf, double turn, double low, double high) const {
    const int below = side(leaf, turn, low);
    for (int step = 0; step < 40; ++step) {
      const double middle = (low + high) / 2;
      (side(leaf, turn, middle) == below ? low : high) = middle;
    }
    return low;
  }

  template <class Leaf>
  void along(const Leaf& leaf, double turn, double share) {
    constexpr int kCells = 16;
    double begin = 0;
    for (int i = 0; i < kCells; ++i) {
      const double low = (i + 0.01) / kCells;
      const double high = (i + 1.01) / kCells < 1 ? (i + 1.01) / kCells : 1 - 1e-9;
      if (side(leaf, turn, low) == side(leaf, turn, high)) continue;
      const double end = cut(leaf, turn, low, high);
      piece(leaf, turn, begin, end, share);
      begin = end;
    }
    piece(leaf, turn, begin, 1, share);
  }

  // Nodes are dense towards the end, where lobes fall off slowly or reach the horizon.
  template <class Leaf>
  void piece(const Leaf& leaf, double turn, double begin, double end, double share) {
    const double width = end - begin;
    for (const Node& node : nodes_) {
      const double u = end - width * square(1 - node.x);
      const double weight = node.weight * 2 * (1 - node.x) * width * share;
      add(leaf, leaf.sample(v_, {0.5, u, turn}), weight);
    }
  }

  template <class Leaf>
  void add(const Leaf&, const Proposal& p, double weight) {
    if (!p.valid || p.l.z == 0) return;
    add_kind(Leaf::kKinds & kDiffuseReflect, p, weight, sum_.diffuse_reflect);
    add_kind(Leaf::kKinds & kDiffuseTransmit, p, weight, sum_.diffuse_transmit);
    add_kind(Leaf::kKinds & kSpecularReflect, p, weight, sum_.specular_reflect);
    add_kind(Leaf::kKinds & kSpecularTransmit, p, weight, sum_.specular_transmit);
  }

  void add_kind(int kind, const Proposal& p, double weight, Rgb& sum) {
    if (kind == 0) return;
    const Directions d(v_, p.l, p.measure, static_cast<std::uint8_t>(kind));
    KindDensity density(d, static_cast<Lobes>(kind));
    visit_node(graph_, density, 1);
    if (density.sum() > 0) sum += graph_.evaluate(d, {}).f * (weight * d.l.z / density.sum());
  }

  const Graph& graph_;
  Vec3d v_;
  int turns_;
  std::vector<Node> nodes_;
  Albedo sum_;
};

}  // namespace gltfx::shader
