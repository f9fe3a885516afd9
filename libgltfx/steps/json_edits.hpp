// SPDX-License-Identifier: Apache-2.0
/// Edits of the text that several steps make.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "json/edit.hpp"
#include "model/accessor.hpp"

namespace gltfx::steps {

/// Members of a new buffer view.
struct NewView {
  std::uint64_t buffer = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;  ///< 0: none
  model::ViewTarget target = model::ViewTarget::none;
};

/// The JSON of a new buffer view.
std::string view_json(const NewView& view);
/// The number of a target in JSON. Precondition: it is not `none`.
unsigned target_number(model::ViewTarget target);

/// The names of the members of a buffer view that do not describe its bytes: `name`, `extras`,
/// `extensions` and unknown ones.
std::vector<std::string_view> free_members(const json::Document& document, json::NodeId view);

/// Sets a member of an object to a number.
void set_number(const json::Document& document, json::Editor& editor, json::NodeId object,
                std::string_view name, std::uint64_t value);
/// Removes a member of an object, if it exists.
void remove_member(const json::Document& document, json::Editor& editor, json::NodeId object,
                   std::string_view name);
/// Adds the object of an extension to `host`. Precondition: `host` does not have the extension.
void add_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                   std::string_view name, std::string_view json);
/// Removes the object of an extension, and `extensions` if it becomes empty.
void remove_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                      std::string_view name);
/// Adds a name to `extensionsUsed` and `extensionsRequired`. Returns an Error (half a sentence) if
/// one of them is not a list of names.
std::optional<Error> require_extension(const json::Document& document, json::Editor& editor,
                                       std::string_view name);

}  // namespace gltfx::steps
