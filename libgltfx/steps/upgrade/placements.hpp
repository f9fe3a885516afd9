// SPDX-License-Identifier: Apache-2.0
/// Members that an upgrade adds to the object that carries the legacy extension.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steps/upgrade/context.hpp"

namespace gltfx::upgrade {

class Placements {
 public:
  /// Keeps references to both.
  Placements(Context& context, const Host& host) : context_(context), host_(host) {}

  /// Plans the JSON text of the member at `path` ("extensions/KHR_x/y"). If the text is empty, the
  /// member is removed so that its default applies. Returns why this is not possible.
  std::optional<std::string> put(std::string_view path, std::string json);
  bool empty() const { return members_.empty(); }
  /// Names of existing members that are changed or removed.
  const std::vector<std::string>& overwritten() const { return overwritten_; }
  /// Their values, in the same order.
  const std::vector<json::NodeId>& taken_out() const { return taken_out_; }
  /// New extensions of the host.
  std::vector<std::string> extensions() const;
  /// Adds the changes to the context's editor.
  void apply() const;

 private:
  using Members = std::map<std::string, std::string>;  ///< JSON text by name
  std::optional<std::string> check(const std::vector<std::string>& path);
  void apply_to(json::NodeId object, const Members& members) const;
  void append(const std::vector<std::string>& path, const Members& members) const;

  Context& context_;
  const Host& host_;
  std::map<std::vector<std::string>, Members> members_;  ///< by the path of their object
  std::vector<std::string> overwritten_;
  std::vector<json::NodeId> taken_out_;
};

}  // namespace gltfx::upgrade
