// SPDX-License-Identifier: Apache-2.0
#include "prove/soup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "model/geometry.hpp"
#include "prove/column.hpp"
#include "prove/hash_sum.hpp"
#include "prove/primitive_pair.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;

constexpr unsigned kColorWidth = 4;

/// A stream before its place in the rows is known.
struct SoupColumn {
  SoupStream stream;
  Column column;
};

class SoupReader {
 public:
  SoupReader(const Side& side, json::NodeId object, const std::vector<double>& joints)
      : side_(side),
        primitive_(model::read_primitive(side.asset(), object)),
        data_(side.source(), primitive_),
        joints_(joints) {}

  Soup run() {
    if (!primitive_.mode || primitive_.targets_are_broken) soup_.readable = false;
    if (!primitive_.mode) return std::move(soup_);
    add_streams(primitive_.attributes, std::nullopt);
    for (std::size_t i = 0; i < primitive_.targets.size(); ++i) {
      add_streams(model::read_attributes(side_.asset(), primitive_.targets[i]), i);
    }
    std::sort(columns_.begin(), columns_.end(), [](const SoupColumn& a, const SoupColumn& b) {
      return a.stream.name < b.stream.name;
    });
    if (columns_.empty()) return std::move(soup_);
    if (!assemble()) {
      if (soup_.readable) {
        soup_.unread = side_.document().find(primitive_.node, "indices");
      }
      soup_.readable = false;
      return std::move(soup_);
    }
    read_rows();
    return std::move(soup_);
  }

 private:
  void add_streams(const std::vector<model::Attribute>& attributes,
                   std::optional<std::size_t> target) {
    for (const auto& [name, attribute] : by_name(attributes)) {
      auto column =
          target ? Column::open_target(side_, *attribute) : Column::open(side_, data_, *attribute);
      if (!column) {
        if (soup_.readable) soup_.unread = attribute->value;
        soup_.readable = false;
        continue;
      }
      SoupStream stream;
      stream.name = std::string(name);
      if (target) stream.name += fmt::format(" of target {}", *target);
      stream.kind = attribute->semantic.kind;
      stream.set = attribute->semantic.set;
      stream.of_target = target.has_value();
      stream.width = column->components();
      // A color without alpha is opaque.
      if (stream.kind == SemanticKind::color) stream.width = std::max(stream.width, kColorWidth);
      stream.value = attribute->value;
      columns_.push_back({std::move(stream), *std::move(column)});
    }
  }

  unsigned arity() const {
    if (model::draws_triangles(*primitive_.mode)) return 3;
    return *primitive_.mode == model::Mode::points ? 1 : 2;
  }

  // Indices without data are zeros: all points are the first vertex, and nothing else shows.
  bool assemble_zeros(std::uint32_t accessor) {
    const auto indices = Column::open(side_, accessor);
    if (!indices || !model::can_index_elements(indices->format().component)) return false;
    soup_.arity = arity();
    if (soup_.arity == 1 && vertices_ > 0) soup_.corners.assign(indices->count(), 0);
    return true;
  }

  bool assemble() {
    std::uint64_t vertices = UINT32_MAX;
    for (const SoupColumn& each : columns_) vertices = std::min(vertices, each.column.count());
    vertices_ = static_cast<std::uint32_t>(vertices);
    if (primitive_.indices && data_.packed() == nullptr) {
      // Their number is not bounded by bytes unless these are there.
      const auto indices = data_.open(primitive_.indices);
      if (!indices) return assemble_zeros(*primitive_.indices);
      if (indices->implied() && !side_.affords_implied(indices->count())) return false;
    }
    model::Geometry geometry;
    if (!model::assemble(data_, vertices_, geometry)) return false;
    std::vector<std::uint32_t>& list = soup_.corners;
    list = std::move(geometry.points);
    soup_.arity = arity();
    list.reserve(3 * geometry.triangles.size() + 2 * geometry.segments.size());
    for (const auto& each : geometry.triangles) list.insert(list.end(), each.begin(), each.end());
    for (const auto& each : geometry.segments) list.insert(list.end(), each.begin(), each.end());
    return true;
  }

