// SPDX-License-Identifier: Apache-2.0
#include "steps/accessor_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "json/writer.hpp"
#include "model/accessor_data.hpp"

namespace gltfx::steps {
namespace {

template <class T>
std::vector<double> bounds_of(Bound bound, std::string_view bytes, unsigned components) {
  std::vector<double> bounds;
  const std::size_t stride = sizeof(T) * components;
  for (unsigned component = 0; component < components; ++component) {
    T best{};
    for (std::size_t at = 0; at + stride <= bytes.size(); at += stride) {
      T value{};
      std::memcpy(&value, bytes.data() + at + sizeof(T) * component, sizeof(T));
      if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) return {};
      }
      const bool better = bound == Bound::least ? value < best : value > best;
      if (at == 0 || better) best = value;
    }
    bounds.push_back(static_cast<double>(best));
  }
  return bounds;
}

std::vector<double> bounds_of(Bound bound, const model::Format& format, std::string_view bytes) {
  return model::with_component_type(format.component, [&](auto sample) {
    return bounds_of<decltype(sample)>(bound, bytes, model::component_count(format.type));
  });
}

double nearest_float(double value) {
  if (std::abs(value) > std::numeric_limits<float>::max()) return value;
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace

std::string bound_text(Bound bound, const model::Format& format, std::string_view bytes) {
  const std::vector<double> bounds = bounds_of(bound, format, bytes);
  std::string text;
  if (bounds.empty()) return text;
  json::Writer writer(text);
  writer.begin_array();
  for (const double each : bounds) writer.number(each);
  writer.end_array();
  return text;
}

bool is_bound(const json::Document& document, json::NodeId array, Bound bound,
              const model::Format& format, std::string_view bytes) {
  if (document.kind(array) != json::Kind::number_array) return false;
  const bool single = format.component == model::ComponentType::float32;
  const std::vector<double> bounds = bounds_of(bound, format, bytes);
  std::size_t i = 0;
  for (json::NumberCursor at(document, array); at.valid(); at.advance(), ++i) {
    const double value = at.number().value;
    const double declared = single ? nearest_float(value) : value;
    if (i == bounds.size() || declared != bounds[i]) return false;
  }
  return i == bounds.size();
}

void mend_bounds(const json::Document& document, json::Editor& editor,
                 const model::Accessor& accessor, std::string_view bytes) {
  const auto mend = [&](json::NodeId array, Bound bound) {
    if (array == json::kNoNode) return;
    if (is_bound(document, array, bound, accessor.format, bytes)) return;
    std::string text = bound_text(bound, accessor.format, bytes);
    if (!text.empty()) editor.replace(accessor.node, array, std::move(text));
  };
  mend(accessor.min, Bound::least);
  mend(accessor.max, Bound::greatest);
}

std::string accessor_like(const json::Document& document, const model::Accessor& accessor,
                          const AccessorMembers& members, std::string_view bytes) {
  model::Format format = accessor.format;
  const bool is_other = members.component != model::ComponentType::none;
  if (is_other) format.component = members.component;
  const auto bounds = [&](Bound bound, json::NodeId declared) {
    std::string text = bound_text(bound, format, bytes);
    return text.empty() ? std::string(document.raw(declared)) : text;
  };
  std::string json = fmt::format(R"({{"count":{})", members.count);
  if (members.buffer_view) json += fmt::format(R"(,"bufferView":{})", *members.buffer_view);
  for (const auto member : document.members(accessor.node)) {
    const std::string_view name = document.key(member.key_id);
    if (name == "count" || name == "bufferView" || name == "byteOffset") continue;
    json += fmt::format(",{}:", document.raw(member.key));
    if (member.value == accessor.min) {
      json += bounds(Bound::least, member.value);
    } else if (member.value == accessor.max) {
      json += bounds(Bound::greatest, member.value);
    } else if (is_other && name == "componentType") {
      json += std::to_string(static_cast<unsigned>(format.component));
    } else {
      json += document.raw(member.value);
    }
  }
  return json.append(1, '}');
}

}  // namespace gltfx::steps
