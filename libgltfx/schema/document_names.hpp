// SPDX-License-Identifier: Apache-2.0
/// Member names of one document, translated once each into those of a Set.
#pragma once

#include <vector>

#include "json/document.hpp"
#include "schema/walk_tables.hpp"

namespace gltfx::schema {

class DocumentNames {
 public:
  DocumentNames(const json::Document& document, const Set& set)
      : document_(document),
        set_(set),
        symbols_(document.key_count(), kUnseen),
        extensions_(document.key_count(), kUnseen) {}

  /// The Set's symbol for a name, or kNone.
  Symbol symbol(json::KeyId key) {
    return symbols_[key] != kUnseen ? symbols_[key] : look_up_symbol(key);
  }
  /// The extension of that name, or kNone.
  ExtensionId extension(json::KeyId key) {
    return extensions_[key] != kUnseen ? extensions_[key] : look_up_extension(key);
  }

 private:
  static constexpr std::uint32_t kUnseen = kNone - 1;
  Symbol look_up_symbol(json::KeyId key) {
    static_assert(json::kNoKey == kNone);
    return symbols_[key] = set_.walk_tables().symbols.find(document_.key(key));
  }
  ExtensionId look_up_extension(json::KeyId key) {
    return extensions_[key] = set_.find_extension(document_.key(key));
  }

  const json::Document& document_;
  const Set& set_;
  std::vector<Symbol> symbols_;
  std::vector<ExtensionId> extensions_;
};

}  // namespace gltfx::schema
