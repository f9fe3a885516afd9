// SPDX-License-Identifier: Apache-2.0
/// Values of words in schema files that are not objects of the vocabulary: texts, lists, names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "json/document.hpp"
#include "schema/vocabulary.hpp"

namespace gltfx::schema {

/// The flaw of a value: continues "'word' ...".
struct Flaw {
  json::NodeId node;
  std::string message;
};

/// Checks values of one file.
class FormCheck {
 public:
  explicit FormCheck(const json::Document& document) : document_(document) {}
  /// The first flaw of a value that should have a form, or nothing.
  std::optional<Flaw> flaw(Form form, json::NodeId node) const;

 private:
  using Maybe = std::optional<Flaw>;
  Maybe scalar(Form form, json::NodeId node) const;
  Maybe text_form(Form form, json::NodeId node) const;
  Maybe number_form(Form form, json::NodeId node) const;
  Maybe list_of(Form element, json::NodeId node, bool may_be_empty) const;
  Maybe literals(json::NodeId node) const;
  Maybe map_of(Form value, json::NodeId node) const;
  Maybe enum_names(json::NodeId node) const;
  Maybe channel_factors(json::NodeId node) const;
  Maybe attachment_points(json::NodeId node) const;
  Maybe one_of(Form form, json::NodeId node) const;
  const json::Document& document_;
};

/// Why an expression is not understood, or nothing.
std::optional<std::string> pattern_flaw(std::string_view expression);

/// "KHR_x": upper-case prefix, underscore, rest.
bool is_extension_name(std::string_view name);

}  // namespace gltfx::schema
