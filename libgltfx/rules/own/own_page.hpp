// SPDX-License-Identifier: Apache-2.0
/// The page of an own rule, read and compiled.
#pragma once

#include <gltfx/own_rules.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.hpp"
#include "model/asset.hpp"
#include "schema/json_schema.hpp"

namespace gltfx::validate {

/// Maximum size of a page in bytes, and maximum number of pages.
inline constexpr std::size_t kLongestOwnPage = 256U << 10U;
inline constexpr std::size_t kMostOwnPages = 1000;

/// The objects that a rule is about.
struct OwnScope {
  enum class Place : unsigned char { root, asset, element, primitive };
  std::string_view name;  ///< "mesh"
  Place place = Place::element;
  model::RootArray array = model::RootArray::nodes;  ///< of elements
};

/// The scope of that name, or null.
const OwnScope* find_own_scope(std::string_view name);

/// An example of a page.
struct OwnExample {
  std::string text;
  std::string file;  ///< name of the asset
  int line = 0;      ///< of the page
};

struct OwnPage {
  std::string file;
  std::string_view code;  ///< static storage
  Severity severity = Severity::error;
  const OwnScope* scope = nullptr;
  std::string message, advice;  ///< advice: `help` of the page, may be empty
  std::string link, summary, why, help;
  OwnExample bad, good;
  Hash128 source;  ///< of the page's name and text
  schema::JsonSchema schema;

  /// Its texts are those of the page.
  RuleDescription description() const;
};

/// Reads a page. Null when there are mistakes, which are added: "file:line: mistake".
std::unique_ptr<const OwnPage> read_own_page(const OwnRulePage& page,
                                             std::vector<std::string>& mistakes);

}  // namespace gltfx::validate
