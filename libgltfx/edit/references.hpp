// SPDX-License-Identifier: Apache-2.0
/// Who refers to the textures, images and buffer views of a document.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::edit {

/// An index as it stands in the text.
struct Reference {
  std::uint64_t index = 0;
  Span span;
};

/// All indices that schemas know as such, by the root array that they lead into ("textures").
class References {
 public:
  References(const json::Document& document, const schema::Set& set);

  const std::vector<Reference>& to(std::string_view array) const;
  /// An extension that the Set does not know and that the document uses: its indices are nobody's.
  /// Empty when there is none.
  const std::string& unknown_extension() const { return unknown_; }

 private:
  std::map<std::string, std::vector<Reference>, std::less<>> by_array_;
  std::string unknown_;
};

}  // namespace gltfx::edit
