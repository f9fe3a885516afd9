// SPDX-License-Identifier: Apache-2.0
// Vertices that are equal in all attributes and morph targets.
#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "base/equal_records.hpp"
#include "measure/vertex_use.hpp"

namespace gltfx::measure {
namespace {

using model::AccessorData;
using model::PrimitiveData;

// -0 becomes 0.
template <typename T>
T comparable(T value) {
  if constexpr (std::is_same_v<T, float>) return value + 0.0F;
  return value;
}

// An attribute of a primitive or of one of its targets.
struct VertexAttribute {
  model::Attribute attribute;
  bool own = false;  // of the primitive
};

class DuplicateVertices {
 public:
  DuplicateVertices(const Source& source, Column& column)
      : source_(source), budget_(geometry_bytes(source)), column_(column) {}

  void take(const std::vector<Subject>& subjects) {
    std::set<std::vector<std::uint64_t>> known;  // bitstream and accessors
    for (const Subject& subject : subjects) {
      const std::vector<VertexAttribute> attributes = all_attributes(*subject.primitive);
      if (attributes.empty()) {
        column_.does_not_apply(subject.element, "The primitive has no attributes.");
        continue;
      }
      std::vector<std::uint64_t> key{vertex_key(source_, *subject.primitive).first};
      for (const VertexAttribute& each : attributes) key.push_back(*each.attribute.accessor);
      if (known.insert(std::move(key)).second) {
        count(subject, attributes);
      } else {
        column_.set(subject.element, std::uint64_t{0});
      }
    }
  }

 private:
  // Each accessor once.
  std::vector<VertexAttribute> all_attributes(const model::Primitive& primitive) const {
    std::vector<VertexAttribute> all;
    const auto add = [&](const std::vector<model::Attribute>& attributes, bool own) {
      for (const model::Attribute& each : attributes) {
        if (each.accessor) all.push_back({each, own});
      }
    };
    add(primitive.attributes, true);
    for (const json::NodeId target : primitive.targets) {
      add(model::read_attributes(source_.asset(), target), false);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const VertexAttribute& a, const VertexAttribute& b) {
                       return *a.attribute.accessor < *b.attribute.accessor;
                     });
    const auto same = [](const VertexAttribute& a, const VertexAttribute& b) {
      return a.attribute.accessor == b.attribute.accessor;
    };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    return all;
  }

  void count(const Subject& subject, const std::vector<VertexAttribute>& attributes) {
    const PrimitiveData data(source_.geometry(), *subject.primitive);
    std::vector<AccessorData> columns;
    bool readable = true;
    for (const auto& [attribute, own] : attributes) {
      // Attributes of a bitstream have names; those of targets are in accessors.
      auto opened = own ? data.open(attribute) : data.open(attribute.accessor);
      readable = readable && (opened || is_implied(data, attribute));
      if (opened) columns.push_back(*std::move(opened));
    }
    if (!readable || columns.empty()) {
      return column_.could_not_be_taken(subject.element, "An attribute cannot be read.");
    }
    count(subject.element, columns);
  }

  // All elements are zeros, and so equal.
  bool is_implied(const PrimitiveData& data, const model::Attribute& attribute) const {
    const model::Accessor& accessor = source_.views().accessors[*attribute.accessor];
    const bool compressed = model::read_draco(source_.asset(), data.primitive()).has_value();
    return !compressed && !accessor.buffer_view && accessor.sparse == json::kNoNode;
  }

  void count(std::size_t element, const std::vector<AccessorData>& columns) {
    constexpr std::uint64_t kPerVertex = 24;  // of the search
    const std::uint64_t vertices = columns.front().count();
    std::uint64_t size = 0;
    for (const AccessorData& column : columns) {
      if (column.count() != vertices) {
        return column_.could_not_be_taken(element, "The attributes differ in length.");
      }
      size += std::uint64_t{column.components()} * model::component_size(column.format().component);
    }
    if (vertices >= UINT32_MAX || !budget_.take(checked_mul(vertices, size + kPerVertex))) {
      return column_.could_not_be_taken(element, kTooLarge);
    }
    const auto first = first_equal_records(records_of(columns, static_cast<std::size_t>(size)),
                                           static_cast<std::size_t>(size));
    std::uint64_t repeated = 0;
    for (std::uint32_t i = 0; i < first.size(); ++i) repeated += first[i] == i ? 0 : 1;
    column_.set(element, repeated);
  }

  static std::string records_of(const std::vector<AccessorData>& columns, std::size_t size) {
    std::string records(static_cast<std::size_t>(columns.front().count()) * size, '\0');
    std::size_t offset = 0;
    for (const AccessorData& column : columns) {
      const unsigned components = column.components();
      model::with_component_type(column.format().component, [&](auto zero) {
        using T = decltype(zero);
        column.visit<T>([&](const T* values, std::size_t elements, std::uint64_t first) {
          char* to = records.data() + static_cast<std::size_t>(first) * size + offset;
          for (std::size_t i = 0; i < elements; ++i, to += size) {
            for (unsigned k = 0; k < components; ++k) {
              const T value = comparable(values[i * components + k]);
              std::memcpy(to + k * sizeof(T), &value, sizeof(T));
            }
          }
        });
        offset += components * sizeof(T);
      });
    }
    return records;
  }

  const Source& source_;
  model::MemoryBudget budget_;
  Column& column_;
};

}  // namespace

void count_duplicate_vertices(const Source& source, const std::vector<Subject>& subjects,
                              Column& column) {
  DuplicateVertices(source, column).take(subjects);
}

}  // namespace gltfx::measure
