// SPDX-License-Identifier: Apache-2.0
#include "report/facts_json.hpp"

#include <gltfx/version.hpp>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

#include "report/measures_json.hpp"
#include "report/safe_text.hpp"

namespace gltfx {
namespace {

using json::Writer;

// Raised when a reader of the previous format could misread the next.
constexpr std::uint64_t kFormat = 1;

constexpr std::array<std::string_view, kByteUseCount> kByteUseNames{
    "json", "meshes", "images", "animations", "skins", "other", "unused", "base64", "padding"};
template <class Facts>
std::uint64_t sum(const std::vector<Facts>& list, std::uint64_t Facts::*member) {
  std::uint64_t total = 0;
  for (const Facts& facts : list) {
    const std::uint64_t room = UINT64_MAX - total;
    total += std::min(facts.*member, room);
  }
  return total;
}

void member_if(Writer& writer, std::string_view name, const std::string& text) {
  if (!text.empty()) writer.member(name, report::long_value(text));
}

void write_counts(Writer& writer, const AssetFacts& facts) {
  writer.key("counts");
  writer.begin_object();
  writer.member("scenes", facts.scenes);
  writer.member("nodes", facts.nodes);
  writer.member("meshes", std::uint64_t{facts.meshes.size()});
  writer.member("primitives", facts.primitives);
  writer.member("triangles", facts.triangles);
  writer.member("vertices", facts.vertices);
  writer.member("drawnTriangles", facts.drawn_triangles);
  writer.member("accessors", facts.accessors);
  writer.member("materials", std::uint64_t{facts.materials.size()});
  writer.member("textures", facts.textures);
  writer.member("images", std::uint64_t{facts.images.size()});
  writer.member("animations", std::uint64_t{facts.animations.size()});
  writer.member("skins", std::uint64_t{facts.skins.size()});
  writer.member("cameras", std::uint64_t{facts.cameras.size()});
  writer.member("lights", std::uint64_t{facts.lights.size()});
  const auto count_if = [&writer](std::string_view name, std::uint64_t count) {
    if (count > 0) writer.member(name, count);
  };
  count_if("shapes", facts.shapes);
  count_if("boundingVolumes", facts.bounding_volumes);
  writer.end_object();
}

void write_point(Writer& writer, std::string_view name, const std::array<double, 3>& point) {
  writer.key(name);
  writer.begin_array();
  for (const double value : point) writer.number(value);
  writer.end_array();
}

void write_bounds(Writer& writer, const SceneBounds& bounds) {
  writer.key("bounds");
  writer.begin_object();
  write_point(writer, "min", bounds.least);
  write_point(writer, "max", bounds.greatest);
  writer.end_object();
}

void write_sizes(Writer& writer, const AssetFacts& facts) {
  writer.key("bytes");
  writer.begin_object();
  writer.member("total", facts.total_bytes());
  for (std::size_t i = 0; i < kByteUseCount; ++i) {
    writer.member(kByteUseNames[i], facts.bytes[i]);
  }
  writer.end_object();
  writer.key("gpuBytes");
  writer.begin_object();
  writer.member("images", facts.image_gpu_bytes());
  writer.member("meshes", facts.mesh_gpu_bytes());
  writer.end_object();
}

void write(Writer& writer, const FileFacts& facts) {
  member_if(writer, "uri", facts.uri);
  writer.member("bytes", facts.bytes);
}

void write(Writer& writer, const ExtensionFacts& facts) {
  writer.member("name", report::long_value(facts.name));
  writer.member("status", facts.status);
  writer.member("used", facts.used);
  writer.member("required", facts.required);
  writer.member("seen", facts.seen);
  if (facts.accessors) writer.member("accessors", *facts.accessors);
  member_if(writer, "spec", facts.spec);
  member_if(writer, "successor", facts.successor);
}

void write(Writer& writer, const MeshFacts& facts) {
  member_if(writer, "name", facts.name);
  writer.member("primitives", facts.primitives);
  writer.member("triangles", facts.triangles);
  writer.member("vertices", facts.vertices);
  writer.member("bytes", facts.bytes);
  writer.member("gpuBytes", facts.gpu_bytes);
}

void write(Writer& writer, const MaterialFacts& facts) {
  member_if(writer, "name", facts.name);
  writer.member("alphaMode", report::long_value(facts.alpha_mode));
  writer.member("doubleSided", facts.double_sided);
  writer.member("textures", facts.textures);
  report::write_long_values(writer, "extensions", facts.extensions);
}

void write(Writer& writer, const ImageFacts& facts) {
  member_if(writer, "name", facts.name);
  member_if(writer, "uri", facts.uri);
  member_if(writer, "format", facts.format);
  member_if(writer, "encoding", facts.encoding);
  writer.member("width", std::uint64_t{facts.width});
  writer.member("height", std::uint64_t{facts.height});
  writer.member("bits", std::uint64_t{facts.bits});
  member_if(writer, "channels", facts.channels);
  writer.member("levels", std::uint64_t{facts.levels});
  report::write_long_values(writer, "slots", facts.slots);
  member_if(writer, "colorSpace", facts.color_space);
  writer.member("textures", facts.textures);
  writer.member("bytes", facts.bytes);
  writer.member("gpuBytes", facts.gpu_bytes);
}

void write(Writer& writer, const AnimationFacts& facts) {
  member_if(writer, "name", facts.name);
  writer.key("duration");
  writer.number(facts.duration);
  writer.member("channels", facts.channels);
  writer.member("samplers", facts.samplers);
  writer.member("keyframes", facts.keyframes);
  writer.member("bytes", facts.bytes);
}

void write(Writer& writer, const SkinFacts& facts) {
  member_if(writer, "name", facts.name);
  writer.member("joints", facts.joints);
  writer.member("bytes", facts.bytes);
}

void write(Writer& writer, const NamedFacts& facts) {
  member_if(writer, "name", facts.name);
  member_if(writer, "type", facts.type);
}

void write(Writer& writer, const MetadataClassFacts& facts) {
  writer.member("name", report::long_value(facts.name));
  writer.member("properties", facts.properties);
}

void write(Writer& writer, const PropertyTableFacts& facts) {
  member_if(writer, "name", facts.name);
  writer.member("class", report::long_value(facts.class_id));
  writer.member("rows", facts.rows);
  writer.member("columns", facts.columns);
  writer.member("bytes", facts.bytes);
}

void write(Writer& writer, const ReferredFileFacts& facts) {
  member_if(writer, "name", facts.name);
  member_if(writer, "uri", facts.uri);
  member_if(writer, "mimeType", facts.mime_type);
  if (facts.bytes) writer.member("bytes", *facts.bytes);
  if (!facts.aliases.empty()) report::write_long_values(writer, "aliases", facts.aliases);
  member_if(writer, "problem", facts.problem);
}

void write(Writer& writer, const ExternalAssetFacts& facts) {
  writer.member("depth", facts.depth);
  writer.member("index", facts.index);
  writer.member("path", report::long_value(facts.path));
  member_if(writer, "mimeType", facts.mime_type);
  writer.member("placed", facts.placed);
  writer.member("state", external_asset_state_name(facts.state));
  if (facts.state == ExternalAssetState::read) {
    writer.member("nodes", facts.nodes);
    writer.member("meshes", facts.meshes);
    writer.member("triangles", facts.triangles);
    writer.member("bytes", facts.bytes);
  }
  member_if(writer, "problem", facts.problem);
}

// A tree in the order of its rows: the first of them are a tree, too.
void write_external_assets(Writer& writer, const std::vector<ExternalAssetFacts>& list,
                           std::size_t most) {
  writer.key("externalAssets");
  writer.begin_array();
  for (std::size_t i = 0; i < list.size() && (most == 0 || i < most); ++i) {
    writer.begin_object();
    write(writer, list[i]);
    writer.end_object();
  }
  writer.end_array();
}

std::uint64_t bytes_of(const ReferredFileFacts& facts) { return facts.bytes.value_or(0); }
std::uint64_t bytes_of(const MetadataClassFacts&) { return 0; }
std::uint64_t bytes_of(const ExtensionFacts&) { return 0; }
std::uint64_t bytes_of(const MaterialFacts&) { return 0; }
std::uint64_t bytes_of(const NamedFacts&) { return 0; }
template <class Facts>
std::uint64_t bytes_of(const Facts& facts) {
  return facts.bytes;
}

// Positions of the entries to write, in the order of the list.
template <class Facts>
std::vector<std::size_t> largest(const std::vector<Facts>& list, std::size_t most) {
  std::vector<std::size_t> order(list.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (most == 0 || list.size() <= most) return order;
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(most);
  std::partial_sort(order.begin(), middle, order.end(), [&](std::size_t a, std::size_t b) {
    const std::uint64_t left = bytes_of(list[a]), right = bytes_of(list[b]);
    return left != right ? left > right : a < b;
  });
  order.erase(middle, order.end());
  std::sort(order.begin(), order.end());
  return order;
}

template <class Facts>
void write_list(Writer& writer, std::string_view name, const std::vector<Facts>& list,
                std::size_t most) {
  writer.key(name);
  writer.begin_array();
  for (const std::size_t i : largest(list, most)) {
    writer.begin_object();
    writer.member("index", std::uint64_t{i});
    write(writer, list[i]);
    writer.end_object();
  }
  writer.end_array();
}

void write_shown(Writer& writer, const std::vector<ShownFact>& shown) {
  writer.key("shows");
  writer.begin_array();
  for (const ShownFact& fact : shown) {
    writer.begin_object();
    writer.member("code", fact.code);
    writer.member("severity", fact.severity);
    writer.member("pointer", fact.pointer);
    writer.member("message", fact.message);
    writer.end_object();
  }
  writer.end_array();
}

void write_report(Writer& writer, const InspectReport& report) {
  writer.begin_object();
  writer.member("path", report.path);
  member_if(writer, "error", report.error);
  if (report.facts) {
    writer.key("facts");
    report::write_facts(writer, *report.facts);
  }
  writer.key("upgrade");
  report::write_upgrade_facts(writer, report.upgrade);
  member_if(writer, "upgradeProblem", report.upgrade_problem);
  write_shown(writer, report.shown);
  member_if(writer, "showsProblem", report.shown_problem);
  writer.end_object();
}

}  // namespace

std::string_view byte_use_name(ByteUse use) { return kByteUseNames[static_cast<std::size_t>(use)]; }

std::string_view external_asset_state_name(ExternalAssetState state) {
  constexpr std::array<std::string_view, 4> kNames{"read", "repeated", "cycle", "unread"};
  return kNames[static_cast<std::size_t>(state)];
}

std::uint64_t AssetFacts::total_bytes() const { return sum(files, &FileFacts::bytes); }
std::uint64_t AssetFacts::image_gpu_bytes() const { return sum(images, &ImageFacts::gpu_bytes); }
std::uint64_t AssetFacts::mesh_gpu_bytes() const { return sum(meshes, &MeshFacts::gpu_bytes); }

namespace report {

void write_facts(Writer& writer, const AssetFacts& facts, std::size_t most) {
  writer.begin_object();
  writer.member("mimeType", facts.mime_type);
  member_if(writer, "version", facts.version);
  member_if(writer, "minVersion", facts.min_version);
  member_if(writer, "generator", facts.generator);
  member_if(writer, "copyright", facts.copyright);
  write_counts(writer, facts);
  if (facts.bounds) write_bounds(writer, *facts.bounds);
  write_sizes(writer, facts);
  write_list(writer, "files", facts.files, most);
  write_list(writer, "extensions", facts.extensions, 0);
  write_list(writer, "meshes", facts.meshes, most);
  write_list(writer, "materials", facts.materials, most);
  write_list(writer, "images", facts.images, most);
  write_list(writer, "animations", facts.animations, most);
  write_list(writer, "skins", facts.skins, most);
  write_list(writer, "cameras", facts.cameras, most);
  write_list(writer, "lights", facts.lights, most);
  if (!facts.metadata_classes.empty()) {
    write_list(writer, "metadataClasses", facts.metadata_classes, most);
  }
  if (!facts.property_tables.empty()) {
    write_list(writer, "propertyTables", facts.property_tables, most);
  }
  if (!facts.referred_files.empty()) {
    write_list(writer, "referredFiles", facts.referred_files, most);
  }
  if (!facts.external_assets.empty()) write_external_assets(writer, facts.external_assets, most);
  report::write_long_values(writer, "problems", facts.problems);
  if (facts.measurements) report::write_measurements(writer, *facts.measurements);
  writer.end_object();
}

void write_upgrade_facts(Writer& writer, const std::vector<UpgradeFact>& upgrade) {
  writer.begin_array();
  for (const UpgradeFact& fact : upgrade) {
    writer.begin_object();
    writer.member("pointer", fact.pointer);
    writer.member("from", fact.from);
    member_if(writer, "to", fact.to);
    writer.member("outcome", fact.outcome);
    writer.member("done", fact.done);
    report::write_long_values(writer, "notes", fact.notes);
    writer.end_object();
  }
  writer.end_array();
}

}  // namespace report

void InspectWriter::begin(std::string& out) {
  Writer writer(out);
  writer.begin_object();
  writer.member("gltfx", version());
  writer.member("format", kFormat);
  writer.key("assets");
  out += '[';
}

void InspectWriter::file(const InspectReport& report, std::string& out) {
  const std::size_t from = out.size();
  out += has_files_ ? ",\n" : "\n";
  has_files_ = true;
  Writer writer(out);
  write_report(writer, report);
  report::defuse_json(out, from);
}

void InspectWriter::end(std::string& out) { out += has_files_ ? "\n]}\n" : "]}\n"; }

}  // namespace gltfx
