// SPDX-License-Identifier: Apache-2.0
// Stores triangles and vertices as bitstreams (KHR_draco_mesh_compression), without loss.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "json/writer.hpp"
#include "model/draco.hpp"
#include "report/wording.hpp"
#include "steps/accessor_bounds.hpp"
#include "steps/codec_steps.hpp"
#include "steps/draco_primitives.hpp"
#include "steps/json_edits.hpp"
#include "steps/new_buffer.hpp"
#include "steps/references.hpp"
#include "steps/shrink_views.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {
namespace {

using model::ComponentType;

// Estimated size of the JSON of the extension after compression for transfer.
constexpr std::size_t kExtensionText = 40;

/// Primitives with the same vertices and triangles.
struct DracoGroup {
  std::vector<std::size_t> primitives;
  std::string trouble;      ///< why there is no bitstream
  bool is_failure = false;  ///< the encoder failed; refuse instead of leave
  codec::EncodedDraco encoded;
  std::uint64_t view = 0;                              ///< number in the pool
  std::map<std::uint32_t, std::uint64_t> copies = {};  ///< new accessors by old ones
  std::optional<std::uint64_t> indices = {};           ///< a new accessor
};

class DracoStep {
 public:
  explicit DracoStep(const StepInput& step)
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
    primitives_.emplace(input_, outcome_);
    make_groups();
    parallel_ordered(
        groups_.size(), step_.options.jobs, [this](std::size_t i) { encode(groups_[i]); },
        [](std::size_t) {});
    for (const DracoGroup& group : groups_) judge(group);
    std::erase_if(groups_, [this](const DracoGroup& group) {
      return primitives_->all()[group.primitives.front()].stays;
    });
    if (groups_.empty()) return std::move(outcome_);
    return store();
  }

 private:
  const DracoPrimitive& primitive(std::size_t index) const { return primitives_->all()[index]; }
  const model::Accessor& accessor(std::uint32_t index) const {
    return input_.views.accessors[index];
  }

  void make_groups() {
    using Key = std::pair<std::optional<model::Mode>,
                          std::vector<std::pair<std::string_view, std::uint32_t>>>;
    std::map<Key, std::size_t> known;
    for (std::size_t i = 0; i < primitives_->all().size(); ++i) {
      const DracoPrimitive& each = primitive(i);
      if (each.stays) continue;
      Key key{each.primitive->mode, {}};
      for (const model::Attribute& attribute : each.primitive->attributes) {
        key.second.emplace_back(attribute.name, *attribute.accessor);
      }
      std::sort(key.second.begin(), key.second.end());
      if (each.primitive->indices) key.second.emplace_back("", *each.primitive->indices);
      const auto [found, is_new] = known.try_emplace(std::move(key), groups_.size());
      if (is_new) {
        groups_.emplace_back();
        for (const std::uint32_t accessor :
             std::set(each.accessors.begin(), each.accessors.end())) {
          ++groups_of_[accessor];
        }
      }
      groups_[found->second].primitives.push_back(i);
    }
  }

