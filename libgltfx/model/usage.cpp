// SPDX-License-Identifier: Apache-2.0
#include "model/usage.hpp"

#include <array>

namespace gltfx::model {

// Visits all uses of accessors and views, in the order of precedence.
class UsageReader {
 public:
  UsageReader(const Asset& asset, const std::vector<Accessor>& accessors,
              const std::vector<BufferView>& views, const std::vector<Mesh>& meshes, Usage& usage)
      : asset_(asset), accessors_(accessors), meshes_(meshes), usage_(usage) {
    usage_.accessors_.resize(accessors.size());
    usage_.views_.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (views[i].target == ViewTarget::none) continue;
      usage_.views_[i].kind =
          views[i].target == ViewTarget::vertices ? ViewUse::vertices : ViewUse::indices;
    }
  }

  void read() {
    for (const Accessor& accessor : accessors_) read_sparse_views(accessor);
    for (const json::NodeId image : asset_.elements(RootArray::images)) {
      note_view(asset_.index(image, "bufferView", RootArray::buffer_views), ViewUse::image,
                document().find(image, "bufferView"));
    }
    for (const Mesh& mesh : meshes_) read_mesh(mesh);
    for (const json::NodeId skin : asset_.elements(RootArray::skins)) {
      note_member(skin, "inverseBindMatrices", AccessorUse::inverse_bind_matrices);
    }
    for (const json::NodeId animation : asset_.elements(RootArray::animations)) {
      read_samplers(animation);
    }
  }

 private:
  const json::Document& document() const { return asset_.document(); }

  void note_view(std::optional<std::uint32_t> view, ViewUse kind, json::NodeId place) {
    if (view) usage_.views_[*view].note(kind, place);
  }

  void note(std::optional<std::uint32_t> accessor, AccessorUse kind, json::NodeId place) {
    if (!accessor) return;
    usage_.accessors_[*accessor].note(kind, place);
    note_view(accessors_[*accessor].buffer_view, view_use(kind), place);
  }

  void note_member(json::NodeId object, std::string_view member, AccessorUse kind) {
    note(asset_.index(object, member, RootArray::accessors), kind, document().find(object, member));
  }

  void read_sparse_views(const Accessor& accessor) {
    const auto sparse = read_sparse(asset_, accessor);
    if (!sparse) return;
    for (const SparsePart* part : {&sparse->indices, &sparse->values}) {
      note_view(part->buffer_view, ViewUse::other, document().find(part->node, "bufferView"));
    }
  }

  void note_attributes(const std::vector<Attribute>& attributes) {
    for (const Attribute& attribute : attributes) {
      note(attribute.accessor, AccessorUse::vertex_attribute, attribute.value);
    }
  }

  void read_mesh(const Mesh& mesh) {
    for (const Primitive& primitive : mesh.primitives) {
      note_attributes(primitive.attributes);
      note(primitive.indices, AccessorUse::indices, primitive.indices_node);
      for (const json::NodeId target : primitive.targets) {
        note_attributes(read_attributes(asset_, target));
      }
    }
  }

  void read_samplers(json::NodeId animation) {
    const json::NodeId samplers = document().find(animation, "samplers");
    if (samplers == json::kNoNode || document().kind(samplers) != json::Kind::array) return;
    for (const json::NodeId sampler : document().elements(samplers)) {
      note_member(sampler, "input", AccessorUse::animation_input);
      note_member(sampler, "output", AccessorUse::animation_output);
    }
  }

  const Asset& asset_;
  const std::vector<Accessor>& accessors_;
  const std::vector<Mesh>& meshes_;
  Usage& usage_;
};

Usage::Usage(const Asset& asset, const std::vector<Accessor>& accessors,
             const std::vector<BufferView>& views, const std::vector<Mesh>& meshes) {
  UsageReader(asset, accessors, views, meshes, *this).read();
}

ViewUse view_use(AccessorUse use) {
  switch (use) {
    case AccessorUse::indices:
      return ViewUse::indices;
    case AccessorUse::vertex_attribute:
      return ViewUse::vertices;
    case AccessorUse::inverse_bind_matrices:
      return ViewUse::inverse_bind_matrices;
    case AccessorUse::none:
      return ViewUse::none;
    default:
      return ViewUse::other;
  }
}

std::string_view use_text(AccessorUse use) {
  static constexpr std::array<std::string_view, 6> kTexts{
      "nothing",        "animation times",  "animation values", "inverse bind matrices",
      "vertex indices", "vertex attributes"};
  return kTexts[static_cast<std::size_t>(use)];
}

std::string_view use_text(ViewUse use) {
  static constexpr std::array<std::string_view, 6> kTexts{
      "nothing",        "inverse bind matrices",    "an image",
      "vertex indices", "sparse or animation data", "vertex attributes"};
  return kTexts[static_cast<std::size_t>(use)];
}

}  // namespace gltfx::model
