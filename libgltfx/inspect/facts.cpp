// SPDX-License-Identifier: Apache-2.0
#include "inspect/facts.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/checked.hpp"
#include "base/media_type.hpp"
#include "graph/graph.hpp"
#include "inspect/external_facts.hpp"
#include "inspect/metadata_facts.hpp"
#include "measure/byte_count.hpp"
#include "measure/image_facts.hpp"
#include "measure/take.hpp"
#include "model/camera.hpp"
#include "model/fields.hpp"
#include "model/format_set.hpp"
#include "model/info.hpp"
#include "model/keyframes.hpp"
#include "model/light.hpp"
#include "model/resource_data.hpp"
#include "model/scene_extent.hpp"
#include "model/skin.hpp"

namespace gltfx::inspect {
namespace {

using model::RootArray;

constexpr std::uint64_t kInstanceBytes = std::uint64_t{1} << 28U;

/// Data that is read once and used by all parts.
struct Source {
  const model::Asset asset;
  const model::Views& views;
  const schema::Set& schemas;
  container::OpenedFiles files;
  const model::LoadedResources loaded;
  const measure::Source measured;
  const graph::Graph& graph;
  const measure::ByteCount& bytes;

  Source(const model::OpenedAsset& opened, const schema::Set& known, unsigned jobs)
      : asset(opened.document()),
        views(opened.views()),
        schemas(known),
        files(opened.resolver()),
        loaded(model::load_resources(opened.container(), files, asset, views, jobs)),
        measured(
            {opened.name(), opened.container(), files, asset, views, loaded.data, known, jobs}),
        graph(measured.graph()),
        bytes(measured.byte_count()) {}

  const json::Document& document() const { return asset.document(); }
};

void read_header(const Source& source, AssetFacts& facts) {
  const json::Document& document = source.document();
  const json::NodeId header = model::object_member(document, document.root(), "asset");
  facts.version = model::string_member(document, header, "version");
  facts.min_version = model::string_member(document, header, "minVersion");
  facts.generator = model::string_member(document, header, "generator");
  facts.copyright = model::string_member(document, header, "copyright");
  facts.scenes = source.asset.count(RootArray::scenes);
  facts.nodes = source.asset.count(RootArray::nodes);
  facts.accessors = source.asset.count(RootArray::accessors);
  facts.textures = source.asset.count(RootArray::textures);
}

std::optional<std::uint64_t> accessors_for(const Source& source,
                                           const schema::Extension& extension) {
  if (!extension.attachment_points.empty()) return std::nullopt;
  std::uint64_t sum = model::count_with_added_format(source.asset, source.views, extension);
  bool formats = !extension.vertex_attributes.empty() || !extension.morph_attributes.empty();
  for (const auto& [place, values] : extension.enum_additions) {
    if (place != "accessor/componentType") continue;
    formats = true;
    for (const model::Accessor& accessor : source.views.accessors) {
      const std::string type = std::to_string(static_cast<unsigned>(accessor.format.component));
      sum += std::find(values.begin(), values.end(), type) != values.end() ? 1 : 0;
    }
  }
  return formats ? std::optional(sum) : std::nullopt;
}

std::vector<ExtensionFacts> extensions_of(const Source& source) {
  std::map<std::string, ExtensionFacts> by_name;
  const schema::CheckResult& checked = source.graph.checked();
  for (const std::string& name : checked.extensions_used) by_name[name].used = true;
  for (const std::string& name : checked.extensions_required) by_name[name].required = true;
  for (const std::string& name : checked.extensions_seen) by_name[name].seen = true;
  std::vector<ExtensionFacts> list;
  for (auto& [name, facts] : by_name) {
    facts.name = name;
    facts.status = "unknown";
    const schema::ExtensionId id = source.schemas.find_extension(name);
    if (id != schema::kNone) {
      const schema::Extension& extension = source.schemas.extensions()[id];
      facts.status = schema::status_name(extension.status);
      facts.spec = extension.spec;
      facts.successor = extension.successor;
      facts.has_objects = !extension.attachment_points.empty();
      facts.accessors = accessors_for(source, extension);
    }
    list.push_back(std::move(facts));
  }
  return list;
}

/// Meshes, with the size of their decompressed accessors.
class MeshReader {
 public:
  explicit MeshReader(const Source& source)
      : source_(source), counted_(source.views.accessors.size(), false) {}

