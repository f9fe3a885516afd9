// SPDX-License-Identifier: Apache-2.0
// Decodes geometry compressed by Draco, which no schema file can describe: the bytes have Draco's
// own format.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "codec/client.hpp"
#include "model/draco.hpp"
#include "model/fields.hpp"
#include "model/mesh.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

struct DracoPrimitive {
  std::uint32_t mesh = 0;
  std::uint32_t index = 0;  ///< in the mesh
  const model::Primitive* primitive = nullptr;
  model::DracoReference reference;
};

/// Calls `use` with the path of the primitive.
template <typename Use>
void with_primitive_path(const DracoPrimitive& primitive, Use&& use) {
  const Path root;
  const Path meshes(root, "meshes");
  const Path mesh(meshes, std::uint64_t{primitive.mesh});
  const Path primitives(mesh, "primitives");
  use(Path(primitives, std::uint64_t{primitive.index}));
}

/// Calls `use` with the path of the extension's object on the primitive.
template <typename Use>
void with_draco_path(const DracoPrimitive& primitive, std::string_view extension, Use&& use) {
  with_primitive_path(primitive, [&](const Path& path) {
    const Path extensions(path, "extensions");
    use(Path(extensions, extension));
  });
}

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
    if (attribute == plain.end()) return;  // reported for the extension
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

  // True if the accessor matches the bitstream.
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

  // A plain copy of the data is checked separately.
  bool needs_data(std::uint32_t index) const {
    const Accessor& target = accessor(index);
    return !target.buffer_view && target.sparse == json::kNoNode;
  }

  void check_indices() {
    if (!site_.primitive->indices) return;
    const std::uint32_t index = *site_.primitive->indices;
    const Accessor& target = accessor(index);
    const std::uint64_t count = mesh_.indices.size();
    // Readers choose how to split a strip into triangles.
    if (site_.primitive->mode != model::Mode::triangles || !target.count) return;
    // If the points do not match the accessors, neither do the indices of points: that is reported
    // already.
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

// Compares a decoded mesh with the accessors of its primitive: ids, formats, counts, and the range
// of indices. Elements of accessors that match and have no other data go to `phase.decoded`.
void check_draco_primitive(DataPhase& phase, const DracoPrimitive& primitive,
                           std::string_view extension, const codec::DracoMesh& mesh) {
  PrimitiveCheck(phase, primitive, extension, mesh).run();
}

constexpr std::string_view kDracoGeometryExtension = model::kDracoExtension;

class GeometryDecoding {
 public:
  explicit GeometryDecoding(DataPhase& phase) : phase_(phase) {}

  void run() {
    if (!has_objects_of(phase_.context, kDracoGeometryExtension)) return;
    collect();
    meshes_.decode(codec::Client::shared(), phase_.context.options.jobs);
    for (const DracoPrimitive& primitive : primitives_) check(primitive);
  }

 private:
  void collect() {
    const Context& context = phase_.context;
    for (std::uint32_t m = 0; m < context.views.meshes.size(); ++m) {
      const auto& primitives = context.views.meshes[m].primitives;
      for (std::uint32_t i = 0; i < primitives.size(); ++i) {
        const auto reference = model::read_draco(context.asset, primitives[i]);
        if (!reference) continue;
        primitives_.push_back({m, i, &primitives[i], *reference});
        meshes_.add(context.asset, context.views, phase_.resources, reference->buffer_view);
      }
    }
  }

  void check(const DracoPrimitive& primitive) {
    const auto* decoded = meshes_.find(primitive.reference.buffer_view);
    if (decoded == nullptr) return;  // reported for the buffer view or the buffer
    if (const auto* mesh = std::get_if<codec::DracoMesh>(decoded)) {
      return check_draco_primitive(phase_, primitive, kDracoGeometryExtension, *mesh);
    }
    const auto* error = std::get_if<codec::DecodeError>(decoded);
    const bool known = error != nullptr && error->kind != codec::ErrorKind::unavailable &&
                       error->kind != codec::ErrorKind::stalled;
    const Code code = !known             ? Code::DRACO_NOT_CHECKED
                      : is_limit(*error) ? Code::DRACO_LIMIT_EXCEEDED
                                         : Code::DRACO_DECODE_FAILED;
    std::string message = error != nullptr
                              ? error->message
                              : "Other Draco data in the file reached the limit on decoding.";
    with_draco_path(primitive, kDracoGeometryExtension, [&](const Path& path) {
      report_member(phase_.sink, phase_.context, path, primitive.reference.object, "bufferView",
                    code, std::move(message));
    });
  }

  static bool is_limit(const codec::DecodeError& error) {
    return error.kind == codec::ErrorKind::out_of_memory ||
           error.kind == codec::ErrorKind::timed_out;
  }

  DataPhase& phase_;
  std::vector<DracoPrimitive> primitives_;
  model::DracoMeshes meshes_;
};

}  // namespace

void decode_geometry(DataPhase& phase) { GeometryDecoding(phase).run(); }

}  // namespace gltfx::validate
