// SPDX-License-Identifier: Apache-2.0
// Stores buffer views as meshoptimizer streams (EXT_meshopt_compression), without loss.
#include "model/meshopt_encode.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "model/meshopt_view.hpp"
#include "report/wording.hpp"
#include "steps/geometry_input.hpp"
#include "steps/json_edits.hpp"
#include "steps/new_buffer.hpp"
#include "steps/references.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using model::meshopt::Mode;

// Stride unit of a view without a stride, which may contain elements of several formats.
constexpr std::uint64_t kStrideUnit = 4;
constexpr std::size_t kMostStrides = 4;
// Limit of an attribute stream.
constexpr std::uint64_t kGreatestStride = 256;
// Estimated sizes of JSON after compression for transfer: the object of an extension; and the new
// buffer with the names in the lists of extensions.
constexpr std::int64_t kStreamText = 40;
constexpr std::int64_t kAssetText = 60;

std::string_view mode_text(Mode mode) {
  if (mode == Mode::attributes) return "ATTRIBUTES";
  return mode == Mode::triangles ? "TRIANGLES" : "INDICES";
}

/// A view that may become a stream, and its smallest one.
struct StreamJob {
  std::uint32_t view = 0;
  container::Bytes bytes;
  std::vector<std::uint64_t> strides;  ///< candidates
  Mode mode = Mode::attributes;
  std::shared_ptr<const std::vector<std::byte>> stream;  ///< null: none is smaller
  std::uint64_t stride = 0;                              ///< of the stream
  std::uint64_t count = 0;                               ///< of elements in the stream

  // An incomplete last element is padded with zeros.
  void encode() {
    for (const std::uint64_t each : strides) {
      const std::uint64_t elements = (bytes.size() + each - 1) / each;
      std::vector<std::byte> padded;
      std::span<const std::byte> whole = bytes.view();
      if (whole.size() != elements * each) {
        padded.assign(whole.begin(), whole.end());
        padded.resize(static_cast<std::size_t>(elements * each));
        whole = padded;
      }
      auto made = model::meshopt::encode(
          whole, {elements, each, mode, model::meshopt::Filter::none, /*newest_version=*/0});
      if (!made || made->size() >= (stream ? stream->size() : bytes.size())) continue;
      stream = std::make_shared<const std::vector<std::byte>>(*std::move(made));
      stride = each;
      count = elements;
    }
  }
};

class MeshoptStep {
 public:
  explicit MeshoptStep(const StepInput& step)
      : step_(step),
        input_(step),
        document_(step.asset.document()),
        editor_(document_),
        buffer_(step.asset) {
    outcome_.change.additions = change::Additions(document_);
  }

  Result<StepOutcome> run() {
    if (auto doubt = find_offset_doubt(input_.graph)) {
      outcome_.row.left.push_back(*std::move(doubt));
      return std::move(outcome_);
    }
    find_turnable();
    for (std::uint32_t i = 0; i < input_.views.buffer_views.size(); ++i) consider(i);
    parallel_ordered(
        jobs_.size(), step_.options.jobs, [this](std::size_t i) { jobs_[i].encode(); },
        [](std::size_t) {});
    store_all();
    if (stored_ == 0) return std::move(outcome_);
    buffer_.add_to(outcome_.change);
    outcome_.change.additions.add_element(
        "buffers", fmt::format(R"({{"byteLength":{},"extensions":{{"{}":{{"fallback":true}}}}}})",
                               fallback_size_, kName));
    if (auto trouble = require_extension(document_, editor_, kName)) return *std::move(trouble);
    outcome_.change.edits = editor_.take();
    outcome_.row.what = fmt::format(
        "{} of {}", stored_, report::counted(input_.views.buffer_views.size(), "buffer view"));
    return std::move(outcome_);
  }

 private:
  static constexpr std::string_view kName = model::kMeshoptExtensions[0];

  void leave(std::uint32_t view, std::string reason) {
    outcome_.row.left.push_back({fmt::format("/bufferViews/{}", view), std::move(reason)});
  }
  void refuse(std::uint32_t view, std::string reason) {
    outcome_.row.refused.push_back({fmt::format("/bufferViews/{}", view), std::move(reason)});
  }

