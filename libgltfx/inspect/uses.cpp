// SPDX-License-Identifier: Apache-2.0
#include "inspect/uses.hpp"

#include <algorithm>

#include "schema/check.hpp"

namespace gltfx::inspect {
namespace {

using model::RootArray;

/// An element of a root array, by where it stands in the text.
struct Region {
  Span span;
  RootArray array = RootArray::meshes;
  std::uint32_t index = 0;
};

/// References are told by their place in the text: what stands around it is who refers.
class Regions {
 public:
  explicit Regions(const model::Asset& asset) {
    for (const RootArray array : {RootArray::meshes, RootArray::images, RootArray::animations,
                                  RootArray::skins, RootArray::accessors}) {
      const auto& elements = asset.elements(array);
      for (std::size_t i = 0; i < elements.size(); ++i) {
        if (elements[i] == json::kNoNode) continue;
        regions_.push_back(
            {asset.document().span(elements[i]), array, static_cast<std::uint32_t>(i)});
      }
    }
    std::sort(regions_.begin(), regions_.end(),
              [](const Region& a, const Region& b) { return a.span.begin < b.span.begin; });
  }

  /// The region that holds a byte of the text, or null.
  const Region* at(std::uint32_t position) const {
    auto next = std::upper_bound(
        regions_.begin(), regions_.end(), position,
        [](std::uint32_t wanted, const Region& region) { return wanted < region.span.begin; });
    if (next == regions_.begin()) return nullptr;
    --next;
    return position < next->span.end ? &*next : nullptr;
  }

 private:
  std::vector<Region> regions_;
};

Owner owner_of(const Region* region) {
  if (region == nullptr) return {};
  switch (region->array) {
    case RootArray::meshes:
      return {ByteUse::meshes, region->index};
    case RootArray::images:
      return {ByteUse::images, region->index};
    case RootArray::animations:
      return {ByteUse::animations, region->index};
    case RootArray::skins:
      return {ByteUse::skins, region->index};
    default:
      return {};
  }
}

class Reader {
 public:
  Reader(const model::Asset& asset, Uses& uses) : asset_(asset), regions_(asset), uses_(uses) {
    uses_.accessors.resize(asset.count(RootArray::accessors));
  }

  void note(std::string_view array, std::uint64_t index, Span span) {
    if (array == "/accessors" && asset_.index(static_cast<double>(index), RootArray::accessors)) {
      auto& owner = uses_.accessors[index];
      const Owner user = owner_of(regions_.at(span.begin));
      if (!owner || user.use < owner->use) owner = user;
    }
    if (array != "/bufferViews") return;
    const auto view = asset_.index(static_cast<double>(index), RootArray::buffer_views);
    if (!view) return;
    const Region* region = regions_.at(span.begin);
    ViewUse use{*view, owner_of(region), std::nullopt};
    if (region != nullptr && region->array == RootArray::accessors) use.accessor = region->index;
    uses_.views.push_back(use);
  }

 private:
  const model::Asset& asset_;
  const Regions regions_;
  Uses& uses_;
};

}  // namespace

Uses find_uses(const model::Asset& asset, const schema::Set& schemas) {
  Uses uses;
  Reader reader(asset, uses);
  const schema::ReferenceVisitor visit = [&reader](const schema::ReferenceUse& use) {
    reader.note(use.array, use.index, use.span);
  };
  schema::CheckOptions options;
  options.references = &visit;
  schema::NoFindings nobody;
  uses.checked = schema::check(asset.document(), schemas, options, nobody, nobody);
  return uses;
}

}  // namespace gltfx::inspect