  // JOINTS_n with the WEIGHTS_n of the same set; nothing where they do not fit.
  std::vector<std::pair<std::size_t, std::size_t>> influences() const {
    std::vector<std::pair<std::size_t, std::size_t>> sets;
    std::map<std::uint64_t, std::size_t> joints, weights;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const SoupStream& stream = columns_[i].stream;
      if (stream.of_target) continue;
      if (stream.kind == SemanticKind::joints) joints[stream.set] = i;
      if (stream.kind == SemanticKind::weights) weights[stream.set] = i;
    }
    if (joints.size() != weights.size()) return {};
    for (const auto& [set, at] : joints) {
      const auto other = weights.find(set);
      if (other == weights.end()) return {};
      if (columns_[at].stream.width != columns_[other->second].stream.width) return {};
      sets.emplace_back(at, other->second);
    }
    return sets;
  }

  void read_rows() {
    const auto sets = influences();
    std::vector<bool> joined(columns_.size());
    for (const auto& [joints, weights] : sets) joined[joints] = joined[weights] = true;
    std::vector<std::size_t> plain;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!joined[i]) plain.push_back(i);
    }
    std::vector<std::vector<std::pair<double, double>>> bound;
    std::size_t most = 0;
    if (!sets.empty()) bound = read_influences(sets, most);
    for (const std::size_t at : plain) add_stream(columns_[at].stream);
    if (!sets.empty()) {
      SoupStream stream = columns_[sets.front().second].stream;
      stream.joints = columns_[sets.front().first].stream.value;
      stream.width = static_cast<unsigned>(2 * most);
      add_stream(std::move(stream));
    }
    soup_.rows.assign(std::size_t{vertices_} * soup_.width, 0);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      read_column(columns_[plain[i]].column, soup_.streams[i]);
    }
    for (std::size_t vertex = 0; vertex < bound.size(); ++vertex) {
      double* to = soup_.rows.data() + vertex * soup_.width + soup_.streams.back().offset;
      for (const auto& [joint, weight] : bound[vertex]) {
        *to++ = joint;
        *to++ = weight;
      }
    }
  }

  void add_stream(SoupStream stream) {
    stream.offset = soup_.width;
    soup_.width += stream.width;
    soup_.streams.push_back(std::move(stream));
  }

  template <class Use>
  void each_element(const Column& column, const Use& use) const {
    constexpr std::size_t kBlock = 1024;
    const std::size_t size = column.packed_size();
    std::vector<std::byte> block(kBlock * size);
    std::uint64_t next = 0;
    for (std::uint64_t first = 0; first < vertices_; first += kBlock) {
      const auto count =
          static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, vertices_ - first));
      column.read(block.data(), first, count, next);
      for (std::size_t i = 0; i < count; ++i) {
        use(static_cast<std::size_t>(first) + i, column.decode(block.data() + i * size));
      }
    }
  }

  void read_column(const Column& column, const SoupStream& stream) {
    each_element(column, [&](std::size_t vertex, const Element& element) {
      double* to = soup_.rows.data() + vertex * soup_.width + stream.offset;
      for (unsigned k = 0; k < stream.width; ++k) {
        const double opaque = stream.of_target ? 0 : 1;
        const double value = k < column.components() ? element[k] : opaque;
        to[k] = std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value + 0.0;
      }
    });
  }

  std::vector<std::vector<std::pair<double, double>>> read_influences(
      const std::vector<std::pair<std::size_t, std::size_t>>& sets, std::size_t& most) const {
    std::vector<std::vector<std::pair<double, double>>> bound(vertices_);
    for (const auto& [joints, weights] : sets) {
      const unsigned width = columns_[joints].stream.width;
      std::vector<double> indices(std::size_t{vertices_} * width);
      each_element(columns_[joints].column, [&](std::size_t vertex, const Element& element) {
        std::copy_n(element.begin(), width,
                    indices.begin() + static_cast<std::ptrdiff_t>(vertex * width));
      });
      each_element(columns_[weights].column, [&](std::size_t vertex, const Element& element) {
        for (unsigned k = 0; k < width; ++k) {
          if (element[k] == 0) continue;
          bound[vertex].emplace_back(joint(indices[vertex * width + k]), element[k]);
        }
      });
    }
    for (auto& list : bound) {
      std::sort(list.begin(), list.end());
      std::size_t kept = 0;
      for (const auto& each : list) {
        if (kept > 0 && list[kept - 1].first == each.first) {
          list[kept - 1].second += each.second;
        } else {
          list[kept++] = each;
        }
      }
      list.resize(kept);
      most = std::max(most, kept);
    }
    return bound;
  }

  double joint(double index) const {
    const bool known = index >= 0 && index < static_cast<double>(joints_.size());
    return known ? joints_[static_cast<std::size_t>(index)] : index;
  }

  const Side& side_;
  const model::Primitive primitive_;
  const model::PrimitiveData data_;
  const std::vector<double>& joints_;
  std::vector<SoupColumn> columns_;
  std::uint32_t vertices_ = 0;
  Soup soup_;
};

