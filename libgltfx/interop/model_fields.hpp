// SPDX-License-Identifier: Apache-2.0
/// The mapping of members of glTF to fields of tinygltf, for both directions. `Io` is a
/// ModelReader, which fills the fields, or a ModelWriter, which writes values other than the
/// default; their functions take the member's name, the field and, where there is one, the default.
/// For files that include <tiny_gltf.h>.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace gltfx::interop {

/// T for a reader, const T for a writer.
template <class Io, class T>
using Field = typename Io::template Field<T>;

inline constexpr int kTriangles = 4;  // the mode of primitives without one

/// Members that every object of glTF may have.
template <class Io, class T>
void describe_rest(Io& io, T& object) {
  io.extensions(object.extensions);
  io.extras(object.extras);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Asset>& asset) {
  io.required_text("version", asset.version);
  io.text("minVersion", asset.minVersion);
  io.text("generator", asset.generator);
  io.text("copyright", asset.copyright);
  describe_rest(io, asset);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Buffer>& buffer) {
  io.text("name", buffer.name);
  io.storage(buffer);
  describe_rest(io, buffer);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::BufferView>& view) {
  io.text("name", view.name);
  io.index("buffer", view.buffer);
  io.size("byteOffset", view.byteOffset);
  io.size("byteLength", view.byteLength);
  io.size("byteStride", view.byteStride);
  io.integer("target", view.target, 0);
  describe_rest(io, view);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Accessor>& accessor) {
  io.text("name", accessor.name);
  io.index("bufferView", accessor.bufferView);
  io.size("byteOffset", accessor.byteOffset);
  io.flag("normalized", accessor.normalized);
  io.integer("componentType", accessor.componentType, -1);
  io.size("count", accessor.count);
  io.element_type("type", accessor.type);
  io.numbers("min", accessor.minValues);
  io.numbers("max", accessor.maxValues);
  auto& sparse = accessor.sparse;
  io.section("sparse", sparse.isSparse, [&](Io& inner) {
    inner.integer("count", sparse.count, 0);
    inner.part("indices", [&](Io& part) {
      part.index("bufferView", sparse.indices.bufferView);
      part.integer("byteOffset", sparse.indices.byteOffset, 0);
      part.integer("componentType", sparse.indices.componentType, -1);
    });
    inner.part("values", [&](Io& part) {
      part.index("bufferView", sparse.values.bufferView);
      part.integer("byteOffset", sparse.values.byteOffset, 0);
    });
  });
  describe_rest(io, accessor);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Image>& image) {
  io.text("name", image.name);
  io.index("bufferView", image.bufferView);
  io.storage(image);
  describe_rest(io, image);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Sampler>& sampler) {
  io.text("name", sampler.name);
  io.integer("magFilter", sampler.magFilter, -1);
  io.integer("minFilter", sampler.minFilter, -1);
  io.integer("wrapS", sampler.wrapS, TINYGLTF_TEXTURE_WRAP_REPEAT);
  io.integer("wrapT", sampler.wrapT, TINYGLTF_TEXTURE_WRAP_REPEAT);
  describe_rest(io, sampler);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Texture>& texture) {
  io.text("name", texture.name);
  io.index("sampler", texture.sampler);
  io.index("source", texture.source);
  describe_rest(io, texture);
}