  void read(AssetFacts& facts) {
    for (std::size_t i = 0; i < source_.views.meshes.size(); ++i) {
      MeshFacts mesh = read(source_.views.meshes[i]);
      mesh.bytes = source_.bytes.meshes[i];
      facts.primitives += mesh.primitives;
      facts.triangles = saturating_add(facts.triangles, mesh.triangles);
      facts.vertices = saturating_add(facts.vertices, mesh.vertices);
      facts.meshes.push_back(std::move(mesh));
    }
  }

 private:
  MeshFacts read(const model::Mesh& mesh) {
    MeshFacts facts;
    if (mesh.node != json::kNoNode) facts.name = source_.asset.name(mesh.node);
    for (const model::Primitive& primitive : mesh.primitives) {
      if (primitive.node == json::kNoNode) continue;
      const model::PrimitiveSize size = model::primitive_size(source_.views, primitive);
      ++facts.primitives;
      facts.triangles = saturating_add(facts.triangles, size.triangles);
      facts.vertices = saturating_add(facts.vertices, size.vertices);
      take(primitive, facts);
    }
    return facts;
  }

  void take(const model::Primitive& primitive, MeshFacts& facts) {
    take(primitive.indices, facts);
    take(primitive.attributes, facts);
    for (const json::NodeId target : primitive.targets) {
      take(model::read_attributes(source_.asset, target), facts);
    }
  }

  void take(const std::vector<model::Attribute>& attributes, MeshFacts& facts) {
    for (const model::Attribute& attribute : attributes) take(attribute.accessor, facts);
  }

  // Several primitives may share an accessor.
  void take(const std::optional<std::uint32_t>& index, MeshFacts& facts) {
    if (!index || counted_[*index]) return;
    counted_[*index] = true;
    const model::Accessor& accessor = source_.views.accessors[*index];
    const Checked bytes =
        checked_mul(accessor.count.value_or(0), model::packed_stride(accessor.format));
    facts.gpu_bytes = saturating_add(facts.gpu_bytes, bytes.value_or(UINT64_MAX));
  }

