// SPDX-License-Identifier: Apache-2.0
#include "report/entry.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "json/literals.hpp"
#include "report/safe_text.hpp"

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

// JSON holds text only: bytes that are none are there in another form besides.
void write_bytes(json::Writer& writer, const std::string& name, std::string_view bytes) {
  writer.member(name, bytes);
  if (json::is_utf8(bytes)) return;
  std::string digits;
  for (const char byte : bytes) {
    fmt::format_to(std::back_inserter(digits), "{:02x}", static_cast<unsigned char>(byte));
  }
  writer.member(name + "Hex", digits);
}

void write_location(json::Writer& writer, const Location& at, Detail detail) {
  writer.begin_object();
  writer.member("line", std::uint64_t{at.line});
  writer.member("column", std::uint64_t{at.column});
  writer.member("endLine", std::uint64_t{at.end_line});
  writer.member("endColumn", std::uint64_t{at.end_column});
  if (detail == Detail::full) {
    writer.member("utf16Column", std::uint64_t{at.utf16_column});
    writer.member("utf16EndColumn", std::uint64_t{at.utf16_end_column});
  }
  writer.member("byte", at.offset);
  writer.member("length", at.length);
  writer.end_object();
}

void write_excerpt(json::Writer& writer, const Excerpt& excerpt) {
  writer.begin_object();
  write_bytes(writer, "text", excerpt.text);
  writer.member("caret", std::uint64_t{excerpt.caret});
  writer.member("width", std::uint64_t{excerpt.width});
  writer.member("cutLeft", excerpt.cut_left);
  writer.member("cutRight", excerpt.cut_right);
  writer.end_object();
}

void write_fix(json::Writer& writer, const ProposedFix& fix) {
  writer.begin_object();
  writer.member("description", fix.description);
  writer.key("replacements");
  writer.begin_array();
  for (const Replacement& replacement : fix.replacements) {
    writer.begin_object();
    writer.key("location");
    write_location(writer, replacement.place, Detail::full);
    writer.member("text", replacement.text);
    writer.end_object();
  }
  writer.end_array();
  writer.end_object();
}

void write_repeat(json::Writer& writer, const Repeat& repeat) {
  writer.begin_object();
  writer.member("finding", std::uint64_t{repeat.finding});
  writer.member("message", repeat.message);
  if (!repeat.help.empty()) writer.member("help", repeat.help);
  writer.member("pointer", long_value(repeat.pointer));
  if (!repeat.object_name.empty()) writer.member("object", long_value(repeat.object_name));
  if (repeat.location.length > 0) {
    writer.key("location");
    write_location(writer, repeat.location, Detail::full);
  }
  if (repeat.count > 1) writer.member("count", repeat.count);
  writer.end_object();
}

void write_repeats(json::Writer& writer, const FileReport& report) {
  if (report.repeats.empty()) return;
  writer.key("repeats");
  writer.begin_array();
  for (const Repeat& repeat : report.repeats) write_repeat(writer, repeat);
  writer.end_array();
}

void write_finding(json::Writer& writer, const Diagnostic& finding, bool readable, Detail detail) {
  writer.begin_object();
  writer.member("code", finding.code);
  writer.member("severity", severity_name(finding.severity));
  writer.member("message", finding.message);
  if (!finding.help.empty()) writer.member("help", finding.help);
  if (finding.fixable) writer.member("fixable", true);
  const bool full = detail == Detail::full;
  if (finding.offset) writer.member("offset", *finding.offset);
  if (full ? !finding.pointer.empty() : readable && !finding.offset) {
    writer.member("pointer", long_value(finding.pointer));
  }
  if (finding.location.line > 0 || (full && finding.location.length > 0)) {
    writer.key("location");
    write_location(writer, finding.location, detail);
  }
  if (!finding.object_name.empty()) writer.member("object", long_value(finding.object_name));
  if (finding.count > 1) {
    writer.member("count", finding.count);
    writer.member("lastPointer", long_value(finding.last_pointer));
  }
  if (full && finding.excerpt.width > 0) {
    writer.key("excerpt");
    write_excerpt(writer, finding.excerpt);
  }
  if (full && finding.fix) {
    writer.key("fix");
    write_fix(writer, *finding.fix);
  }
  writer.end_object();
}

void write_counts(json::Writer& writer, const Counts& counts) {
  writer.member("errors", counts.errors);
  writer.member("warnings", counts.warnings);
  writer.member("infos", counts.infos);
  writer.member("hints", counts.hints);
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

void write_entry(json::Writer& writer, const FileReport& report, Detail detail, bool timings) {
  writer.begin_object();
  if (detail == Detail::full) {
    writer.member("position", report.position);
    write_bytes(writer, "path", report.path);
  } else {
    writer.member("path", report.path);
  }
  if (!report.mime_type.empty()) writer.member("mimeType", report.mime_type);
  writer.member("readable", report.readable);
  if (timings) writer.member("microseconds", report.microseconds);
  writer.key("counts");
  writer.begin_object();
  write_counts(writer, report.counts);
  writer.end_object();
  writer.member("truncated", report.truncated);
  writer.member("suppressed", report.suppressed);
  writer.member("leftOut", report.left_out);
  writer.member("unchanged", report.unchanged);
  writer.member("fixable", report.fixable);
  writer.member("unverified", report.unverified);
  writer.member("imagesWanted", report.images_wanted);
  writer.member("imagesDecoded", report.images_decoded);
  writer.key("findings");
  writer.begin_array();
  for (const Diagnostic& finding : report.diagnostics) {
    write_finding(writer, finding, report.readable, detail);
  }
  writer.end_array();
  if (detail == Detail::full) write_repeats(writer, report);
  if (report.info) {
    writer.key("info");
    write_asset_info(writer, *report.info);
  }
  writer.end_object();
}

void write_summary(json::Writer& writer, const RunSummary& summary) {
  writer.begin_object();
  writer.member("files", summary.files);
  writer.member("filesWithErrors", summary.files_with_errors);
  writer.member("unreadable", summary.unreadable);
  writer.member("fixable", summary.fixable);
  writer.member("unverified", summary.unverified);
  writer.member("suppressed", summary.suppressed);
  writer.member("leftOut", summary.left_out);
  writer.member("imagesWanted", summary.images_wanted);
  writer.member("imagesDecoded", summary.images_decoded);
  writer.member("unchanged", summary.unchanged);
  write_counts(writer, summary.counts);
  writer.end_object();
}

}  // namespace gltfx::report
