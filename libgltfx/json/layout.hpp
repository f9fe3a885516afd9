// SPDX-License-Identifier: Apache-2.0
/// The layout of a JSON text, so that additions look like the rest of the text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"

namespace gltfx::json {

/// Spacing of the items of one container and of nested values.
struct Layout {
  std::string line_end;      ///< "\n" or "\r\n"; empty: everything on one line
  std::string indent;        ///< before each item, when there are lines
  std::string unit = "  ";   ///< one step further in
  std::string colon = ": ";  ///< between a name and its value
  std::string gap = " ";     ///< after a comma within a line
  std::string padding;       ///< inside the braces of an object within a line
  bool numbers_on_one_line = true;
};

/// A JSON value laid out as an item of a container with that layout. Numbers and strings keep their
/// spelling. Precondition: `json` is valid, or has trailing commas, which are removed.
std::string lay_out(std::string_view json, const Layout& layout);

/// Finds the layout of a document. Keeps a reference to it. The time of all calls together is
/// linear in their number and in the document. Not thread-safe.
class LayoutFinder {
 public:
  explicit LayoutFinder(const Document& document);
  /// The layout of the items of an object, or of an array that is not a number_array; an empty
  /// container gets that of its surroundings.
  Layout of(NodeId container) const;

 private:
  NodeId parent_of(NodeId node) const;
  void find_parents() const;
  std::string_view before_first_item(NodeId container) const;
  Layout of_items(NodeId container, std::string_view blank) const;

  const Document& document_;
  Layout common_;
  mutable std::vector<NodeId> parents_;  ///< containers by node; empty until first used
};

}  // namespace gltfx::json
