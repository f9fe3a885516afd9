// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/media_type.hpp"
#include "container/content.hpp"
#include "container/glb_errors.hpp"
#include "model/buffer_chunk.hpp"
#include "rules/context.hpp"
#include "rules/fix.hpp"
#include "rules/phases.hpp"

namespace gltfx::validate {
namespace {

bool ends_with_ignoring_case(std::string_view text, std::string_view ending) {
  if (text.size() < ending.size()) return false;
  const std::string_view tail = text.substr(text.size() - ending.size());
  for (std::size_t i = 0; i < ending.size(); ++i) {
    const char c = tail[i] >= 'A' && tail[i] <= 'Z' ? static_cast<char>(tail[i] + 32) : tail[i];
    if (c != ending[i]) return false;
  }
  return true;
}

Finding make(Code code, std::string message, std::string help = {}) {
  Finding finding(code);
  finding.message = std::move(message);
  finding.help = std::move(help);
  return finding;
}

void report_errors(const std::vector<container::ContainerError>& errors, Phase phase,
                   Collector& collector) {
  for (const container::ContainerError& error : errors) {
    Finding finding = make(error.code, error.message, error.help);
    finding.severity = error.severity;
    collector.report_offset(phase, error.offset, std::move(finding));
  }
}

// The file name implies a GLB, but the content is something else.
bool check_promised_glb(const container::Container& container, Collector& collector) {
  if (container.format == container::Format::glb) return true;
  if (container.format == container::Format::empty) {
    collector.report_offset(Phase::container, 0,
                            make(Code::GLB_UNEXPECTED_END_OF_HEADER, "The file is empty."));
    return false;
  }
  const bool json = container.format == container::Format::gltf;
  collector.report_offset(Phase::container, 0,
                          make(Code::GLB_INVALID_MAGIC, "The file does not start with 'glTF'.",
                               json ? "rename the file to .gltf: it looks like JSON text" : ""));
  return false;
}

// --- Padding of the JSON chunk ---

/// The padding of the JSON chunk up to the alignment of chunks, as a span of its text. Further
/// characters are white space of the text itself, as is all in a file without chunks, and in
/// version 3, where a chunk has any length.
Span json_padding(const container::Container& container) {
  if (container.format != container::Format::glb || container.chunks.empty()) return {};
  if (container.glb_version == 3U) return {};
  const std::string_view json = *container.json;
  const std::size_t end = json.find_last_not_of(" \t\r\n") + 1;
  constexpr std::size_t kAlignment = 4;
  const std::uint64_t length = container.chunks.front().length;
  if (length % kAlignment != 0 || end == 0 || json.size() - end >= kAlignment) return {};
  return {static_cast<std::uint32_t>(end), static_cast<std::uint32_t>(json.size())};
}

void check_json_padding(const container::Container& container, Collector& collector) {
  const Span padding = json_padding(container);
  const std::size_t at = padding.in(*container.json).find_first_not_of(' ');
  if (at == std::string_view::npos) return;
  const std::size_t byte = padding.begin + at;
  collector.report_offset(
      Phase::container, container.json_offset + byte,
      make(Code::GLB_JSON_PADDING,
           fmt::format("The JSON chunk is padded with 0x{:02x}; it must be padded with spaces.",
                       static_cast<unsigned char>((*container.json)[byte]))));
}

// --- Fixes: a container that is written anew has correct lengths and padding ---

bool pad_with_spaces(Fixing& fixing, const Subject&) {
  const Span padding = json_padding(fixing.opened().container());
  if (padding.begin == padding.end) return false;
  fixing.replace_text(padding, std::string(padding.end - padding.begin, ' '));
  return true;
}

bool rewrite(Fixing& fixing, const Subject&) {
  fixing.rewrite_container();
  return true;
}

// Zeros and blanks after the last chunk have no use.
bool drop_trailing_zeros(Fixing& fixing, const Subject&) {
  const container::Container& glb = fixing.opened().container();
  if (glb.chunks.empty()) return false;
  const container::Chunk& last = glb.chunks.back();
  const std::string_view rest = glb.bytes.text().substr(last.offset + last.length);
  if (rest.find_first_not_of(std::string_view("\0 ", 2)) != std::string_view::npos) return false;
  fixing.rewrite_container();
  return true;
}

// A text or a file of a known kind other than JSON, for which the first syntax error would be no
// help.
bool check_kind(const container::Container& container, Collector& collector) {
  if (container.format == container::Format::glb) return true;
  const std::string_view bytes = container.bytes.text();
  // A byte order mark is reported for the text.
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), bytes.size());
  if (bytes.substr(first).starts_with('{')) return true;
  const container::Content found = container::name_content(bytes);
  if (found.name.empty() || found.image) return true;
  collector.report_file(Phase::container, make(Code::INVALID_JSON,
                                               fmt::format("The file is {}, not glTF.", found.name),
                                               std::string(found.advice)));
  return false;
}

