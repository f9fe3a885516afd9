// SPDX-License-Identifier: Apache-2.0
/// The members of a report, listed once for every form in which it is written and read back.
#pragma once

#include <gltfx/report.hpp>

namespace gltfx::report {

/// A Form writes (`Form::Of<T>` is const T) or reads (T): JSON in `entry.cpp` and `read_line.cpp`,
/// bytes in `packed.cpp`. Names are those of JSON. The last argument says whether a member is
/// written to JSON; what is read may lack any member, which keeps its value then.
///
///   text, long_text, bytes    strings; long ones are cut, bytes may be invalid UTF-8
///   number, flag, code, severity, verdict, texts
///   value                     of a measure
///   optional                  a value, text or object that may be missing
///   object, list              of values with a fields() of their own

template <class Form>
void fields(Form& form, typename Form::template Of<Counts>& counts) {
  form.number("errors", counts.errors);
  form.number("warnings", counts.warnings);
  form.number("infos", counts.infos);
  form.number("hints", counts.hints);
}

template <class Form>
void fields(Form& form, typename Form::template Of<Location>& at) {
  form.number("line", at.line);
  form.number("column", at.column);
  form.number("endLine", at.end_line);
  form.number("endColumn", at.end_column);
  form.number("utf16Column", at.utf16_column, form.is_full());
  form.number("utf16EndColumn", at.utf16_end_column, form.is_full());
  form.number("byte", at.offset);
  form.number("length", at.length);
}

template <class Form>
void fields(Form& form, typename Form::template Of<Excerpt>& excerpt) {
  form.bytes("text", excerpt.text);
  form.number("caret", excerpt.caret);
  form.number("width", excerpt.width);
  form.flag("cutLeft", excerpt.cut_left);
  form.flag("cutRight", excerpt.cut_right);
}

template <class Form>
void fields(Form& form, typename Form::template Of<Replacement>& replacement) {
  form.object("location", replacement.place);
  form.text("text", replacement.text);
}

template <class Form>
void fields(Form& form, typename Form::template Of<ProposedFix>& fix) {
  form.text("description", fix.description);
  form.list("replacements", fix.replacements);
}

/// `name`: the member for the name of the measure.
template <class Form, class Limit>
void limit_fields(Form& form, std::string_view name, Limit& limit) {
  form.text(name, limit.measure);
  form.text("on", limit.on);
  form.value("value", limit.value);
  form.text("op", limit.op);
  form.value("limit", limit.limit);
  form.text("unit", limit.unit, !limit.unit.empty());
  form.text("from", limit.from);
  form.text("parameters", limit.parameters, !limit.parameters.empty());
}

template <class Form>
void fields(Form& form, typename Form::template Of<CheckedLimit>& limit) {
  limit_fields(form, "name", limit);
}

template <class Form>
void fields(Form& form, typename Form::template Of<Requirement>& requirement) {
  limit_fields(form, "measure", requirement);
  form.long_text("pointer", requirement.pointer, !requirement.pointer.empty());
  form.long_text("object", requirement.object_name, !requirement.object_name.empty());
  form.verdict("verdict", requirement.verdict);
  form.severity("severity", requirement.severity);
}

template <class Form>
void fields(Form& form, typename Form::template Of<Diagnostic>& finding) {
  const Location& at = finding.location;
  const bool full = form.is_full();
  form.code("code", finding.code);
  form.severity("severity", finding.severity);
  form.text("message", finding.message);
  form.text("help", finding.help, !finding.help.empty());
  form.flag("fixable", finding.fixable, finding.fixable);
  form.optional("offset", finding.offset);
  form.long_text("pointer", finding.pointer,
                 full ? !finding.pointer.empty() : form.is_readable() && !finding.offset);
  form.object("location", finding.location, at.line > 0 || (full && at.length > 0));
  form.long_text("object", finding.object_name, !finding.object_name.empty());
  form.number("count", finding.count, finding.count > 1);
  form.long_text("lastPointer", finding.last_pointer, finding.count > 1);
  form.object("excerpt", finding.excerpt, full && finding.excerpt.width > 0);
  form.optional("fix", finding.fix, full);
  form.optional("measure", finding.requirement);
}

template <class Form>
void fields(Form& form, typename Form::template Of<Repeat>& repeat) {
  form.number("finding", repeat.finding);
  form.text("message", repeat.message);
  form.text("help", repeat.help, !repeat.help.empty());
  form.long_text("pointer", repeat.pointer);
  form.long_text("object", repeat.object_name, !repeat.object_name.empty());
  form.object("location", repeat.location, repeat.location.length > 0);
  form.number("count", repeat.count, repeat.count > 1);
  form.optional("measure", repeat.requirement);
}

template <class Form>
void fields(Form& form, typename Form::template Of<ResourceInfo::Image>& image) {
  form.number("width", image.width);
  form.number("height", image.height);
  form.long_text("format", image.format, !image.format.empty());
  form.long_text("primaries", image.primaries, !image.primaries.empty());
  form.long_text("transfer", image.transfer, !image.transfer.empty());
  form.number("bits", image.bits, image.bits > 0);
}

template <class Form>
void fields(Form& form, typename Form::template Of<ResourceInfo>& resource) {
  form.text("pointer", resource.pointer);
  form.long_text("mimeType", resource.mime_type, !resource.mime_type.empty());
  form.long_text("storage", resource.storage, !resource.storage.empty());
  form.long_text("uri", resource.uri, resource.storage == "external");
  form.optional("byteLength", resource.byte_length);
  form.optional("image", resource.image);
}

/// Members of the Khronos report, in its order.
template <class Form>
void fields(Form& form, typename Form::template Of<AssetInfo>& info) {
  form.long_text("version", info.version, !info.version.empty());
  form.long_text("minVersion", info.min_version, !info.min_version.empty());
  form.optional("generator", info.generator);
  form.texts("extensionsUsed", info.extensions_used);
  form.texts("extensionsRequired", info.extensions_required);
  form.list("resources", info.resources, !info.resources.empty());
  form.number("animationCount", info.animation_count);
  form.number("materialCount", info.material_count);
  form.flag("hasMorphTargets", info.has_morph_targets);
  form.flag("hasSkins", info.has_skins);
  form.flag("hasTextures", info.has_textures);
  form.flag("hasDefaultScene", info.has_default_scene);
  form.number("drawCallCount", info.draw_call_count);
  form.number("totalVertexCount", info.total_vertex_count);
  form.number("totalTriangleCount", info.total_triangle_count);
  form.number("maxUVs", info.max_uvs);
  form.number("maxInfluences", info.max_influences);
  form.number("maxAttributes", info.max_attributes);
}

/// Of packed bytes, all but where the file lies and what depends on the run.
template <class Form>
void fields(Form& form, typename Form::template Of<FileReport>& report) {
  if constexpr (Form::kIsJson) {
    form.number("position", report.position, form.is_full());
    form.bytes("path", report.path);
  }
  form.text("mimeType", report.mime_type, !report.mime_type.empty());
  form.flag("readable", report.readable);
  if constexpr (Form::kIsJson) {
    form.number("microseconds", report.microseconds, form.has_timings());
  }
  form.object("counts", report.counts);
  form.flag("truncated", report.truncated);
  form.number("suppressed", report.suppressed);
  form.number("leftOut", report.left_out);
  if constexpr (Form::kIsJson) form.number("unchanged", report.unchanged);
  form.number("fixable", report.fixable);
  form.number("unverified", report.unverified);
  form.number("imagesWanted", report.images_wanted);
  form.number("imagesDecoded", report.images_decoded);
  form.list("findings", report.diagnostics);
  form.list("repeats", report.repeats, form.is_full() && !report.repeats.empty());
  form.optional("info", report.info);
  const std::uint64_t unlisted = report.unlisted_requirements;
  form.list("requirements", report.requirements, !report.requirements.empty());
  form.number("unlistedRequirements", report.unlisted_requirements, unlisted > 0);
}

template <class Form>
void fields(Form& form, typename Form::template Of<RunSummary>& summary) {
  form.number("files", summary.files);
  form.number("filesWithErrors", summary.files_with_errors);
  form.number("unreadable", summary.unreadable);
  form.number("fixable", summary.fixable);
  form.number("unverified", summary.unverified);
  form.number("suppressed", summary.suppressed);
  form.number("leftOut", summary.left_out);
  form.number("imagesWanted", summary.images_wanted);
  form.number("imagesDecoded", summary.images_decoded);
  form.number("unchanged", summary.unchanged);
  fields(form, summary.counts);
}

}  // namespace gltfx::report