  // Finds index accessors of triangles that may start at any of their corners.
  void find_turnable() {
    if (!step_.options.reorder && !step_.options.shrink) return;
    std::set<std::uint32_t> others;
    for (const model::Mesh& mesh : input_.views.meshes) {
      for (const model::Primitive& primitive : mesh.primitives) {
        if (!primitive.indices) continue;
        const bool is_plain = primitive.mode == model::Mode::triangles &&
                              document_.find(primitive.node, "extensions") == json::kNoNode;
        if (is_plain) {
          ++turnable_[*primitive.indices];
        } else {
          others.insert(*primitive.indices);
        }
      }
    }
    for (const std::uint32_t other : others) turnable_.erase(other);
  }

  // Names a user of a view that is not an accessor.
  std::string name_other_user(json::NodeId view) const {
    for (const graph::Use& use : input_.graph.users(view)) {
      if (input_.accessor_of(use)) continue;
      const json::NodeId element = input_.graph.tree().root_element(use.at.node);
      const json::NodeId list =
          element == json::kNoNode ? json::kNoNode : input_.graph.tree().parent(element);
      if (list != json::kNoNode && list == document_.find(document_.root(), "images")) {
        return "it is an image";
      }
      return fmt::format("{} uses it",
                         printable(input_.pointer(input_.graph.tree().parent(use.at.node))));
    }
    return {};
  }

  void consider(std::uint32_t index) {
    const model::BufferView& view = input_.views.buffer_views[index];
    if (view.node == json::kNoNode) return;
    for (const std::string_view name : model::kMeshoptExtensions) {
      const json::NodeId extensions = document_.find(view.node, "extensions");
      if (document_.find(extensions, name) != json::kNoNode) {
        return leave(index, "it is already compressed");
      }
    }
    const json::NodeId extensions = document_.find(view.node, "extensions");
    if (extensions != json::kNoNode &&
        (!document_.is_object(extensions) || document_.object_size(extensions) > 0)) {
      return leave(index, "it has extensions");
    }
    const auto accessors = input_.accessors_of(view.node);
    if (!accessors) return leave(index, name_other_user(view.node));
    if (accessors->empty()) return leave(index, "no accessor uses it");
    for (const std::uint32_t i : *accessors) {
      if (input_.graph.users(input_.views.accessors[i].node).empty()) {
        return leave(index, fmt::format("no known object uses /accessors/{}", i));
      }
      if (!input_.end_in_view(input_.views.accessors[i])) {
        return refuse(index,
                      fmt::format("/accessors/{} does not fit into it (see 'gltfx fix')", i));
      }
    }
    auto bytes = input_.resources.part(document_, view, 0, *view.byte_length);
    if (!bytes) return refuse(index, "its bytes are missing");
    if (view.byte_stride.value_or(kStrideUnit) % kStrideUnit != 0) {
      return leave(index, "its byteStride is not a multiple of 4");
    }
    StreamJob& job = jobs_.emplace_back();
    job.view = index;
    job.bytes = *std::move(bytes);
    job.mode = mode_of(*accessors);
    job.strides = strides_of(job.mode, *accessors);
  }

  const model::Accessor& accessor(std::uint32_t index) const {
    return input_.views.accessors[index];
  }

  Mode mode_of(const std::vector<std::uint32_t>& accessors) const {
    const model::Format format = accessor(accessors.front()).format;
    const std::uint64_t size = model::packed_stride(format);
    bool turnable = true;
    for (const std::uint32_t i : accessors) {
      const bool fits = (format.component == model::ComponentType::uint16 ||
                         format.component == model::ComponentType::uint32) &&
                        accessor(i).format == format && format.type == model::ElementType::scalar &&
                        !input_.views.view_of(accessor(i))->byte_stride;
      const bool is_index = input_.views.usage.accessor(i).only() == model::AccessorUse::indices;
      if (!fits || !is_index) return Mode::attributes;
      const auto found = turnable_.find(i);
      turnable = turnable && found != turnable_.end() &&
                 input_.graph.users(accessor(i).node).size() == found->second &&
                 *accessor(i).count % 3 == 0 &&
                 accessor(i).byte_offset.value_or(0) % (3 * size) == 0;
    }
    const model::BufferView& view = *input_.views.view_of(accessor(accessors.front()));
    return turnable && *view.byte_length % (3 * size) == 0 ? Mode::triangles : Mode::indices;
  }

