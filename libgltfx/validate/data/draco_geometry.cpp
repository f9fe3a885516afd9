// SPDX-License-Identifier: Apache-2.0
// Decodes geometry that is compressed by Draco, which no schema file can say anything about: the
// bytes are Draco's own.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "codec/client.hpp"
#include "model/draco.hpp"
#include "validate/data/draco_primitive.hpp"
#include "validate/data/phases.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

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
    if (decoded == nullptr) return;  // said of the buffer view or the buffer
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
