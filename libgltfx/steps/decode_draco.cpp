// SPDX-License-Identifier: Apache-2.0
// Replaces bitstreams of KHR_draco_mesh_compression with the decoded vertices and triangles.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "codec/client.hpp"
#include "model/draco.hpp"
#include "steps/accessor_bounds.hpp"
#include "steps/decode.hpp"
#include "steps/json_edits.hpp"
#include "steps/storage.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {
namespace {

using model::ComponentType;

/// Decoded elements: an attribute, or the indices of a bitstream in a component type.
struct Decoded {
  std::uint32_t view = 0;  ///< of the bitstream
  std::optional<std::uint64_t> attribute;
  ComponentType indices = ComponentType::none;
  bool operator==(const Decoded&) const = default;
  bool operator<(const Decoded& other) const {
    return std::tie(view, attribute, indices) <
           std::tie(other.view, other.attribute, other.indices);
  }
};

/// An accessor that receives decoded elements.
struct Part {
  json::NodeId value = json::kNoNode;     ///< index of the accessor; kNoNode: a new one
  std::optional<std::uint32_t> accessor;  ///< nothing: a new one
  Decoded elements;
};

struct PlainPrimitive {
  const model::Primitive* primitive;
  model::DracoReference reference;
  std::vector<Part> parts;
};

// Adds padding to elements. Vertex attributes are aligned to 4 bytes.
std::string spread(std::string bytes, std::size_t size, std::size_t stride) {
  if (size == stride) return bytes;
  std::string wide(bytes.size() / size * stride, '\0');
  for (std::size_t i = 0; i * size < bytes.size(); ++i) {
    bytes.copy(wide.data() + i * stride, size, i * size);
  }
  return wide;
}

class DracoDecoder {
 public:
  explicit DracoDecoder(Decoding& decoding)
      : decoding_(decoding),
        input_(decoding.input),
        document_(decoding.document),
        pool_(input_, decoding.buffer, decoding.outcome.change.additions, decoding.editor) {}

  void run() {
    if (document_.key_id(model::kDracoExtension) == json::kNoKey) return;
    meshes_.add_all(input_.asset, input_.views, input_.resources);
    meshes_.decode(codec::Client::shared(), decoding_.jobs);
    for (const model::Mesh& mesh : input_.views.meshes) {
      for (const model::Primitive& primitive : mesh.primitives) consider(primitive);
    }
    if (primitives_.empty()) return;
    assign();
    free_views();
    place();
    pool_.settle(edited_, decoding_.outcome);
    for (const auto& [accessor, elements] : owners_) declare(accessor, elements);
    for (auto& [copy, index] : copies_) index = add_accessor(copy.first, copy.second);
    for (const PlainPrimitive& primitive : primitives_) make_plain(primitive);
    decoding_.primitives += primitives_.size();
  }

 private:
  const codec::DracoMesh& mesh(const Decoded& elements) const {
    return *meshes_.mesh(elements.view);
  }
  const model::Accessor& accessor(std::uint32_t index) const {
    return input_.views.accessors[index];
  }
  model::Format format(const Decoded& attribute) const {
    return model::format_of(*model::find_attribute(mesh(attribute), *attribute.attribute), false);
  }
  // The packed elements.
  std::string bytes(const Decoded& elements) const {
    if (!elements.attribute) return index_bytes(mesh(elements).indices, elements.indices);
    const auto values = model::find_attribute(mesh(elements), *elements.attribute)->values;
    return {reinterpret_cast<const char*>(values.data()), values.size()};
  }
  std::uint64_t count(const Decoded& elements) const {
    return elements.attribute ? mesh(elements).points : std::uint64_t{mesh(elements).faces} * 3;
  }

  void consider(const model::Primitive& primitive) {
    if (primitive.node == json::kNoNode) return;
    const json::NodeId extensions = document_.find(primitive.node, "extensions");
    if (document_.find(extensions, model::kDracoExtension) == json::kNoNode) return;
    const auto reference = model::read_draco(input_.asset, primitive);
    PlainPrimitive plain{&primitive, reference.value_or(model::DracoReference()), {}};
    std::string why = reference ? find_obstacle(plain) : "it has no bitstream";
    if (!why.empty()) return decoding_.refuse(primitive.node, std::move(why));
    primitives_.push_back(std::move(plain));
  }