/// Members that the three kinds of texture infos share.
template <class Io, class T>
void describe_slot(Io& io, T& info) {
  io.index("index", info.index);
  io.integer("texCoord", info.texCoord, 0);
  describe_rest(io, info);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::TextureInfo>& info) {
  describe_slot(io, info);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::NormalTextureInfo>& info) {
  describe_slot(io, info);
  io.number("scale", info.scale, 1);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::OcclusionTextureInfo>& info) {
  describe_slot(io, info);
  io.number("strength", info.strength, 1);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::PbrMetallicRoughness>& pbr) {
  io.numbers("baseColorFactor", pbr.baseColorFactor, {1, 1, 1, 1});
  io.object("baseColorTexture", pbr.baseColorTexture, pbr.baseColorTexture.index >= 0);
  io.number("metallicFactor", pbr.metallicFactor, 1);
  io.number("roughnessFactor", pbr.roughnessFactor, 1);
  io.object("metallicRoughnessTexture", pbr.metallicRoughnessTexture,
            pbr.metallicRoughnessTexture.index >= 0);
  describe_rest(io, pbr);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Material>& material) {
  io.text("name", material.name);
  io.optional_object("pbrMetallicRoughness", material.pbrMetallicRoughness);
  io.object("normalTexture", material.normalTexture, material.normalTexture.index >= 0);
  io.object("occlusionTexture", material.occlusionTexture, material.occlusionTexture.index >= 0);
  io.object("emissiveTexture", material.emissiveTexture, material.emissiveTexture.index >= 0);
  io.numbers("emissiveFactor", material.emissiveFactor, {0, 0, 0});
  io.text("alphaMode", material.alphaMode, "OPAQUE");
  io.number("alphaCutoff", material.alphaCutoff, 0.5);
  io.flag("doubleSided", material.doubleSided);
  io.parameters(material);
  describe_rest(io, material);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Primitive>& primitive) {
  io.attributes("attributes", primitive.attributes);
  io.index("indices", primitive.indices);
  io.index("material", primitive.material);
  io.mode("mode", primitive.mode);
  io.targets("targets", primitive.targets);
  describe_rest(io, primitive);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Mesh>& mesh) {
  io.text("name", mesh.name);
  io.objects("primitives", mesh.primitives);
  io.numbers("weights", mesh.weights);
  describe_rest(io, mesh);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Node>& node) {
  io.text("name", node.name);
  io.indices("children", node.children);
  io.numbers("matrix", node.matrix);
  io.numbers("translation", node.translation);
  io.numbers("rotation", node.rotation);
  io.numbers("scale", node.scale);
  io.index("mesh", node.mesh);
  io.index("skin", node.skin);
  io.index("camera", node.camera);
  io.numbers("weights", node.weights);
  describe_rest(io, node);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Scene>& scene) {
  io.text("name", scene.name);
  io.indices("nodes", scene.nodes);
  describe_rest(io, scene);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Skin>& skin) {
  io.text("name", skin.name);
  io.index("inverseBindMatrices", skin.inverseBindMatrices);
  io.index("skeleton", skin.skeleton);
  io.indices("joints", skin.joints);
  describe_rest(io, skin);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::AnimationSampler>& sampler) {
  io.index("input", sampler.input);
  io.text("interpolation", sampler.interpolation, "LINEAR");
  io.index("output", sampler.output);
  describe_rest(io, sampler);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::AnimationChannel>& channel) {
  io.index("sampler", channel.sampler);
  io.part("target", [&](Io& target) {
    target.index("node", channel.target_node);
    target.text("path", channel.target_path);
    target.extensions(channel.target_extensions);
  });
  describe_rest(io, channel);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Animation>& animation) {
  io.text("name", animation.name);
  io.objects("channels", animation.channels);
  io.objects("samplers", animation.samplers);
  describe_rest(io, animation);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::PerspectiveCamera>& camera) {
  io.number("aspectRatio", camera.aspectRatio, 0);
  io.required_number("yfov", camera.yfov);
  io.number("zfar", camera.zfar, 0);
  io.required_number("znear", camera.znear);
  describe_rest(io, camera);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::OrthographicCamera>& camera) {
  io.required_number("xmag", camera.xmag);
  io.required_number("ymag", camera.ymag);
  io.required_number("zfar", camera.zfar);
  io.required_number("znear", camera.znear);
  describe_rest(io, camera);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Camera>& camera) {
  io.text("name", camera.name);
  io.text("type", camera.type);
  io.object("perspective", camera.perspective, camera.type == "perspective");
  io.object("orthographic", camera.orthographic, camera.type == "orthographic");
  describe_rest(io, camera);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::SpotLight>& spot) {
  io.number("innerConeAngle", spot.innerConeAngle, 0);
  io.number("outerConeAngle", spot.outerConeAngle, tinygltf::SpotLight().outerConeAngle);
  describe_rest(io, spot);
}

template <class Io>
void describe(Io& io, Field<Io, tinygltf::Light>& light) {
  io.text("name", light.name);
  io.required_text("type", light.type);
  io.numbers("color", light.color, {1, 1, 1});
  io.number("intensity", light.intensity, 1);
  io.number("range", light.range, 0);
  io.object("spot", light.spot, light.type == "spot");
  describe_rest(io, light);
}

/// The whole document. Its extensions include the lights, for which tinygltf has a list.
template <class Io>
void describe(Io& io, Field<Io, tinygltf::Model>& model) {
  io.object("asset", model.asset, true);
  io.extension_names(model);
  io.index("scene", model.defaultScene);
  io.objects("scenes", model.scenes);
  io.objects("nodes", model.nodes);
  io.objects("cameras", model.cameras);
  io.objects("meshes", model.meshes);
  io.objects("skins", model.skins);
  io.objects("animations", model.animations);
  io.objects("materials", model.materials);
  io.objects("textures", model.textures);
  io.objects("samplers", model.samplers);
  io.objects("images", model.images);
  io.objects("accessors", model.accessors);
  io.objects("bufferViews", model.bufferViews);
  io.objects("buffers", model.buffers);
  io.root_extensions(model);
  io.extras(model.extras);
}

/// Names of the types of elements, and tinygltf's numbers for them.
inline constexpr std::array<std::pair<std::string_view, int>, 7> kElementTypes{
    {{"SCALAR", TINYGLTF_TYPE_SCALAR},
     {"VEC2", TINYGLTF_TYPE_VEC2},
     {"VEC3", TINYGLTF_TYPE_VEC3},
     {"VEC4", TINYGLTF_TYPE_VEC4},
     {"MAT2", TINYGLTF_TYPE_MAT2},
     {"MAT3", TINYGLTF_TYPE_MAT3},
     {"MAT4", TINYGLTF_TYPE_MAT4}}};

}  // namespace gltfx::interop
