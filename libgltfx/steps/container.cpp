// SPDX-License-Identifier: Apache-2.0
// The storage of the text, the buffers and the images of an asset (glTF 2.0 sections 3.6.1, 4).
#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/unknown_indices.hpp"
#include "report/wording.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

Result<StepOutcome> store(const StepInput& input) {
  return input.options.to == StoredAs::glb ? pack(input) : store_as_text(input);
}

}  // namespace

std::string find_doubt(const graph::Graph& graph, std::string_view things) {
  const json::NodeId unknown = graph::find_unknown_with_integer(graph);
  if (unknown == json::kNoNode) return {};
  return fmt::format("{} may hold indices of {} (describe it with --schema)",
                     printable(graph.tree().pointer(unknown)), things);
}

std::string describe_moves(std::string_view form, std::uint64_t buffers, std::uint64_t images) {
  std::string what(form);
  if (buffers > 0) what += fmt::format(", {}", report::counted(buffers, "buffer"));
  if (images > 0) what += fmt::format(", {}", report::counted(images, "image"));
  return what;
}

StepDescription container_step();
StepDescription container_step() {
  return {"container",
          "moves buffers and images into one GLB, files or data URIs",
          "all bytes, and the text except `uri`, `buffer`, offsets and views of images",
          "the `name` of a buffer that becomes part of another",
          [](const ConvertOptions& options) { return options.to.has_value(); },
          store};
}

}  // namespace gltfx::steps
