// SPDX-License-Identifier: Apache-2.0
// Replaces compressed geometry with the decoded bytes.
#include "steps/decode.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "change/name_list.hpp"
#include "graph/extensions.hpp"
#include "model/meshopt_view.hpp"
#include "report/wording.hpp"
#include "steps/accessor_bounds.hpp"
#include "steps/json_edits.hpp"

namespace gltfx::steps {
namespace {

/// Decodes buffer views with meshoptimizer streams.
class StreamDecoder {
 public:
  explicit StreamDecoder(Decoding& decoding) : decoding_(decoding), input_(decoding.input) {}

  void run() {
    for (std::uint32_t i = 0; i < input_.views.buffer_views.size(); ++i) {
      const json::NodeId view = input_.views.buffer_views[i].node;
      if (view == json::kNoNode) continue;
      const json::NodeId extensions = document().find(view, "extensions");
      for (const std::string_view name : model::kMeshoptExtensions) {
        if (document().find(extensions, name) == json::kNoNode) continue;
        const auto& buffer = input_.views.buffer_views[i].buffer;
        auto& buffers = decode(i, name) ? decoded_ : left_;
        if (buffer) buffers.insert(*buffer);
      }
    }
    if (!rounded_.empty()) mend_all_bounds();
    unmark_buffers();
  }

 private:
  const json::Document& document() const { return decoding_.document; }

  bool decode(std::uint32_t index, std::string_view extension) {
    const model::BufferView& view = input_.views.buffer_views[index];
    const auto described = model::read_meshopt_view(input_.asset, view.node);
    if (!described || described->extension != extension) {
      return refuse(view, "the description of its stream is invalid");
    }
    if (const model::DecodedView* decoded = input_.resources.decoded(view)) {
      put(view, decoded->bytes);
      if (decoded->rounded) rounded_.insert(index);
    } else if (std::string why = find_problem(index); !why.empty()) {
      return refuse(view, "it " + why);
    } else {
      kept_.insert(*view.buffer);
    }
    decoding_.remove(view.node, extension);
    ++decoding_.views;
    return true;
  }

  bool refuse(const model::BufferView& view, std::string reason) {
    decoding_.refuse(view.node, std::move(reason));
    return false;
  }

  void put(const model::BufferView& view, const container::Bytes& bytes) {
    json::Editor& editor = decoding_.editor;
    set_number(document(), editor, view.node, "buffer", decoding_.buffer.index());
    set_number(document(), editor, view.node, "byteOffset", decoding_.buffer.add(bytes));
    if (bytes.size() == view.byte_length) return;
    set_number(document(), editor, view.node, "byteLength", bytes.size());
  }

  // Why a view has no elements, to follow "it"; empty: its plain copy has them.
  std::string find_problem(std::uint32_t index) {
    if (!streams_) {
      streams_ =
          model::decode_streams(input_.asset, input_.views, input_.resources, decoding_.jobs);
    }
    const auto found =
        std::find_if(streams_->begin(), streams_->end(),
                     [&](const model::DecodedStream& stream) { return stream.index == index; });
    return found == streams_->end() ? "has no bytes for its stream" : found->problem();
  }

  // A filter may round values, so declared bounds may no longer match.
  void mend_all_bounds() {
    for (const model::Accessor& accessor : input_.views.accessors) {
      if (!accessor.buffer_view || !rounded_.contains(*accessor.buffer_view)) continue;
      if (accessor.min == json::kNoNode && accessor.max == json::kNoNode) continue;
      const auto elements = input_.elements_of(accessor);
      if (elements) mend_bounds(document(), decoding_.editor, accessor, *elements);
    }
  }

  // After decoding, placeholders for plain bytes are unused or contain these bytes.
  void unmark_buffers() {
    const auto& buffers = input_.asset.elements(model::RootArray::buffers);
    for (const std::uint32_t index : decoded_) {
      if (left_.contains(index) && !kept_.contains(index)) continue;
      for (const std::string_view name : model::kMeshoptExtensions) {
        const json::NodeId extensions = document().find(buffers[index], "extensions");
        if (document().find(extensions, name) != json::kNoNode) {
          decoding_.remove(buffers[index], name);
        }
      }
    }
  }

  Decoding& decoding_;
  const GeometryInput& input_;
  std::set<std::uint32_t> decoded_;  ///< buffers of decoded views
  std::set<std::uint32_t> kept_;     ///< those with plain copies
  std::set<std::uint32_t> left_;     ///< buffers of views that keep their streams
  std::set<std::uint32_t> rounded_;  ///< views
  std::optional<std::vector<model::DecodedStream>> streams_;
};

// Removes the names of extensions that lost their last object.
void drop_names(Decoding& decoding) {
  std::map<std::string, std::uint64_t, std::less<>> left = decoding.removed;
  graph::each_extension(decoding.document, [&](const auto& member) {
    const auto found = left.find(decoding.document.key(member.key_id));
    if (found != left.end()) --found->second;
  });
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    change::NameList names(decoding.document, list);
    for (const auto& [name, count] : left) {
      if (count == 0) names.remove(name);
    }
    names.apply(decoding.editor);
  }
}

Result<StepOutcome> decode(const StepInput& step) {
  Decoding decoding(step);
  const auto codec = step.options.compress;
  const auto is_asked = [&](Compression own, target::Repair repair) {
    return (codec && codec != own) || step.repairs.has(repair);
  };
  if (is_asked(Compression::meshopt, target::Repair::decode_meshopt)) StreamDecoder(decoding).run();
  if (is_asked(Compression::draco, target::Repair::decode_draco)) decode_draco(decoding);
  if (decoding.removed.empty()) return std::move(decoding.outcome);
  drop_names(decoding);
  StepOutcome& outcome = decoding.outcome;
  decoding.buffer.add_to(outcome.change);
  outcome.freedom.plain_elements = true;
  outcome.change.edits = decoding.editor.take();
  for (const auto& [name, count] : decoding.extras) {
    outcome.row.losses.push_back(
        {fmt::format("the extras of {} in {}", name, report::counted(count, "place")), 0, 0, {}});
  }
  if (decoding.views > 0) outcome.row.what = report::counted(decoding.views, "buffer view");
  if (decoding.primitives > 0) {
    if (!outcome.row.what.empty()) outcome.row.what += ", ";
    outcome.row.what += report::counted(decoding.primitives, "primitive");
  }
  return std::move(outcome);
}

}  // namespace

StepDescription decode_step();
StepDescription decode_step() {
  return {"decode",
          "decodes geometry, unless it is stored with the requested codec",
          "the values of all elements, and indices of buffer views and accessors",
          "nothing",
          [](const ConvertOptions& options) { return options.compress.has_value(); },
          decode,
          {target::Repair::decode_draco, target::Repair::decode_meshopt}};
}

}  // namespace gltfx::steps