  void encode(DracoGroup& group) const {
    const DracoPrimitive& first = primitive(group.primitives.front());
    const auto source = read_source(input_, first);
    if (!source) {
      group.trouble = source.error().message;
      return;
    }
    auto result = codec::Client::shared().encode_draco(source->mesh, input_.resources.origin);
    if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
      group.is_failure = error->kind != codec::ErrorKind::malformed;
      group.trouble = "Draco: " + half_sentence(error->message);
      return;
    }
    group.encoded = std::get<codec::EncodedDraco>(std::move(result));
    std::uint64_t plain = 0;
    for (const std::uint32_t each : std::set(first.accessors.begin(), first.accessors.end())) {
      const std::uint64_t size = model::packed_stride(accessor(each).format);
      plain += *accessor(each).count * size / groups_of_.at(each);
    }
    if (group.encoded.bytes.size() + kExtensionText >= plain) {
      group.trouble = "its bitstream would not be smaller";
    }
  }

  void judge(const DracoGroup& group) {
    if (group.trouble.empty()) return;
    for (const std::size_t each : group.primitives) {
      if (group.is_failure) {
        primitives_->refuse(each, group.trouble);
      } else {
        primitives_->leave(each, group.trouble);
      }
    }
  }

  Result<StepOutcome> store() {
    ViewPool pool(input_, buffer_, outcome_.change.additions, editor_);
    const std::set<std::uint32_t> accessors = encoded_accessors();
    const std::set<json::NodeId> edited = free_views(accessors, pool);
    for (DracoGroup& group : groups_) {
      const auto& encoded = group.encoded;
      group.view =
          pool.add(container::Bytes(encoded.bytes, encoded.owner), 0, model::ViewTarget::none);
    }
    pool.settle(edited, outcome_);
    shrink_views(input_, accessors, buffer_, editor_);
    std::size_t stored = 0;
    std::uint64_t dropped = 0;
    for (DracoGroup& group : groups_) {
      const auto& attributes = primitive(group.primitives.front()).primitive->attributes;
      const std::uint64_t vertices = *accessor(*attributes.front().accessor).count;
      dropped += vertices - std::min<std::uint64_t>(vertices, group.encoded.mesh.points);
      for (const std::size_t each : group.primitives) declare(group, each, pool);
      stored += group.primitives.size();
    }
    if (auto trouble = require_extension(document_, editor_, model::kDracoExtension))
      return *std::move(trouble);
    buffer_.add_to(outcome_.change);
    outcome_.change.edits = editor_.take();
    outcome_.freedom.vertex_order = true;
    if (dropped > 0) {
      outcome_.row.losses.push_back({fmt::format("{} {} that no triangle needs", dropped,
                                                 dropped == 1 ? "vertex" : "vertices"),
                                     0,
                                     0,
                                     {}});
    }
    outcome_.row.what =
        fmt::format("{} of {}", stored, report::counted(primitives_->all().size(), "primitive"));
    return std::move(outcome_);
  }

  // The accessors whose elements are now in bitstreams.
  std::set<std::uint32_t> encoded_accessors() const {
    std::set<std::uint32_t> accessors;
    for (const DracoGroup& group : groups_) {
      for (const std::size_t each : group.primitives) {
        accessors.insert(primitive(each).accessors.begin(), primitive(each).accessors.end());
      }
    }
    return accessors;
  }

  std::set<json::NodeId> free_views(const std::set<std::uint32_t>& accessors,
                                    ViewPool& pool) const {
    std::set<json::NodeId> edited;
    std::map<std::uint32_t, std::size_t> lost;  // users, by view
    for (const std::uint32_t each : accessors) {
      edited.insert(document_.find(accessor(each).node, "bufferView"));
      ++lost[*accessor(each).buffer_view];
    }
    for (const auto& [view, users] : lost) {
      const json::NodeId node = input_.views.buffer_views[view].node;
      if (input_.graph.users(node).size() == users) pool.free(view);
    }
    return edited;
  }

  void declare(DracoGroup& group, std::size_t index, const ViewPool& pool) {
    const model::Primitive& each = *primitive(index).primitive;
    std::string json =
        fmt::format(R"({{"bufferView":{},"attributes":{{)", pool.position(group.view));
    for (std::size_t i = 0; i < each.attributes.size(); ++i) {
      const model::Attribute& attribute = each.attributes[i];
      const std::uint32_t id = id_of(group, attribute.name);
      if (i > 0) json += ',';
      json::append_string(json, attribute.name);
      json += fmt::format(":{}", id);
      const codec::DracoAttribute& packed = *model::find_attribute(group.encoded.mesh, id);
      refer(group, *attribute.accessor, attribute.value,
            {reinterpret_cast<const char*>(packed.values.data()), packed.values.size()},
            group.encoded.mesh.points);
    }
    add_extension(document_, editor_, each.node, model::kDracoExtension, json + "}}");
    if (each.mode != model::Mode::triangles) {
      constexpr unsigned kTriangles = 4;
      set_number(document_, editor_, each.node, "mode", kTriangles);
    }
    declare_indices(group, each);
  }

  // Ids are positions of attributes in the first primitive of a group.
  std::uint32_t id_of(const DracoGroup& group, std::string_view name) const {
    const auto& attributes = primitive(group.primitives.front()).primitive->attributes;
    const auto found =
        std::find_if(attributes.begin(), attributes.end(),
                     [&](const model::Attribute& attribute) { return attribute.name == name; });
    return static_cast<std::uint32_t>(found - attributes.begin());
  }

  // Makes an accessor describe elements of a bitstream. If it already describes another bitstream,
  // the primitive gets a copy. `component` none: unchanged.
  void refer(DracoGroup& group, std::uint32_t index, json::NodeId value, std::string_view bytes,
             std::uint64_t count, ComponentType component = ComponentType::none) {
    const auto own = owners_.try_emplace(index, &group);
    const model::Accessor& described = accessor(index);
    if (own.second) {
      remove_member(document_, editor_, described.node, "bufferView");
      remove_member(document_, editor_, described.node, "byteOffset");
      if (count != described.count) {
        set_number(document_, editor_, described.node, "count", count);
      }
      model::Accessor now = described;
      if (component != ComponentType::none) {
        now.format.component = component;
        set_number(document_, editor_, described.node, "componentType",
                   static_cast<unsigned>(component));
      }
      mend_bounds(document_, editor_, now, bytes);
    } else if (own.first->second != &group) {
      const auto [copy, is_new] = group.copies.try_emplace(index, 0);
      if (is_new) {
        copy->second = outcome_.change.additions.add_element(
            "accessors",
            accessor_like(document_, described, {std::nullopt, count, component}, bytes));
      }
      editor_.replace_scalar(value, std::to_string(copy->second));
    }
  }

  void declare_indices(DracoGroup& group, const model::Primitive& each) {
    const codec::DracoMesh& mesh = group.encoded.mesh;
    const std::uint64_t count = std::uint64_t{mesh.faces} * 3;
    const ComponentType type =
        mesh.points > UINT16_MAX ? ComponentType::uint32 : ComponentType::uint16;
    if (each.indices) {
      const ComponentType old = accessor(*each.indices).format.component;
      const bool fits = mesh.points <= model::value_range(old).most;
      refer(group, *each.indices, each.indices_node, index_bytes(mesh.indices, fits ? old : type),
            count, fits ? ComponentType::none : type);
      return;
    }
    if (!group.indices) {
      group.indices = outcome_.change.additions.add_element(
          "accessors", fmt::format(R"({{"componentType":{},"count":{},"type":"SCALAR"}})",
                                   static_cast<unsigned>(type), count));
    }
    editor_.append_member(each.node, "indices", std::to_string(*group.indices));
  }

  const StepInput& step_;
  const GeometryInput input_;
  const json::Document& document_;
  json::Editor editor_;
  NewBuffer buffer_;
  StepOutcome outcome_;
  std::optional<DracoPrimitives> primitives_;
  std::vector<DracoGroup> groups_;
  std::map<std::uint32_t, std::uint64_t> groups_of_;   ///< number of them by accessor
  std::map<std::uint32_t, const DracoGroup*> owners_;  ///< by accessor
};

}  // namespace

Result<StepOutcome> encode_draco(const StepInput& input) { return DracoStep(input).run(); }

}  // namespace gltfx::steps
