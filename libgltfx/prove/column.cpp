// SPDX-License-Identifier: Apache-2.0
#include "prove/column.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "model/elements.hpp"

namespace gltfx::prove {
namespace {

using model::AccessorData;

constexpr std::size_t kBlock = 1024;  // elements

double angle(const Element& a, const Element& b) {
  const model::Vector3 p{a[0], a[1], a[2]};
  const model::Vector3 q{b[0], b[1], b[2]};
  // A vector of length 0 has no direction, and atan2(0, 0) is 0.
  const bool turns = model::dot(p, p) > 0;
  if (turns != (model::dot(q, q) > 0)) return std::numeric_limits<double>::infinity();
  const model::Vector3 across = model::cross(p, q);
  const double sine = std::sqrt(model::dot(across, across));
  const double degrees = std::atan2(sine, model::dot(p, q)) * 180 / std::numbers::pi;
  return std::isnan(degrees) ? std::numeric_limits<double>::infinity() : degrees;
}

bool same_components(const Element& a, const Element& b, unsigned components) {
  for (unsigned i = 0; i < components; ++i) {
    if (apart(a[i], b[i]) > 0) return false;
  }
  return true;
}

}  // namespace

double apart(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double difference = std::fabs(a - b);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double distance(Metric metric, const Element& a, const Element& b, unsigned components) {
  if (same_components(a, b, components)) return 0;
  const unsigned vector = metric == Metric::component ? 0 : std::min(components, 3U);
  double greatest = 0;
  for (unsigned i = vector; i < components; ++i) greatest = std::max(greatest, apart(a[i], b[i]));
  // A difference of w is not in degrees.
  if (metric == Metric::direction && greatest > 0) return std::numeric_limits<double>::infinity();
  if (metric == Metric::euclidean) {
    double square = 0;
    for (unsigned i = 0; i < vector; ++i) square += std::pow(apart(a[i], b[i]), 2);
    greatest = std::max(greatest, std::sqrt(square));
  } else if (metric == Metric::direction) {
    greatest = std::max(greatest, angle(a, b));
    // If only the lengths differ, there is no angle, but the vectors are not equal.
    if (greatest == 0) greatest = std::numeric_limits<double>::min();
  }
  return greatest;
}

std::optional<Column> Column::make(const Side& side, std::uint32_t accessor,
                                   std::optional<AccessorData> data) {
  Column column;
  if (data) {
    if (data->implied() && !side.affords_implied(data->count())) return std::nullopt;
    column.format_ = data->format();
    column.count_ = data->count();
    column.data_ = std::move(data);
    return column;
  }
  const model::Accessor& described = side.views().accessors[accessor];
  const json::Document& document = side.document();
  if (document.find(described.node, "bufferView") != json::kNoNode) return std::nullopt;
  if (described.sparse != json::kNoNode || !described.format.known()) return std::nullopt;
  if (!model::is_core_component(described.format.component)) return std::nullopt;
  if (!described.count || !side.affords_implied(*described.count)) return std::nullopt;
  column.format_ = described.format;
  column.count_ = *described.count;
  return column;
}

std::optional<Column> Column::open(const Side& side, std::uint32_t accessor) {
  return make(side, accessor, side.open(accessor));
}

std::optional<Column> Column::open(const Side& side, const model::PrimitiveData& data,
                                   const model::Attribute& attribute) {
  if (!attribute.accessor) return std::nullopt;
  auto elements = data.open(attribute);
  // The accessor of an attribute in a bitstream has no stored data, but its elements are not zeros.
  const auto reference =
      elements ? std::nullopt : model::read_draco(side.asset(), data.primitive());
  if (reference &&
      (data.packed() == nullptr || model::draco_id(side.asset(), *reference, attribute.name))) {
    return std::nullopt;
  }
  return make(side, *attribute.accessor, std::move(elements));
}

std::optional<Column> Column::open_target(const Side& side, const model::Attribute& attribute) {
  return attribute.accessor ? open(side, *attribute.accessor) : std::nullopt;
}

std::size_t Column::packed_size() const {
  return std::size_t{components()} * model::component_size(format_.component);
}

Element Column::decode(const std::byte* from) const {
  Element element{};
  const unsigned count = components();
  model::with_component_type(format_.component, [&](auto zero) {
    using T = decltype(zero);
    for (unsigned i = 0; i < count; ++i) {
      T value;
      std::memcpy(&value, from + i * sizeof(T), sizeof(T));
      // Integers of 32 bits do not fit into floats.
      element[i] = format_.normalized ? static_cast<double>(model::to_float(value, true))
                                      : static_cast<double>(value);
    }
  });
  return element;
}

Element Column::at(std::uint64_t index) const {
  if (!data_) return {};
  std::array<std::byte, 16 * sizeof(float)> bytes;
  data_->read_one(bytes.data(), index);
  return decode(bytes.data());
}

void Column::read(std::byte* to, std::uint64_t first, std::size_t count,
                  std::uint64_t& next) const {
  if (data_) {
    data_->read(to, first, count, next);
  } else {
    std::memset(to, 0, count * packed_size());
  }
}

Farthest farthest(Metric metric, const Column& a, const Column& b) {
  Farthest found;
  std::vector<std::byte> ours(kBlock * a.packed_size());
  std::vector<std::byte> theirs(kBlock * b.packed_size());
  std::uint64_t next_here = 0;
  std::uint64_t next_there = 0;
  for (std::uint64_t first = 0; first < a.count(); first += kBlock) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, a.count() - first));
    a.read(ours.data(), first, count, next_here);
    b.read(theirs.data(), first, count, next_there);
    if (a.format() == b.format() &&
        std::memcmp(ours.data(), theirs.data(), count * a.packed_size()) == 0) {
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double apart = distance(metric, a.decode(ours.data() + i * a.packed_size()),
                                    b.decode(theirs.data() + i * b.packed_size()), a.components());
      if (apart > found.distance) found = {apart, first + i};
    }
  }
  return found;
}

std::vector<std::uint32_t> read_indices(const Column& column) {
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(column.count()));
  const std::size_t size = column.packed_size();
  std::vector<std::byte> block(kBlock * size);
  std::uint64_t next = 0;
  for (std::uint64_t first = 0; first < column.count(); first += kBlock) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, column.count() - first));
    column.read(block.data(), first, count, next);
    for (std::size_t i = 0; i < count; ++i) {
      indices.push_back(static_cast<std::uint32_t>(column.decode(block.data() + i * size)[0]));
    }
  }
  return indices;
}

}  // namespace gltfx::prove
