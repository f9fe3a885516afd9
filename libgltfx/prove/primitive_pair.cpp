// SPDX-License-Identifier: Apache-2.0
#include "prove/primitive_pair.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace gltfx::prove {
namespace {

using model::Attribute;
using model::Mode;
using model::Primitive;
using model::PrimitiveData;

/// One side of a pair.
struct Opened {
  Opened(const Side& of, json::NodeId object)
      : side(of),
        primitive(model::read_primitive(of.asset(), object)),
        data(of.source(), primitive) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  const Side& side;
  const Primitive primitive;
  const PrimitiveData data;
};

class PairReader {
 public:
  PairReader(const Opened& ours, const Opened& theirs, Differences& found)
      : ours_(ours), theirs_(theirs), found_(found) {}

  std::optional<PrimitivePair> run() {
    const Primitive& before = ours_.primitive;
    const Primitive& after = theirs_.primitive;
    if (!before.mode) return std::nullopt;
    if (!after.mode) return differ("has no mode");
    read_attributes(before.attributes, after.attributes, std::nullopt);
    if (!before.targets_are_broken && before.targets.size() != after.targets.size()) {
      return differ(fmt::format("has {} morph targets in place of {}", after.targets.size(),
                                before.targets.size()));
    }
    for (std::size_t i = 0; i < before.targets.size(); ++i) {
      read_attributes(model::read_attributes(ours_.side.asset(), before.targets[i]),
                      model::read_attributes(theirs_.side.asset(), after.targets[i]), i);
    }
    if (pair_.streams.empty()) return std::nullopt;
    if (!read_corners(ours_, &Stream::ours, pair_.ours)) {
      found_.leave_out(pointer(), "has indices that cannot be read");
      return std::nullopt;
    }
    if (!read_corners(theirs_, &Stream::theirs, pair_.theirs)) {
      return differ("has indices that can no longer be read");
    }
    return std::move(pair_);
  }

 private:
  std::string pointer() const { return ours_.side.pointer(ours_.primitive.node); }
  std::optional<PrimitivePair> differ(std::string what) {
    found_.add(pointer(), std::move(what));
    return std::nullopt;
  }

  void read_attributes(const std::vector<Attribute>& before, const std::vector<Attribute>& after,
                       std::optional<std::size_t> target) {
    const auto here = by_name(before);
    const auto there = by_name(after);
    for (const auto& [name, attribute] : here) {
      const auto other = there.find(name);
      if (other == there.end()) {
        found_.add(ours_.side.pointer(attribute->value), "is gone");
      } else {
        read(*attribute, *other->second, target);
      }
    }
    for (const auto& [name, attribute] : there) {
      if (!here.contains(name)) found_.add(pointer(), fmt::format("has a new {}", name));
    }
  }

  void read(const Attribute& before, const Attribute& after, std::optional<std::size_t> target) {
    const std::string place = ours_.side.pointer(before.value);
    const auto open = [&](const auto& opened, const Attribute& attribute) {
      return target ? Column::open_target(opened.side, attribute)
                    : Column::open(opened.side, opened.data, attribute);
    };
    auto here = open(ours_, before);
    if (!here) return found_.leave_out(place, "cannot be read");
    auto there = open(theirs_, after);
    if (!there) return found_.add(place, "can no longer be read");
    if (here->components() != there->components()) {
      return found_.add(place, fmt::format("has {} components in place of {}", there->components(),
                                           here->components()));
    }
    std::string name(before.name);
    if (target) name += fmt::format(" of target {}", *target);
    pair_.streams.push_back({std::move(name), before.semantic.kind, target.has_value(),
                             before.value, *std::move(here), *std::move(there)});
  }

