// SPDX-License-Identifier: Apache-2.0
/// State of the step that decodes compressed geometry.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "json/edit.hpp"
#include "steps/geometry_input.hpp"
#include "steps/json_edits.hpp"
#include "steps/new_buffer.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

struct Decoding {
  explicit Decoding(const StepInput& step)
      : input(step),
        document(step.asset.document()),
        jobs(step.options.jobs),
        editor(document),
        buffer(step.asset) {
    outcome.change.additions = change::Additions(document);
  }

  void refuse(json::NodeId object, std::string reason) {
    outcome.row.refused.push_back({input.pointer(object), std::move(reason)});
  }
  /// Removes the object of an extension from `host`.
  void remove(json::NodeId host, std::string_view extension) {
    const json::NodeId object = document.find(document.find(host, "extensions"), extension);
    if (document.find(object, "extras") != json::kNoNode) ++extras[std::string(extension)];
    remove_extension(document, editor, host, extension);
    ++removed[std::string(extension)];
  }

  const GeometryInput input;
  const json::Document& document;
  const unsigned jobs;
  json::Editor editor;
  NewBuffer buffer;
  StepOutcome outcome;
  std::map<std::string, std::uint64_t, std::less<>> removed;  ///< number of objects, by extension
  std::map<std::string, std::uint64_t> extras;                ///< those with `extras`
  std::uint64_t views = 0;                                    ///< decoded from streams
  std::uint64_t primitives = 0;                               ///< decoded from bitstreams
};

/// Gives primitives that are stored by Draco plain accessors.
void decode_draco(Decoding& decoding);

}  // namespace gltfx::steps