  // Why a primitive keeps its bitstream; empty: `plain.parts` is filled.
  std::string find_obstacle(PlainPrimitive& plain) const {
    const model::Primitive& primitive = *plain.primitive;
    const std::uint32_t view = plain.reference.buffer_view;
    const auto* decoded = meshes_.find(view);
    if (decoded == nullptr) return "the bytes of its bitstream are missing";
    if (const auto* error = std::get_if<codec::DecodeError>(decoded)) {
      return "its bitstream cannot be decoded: " + half_sentence(error->message);
    }
    const auto* mesh = std::get_if<codec::DracoMesh>(decoded);
    if (mesh == nullptr) return "its bitstream exceeds the limits for one asset";
    if (mesh->faces == 0) return "its bitstream has no triangles";
    if (document_.find(input_.views.buffer_views[view].node, "extensions") != json::kNoNode) {
      return "the buffer view of its bitstream has extensions";
    }
    bool others = primitive.targets_are_broken || !primitive.targets.empty();
    for (const model::Attribute& attribute : primitive.attributes) {
      const auto id = model::draco_id(input_.asset, plain.reference, attribute.name);
      others = others || !id;
      if (!id) continue;
      std::string why = find_attribute_obstacle(*mesh, attribute, *id);
      if (!why.empty()) return why;
      plain.parts.push_back({attribute.value, attribute.accessor, {view, *id, {}}});
    }
    if (plain.parts.empty()) return "its bitstream has none of its attributes";
    const std::uint64_t declared = accessor(*plain.parts.front().accessor).count.value_or(0);
    if (others && declared != mesh->points)
      return "its bitstream has a different number of vertices";
    return add_indices(*mesh, plain);
  }

  std::string find_attribute_obstacle(const codec::DracoMesh& mesh,
                                      const model::Attribute& attribute, std::uint64_t id) const {
    const codec::DracoAttribute* found = model::find_attribute(mesh, id);
    if (found == nullptr || !attribute.accessor) {
      return fmt::format("its bitstream has no {}", gltfx::quoted(attribute.name));
    }
    const model::Accessor& described = accessor(*attribute.accessor);
    const model::Format held = model::format_of(*found, described.format.normalized);
    if (!held.known() || held != described.format) {
      return fmt::format(
          "{} is {} in its bitstream, but its accessor has a different type",
          gltfx::quoted(attribute.name),
          held.known() ? model::format_text(held) : "of a type that glTF does not have");
    }
    return described.sparse == json::kNoNode ? "" : "one of its accessors is sparse";
  }

  std::string add_indices(const codec::DracoMesh& mesh, PlainPrimitive& plain) const {
    const auto& indices = plain.primitive->indices;
    const std::uint32_t most = *std::max_element(mesh.indices.begin(), mesh.indices.end());
    Part part{plain.primitive->indices_node, indices, {plain.reference.buffer_view, {}, {}}};
    if (indices) {
      const model::Accessor& described = accessor(*indices);
      part.elements.indices = described.format.component;
      const bool fits = described.format.type == model::ElementType::scalar &&
                        model::can_index_elements(described.format.component) &&
                        most < model::value_range(described.format.component).most;
      if (!fits) return "its indices do not fit into the type of their accessor";
      if (described.sparse != json::kNoNode) return "its indices are sparse";
    } else if (plain.primitive->indices_node != json::kNoNode) {
      return "its indices cannot be read";
    } else {
      part.elements.indices = most < UINT16_MAX ? ComponentType::uint16 : ComponentType::uint32;
    }
    plain.parts.push_back(part);
    return {};
  }

  void assign() {
    for (const PlainPrimitive& primitive : primitives_) {
      for (const Part& part : primitive.parts) {
        if (part.accessor) ++claims_[*part.accessor];
      }
    }
    for (const PlainPrimitive& primitive : primitives_) {
      for (const Part& part : primitive.parts) assign(part);
    }
  }

  // An accessor without other users receives its first decoded elements. All other elements go to
  // copies of the accessor.
  void assign(const Part& part) {
    if (part.accessor) {
      const bool same = has_already(*part.accessor, part.elements);
      const json::NodeId node = accessor(*part.accessor).node;
      const bool is_only_user = claims_[*part.accessor] == input_.graph.users(node).size();
      if (same && !is_only_user) return;
      if (is_only_user &&
          owners_.try_emplace(*part.accessor, part.elements).first->second == part.elements) {
        if (!same) views_.try_emplace(part.elements);
        return;
      }
    }
    copies_.try_emplace({part.accessor, part.elements});
    views_.try_emplace(part.elements);
  }