model::Vector3 vector_at(const double* at) { return {at[0], at[1], at[2]}; }

void store(const model::Vector3& value, double* to) {
  for (std::size_t i = 0; i < 3; ++i) to[i] = value[i];
}

// Whether directions keep their numbers.
bool only_scales(const model::Affine& place) {
  const auto& c = place.columns;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (i != k && c[i][k] != 0) return false;
    }
  }
  return c[0][0] > 0 && c[0][0] == c[1][1] && c[1][1] == c[2][2];
}

}  // namespace

const SoupStream* Soup::find(SemanticKind kind) const {
  for (const SoupStream& stream : streams) {
    if (stream.kind == kind && stream.set == 0 && !stream.of_target) return &stream;
  }
  return nullptr;
}

Soup read_soup(const Side& side, json::NodeId primitive, const std::vector<double>& joints) {
  return SoupReader(side, primitive, joints).run();
}

void place_soup(Soup& soup, const model::Affine& place, const model::Affine& turn) {
  if (place == model::Affine{} && turn == place) return;
  const bool keeps_directions = only_scales(turn);
  // Normals are placed by the cofactors of the linear part.
  const auto& c = turn.columns;
  model::Affine cofactors;
  cofactors.columns = {model::cross(c[1], c[2]), model::cross(c[2], c[0]), model::cross(c[0], c[1]),
                       model::Vector3{}};
  if (turn.determinant() < 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (double& each : cofactors.columns[i]) each = -each;
    }
  }
  for (const SoupStream& stream : soup.streams) {
    if (stream.width < 3) continue;
    const bool normal = stream.kind == SemanticKind::normal;
    const bool tangent = stream.kind == SemanticKind::tangent;
    if (!normal && !tangent && stream.kind != SemanticKind::position) continue;
    if ((normal || tangent) && (keeps_directions || stream.of_target)) continue;
    for (std::size_t i = 0; i < soup.vertices(); ++i) {
      double* at = soup.rows.data() + i * soup.width + stream.offset;
      const model::Vector3 old = vector_at(at);
      if (normal) {
        store(model::unit(cofactors.vector(old)), at);
      } else if (tangent) {
        store(model::unit(turn.vector(old)), at);
      } else {
        store(stream.of_target ? place.vector(old) : place.point(old), at);
      }
    }
  }
  // A mirror turns triangles over, and renderers turn them back.
}

void append_soup(Soup& to, const Soup& from) {
  const auto first = static_cast<std::uint32_t>(to.vertices());
  const std::size_t begin = to.rows.size();
  to.rows.resize(begin + from.vertices() * to.width, 0);
  for (const SoupStream& stream : to.streams) {
    if (stream.kind == SemanticKind::color && !stream.of_target) {
      for (std::size_t at = begin; at < to.rows.size(); at += to.width) {
        std::fill_n(to.rows.begin() + static_cast<std::ptrdiff_t>(at + stream.offset), stream.width,
                    1.0);
      }
    }
    const auto source = std::find_if(from.streams.begin(), from.streams.end(),
                                     [&](const SoupStream& s) { return s.name == stream.name; });
    if (source == from.streams.end()) continue;
    const unsigned width = std::min(stream.width, source->width);
    for (std::size_t i = 0; i < from.vertices(); ++i) {
      std::copy_n(from.row(static_cast<std::uint32_t>(i)) + source->offset, width,
                  to.rows.data() + begin + i * to.width + stream.offset);
    }
  }
  for (const std::uint32_t corner : from.corners) to.corners.push_back(first + corner);
}

}  // namespace gltfx::prove
