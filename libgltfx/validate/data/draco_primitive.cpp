// SPDX-License-Identifier: Apache-2.0
#include "validate/data/draco_primitive.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::Accessor;
using model::AccessorData;
using model::ComponentType;
using model::Format;

std::string text_of(const codec::DracoAttribute& attribute) {
  const Format format = model::format_of(attribute, false);
  if (format.known()) return model::format_text(format);
  return fmt::format("{} components of a type that glTF does not support", attribute.components);
}

// Indices as numbers of type T.
template <typename T>
container::Bytes narrowed(std::span<const std::uint32_t> indices) {
  auto memory = std::make_shared<std::vector<T>>(indices.size());
  std::transform(indices.begin(), indices.end(), memory->begin(),
                 [](std::uint32_t index) { return static_cast<T>(index); });
  return {std::as_bytes(std::span<const T>(*memory)), memory};
}

container::Bytes index_bytes(const codec::DracoMesh& mesh, ComponentType type) {
  if (type == ComponentType::uint8) return narrowed<std::uint8_t>(mesh.indices);
  if (type == ComponentType::uint16) return narrowed<std::uint16_t>(mesh.indices);
  return {std::as_bytes(mesh.indices), mesh.owner};
}

class PrimitiveCheck {
 public:
  PrimitiveCheck(DataPhase& phase, const DracoPrimitive& primitive, std::string_view extension,
                 const codec::DracoMesh& mesh)
      : phase_(phase), site_(primitive), extension_(extension), mesh_(mesh) {}

  void run() {
    const json::Document& document = phase_.context.document;
    const json::NodeId ids = model::object_member(document, site_.reference.object, "attributes");
    if (ids != json::kNoNode) {
      for (const auto member : document.members(ids)) {
        const auto id = document.unsigned_integer(member.value);
        if (id) check_attribute(document.key(member.key_id), member.value, *id);
      }
    }
    check_indices();
  }

 private:
  const Accessor& accessor(std::uint32_t index) const {
    return phase_.context.views.accessors[index];
  }

  void report(std::string_view name, json::NodeId value, Code code, std::string message) {
    with_draco_path(site_, extension_, [&](const Path& path) {
      const Path attributes(path, "attributes");
      phase_.sink.report(Path(attributes, name),
                         finding_on(phase_.context, value, code, std::move(message)));
    });
  }

  void report_indices(Code code, std::string message) {
    with_primitive_path(site_, [&](const Path& path) {
      phase_.sink.report(
          Path(path, "indices"),
          finding_on(phase_.context, site_.primitive->indices_node, code, std::move(message)));
    });
  }

  void check_attribute(std::string_view name, json::NodeId value, std::uint64_t id) {
    const auto& plain = site_.primitive->attributes;
    const auto attribute = std::find_if(plain.begin(), plain.end(),
                                        [&](const auto& each) { return each.name == name; });
    if (attribute == plain.end()) return;  // said of the extension
    const codec::DracoAttribute* decoded = model::find_attribute(mesh_, id);
    if (decoded == nullptr) {
      return report(name, value, Code::DRACO_ATTRIBUTE_ID_UNKNOWN,
                    fmt::format("The Draco data has no attribute with the ID {}.", id));
    }
    if (!attribute->accessor) return;
    const bool sound = check_format(name, value, *attribute->accessor, *decoded) &&
                       check_count(name, value, *attribute->accessor);
    if (sound) keep(*attribute->accessor, *decoded);
  }

  // True when the accessor says what the bitstream holds.
  bool check_format(std::string_view name, json::NodeId value, std::uint32_t index,
                    const codec::DracoAttribute& decoded) {
    const Format& format = accessor(index).format;
    if (!format.known()) return false;
    if (model::format_of(decoded, format.normalized) == format) return true;
    report(name, value, Code::DRACO_FORMAT_MISMATCH,
           fmt::format("The Draco data is {}, but accessor {} is {}.", text_of(decoded), index,
                       model::format_text(format)));
    return false;
  }

  // Accessors that agree with each other but not with the bitstream are one error.
  bool check_count(std::string_view name, json::NodeId value, std::uint32_t index) {
    const auto& count = accessor(index).count;
    if (!count || *count == mesh_.points) return count.has_value();
    if (!reported_counts_.insert(*count).second) return false;
    report(name, value, Code::DRACO_COUNT_MISMATCH,
           fmt::format("The Draco data has {} points, but accessor {} has {} elements.",
                       mesh_.points, index, *count));
    return false;
  }

  void keep(std::uint32_t index, const codec::DracoAttribute& decoded) {
    if (!needs_data(index)) return;
    auto data = AccessorData::packed(accessor(index).format, mesh_.points,
                                     {decoded.values, mesh_.owner}, decoded.quantization_step);
    if (data) phase_.decoded.emplace(index, *std::move(data));
  }

  // A plain copy beside the bitstream is checked by itself.
  bool needs_data(std::uint32_t index) const {
    const Accessor& target = accessor(index);
    return !target.buffer_view && target.sparse == json::kNoNode;
  }

  void check_indices() {
    if (!site_.primitive->indices) return;
    const std::uint32_t index = *site_.primitive->indices;
    const Accessor& target = accessor(index);
    const std::uint64_t count = mesh_.indices.size();
    // How a strip is made of triangles is up to the reader.
    if (site_.primitive->mode != model::Mode::triangles || !target.count) return;
    // Where the points do not go with the accessors, neither do indices of them: that has been
    // said.
    if (!reported_counts_.empty()) return;
    if (*target.count != count) {
      return report_indices(Code::DRACO_COUNT_MISMATCH,
                            fmt::format("The number of triangles in the Draco data is {} ({} "
                                        "indices), but accessor {} has {} elements.",
                                        mesh_.faces, count, index, *target.count));
    }
    const ComponentType type = target.format.component;
    if (!model::can_index_elements(type) || target.format.type != model::ElementType::scalar)
      return;
    if (mesh_.points > 0 && !model::value_range(type).contains(mesh_.points - 1.0)) {
      return report_indices(
          Code::DRACO_INDEX_TYPE_TOO_SMALL,
          fmt::format("The Draco data has {} points, which exceeds the range of {}.", mesh_.points,
                      model::component_type_name(type)));
    }
    if (!needs_data(index)) return;
    auto data = AccessorData::packed(target.format, count, index_bytes(mesh_, type), 0);
    if (data) phase_.decoded.emplace(index, *std::move(data));
  }

  DataPhase& phase_;
  const DracoPrimitive& site_;
  std::string_view extension_;
  const codec::DracoMesh& mesh_;
  std::set<std::uint64_t> reported_counts_;
};

}  // namespace

void check_draco_primitive(DataPhase& phase, const DracoPrimitive& primitive,
                           std::string_view extension, const codec::DracoMesh& mesh) {
  PrimitiveCheck(phase, primitive, extension, mesh).run();
}

}  // namespace gltfx::validate
