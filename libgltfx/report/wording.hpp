// SPDX-License-Identifier: Apache-2.0
/// Phrases that the formats for people share, and colours by meaning.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/report.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx::report {

/// The first four are in the order of Severity.
enum class Ink : std::uint8_t { error, warning, info, hint, strong, frame, help, good };

inline Ink ink_of(Severity severity) { return static_cast<Ink>(severity); }

/// Wraps words in ANSI escapes, or returns them unchanged.
class Style {
 public:
  explicit Style(bool color) : color_(color) {}

  std::string paint(Ink ink, std::string_view text) const {
    if (!color_ || text.empty()) return std::string(text);
    // Bold red, yellow, blue and green; bold alone; bold blue; bold cyan; bold green.
    constexpr std::array<std::string_view, 8> kCodes{"1;31", "1;33", "1;34", "1;32",
                                                     "1",    "1;34", "1;36", "1;32"};
    std::string out = "\x1b[";
    out.append(kCodes[static_cast<std::size_t>(ink)]).append("m").append(text);
    return out.append("\x1b[0m");
  }

 private:
  bool color_;
};

/// Whether the asset is a GLB. Lines of its JSON chunk are not lines of the file.
bool is_glb(const FileReport& report);
/// Whether the place is a line of the file.
bool is_in_file_line(const FileReport& report, const Location& at);

/// "1 error", "3 errors".
std::string counted(std::uint64_t count, std::string_view noun);

/// "leaf.gltf:12:25"; in a GLB the line is that of the JSON chunk, so the byte in the file is
/// added. Neutralised.
std::string file_place(const FileReport& report, const Diagnostic& diagnostic);

/// " at /nodes/5/mesh ('Leaf')": place in the document, or an empty text for a finding on the file.
/// Neutralised, and cut if a pointer or a name is very long.
std::string document_place(const Diagnostic& diagnostic);

/// "The value is a string. Help: remove the quotes."
std::string message_with_help(const Diagnostic& diagnostic);

/// "repeated 41 more times, last at /nodes/44", or nothing when there are no repeats.
std::string repeat_note(const Diagnostic& diagnostic);

/// Findings that --max-issues kept out of the listing, repeats counted one by one.
std::uint64_t unlisted(const FileReport& report);

/// "3 more findings are not listed (--max-issues)". Precondition: the report is truncated.
std::string truncation_note(const FileReport& report);

/// "2 findings left out, as the assets ask".
std::string left_out_note(std::uint64_t left_out);

/// "12 findings not shown, on lines that did not change (--diff-base)".
std::string unchanged_note(std::uint64_t unchanged);

/// "3 of these have a fix: gltfx fix lamp.gltf", with the profile where it finds more.
/// Neutralised.
std::string fixable_note(const RunSummary& summary, std::string_view profile);

/// "4 files not verified (Git-LFS pointers)".
std::string unverified_note(std::uint64_t unverified);
/// Numbers of images that were decoded and needed; empty if none was needed.
std::string pixels_note(const RunSummary& summary, std::string_view pixel_level);

}  // namespace gltfx::report
