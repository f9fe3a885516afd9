// SPDX-License-Identifier: Apache-2.0
// Where the text, the buffers and the images of an asset stand (glTF 2.0 sections 3.6.1, 4).
#include <utility>

#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

Result<StepOutcome> store(const StepInput& input) {
  return input.options.to == StoredAs::glb ? pack(input) : store_as_text(input);
}

}  // namespace

void note(std::vector<ConvertNote>& notes, std::string pointer, std::string reason) {
  notes.push_back({std::move(pointer), std::move(reason)});
}

StepDescription container_step();
StepDescription container_step() {
  return {"container",
          "moves buffers and images into one GLB, files or data URIs",
          "all bytes, and the text but for `uri`, `buffer`, offsets and views of images",
          "the `name` of a buffer that becomes part of another",
          [](const ConvertOptions& options) { return options.to.has_value(); },
          store};
}

}  // namespace gltfx::steps
