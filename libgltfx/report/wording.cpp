// SPDX-License-Identifier: Apache-2.0
#include "report/wording.hpp"

#include <fmt/format.h>

#include "base/media_type.hpp"
#include "report/safe_text.hpp"

namespace gltfx::report {
namespace {

constexpr std::size_t kPointerLimit = 160;
constexpr std::size_t kNameLimit = 40;

}  // namespace

bool is_glb(const FileReport& report) { return report.mime_type == kGlbMediaType; }

bool is_in_file_line(const FileReport& report, const Location& at) {
  return at.line > 0 && !is_glb(report);
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string file_place(const FileReport& report, const Diagnostic& diagnostic) {
  std::string path = safe(report.path);
  if (diagnostic.offset) return fmt::format("{}: byte {}", path, *diagnostic.offset);
  const Location& at = diagnostic.location;
  if (at.line == 0) return path;
  std::string place = fmt::format("{}:{}:{}", path, at.line, at.column);
  if (!is_glb(report)) return place;
  return fmt::format("{} (JSON chunk, byte {})", place, at.offset);
}

std::string document_place(const Diagnostic& diagnostic) {
  std::string place;
  if (!diagnostic.pointer.empty()) {
    place.append(" at ").append(safe_cut(diagnostic.pointer, kPointerLimit));
  }
  if (!diagnostic.object_name.empty()) {
    place += fmt::format(" ('{}')", safe_cut(diagnostic.object_name, kNameLimit));
  }
  return place;
}

std::string message_with_help(const Diagnostic& diagnostic) {
  const std::string& help = diagnostic.help;
  if (help.empty()) return diagnostic.message;
  const bool ends = std::string_view(".!?").find(help.back()) != std::string_view::npos;
  return fmt::format("{} Help: {}{}", diagnostic.message, help, ends ? "" : ".");
}

std::string repeat_note(const Diagnostic& diagnostic) {
  if (diagnostic.count < 2) return {};
  const bool elsewhere = diagnostic.last_pointer != diagnostic.pointer;
  const std::string last =
      elsewhere ? safe_cut(diagnostic.last_pointer, kPointerLimit) : std::string();
  if (diagnostic.count == 2) {
    return fmt::format("repeated once more{}{}", last.empty() ? "" : " at ", last);
  }
  return fmt::format("repeated {} more times{}{}", diagnostic.count - 1,
                     last.empty() ? "" : ", last at ", last);
}

std::uint64_t unlisted(const FileReport& report) {
  std::uint64_t listed = 0;
  for (const Diagnostic& diagnostic : report.diagnostics) listed += diagnostic.count;
  const std::uint64_t all = report.counts.at_least(Severity::hint);
  return all > listed ? all - listed : 0;
}

std::string truncation_note(const FileReport& report) {
  const std::uint64_t more = unlisted(report);
  if (more == 0) return "more findings are not listed (--max-issues)";
  return fmt::format("{} more finding{} not listed (--max-issues)", more,
                     more == 1 ? " is" : "s are");
}

std::string left_out_note(std::uint64_t left_out) {
  return counted(left_out, "finding") + " left out, as the assets ask";
}

std::string unchanged_note(std::uint64_t unchanged) {
  return counted(unchanged, "finding") + " not shown, on lines that did not change (--diff-base)";
}

std::string fixable_note(const RunSummary& summary, std::string_view profile) {
  // For a path that a shell would interpret, PATH is printed.
  const std::string& path = summary.fixable_path;
  const bool plain = !path.empty() && path.front() != '-' &&
                     path.find_first_not_of(
                         "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-/") ==
                         std::string::npos;
  return fmt::format("{} of these {} a fix: gltfx fix {}{}", summary.fixable,
                     summary.fixable == 1 ? "has" : "have", plain ? path : "PATH",
                     profile == "strict" ? " --profile strict" : "");
}

std::string unverified_note(std::uint64_t unverified) {
  return counted(unverified, "file") + " not verified (Git-LFS pointers)";
}

std::string pixels_note(const RunSummary& summary, std::string_view pixel_level) {
  const bool all = pixel_level == "all";
  if (!all && pixel_level != "needed") return {};
  if (summary.images_wanted == 0) {
    return all ? "there are no images to decode" : "no rule needs the pixels of an image";
  }
  std::string note = fmt::format("{} of {} decoded", summary.images_decoded,
                                 counted(summary.images_wanted, "image"));
  if (!all) note += " for rules that need their pixels";
  const std::uint64_t failed = summary.images_wanted - summary.images_decoded;
  if (failed > 0) note += fmt::format("; {} could not be decoded", failed);
  return note;
}

}  // namespace gltfx::report
