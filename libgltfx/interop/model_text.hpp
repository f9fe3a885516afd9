// SPDX-License-Identifier: Apache-2.0
/// Models as JSON, without the bytes of buffers and images.
#pragma once

#include <string>
#include <vector>

#include "interop/notes.hpp"
#include "json/document.hpp"

namespace gltfx::interop {

/// Fills `model`, which must be empty, from a document without errors. Buffers and images have no
/// bytes yet. Members without a field in tinygltf are noted; numbers that do not fit make notes
/// fail.
void read_model(const json::Document& document, tinygltf::Model& model, Notes& notes);

/// Where the bytes of a buffer or image are.
struct Storage {
  std::string uri;         ///< empty: none
  std::string media_type;  ///< of an image; empty: none
};

/// The JSON text of a model. `buffers` and `images` are as many as the model has.
std::string write_model(const tinygltf::Model& model, const std::vector<Storage>& buffers,
                        const std::vector<Storage>& images, Notes& notes);

/// tinygltf has a list of the lights of this extension, beside those of all extensions.
inline constexpr std::string_view kLightsExtension = "KHR_lights_punctual";

}  // namespace gltfx::interop