  // A stream compares elements of one size. If a view has several sizes, each one is a candidate.
  std::vector<std::uint64_t> strides_of(Mode mode,
                                        const std::vector<std::uint32_t>& accessors) const {
    const std::uint64_t first = model::packed_stride(accessor(accessors.front()).format);
    if (mode != Mode::attributes) return {first};
    const model::BufferView& view = *input_.views.view_of(accessor(accessors.front()));
    if (view.byte_stride) return {*view.byte_stride};
    std::vector<std::uint64_t> strides;
    for (const std::uint32_t i : accessors) {
      const std::uint64_t stride = model::packed_stride(accessor(i).format);
      if (stride % kStrideUnit != 0 || stride > kGreatestStride) continue;
      if (std::find(strides.begin(), strides.end(), stride) != strides.end()) continue;
      if (strides.size() < kMostStrides) strides.push_back(stride);
    }
    const bool mixed = strides.size() != 1 || accessors.size() > 1;
    if (mixed && std::find(strides.begin(), strides.end(), kStrideUnit) == strides.end()) {
      strides.push_back(kStrideUnit);
    }
    return strides;
  }

  // The bytes that a stream saves, minus the JSON for it.
  static std::int64_t gain_of(const StreamJob& job) {
    if (!job.stream) return 0;
    return static_cast<std::int64_t>(job.bytes.size()) -
           static_cast<std::int64_t>(job.stream->size()) - kStreamText;
  }

  void store(const StreamJob& job) {
    const json::NodeId view = input_.views.buffer_views[job.view].node;
    const std::size_t length = job.stream->size();
    const std::uint64_t size = job.count * job.stride;
    const std::uint64_t begin = buffer_.add(container::Bytes(*job.stream, job.stream));
    set_number(document_, editor_, view, "buffer", buffer_.index() + 1);
    const bool has_offset = document_.find(view, "byteOffset") != json::kNoNode;
    if (has_offset || fallback_size_ > 0) {
      set_number(document_, editor_, view, "byteOffset", fallback_size_);
    }
    if (size != input_.views.buffer_views[job.view].byte_length) {
      set_number(document_, editor_, view, "byteLength", size);
    }
    add_extension(
        document_, editor_, view, kName,
        fmt::format(R"({{"buffer":{},"byteOffset":{},"byteLength":{},"byteStride":{},)"
                    R"("count":{},"mode":"{}"}})",
                    buffer_.index(), begin, length, job.stride, job.count, mode_text(job.mode)));
    fallback_size_ += aligned(size);
    outcome_.freedom.vertex_order |= job.mode == Mode::triangles;
    ++stored_;
  }

  // Stores all views that become smaller, if they save more than the JSON of the asset grows.
  void store_all() {
    std::int64_t gain = -kAssetText;
    for (const StreamJob& job : jobs_) gain += std::max<std::int64_t>(gain_of(job), 0);
    for (const StreamJob& job : jobs_) {
      if (gain > 0 && gain_of(job) > 0) {
        store(job);
      } else {
        leave(job.view, job.stream ? "its stream and the JSON for it would not be smaller"
                                   : "its stream would not be smaller");
      }
    }
  }

  const StepInput& step_;
  const GeometryInput input_;
  const json::Document& document_;
  json::Editor editor_;
  NewBuffer buffer_;
  StepOutcome outcome_;
  std::map<std::uint32_t, std::size_t> turnable_;  ///< primitives by accessor
  std::vector<StreamJob> jobs_;
  std::uint64_t fallback_size_ = 0;  ///< of all decoded views
  std::uint64_t stored_ = 0;         ///< views
};

Result<StepOutcome> encode_meshopt(const StepInput& input) { return MeshoptStep(input).run(); }

}  // namespace

StepDescription meshopt_step();
StepDescription meshopt_step() {
  return {"meshopt",
          "stores vertices, indices and keyframes as meshoptimizer streams",
          "all values, their order, and all indices",
          "nothing",
          [](const ConvertOptions& options) { return options.compress == Compression::meshopt; },
          encode_meshopt};
}

}  // namespace gltfx::steps
