// SPDX-License-Identifier: Apache-2.0
// Features of scenes, nodes, skins, cameras, lights and animations.
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/fields.hpp"
#include "model/skin.hpp"
#include "rules/targets/features.hpp"

namespace gltfx::validate {
namespace {

using json::NodeId;
using model::RootArray;

constexpr std::string_view kLights = "KHR_lights_punctual";

class SceneFeatures {
 public:
  SceneFeatures(const Context& context, Features& features)
      : context_(context),
        document_(context.document),
        views_(context.views),
        features_(features),
        scales_(features.matters("node.negative-scale") || features.matters("node.zero-scale")),
        places_(features.matters("node.translation-over-million")),
        special_names_(features.matters("node.name-special")),
        meshes_(views_.meshes.size()),
        name_key_(document_.key_id("name")) {}

  void find() {
    find_scenes();
    for (const model::Node& node : views_.nodes) {
      if (node.object != json::kNoNode) find_node(node);
    }
    for (const NodeId skin : context_.asset.elements(RootArray::skins)) {
      if (skin != json::kNoNode) find_skin(skin);
    }
    find_lights();
    for (const model::Animation& animation : views_.animations) {
      if (animation.object != json::kNoNode) find_animation(animation);
    }
    note_if(views_.animations.size() > 1, "animation.several", member("animations"));
    find_animation_names();
    if (features_.matters("node.name-doubled")) find_doubled_names();
  }

 private:
  void note_if(bool has, std::string_view name, NodeId node) { features_.note_if(has, name, node); }
  NodeId member(std::string_view name) const { return document_.find(document_.root(), name); }

  void find_scenes() {
    const auto& scenes = context_.asset.elements(RootArray::scenes);
    const auto chosen = context_.asset.index(document_.root(), "scene", RootArray::scenes);
    const NodeId root = document_.root();
    note_if(scenes.empty(), "scene.none", root);
    note_if(scenes.size() > 1, "scene.several", member("scenes"));
    note_if(!scenes.empty() && member("scene") == json::kNoNode, "scene.no-default",
            member("scenes"));
    note_if(chosen.value_or(0) != 0, "scene.default-not-first", member("scene"));
    if (!chosen) return;
    const NodeId scene = scenes[*chosen];
    note_if(document_.find(scene, "nodes") == json::kNoNode, "scene.empty", scene);
  }

  void find_node(const model::Node& node) {
    const NodeId object = node.object;
    note_if(node.matrix != json::kNoNode, "node.matrix", object);
    if (scales_) find_scale(node);
    if (places_) find_place(node);
    note_if(node.weights != json::kNoNode, "morph.node-weights", object);
    if (node.mesh) {
      note_if(meshes_[*node.mesh], "node.mesh-shared", object);
      meshes_[*node.mesh] = true;
    }
    if (special_names_) find_special_name(object);
    if (node.camera) find_camera(context_.asset.elements(RootArray::cameras)[*node.camera]);
    if (!node.skin) return;
    features_.note("skin.joints", object);
    note_if(!skins_.insert(*node.skin).second, "skin.shared", object);
    note_if(!model::read_transform(document_, node).is_identity(), "skin.transformed-mesh", object);
  }

  void find_scale(const model::Node& node) {
    if (const auto matrix = model::float_array<16>(document_, node.matrix)) {
      const bool mirrors = model::Affine::from_matrix(*matrix).determinant() < 0;
      return note_if(mirrors, "node.negative-scale", node.object);
    }
    const auto scale = model::float_array<3>(document_, node.scale);
    if (!scale) return;
    const float product = (*scale)[0] * (*scale)[1] * (*scale)[2];
    note_if(product < 0, "node.negative-scale", node.object);
    note_if((*scale)[0] == 0 || (*scale)[1] == 0 || (*scale)[2] == 0, "node.zero-scale",
            node.object);
  }

  void find_place(const model::Node& node) {
    const auto far = [&](const std::array<float, 3>& place) {
      note_if(is_far(place), "node.translation-over-million", node.object);
    };
    if (const auto m = model::float_array<16>(document_, node.matrix)) {
      return far({(*m)[12], (*m)[13], (*m)[14]});
    }
    if (const auto place = model::float_array<3>(document_, node.translation)) far(*place);
  }

  void find_animation_names() {
    json::KeyTable names;
    for (const model::Animation& animation : views_.animations) {
      const NodeId name =
          animation.object == json::kNoNode ? animation.object : name_of(animation.object);
      if (name == json::kNoNode) continue;
      features_.note("animation.name", animation.object);
      note_if(!document_.insert_string(name, names), "animation.name-doubled", animation.object);
    }
  }

  // The name of an object, or kNoNode where it has none.
  NodeId name_of(NodeId object) const {
    const NodeId value = document_.find(object, name_key_);
    const bool named = value != json::kNoNode && document_.is_string(value);
    std::string buffer;
    return named && !document_.string(value, buffer).empty() ? value : json::kNoNode;
  }

  void find_special_name(NodeId object) {
    const NodeId value = name_of(object);
    if (value == json::kNoNode) return;
    std::string buffer;
    const std::string_view name = document_.string(value, buffer);
    note_if(std::any_of(name.begin(), name.end(), is_special), "node.name-special", object);
  }

