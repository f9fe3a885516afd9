// SPDX-License-Identifier: Apache-2.0
/// The phases around the schema walk, one function each.
#pragma once

#include <gltfx/report.hpp>

#include <string>
#include <vector>

#include "container/container.hpp"
#include "json/document.hpp"
#include "json/parse.hpp"
#include "model/resource_data.hpp"
#include "validate/collector.hpp"
#include "validate/context.hpp"

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
void check_torn(const Context& context, const model::ResourceData& resources, Sink& sink);

/// Phases 5 to 7 over `resources`: sparse indices, elements of accessors, skinning, textures.
/// Counts the images that they decode in `report`.
void check_data(const Context& context, const model::ResourceData& resources, Sink& sink,
                FileReport& report);

/// The media type of the report; empty when the JSON text gives no root object.
std::string mime_type(const container::Container& container, const json::Document& document);

}  // namespace gltfx::validate
