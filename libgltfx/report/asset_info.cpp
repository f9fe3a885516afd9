// SPDX-License-Identifier: Apache-2.0
#include "report/asset_info.hpp"

#include <string_view>

#include "report/long_value.hpp"

namespace gltfx::report {
namespace {

void write_if_any(json::Writer& writer, std::string_view name, const std::string& text) {
  if (!text.empty()) writer.member(name, long_value(text));
}

void write_if_any(json::Writer& writer, std::string_view name,
                  const std::vector<std::string>& texts) {
  if (!texts.empty()) write_long_values(writer, name, texts);
}

void write_image(json::Writer& writer, const ResourceInfo::Image& image) {
  writer.begin_object();
  writer.member("width", std::uint64_t{image.width});
  writer.member("height", std::uint64_t{image.height});
  write_if_any(writer, "format", image.format);
  write_if_any(writer, "primaries", image.primaries);
  write_if_any(writer, "transfer", image.transfer);
  if (image.bits > 0) writer.member("bits", std::uint64_t{image.bits});
  writer.end_object();
}

void write_resource(json::Writer& writer, const ResourceInfo& resource) {
  writer.begin_object();
  writer.member("pointer", resource.pointer);
  write_if_any(writer, "mimeType", resource.mime_type);
  write_if_any(writer, "storage", resource.storage);
  if (resource.storage == "external") {
    writer.member("uri", long_value(resource.uri));
  }
  if (resource.byte_length) writer.member("byteLength", *resource.byte_length);
  if (resource.image) {
    writer.key("image");
    write_image(writer, *resource.image);
  }
  writer.end_object();
}

void write_resources(json::Writer& writer, const std::vector<ResourceInfo>& resources) {
  if (resources.empty()) return;
  writer.key("resources");
  writer.begin_array();
  for (const ResourceInfo& resource : resources) write_resource(writer, resource);
  writer.end_array();
}

}  // namespace

void write_asset_info(json::Writer& writer, const AssetInfo& info) {
  writer.begin_object();
  write_if_any(writer, "version", info.version);
  write_if_any(writer, "minVersion", info.min_version);
  if (info.generator) writer.member("generator", long_value(*info.generator));
  write_if_any(writer, "extensionsUsed", info.extensions_used);
  write_if_any(writer, "extensionsRequired", info.extensions_required);
  write_resources(writer, info.resources);
  writer.member("animationCount", info.animation_count);
  writer.member("materialCount", info.material_count);
  writer.member("hasMorphTargets", info.has_morph_targets);
  writer.member("hasSkins", info.has_skins);
  writer.member("hasTextures", info.has_textures);
  writer.member("hasDefaultScene", info.has_default_scene);
  writer.member("drawCallCount", info.draw_call_count);
  writer.member("totalVertexCount", info.total_vertex_count);
  writer.member("totalTriangleCount", info.total_triangle_count);
  writer.member("maxUVs", info.max_uvs);
  writer.member("maxInfluences", info.max_influences);
  writer.member("maxAttributes", info.max_attributes);
  writer.end_object();
}

}  // namespace gltfx::report
