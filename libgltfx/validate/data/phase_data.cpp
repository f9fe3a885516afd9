// SPDX-License-Identifier: Apache-2.0
#include "validate/data/mesh_edges.hpp"
#include "validate/data/phases.hpp"
#include "validate/image_phase.hpp"
#include "validate/phases.hpp"
#include "validate/rules/texture_phase.hpp"

namespace gltfx::validate {

namespace {

// Half a second of zeros, or the same bytes through a few accessors each.
constexpr std::uint64_t kFreeNumbers = std::uint64_t{1} << 29U;
constexpr std::uint64_t kNumbersPerByte = 16;
// Some megabytes of report, and as many errors as buffers have floats.
constexpr std::uint64_t kFreeErrors = 65536;
constexpr std::uint64_t kBytesPerError = 4;

}  // namespace

Budget::Budget(const model::ResourceData& resources)
    : left_(kFreeNumbers), listed_left_(kFreeErrors) {
  for (const auto& buffer : resources.buffers) {
    if (!buffer) continue;
    left_ += buffer->size() * kNumbersPerByte;
    listed_left_ += buffer->size() / kBytesPerError;
  }
}

bool Budget::list(std::uint64_t errors) {
  if (errors > listed_left_) return false;
  listed_left_ -= errors;
  return true;
}

bool Budget::take(std::uint64_t count, std::uint64_t each) {
  const Checked cost = checked_mul(count, each);
  if (!cost || *cost > left_) return false;
  left_ -= *cost;
  return true;
}

void check_data(const Context& context, const model::ResourceData& resources, Sink& sink,
                FileReport& report) {
  DataPhase phase{context, resources, sink, Budget(resources)};
  decode_geometry(phase);
  check_sparse_indices(phase);
  check_elements(phase);
  check_influences(phase);
  check_mesh_edges(phase);
  check_textures(context, resources, sink);
  check_texture_slots(context, resources, sink, report);
}

}  // namespace gltfx::validate
