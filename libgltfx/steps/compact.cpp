// SPDX-License-Identifier: Apache-2.0
// The JSON of a GLB without spaces and line breaks. That of a .gltf is for people, too, and stays.
#include "json/compact.hpp"

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "steps/step.hpp"

namespace gltfx::steps {
namespace {

bool makes_glb(const StepInput& input) {
  if (input.options.to) return input.options.to == StoredAs::glb;
  return input.asset.container().format == container::Format::glb;
}

Result<StepOutcome> remove_spaces(const StepInput& input) {
  StepOutcome outcome;
  if (!makes_glb(input)) return outcome;
  const json::Document& document = input.asset.document();
  const std::string_view text = document.raw(document.root());
  std::string shorter = json::compact(text);
  if (shorter.size() == text.size()) return outcome;
  outcome.row.what = fmt::format("{} of {} bytes of JSON are spaces and line breaks",
                                 text.size() - shorter.size(), text.size());
  outcome.change.edits.push_back({document.span(document.root()), std::move(shorter)});
  return outcome;
}

}  // namespace

StepDescription compact_step();
StepDescription compact_step() {
  return {"compact",
          "removes spaces and line breaks between the tokens of the JSON in a GLB",
          "all members, their order, and the spelling of numbers and strings",
          "nothing",
          [](const ConvertOptions& options) { return options.shrink; },
          remove_spaces};
}

}  // namespace gltfx::steps
