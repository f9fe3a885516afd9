// SPDX-License-Identifier: Apache-2.0
/// The phases around the schema walk and the checks behind them, one function each.
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

namespace gltfx::validate {

/// Phase 1: what the container says of itself. True when there is a JSON text to read.
bool check_container(const container::Container& container, const std::string& name,
                     FileReport& report, Collector& collector);

/// Phase 2: what is wrong with the JSON text. True when there is a document to look at. A text with
/// errors that leave no doubt of what was meant has one, unless
/// Deviations::syntax_errors_end_the_report.
bool check_text(const SharedText& text, const json::Parsed& parsed, const ValidateOptions& options,
                Collector& collector);

/// Names files for what they are: glTF 1.0, drafts, VRM. False when the rules of glTF 2.0 would
/// only produce noise.
bool check_identity(const Context& context, Collector& collector);

/// What buffers and images hold, and how the report lists them.
struct Resources {
  model::ResourceData data;
  std::vector<ResourceInfo> listed;
};

/// Phase 5: opens what buffers and images refer to, once. Reports what is not there, outside the
/// root, too short, a Git-LFS pointer, and images whose header is invalid.
Resources load_resources(const Context& context, Sink& sink, FileReport& report);

/// Files that became shorter while phases read them; to be called behind those.
void check_truncated(const Context& context, const model::ResourceData& resources, Sink& sink);

/// The media type of the report; empty for JSON text without a root object.
std::string mime_type(const container::Container& container, bool has_root);

/// Opens every image, reads its header and reports what is wrong with it. Buffers have been loaded.
void load_images(const Context& context, Sink& sink, FileReport& report, Resources& resources);

/// Reports what exceeds the budgets of the options.
void check_budgets(const Context& context, const model::ResourceData& resources,
                   const AssetInfo& info, const std::vector<ResourceInfo>& listed, Sink& sink);

/// Reports what the targets of the options refuse or ignore.
void check_targets(const Context& context, const model::ResourceData& resources, Sink& sink);

/// Decodes each stream of meshoptimizer once and reports what is wrong with it. Elements without a
/// plain copy go to `resources`, so that everything behind reads them as plain data; those that
/// have one are compared with it. Takes memory only for what its stream can hold, and for little
/// beyond a limit that grows with the streams. Several threads; findings in the order of the views.
/// Nothing where Deviations::unsupported_extensions_are_skipped.
void decode_views(const Context& context, model::ResourceData& resources, Sink& sink);

/// Phase 3 and the references of phase 4 for that profile. Findings on form go to the schema sink;
/// broken references are left with `order`, for the rules to release. `document` is the context's
/// own; members that count as absent are hidden in it.
schema::CheckResult check_as_khronos(Context& context, json::Document& document, LinkOrder& order,
                                     const schema::ObjectVisitor& visitor);

}  // namespace gltfx::validate