  bool has_already(std::uint32_t index, const Decoded& elements) {
    const model::Accessor& described = accessor(index);
    if (!described.buffer_view || described.count != count(elements)) return false;
    const auto [found, is_new] = same_.try_emplace({index, elements}, false);
    if (is_new) found->second = input_.elements_of(described) == bytes(elements);
    return found->second;
  }

  void free_views() {
    std::map<std::uint32_t, std::size_t> lost;  // users, by view
    for (const PlainPrimitive& primitive : primitives_) {
      ++lost[primitive.reference.buffer_view];
      edited_.insert(document_.find(primitive.reference.object, "bufferView"));
    }
    for (const auto& [index, elements] : owners_) {
      if (!accessor(index).buffer_view || has_already(index, elements)) continue;
      ++lost[*accessor(index).buffer_view];
      edited_.insert(document_.find(accessor(index).node, "bufferView"));
    }
    for (const auto& [view, users] : lost) {
      const json::NodeId node = input_.views.buffer_views[view].node;
      const bool has_extensions = document_.find(node, "extensions") != json::kNoNode;
      if (users == input_.graph.users(node).size() && !has_extensions) pool_.free(view);
    }
  }

  void place() {
    for (auto& [elements, view] : views_) {
      if (!elements.attribute) {
        view = pool_.add(container::Bytes::from_string(bytes(elements)), 0,
                         model::ViewTarget::indices);
        continue;
      }
      const model::Format format = this->format(elements);
      const std::uint64_t size = std::uint64_t{model::component_count(format.type)} *
                                 model::component_size(format.component);
      const std::uint64_t stride = aligned(size, kVertexAlignment);
      view = pool_.add(container::Bytes::from_string(spread(bytes(elements), size, stride)), stride,
                       model::ViewTarget::vertices);
    }
  }

  void declare(std::uint32_t index, const Decoded& elements) {
    if (has_already(index, elements)) return;
    json::Editor& editor = decoding_.editor;
    const model::Accessor& described = accessor(index);
    set_number(document_, editor, described.node, "bufferView",
               pool_.position(views_.at(elements)));
    remove_member(document_, editor, described.node, "byteOffset");
    if (described.count != count(elements)) {
      set_number(document_, editor, described.node, "count", count(elements));
    }
    mend_bounds(document_, editor, described, bytes(elements));
  }

  std::uint64_t add_accessor(const std::optional<std::uint32_t>& like, const Decoded& elements) {
    const AccessorMembers members{pool_.position(views_.at(elements)), count(elements)};
    const std::string json =
        like ? accessor_like(document_, accessor(*like), members, bytes(elements))
             : fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"SCALAR"}})",
                           *members.buffer_view, static_cast<unsigned>(elements.indices),
                           members.count);
    return decoding_.outcome.change.additions.add_element("accessors", json);
  }

  void make_plain(const PlainPrimitive& plain) {
    json::Editor& editor = decoding_.editor;
    const json::NodeId node = plain.primitive->node;
    for (const Part& part : plain.parts) {
      const auto copy = copies_.find({part.accessor, part.elements});
      if (copy == copies_.end()) continue;
      if (part.value == json::kNoNode) {
        editor.append_member(node, "indices", std::to_string(copy->second));
      } else {
        editor.replace_scalar(part.value, std::to_string(copy->second));
      }
    }
    if (plain.primitive->mode != model::Mode::triangles) {
      constexpr unsigned kTriangles = 4;
      set_number(document_, editor, node, "mode", kTriangles);
    }
    decoding_.remove(node, model::kDracoExtension);
  }

  Decoding& decoding_;
  const GeometryInput& input_;
  const json::Document& document_;
  ViewPool pool_;
  model::DracoMeshes meshes_;
  std::vector<PlainPrimitive> primitives_;
  std::map<std::uint32_t, std::size_t> claims_;  ///< references from primitives, by accessor
  std::map<std::pair<std::uint32_t, Decoded>, bool> same_;  ///< results of has_already()
  std::map<std::uint32_t, Decoded> owners_;                 ///< by accessor
  /// Copies of old accessors, and new ones.
  std::map<std::pair<std::optional<std::uint32_t>, Decoded>, std::uint64_t> copies_;
  std::map<Decoded, std::uint64_t> views_;  ///< numbers in the pool
  std::set<json::NodeId> edited_;           ///< replaced indices of views
};

}  // namespace

void decode_draco(Decoding& decoding) { DracoDecoder(decoding).run(); }

}  // namespace gltfx::steps
