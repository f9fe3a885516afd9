// SPDX-License-Identifier: Apache-2.0
/// How a JSON text is laid out, so that what is added to it looks as if its author had written it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"

namespace gltfx::json {

/// Spacing of the items of one container and of what is nested in them.
struct Layout {
  std::string line_end;      ///< "\n" or "\r\n"; empty: everything on one line
  std::string indent;        ///< before each item, when there are lines
  std::string unit = "  ";   ///< one step further in
  std::string colon = ": ";  ///< between a name and its value
  std::string gap = " ";     ///< behind a comma within a line
  std::string padding;       ///< inside the braces of an object within a line
  bool numbers_on_one_line = true;
};

/// A JSON value laid out to stand as an item of a container with that layout. Numbers and strings
/// keep their spelling. Precondition: `json` is valid, or has commas behind last items, which go.
std::string lay_out(std::string_view json, const Layout& layout);

/// Reads the layout off a document. Keeps a reference to it. Any number of questions take time
/// linear in them and in the document. Not thread-safe.
class LayoutFinder {
 public:
  explicit LayoutFinder(const Document& document);
  /// Of the items of an object or array that is no number_array; an empty one gets that of its
  /// surroundings.
  Layout of(NodeId container) const;

 private:
  NodeId parent_of(NodeId node) const;
  void find_parents() const;
  std::string_view before_first_item(NodeId container) const;
  Layout of_items(NodeId container, std::string_view blank) const;

  const Document& document_;
  Layout common_;
  mutable std::vector<NodeId> parents_;  ///< containers by node; empty until somebody asks
};

}  // namespace gltfx::json
