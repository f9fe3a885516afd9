// SPDX-License-Identifier: Apache-2.0
// Decodes KHR_draco_mesh_compression, which no schema file can say anything about: the bytes are
// Draco's own. This file is about that extension and names it.
#include <atomic>
#include <variant>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "codec/client.hpp"
#include "model/fields.hpp"
#include "validate/data/draco_primitive.hpp"
#include "validate/data/phases.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kExtension = "KHR_draco_mesh_compression";

// Payloads that run into a limit cost a second each: one file gets no more than two of them.
constexpr int kMostCostly = 2;
// Decoded bytes of one file: those of a few million triangles, and more where there are more bytes
// to decode.
constexpr std::uint64_t kFreeResultBytes = std::uint64_t{128} << 20U;
constexpr std::uint64_t kResultBytesPerByte = 128;

struct NotLookedAt {};
using Decoded = std::variant<NotLookedAt, codec::DracoMesh, codec::Fault>;

// A buffer view with a bitstream.
struct Payload {
  container::Bytes bytes;
  Decoded decoded;
};

std::uint64_t size_of(const codec::DracoMesh& mesh) {
  std::uint64_t size = mesh.indices.size_bytes();
  for (const codec::DracoAttribute& attribute : mesh.attributes) size += attribute.values.size();
  return size;
}

bool is_costly(const codec::Fault& fault) {
  return fault.kind == codec::FaultKind::out_of_memory ||
         fault.kind == codec::FaultKind::timed_out || fault.kind == codec::FaultKind::died;
}

class GeometryDecoding {
 public:
  explicit GeometryDecoding(DataPhase& phase) : phase_(phase) {}

  void run() {
    if (!has_objects_of(phase_.context, kExtension)) return;
    collect();
    decode();
    for (const DracoPrimitive& primitive : primitives_) check(primitive);
  }

 private:
  void collect() {
    const Context& context = phase_.context;
    for (std::uint32_t m = 0; m < context.views.meshes.size(); ++m) {
      const auto& primitives = context.views.meshes[m].primitives;
      for (std::uint32_t i = 0; i < primitives.size(); ++i) collect({m, i, &primitives[i]});
    }
  }

  void collect(DracoPrimitive primitive) {
    const Context& context = phase_.context;
    const json::NodeId host = primitive.primitive->node;
    if (host == json::kNoNode) return;
    primitive.object = model::extension_object(context.document, host, kExtension);
    if (primitive.object == json::kNoNode) return;
    const auto index =
        context.asset.index(primitive.object, "bufferView", model::RootArray::buffer_views);
    if (!index) return;
    const model::BufferView& view = context.views.buffer_views[*index];
    if (!view.byte_length) return;
    const auto [at, fresh] = positions_.try_emplace(*index, payloads_.size());
    if (fresh) {
      auto bytes = phase_.resources.part(context.document, view, 0, *view.byte_length);
      payloads_.push_back({bytes ? *std::move(bytes) : container::Bytes(), NotLookedAt{}});
    }
    primitive.payload = at->second;
    primitives_.push_back(primitive);
  }

  // What is given up, and from where on, does not depend on the number of threads.
  void decode() {
    std::atomic<bool> stopped = false;
    std::uint64_t left = kFreeResultBytes;
    for (const Payload& payload : payloads_) left += payload.bytes.size() * kResultBytesPerByte;
    int costly = 0;
    parallel_ordered(
        payloads_.size(), phase_.context.options.jobs,
        [&](std::size_t i) {
          if (!stopped && !payloads_[i].bytes.empty()) decode(payloads_[i]);
        },
        [&](std::size_t i) {
          Decoded& decoded = payloads_[i].decoded;
          if (stopped) decoded = NotLookedAt{};
          const auto* fault = std::get_if<codec::Fault>(&decoded);
          const auto* mesh = std::get_if<codec::DracoMesh>(&decoded);
          if (fault != nullptr && is_costly(*fault) && ++costly == kMostCostly) stopped = true;
          if (mesh == nullptr) return;
          const std::uint64_t size = size_of(*mesh);
          if (size > left) {
            decoded = NotLookedAt{};
            stopped = true;
          } else {
            left -= size;
          }
        });
  }

  static void decode(Payload& payload) {
    auto result = codec::Client::shared().decode_draco(payload.bytes.view());
    if (auto* mesh = std::get_if<codec::DracoMesh>(&result)) {
      payload.decoded = std::move(*mesh);
    } else {
      payload.decoded = std::get<codec::Fault>(std::move(result));
    }
  }

  void check(const DracoPrimitive& primitive) {
    const Payload& payload = payloads_[primitive.payload];
    if (payload.bytes.empty()) return;  // said of the buffer view or the buffer
    if (const auto* mesh = std::get_if<codec::DracoMesh>(&payload.decoded)) {
      return check_draco_primitive(phase_, primitive, kExtension, *mesh);
    }
    const auto* fault = std::get_if<codec::Fault>(&payload.decoded);
    const bool known = fault != nullptr && fault->kind != codec::FaultKind::unavailable;
    const std::string_view code = !known             ? "DRACO_NOT_CHECKED"
                                  : is_limit(*fault) ? "DRACO_LIMIT_EXCEEDED"
                                                     : "DRACO_DECODE_FAILED";
    std::string message = fault != nullptr
                              ? fault->message
                              : "Earlier bitstreams of this file took all that decoding may take.";
    with_draco_path(primitive, kExtension, [&](const Path& path) {
      report_member(phase_.sink, phase_.context, path, primitive.object, "bufferView", code,
                    std::move(message));
    });
  }

  static bool is_limit(const codec::Fault& fault) {
    return is_costly(fault) && fault.kind != codec::FaultKind::died;
  }

  DataPhase& phase_;
  std::vector<DracoPrimitive> primitives_;
  std::vector<Payload> payloads_;
  std::unordered_map<std::uint32_t, std::size_t> positions_;  // in payloads_, by buffer view
};

}  // namespace

void decode_geometry(DataPhase& phase) { GeometryDecoding(phase).run(); }

}  // namespace gltfx::validate