  // Finds a name shared by an animated node and another one.
  void find_doubled_names() {
    json::KeyTable moving;
    std::set<std::uint32_t> seen;
    for (const model::Animation& animation : views_.animations) {
      for (const model::AnimationChannel& channel : animation.channels) {
        if (!channel.node || !seen.insert(*channel.node).second) continue;
        const NodeId object = views_.nodes[*channel.node].object;
        const NodeId name = name_of(object);
        if (name == json::kNoNode) continue;
        note_if(!document_.insert_string(name, moving), "node.name-doubled", object);
      }
    }
    if (seen.empty()) return;
    for (std::uint32_t node = 0; node < views_.nodes.size(); ++node) {
      const NodeId object = views_.nodes[node].object;
      const NodeId name = object == json::kNoNode ? object : name_of(object);
      if (name == json::kNoNode || seen.count(node) != 0) continue;
      std::string buffer;
      const bool doubled = moving.find(document_.string(name, buffer)) != json::kNoKey;
      note_if(doubled, "node.name-doubled", object);
    }
  }

  static bool is_special(char c) {
    return c == '[' || c == ']' || c == '.' || c == ':' || c == '/';
  }

  void find_camera(NodeId camera) {
    const std::string type = model::string_member(document_, camera, "type");
    note_if(type == "orthographic", "camera.orthographic", camera);
    if (type != "perspective") return;
    features_.note("camera.perspective", camera);
    const NodeId lens = model::object_member(document_, camera, "perspective");
    note_if(lens != json::kNoNode && document_.find(lens, "zfar") == json::kNoNode,
            "camera.infinite", camera);
  }

  void find_skin(NodeId object) {
    const model::Skin skin = model::read_skin(context_.asset, object);
    note_if(skin.joint_count > 64, "skin.joints-over-64", object);
    note_if(skin.joint_count > 256, "skin.joints-over-256", object);
    note_if(skin.inverse_bind_matrices_value == json::kNoNode, "skin.no-inverse-bind-matrices",
            object);
    if (!features_.matters("skin.joint-name-doubled")) return;
    json::KeyTable names;
    for (const model::NodeIndex joint : skin.joint_nodes) {
      const NodeId name = name_of(views_.nodes[joint].object);
      if (name == json::kNoNode) continue;
      note_if(!document_.insert_string(name, names), "skin.joint-name-doubled", object);
    }
  }

  void find_lights() {
    const NodeId extension = model::extension_object(document_, document_.root(), kLights);
    const NodeId lights = document_.find(extension, "lights");
    if (lights == json::kNoNode || document_.kind(lights) != json::Kind::array) return;
    std::vector<bool> directional;  // by light
    for (const NodeId light : document_.elements(lights)) {
      const bool is_object = document_.is_object(light);
      const std::string type =
          is_object ? model::string_member(document_, light, "type") : std::string();
      directional.push_back(type == "directional");
      note_if(type == "directional", "light.directional", light);
      note_if(type == "point", "light.point", light);
      note_if(type == "spot", "light.spot", light);
    }
    find_lit_nodes(directional);
  }

  void find_lit_nodes(const std::vector<bool>& directional) {
    std::size_t count = 0, suns = 0;
    for (const model::Node& node : views_.nodes) {
      if (node.object == json::kNoNode) continue;
      const NodeId extension = model::extension_object(document_, node.object, kLights);
      const auto light = model::unsigned_member(document_, extension, "light");
      if (!light || *light >= directional.size()) continue;
      ++count;
      note_if(count > 4, "light.lights-over-4", node.object);
      note_if(count > 8, "light.lights-over-8", node.object);
      note_if(count > 16, "light.lights-over-16", node.object);
      if (directional[*light]) note_if(++suns > 1, "light.several-directional", node.object);
    }
  }

  void find_animation(const model::Animation& animation) {
    for (const model::AnimationSampler& sampler : animation.samplers) {
      note_if(sampler.interpolation == model::Interpolation::step, "animation.step",
              sampler.object);
      note_if(sampler.interpolation == model::Interpolation::cubic_spline, "animation.cubic-spline",
              sampler.object);
      if (sampler.input) find_times(views_.accessors[*sampler.input], sampler.object);
    }
    for (const model::AnimationChannel& channel : animation.channels) {
      find_channel(animation, channel);
    }
  }

  void find_times(const model::Accessor& times, NodeId sampler) {
    note_if(times.count == 1U, "animation.single-key", sampler);
    const auto first = model::float_array<1>(document_, times.min);
    note_if(first && (*first)[0] > 0, "animation.late-start", sampler);
  }

  void find_channel(const model::Animation& animation, const model::AnimationChannel& channel) {
    using model::AnimationPath;
    using model::ComponentType;
    const NodeId object = channel.object;
    note_if(!channel.node && channel.target != json::kNoNode &&
                document_.find(channel.target, "node") == json::kNoNode &&
                document_.find(channel.target, "extensions") == json::kNoNode,
            "animation.no-target", object);
    note_if(channel.path == AnimationPath::translation, "animation.translation", object);
    note_if(channel.path == AnimationPath::rotation, "animation.rotation", object);
    note_if(channel.path == AnimationPath::scale, "animation.scale", object);
    note_if(channel.path == AnimationPath::weights, "animation.weights", object);
    if (!channel.sampler || !animation.samplers[*channel.sampler].output) return;
    const std::uint32_t output = *animation.samplers[*channel.sampler].output;
    const ComponentType type = views_.accessors[output].format.component;
    if (channel.path == AnimationPath::rotation) {
      note_if(type == ComponentType::int8, "animation.rotation-int8", object);
      note_if(type == ComponentType::int16, "animation.rotation-int16", object);
    }
    note_if(channel.path == AnimationPath::weights && type == ComponentType::uint8,
            "animation.weights-uint8", object);
  }

  const Context& context_;
  const json::Document& document_;
  const model::Views& views_;
  Features& features_;
  bool scales_, places_, special_names_;  // whether a target depends on it
  std::vector<bool> meshes_;              // by mesh: whether a node uses it
  json::KeyId name_key_;
  std::set<std::uint32_t> skins_;
};

}  // namespace

void find_scene_features(const Context& context, Features& features) {
  SceneFeatures(context, features).find();
}

}  // namespace gltfx::validate