  const Source& source_;
  std::vector<bool> counted_;  // by accessor
};

std::vector<MaterialFacts> materials_of(const Source& source) {
  const json::Document& document = source.document();
  std::vector<MaterialFacts> list;
  for (const json::NodeId object : source.asset.elements(RootArray::materials)) {
    MaterialFacts facts;
    facts.name = source.asset.name(object);
    facts.alpha_mode = model::string_member(document, object, "alphaMode");
    if (facts.alpha_mode.empty()) facts.alpha_mode = "OPAQUE";
    facts.double_sided = model::true_member(document, object, "doubleSided");
    const json::NodeId extensions = model::object_member(document, object, "extensions");
    if (extensions != json::kNoNode) {
      for (const auto member : document.members(extensions)) {
        facts.extensions.emplace_back(document.key(member.key_id));
      }
    }
    list.push_back(std::move(facts));
  }
  return list;
}

// The pointer of a slot gives its material.
void count_slots(const Source& source, std::vector<MaterialFacts>& materials) {
  constexpr std::string_view kStart = "/materials/";
  for (const schema::SlotUse& use : source.graph.checked().slots) {
    if (!std::string_view(use.pointer).starts_with(kStart)) continue;
    std::uint64_t index = 0;
    for (std::size_t i = kStart.size(); i < use.pointer.size() && use.pointer[i] != '/'; ++i) {
      index = index * 10 + static_cast<std::uint64_t>(use.pointer[i] - '0');
    }
    if (index < materials.size()) ++materials[index].textures;
  }
}

std::vector<AnimationFacts> animations_of(const Source& source) {
  std::vector<AnimationFacts> list;
  for (std::size_t i = 0; i < source.views.animations.size(); ++i) {
    const model::Animation& animation = source.views.animations[i];
    AnimationFacts facts;
    facts.name = source.asset.name(animation.object);
    facts.channels = animation.channels.size();
    facts.samplers = animation.samplers.size();
    facts.bytes = source.bytes.animations[i];
    facts.duration = model::duration_of(source.asset, source.views, animation);
    for (const model::AnimationSampler& sampler : animation.samplers) {
      if (!sampler.input) continue;
      const auto count = source.views.accessors[*sampler.input].count;
      facts.keyframes = saturating_add(facts.keyframes, count.value_or(0));
    }
    list.push_back(std::move(facts));
  }
  return list;
}

std::vector<SkinFacts> skins_of(const Source& source) {
  std::vector<SkinFacts> list;
  const auto& objects = source.asset.elements(RootArray::skins);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    SkinFacts facts;
    facts.bytes = source.bytes.skins[i];
    if (objects[i] != json::kNoNode) {
      facts.name = source.asset.name(objects[i]);
      facts.joints = model::read_skin(source.asset, objects[i]).joint_count;
    }
    list.push_back(std::move(facts));
  }
  return list;
}

std::vector<NamedFacts> cameras_of(const Source& source) {
  std::vector<NamedFacts> list;
  for (const json::NodeId object : source.asset.elements(RootArray::cameras)) {
    list.push_back(
        {source.asset.name(object), model::string_member(source.document(), object, "type")});
  }
  return list;
}

std::vector<NamedFacts> lights_of(const Source& source) {
  std::vector<NamedFacts> list;
  for (const auto& light : model::read_lights(source.asset)) {
    if (!light) {
      list.push_back({"", "unknown"});
      continue;
    }
    const bool spot = light->type == model::LightType::spot;
    const bool sun = light->type == model::LightType::directional;
    list.push_back({light->name, spot ? "spot" : sun ? "directional" : "point"});
  }
  return list;
}

}  // namespace

AssetFacts collect_own_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                             const InspectOptions& options) {
  Source source(opened, schemas, options.jobs);
  AssetFacts facts;
  const bool glb = opened.container().format == container::Format::glb;
  facts.mime_type = glb ? kGlbMediaType : kGltfMediaType;
  for (const model::MissingData& missing : source.loaded.missing) {
    facts.problems.push_back(missing.sentence());
  }
  facts.files = source.bytes.files;
  facts.bytes = source.bytes.shares;
  read_header(source, facts);
  facts.extensions = extensions_of(source);
  MeshReader(source).read(facts);
  facts.materials = materials_of(source);
  count_slots(source, facts.materials);
  facts.images = measure::image_facts(source.asset, source.loaded.data,
                                      source.graph.checked().slots, facts.problems);
  for (std::size_t i = 0; i < facts.images.size(); ++i) {
    facts.images[i].bytes = source.bytes.images[i];
  }
  facts.animations = animations_of(source);
  facts.skins = skins_of(source);
  facts.cameras = cameras_of(source);
  facts.lights = lights_of(source);
  add_metadata_facts(source.asset, source.views, facts);
  const model::SceneExtent extent = model::scene_extent(
      source.asset, source.views, source.loaded.data, facts.meshes, kInstanceBytes,
      model::compute_pose(source.asset, source.views,
                          model::choose_scene(source.asset, source.views)));
  facts.drawn_triangles = extent.triangles;
  facts.bounds = extent.bounds;
  if (options.measures) {
    measure::Request request;
    request.pixels = options.pixels;
    facts.measurements = measure::take(source.measured, request);
  }
  return facts;
}

AssetFacts collect_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                         const InspectOptions& options) {
  AssetFacts facts = collect_own_facts(opened, schemas, options);
  add_external_facts(opened, schemas, options, facts);
  return facts;
}

}  // namespace gltfx::inspect
