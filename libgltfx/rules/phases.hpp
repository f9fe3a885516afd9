// SPDX-License-Identifier: Apache-2.0
/// The phases before and after the schema walk, one function each.
#pragma once

#include <gltfx/report.hpp>

#include <string>
#include <vector>

#include "container/container.hpp"
#include "json/document.hpp"
#include "json/parse.hpp"
#include "model/resource_data.hpp"
#include "rules/collector.hpp"
#include "rules/context.hpp"
#include "rules/khronos/link_order.hpp"
#include "rules/shortfall.hpp"

namespace gltfx::measure {
class Source;
}

namespace gltfx::validate {

struct ExternalLinks;

/// Phase 1: the form of the container. True if there is a JSON text to read.
bool check_container(const container::Container& container, const std::string& name,
                     FileReport& report, Collector& collector);

/// The encodings of the chunks that buffers refer to, which nothing can read; call it with the
/// asset.
void check_encodings(const Context& context, Collector& collector);

/// Phase 2: errors of the JSON text. True if there is a document to check. A text with errors that
/// leave no doubt of its meaning has one, unless Deviations::syntax_errors_end_the_report.
bool check_text(const SharedText& text, const json::Parsed& parsed, const ValidateOptions& options,
                Collector& collector);

/// Reports files of other versions and formats: glTF 1.0, drafts, VRM. False if the rules of glTF
/// 2.0 would only produce noise.
bool check_identity(const Context& context, Collector& collector);

/// The content of buffers and images, and how the report lists them.
struct Resources {
  model::ResourceData data;
  std::vector<ResourceInfo> listed;
};

/// Phase 5: opens the resources of buffers, images and files, once. Reports those that are missing,
/// outside the root, too short, a Git-LFS pointer, and images whose header is invalid.
Resources load_resources(const Context& context, Sink& sink, FileReport& report);

/// Reports files that were truncated while phases read them; call it after those phases.
void check_truncated(const Context& context, const model::ResourceData& resources, Sink& sink);

/// The media type of the report; empty for JSON text without a root object.
std::string mime_type(const container::Container& container, bool has_root);

/// Opens every image, reads its header and reports problems. Buffers must be loaded before.
void load_images(const Context& context, Sink& sink, FileReport& report, Resources& resources);

/// The files of an asset of glTF 2.1: opens them and reports those that are missing, media types
/// that do not fit, and aliases without effect. Buffers must be loaded before.
void load_files(const Context& context, Sink& sink, FileReport& report, Resources& resources);

/// Reports external assets that have errors or lead into a cycle, and aliases that they do not use.
void report_external_assets(const Context& context, const ExternalLinks& links, Sink& sink);

/// Measures what the options limit, lists the limits in the report, and reports those that do not
/// hold.
void check_limits(const Context& context, const measure::Source& source, FileReport& report,
                  Sink& sink);

/// Reports features that the targets of the options refuse or ignore. `shortfalls`, if it is not
/// null, gets them.
void check_targets(const Context& context, const model::ResourceData& resources, Sink& sink,
                   std::vector<Shortfall>* shortfalls);

/// Decodes each stream of meshoptimizer once and reports problems. Decoded elements without a plain
/// copy go to `resources`, so that all later phases read them as plain data; those with a copy are
/// compared with it. The memory is limited to what the stream can hold, plus a limit that grows
/// with the streams. Several threads; findings in the order of the views. Nothing with
/// Deviations::unsupported_extensions_are_skipped.
void decode_views(const Context& context, model::ResourceData& resources, Sink& sink);

/// Phase 3 and the references of phase 4 for the Khronos profile. Findings on form go to the schema
/// sink; broken references are left with `order`, for the rules to release. `document` is the
/// document of the context; members that count as absent are hidden in it.
schema::CheckResult check_as_khronos(Context& context, json::Document& document, LinkOrder& order,
                                     const schema::ObjectVisitor& visitor);

}  // namespace gltfx::validate