constexpr FixEntry kContainerFixes[] = {
    {Code::GLB_LENGTH_MISMATCH, drop_trailing_zeros, FixStage::container},
    {Code::GLB_CHUNK_LENGTH_UNALIGNED, rewrite, FixStage::container},
    {Code::GLB_CHUNK_TOO_BIG, rewrite, FixStage::container},
    {Code::GLB_CHUNK_TYPE_NUMBER, rewrite, FixStage::container},
    {Code::GLB_EXTRA_DATA, drop_trailing_zeros, FixStage::container},
    {Code::GLB_JSON_PADDING, pad_with_spaces, FixStage::syntax},
};

}  // namespace

const RuleGroup& container_rules() {
  static constexpr RuleGroup group{.fixes = kContainerFixes};
  return group;
}

void check_encodings(const Context& context, Collector& collector) {
  const container::Container& glb = context.container;
  const auto& buffers = context.asset.elements(model::RootArray::buffers);
  std::set<std::uint64_t> encoded;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (buffers[i] == json::kNoNode) continue;
    const auto index = model::chunk_number(context.document, buffers[i], i, context.version);
    if (!index || *index >= glb.chunks.size()) continue;
    const container::Chunk& chunk = glb.chunks[*index];
    if (chunk.type == container::kChunkBin && chunk.encoding != 0) encoded.insert(*index);
  }
  std::vector<container::ContainerError> errors;
  for (const std::uint64_t index : encoded) {
    errors.push_back(container::glb_error::unknown_encoding(glb.chunks[index]));
  }
  report_errors(errors, Phase::container, collector);
}

bool check_container(const container::Container& container, const std::string& name,
                     FileReport& report, Collector& collector) {
  report_errors(container.errors, Phase::container, collector);
  report_errors(container.late_errors, Phase::container_end, collector);
  if (container.json) check_json_padding(container, collector);
  if (container.format == container::Format::git_lfs_pointer) {
    report.unverified = 1;
    collector.report_file(
        Phase::container,
        make(Code::GIT_LFS_POINTER, "The file is a Git LFS pointer, not the asset itself.",
             "run 'git lfs pull'"));
    return false;
  }
  if (ends_with_ignoring_case(name, ".glb")) {
    return check_promised_glb(container, collector) && container.json != nullptr;
  }
  if (container.format == container::Format::glb && ends_with_ignoring_case(name, ".gltf")) {
    collector.report_file(Phase::container,
                          make(Code::FILE_EXTENSION_MISMATCH,
                               "The file name ends in .gltf, but the file is a binary GLB.",
                               "rename the file to .glb"));
  }
  const bool empty = container.format == container::Format::empty;
  if (!empty && !check_kind(container, collector)) return false;
  if (container.format == container::Format::unknown || empty) {
    collector.report_file(
        Phase::container,
        make(Code::INVALID_JSON,
             empty ? "The file is empty." : "The file is neither JSON text nor a GLB."));
    return false;
  }
  return container.json != nullptr;
}

std::string mime_type(const container::Container& container, bool has_root) {
  if (container.format == container::Format::glb) return std::string(kGlbMediaType);
  return has_root ? std::string(kGltfMediaType) : std::string();
}

}  // namespace gltfx::validate
