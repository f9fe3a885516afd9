// SPDX-License-Identifier: Apache-2.0
/// The phases around the schema walk, one function each.
#pragma once

#include <gltfx/report.hpp>

#include <string>

#include "container/container.hpp"
#include "json/document.hpp"
#include "validate/collector.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// Phase 1: what the container says of itself. True when there is a JSON text to read.
bool check_container(const container::Container& container, const std::string& name,
                     FileReport& report, Collector& collector);

/// Phase 2: reads the JSON text. True when there is a document to look at. A text with faults that
/// leave no doubt of what was meant has one; the khronos profile gives up as that validator does.
bool parse_document(const container::Container& container, const ValidateOptions& options,
                    Collector& collector, json::Document& document);

/// Names files for what they are: glTF 1.0, drafts, VRM. False when the rules of glTF 2.0 would
/// only produce noise.
bool check_identity(const Context& context, Collector& collector);

/// What buffers and images refer to: there, inside the root, long enough, no Git-LFS pointer.
void check_resources(const Context& context, Sink& sink, FileReport& report);

/// The media type of the report; empty when the JSON text gives no root object.
std::string mime_type(const container::Container& container, const json::Document& document);

}  // namespace gltfx::validate