  bool read_corners(const Opened& opened, Column Stream::*column, Corners& corners) {
    corners.vertices = UINT32_MAX;
    for (const Stream& stream : pair_.streams) {
      corners.vertices = std::min(corners.vertices, (stream.*column).count());
    }
    corners.mode = *opened.primitive.mode;
    if (const codec::DracoMesh* mesh = opened.data.packed()) {
      if (model::draws_triangles(corners.mode)) corners.mode = Mode::triangles;
      corners.indices.assign(mesh->indices.begin(), mesh->indices.end());
      return true;
    }
    if (opened.primitive.indices_node == json::kNoNode) {
      corners.indices.resize(static_cast<std::size_t>(corners.vertices));
      std::iota(corners.indices.begin(), corners.indices.end(), 0U);
      return true;
    }
    if (!opened.primitive.indices) return false;
    const auto indices = Column::open(opened.side, *opened.primitive.indices);
    if (!indices || indices->components() != 1) return false;
    if (!model::can_index_elements(indices->format().component)) return false;
    corners.restart =
        static_cast<std::uint32_t>(model::value_range(indices->format().component).most);
    corners.indices = read_indices(*indices);
    return true;
  }

  const Opened& ours_;
  const Opened& theirs_;
  Differences& found_;
  PrimitivePair pair_;
};

}  // namespace

std::string Stream::quantity() const {
  const std::string_view prefix = model::semantic_prefix(kind);
  return prefix.empty() ? name : std::string(prefix);
}

std::size_t Corners::arity() const {
  if (model::draws_triangles(mode)) return 3;
  return mode == Mode::points ? 1 : 2;
}

std::vector<std::uint32_t> Corners::assembled() const {
  model::Geometry geometry;
  const auto count = static_cast<std::uint32_t>(vertices);
  model::PrimitiveAssembly assembly(mode, count, restart, geometry);
  for (const std::uint32_t index : indices) assembly.add(index);
  assembly.finish();
  std::vector<std::uint32_t> list = std::move(geometry.points);
  list.reserve(3 * geometry.triangles.size() + 2 * geometry.segments.size());
  for (const auto& each : geometry.triangles) list.insert(list.end(), each.begin(), each.end());
  for (const auto& each : geometry.segments) list.insert(list.end(), each.begin(), each.end());
  return list;
}

std::map<std::string_view, const Attribute*> by_name(const std::vector<Attribute>& attributes) {
  std::map<std::string_view, const Attribute*> names;
  for (const Attribute& attribute : attributes) names[attribute.name] = &attribute;
  return names;
}

std::string storage_key(const Side& side, json::NodeId object) {
  const Primitive primitive = model::read_primitive(side.asset(), object);
  const auto draco = model::read_draco(side.asset(), primitive);
  std::string key =
      fmt::format("{} {} {} {};", primitive.mode ? static_cast<int>(*primitive.mode) : -1,
                  primitive.indices_node != json::kNoNode,
                  primitive.indices ? std::int64_t{*primitive.indices} : -1,
                  draco ? std::int64_t{draco->buffer_view} : -1);
  const auto add = [&](const std::vector<Attribute>& attributes) {
    for (const Attribute& one : attributes) {
      const auto id = draco ? model::draco_id(side.asset(), *draco, one.name) : std::nullopt;
      // Names have any characters: their lengths tell where they end.
      key += fmt::format("{}:{} {} ", one.name.size(), one.name,
                         one.accessor ? std::int64_t{*one.accessor} : -1);
      key += id ? fmt::format("{},", *id) : std::string(",");
    }
    key += ';';
  };
  add(primitive.attributes);
  key += primitive.targets_are_broken ? "broken" : "";
  for (const json::NodeId target : primitive.targets) {
    add(model::read_attributes(side.asset(), target));
  }
  return key;
}

std::optional<PrimitivePair> open_pair(const Side& before, const Side& after, json::NodeId ours,
                                       json::NodeId theirs, Differences& found) {
  const Opened here(before, ours);
  const Opened there(after, theirs);
  return PairReader(here, there, found).run();
}

}  // namespace gltfx::prove
