// SPDX-License-Identifier: Apache-2.0
/// Schema files during compilation: parsed texts, and the errors found in them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "json/parse.hpp"
#include "schema/compile.hpp"
#include "schema/vocabulary.hpp"

namespace gltfx::schema {

/// One file. Its position in the list of sources is its SourceId.
struct Source {
  std::string name;
  bool from_user = false;
  json::Document document;
  std::string id;                 ///< `$id`
  std::vector<Keyword> keywords;  ///< by KeyId: the schema keyword of that name
  bool is_extension() const { return id.rfind("gltfx:ext/", 0) == 0; }
  /// The part of `$id` after the slash: "material", "KHR_x".
  std::string_view short_name() const;
  /// The value of a member of an object node, or kNoNode.
  json::NodeId find(json::NodeId object, std::string_view member) const {
    return document.find(object, member);
  }
};

using SourceId = std::uint32_t;

/// A node of a schema file.
struct Site {
  SourceId source = kNone;
  json::NodeId node = json::kNoNode;
  bool exists() const { return node != json::kNoNode; }
  friend bool operator==(const Site&, const Site&) = default;
};

/// Collects errors with their places.
class ErrorList {
 public:
  explicit ErrorList(const std::vector<Source>& sources) : sources_(&sources) {}

  /// An error at a value or key.
  void add(Site at, std::string message);
  /// An error at the key of a member's value.
  void add_at_key(Site value, std::string message) {
    add({value.source, value.node - 1}, std::move(message));
  }
  bool empty() const { return errors_.empty(); }
  /// Whether further errors are dropped, so that messages need not be made.
  bool is_full() const { return errors_.size() >= kMost; }
  std::size_t size() const { return errors_.size(); }
  /// Removes all errors except the first `count`.
  void keep(std::size_t count) {
    errors_.erase(errors_.begin() + static_cast<std::ptrdiff_t>(count), errors_.end());
  }
  /// All errors, by file and place.
  std::vector<SchemaError> take();

 private:
  static constexpr std::size_t kMost = 200;  // each one costs a pass over its text
  struct Entry {
    SourceId source;
    std::uint32_t begin;
    SchemaError error;
  };
  const std::vector<Source>* sources_;
  std::vector<Entry> errors_;
};

/// Parses the files; a user's file replaces an earlier one with the same `$id`. Files that cannot
/// be parsed are reported in `errors`.
std::vector<Source> load_sources(const std::vector<SourceFile>& files,
                                 std::vector<SchemaError>& errors);

/// The mistake in a JSON text, such as "a comma is missing".
std::string json_mistake(const json::ParseError& error);

}  // namespace gltfx::schema
