// SPDX-License-Identifier: Apache-2.0
/// Functions that create and report findings.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rules/context.hpp"

namespace gltfx::validate {

/// A finding that marks `value`: all of a scalar, only the first character of an object or array.
/// With json::kNoNode it has no mark.
Finding finding_on(const Context& context, json::NodeId value, Code code, std::string message,
                   std::string help = {});

/// Reports a finding on a member of the object at `path`: at the member if it exists, otherwise at
/// the object, with the pointer of the member in both cases.
void report_member(Sink& sink, const Context& context, const Path& path, json::NodeId object,
                   std::string_view member, Code code, std::string message, std::string help = {},
                   std::optional<Severity> severity = {});

/// Reports a finding of phase 4 at `path` that marks `place` (as finding_on() does) or exactly the
/// span, such as one number of an array.
void report_link(const Context& context, const Path& path, json::NodeId place, Code code,
                 std::string message, std::string help = {});
void report_link(const Context& context, const Path& path, Span span, Code code,
                 std::string message);

/// Reports a finding on element `index` of a root array.
void report_element(Sink& sink, const Context& context, model::RootArray array, std::size_t index,
                    Code code, std::string message, std::optional<Severity> severity = {});

/// Reading order: reports the broken references inside `value` that are not reported yet, at the
/// point where linking reaches them. Otherwise the walk has reported them. Nothing for
/// json::kNoNode.
void report_references(const Context& context, json::NodeId value);
void report_references(const Context& context, Span place);

/// The label of another object in messages: "node 1 ('tmpParent')", or "node 1" if it has no name.
std::string object_label(const Context& context, model::RootArray array, std::size_t index);
/// The label of a member: "emissiveTexture of material 0 ('glass')".
std::string member_label(const Context& context, std::string_view pointer);

/// Reports a finding at a pointer given as text, such as that of a texture slot.
void report_at(Sink& sink, std::string_view pointer, Finding finding);

/// Reports UNSATISFIED_DEPENDENCY if the root object lacks the object of an extension that `object`
/// needs. True if it exists.
bool check_root_extension(const Context& context, std::string_view extension, json::NodeId object,
                          const Path& path);

}  // namespace gltfx::validate
