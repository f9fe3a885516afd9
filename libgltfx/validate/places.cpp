// SPDX-License-Identifier: Apache-2.0
// Spans that findings mark.
#include "validate/context.hpp"

namespace gltfx::validate {

Span first_character(const json::Document& document, json::NodeId value) {
  const Span span = document.span(value);
  return {span.begin, span.empty() ? span.end : span.begin + 1};
}

Span member_span(const json::Document& document, json::NodeId object, std::string_view member) {
  const json::NodeId value = document.find(object, member);
  return value != json::kNoNode ? document.span(value) : first_character(document, object);
}

}  // namespace gltfx::validate
