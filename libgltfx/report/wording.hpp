// SPDX-License-Identifier: Apache-2.0
/// Sentences that the formats for people have in common.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx::report {

/// "1 error", "3 errors".
std::string counted(std::uint64_t count, std::string_view noun);

/// "leaf.gltf:12:25"; in a GLB the line is one of the JSON chunk, so the byte in the file is added.
/// Neutralised.
std::string file_place(const FileReport& report, const Diagnostic& diagnostic);

/// " at /nodes/5/mesh ('Leaf')": where in the document, or nothing for a finding on the file.
/// Neutralised, and cut where a pointer or a name is unreasonably long.
std::string document_place(const Diagnostic& diagnostic);

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

/// "4 files not verified (Git-LFS pointers)".
std::string unverified_note(std::uint64_t unverified);
/// How many of the images that were to be decoded were; empty where none was to be.
std::string pixels_note(const RunSummary& summary, std::string_view pixel_level);

}  // namespace gltfx::report
