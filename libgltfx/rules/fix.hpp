// SPDX-License-Identifier: Apache-2.0
/// What fixes of rules have to work with: the asset, and the changes that they collect.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/span.hpp"
#include "change/change.hpp"
#include "change/name_list.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/asset.hpp"
#include "model/opened_asset.hpp"
#include "model/resource_data.hpp"
#include "rules/fix_entry.hpp"
#include "schema/set.hpp"

namespace gltfx::validate {

/// The innermost value or key that holds the first byte of `place`, or json::kNoNode.
json::NodeId node_around(const json::Document& document, Span place);
/// The value or key that begins where `place` does, or json::kNoNode.
json::NodeId node_at(const json::Document& document, Span place);

/// The changes of one asset, as fixes collect them. Each value is changed once: a fix that finds it
/// changed leaves it to the next run over the new asset.
class Fixing {
 public:
  /// Fixes may change as many bytes of buffers as `content_bytes`, whole buffers counted.
  Fixing(const model::OpenedAsset& opened, const schema::Set& schemas,
         std::uint64_t content_bytes = UINT64_MAX);

  const json::Document& document() const { return document_; }
  const schema::Set& schemas() const { return schemas_; }
  const model::OpenedAsset& opened() const { return opened_; }
  const model::Asset& elements() const { return elements_; }
  const model::Views& views() const { return opened_.views(); }
  /// Bytes of buffers and images, loaded when somebody asks.
  const model::ResourceData& resources();

  /// Where values are; made at the first call, as all tables.
  const graph::Tree& tree();
  /// What refers to what, which takes a walk over the whole document.
  const graph::Graph& graph();

  /// A table that the fixes of one run look into, made of this when the first of them asks.
  template <class Table>
  Table& table() {
    auto& made = tables_[&kTableKey<Table>];
    if (!made) made = std::make_shared<Table>(*this);
    return *static_cast<Table*>(made.get());
  }

  json::NodeId node_at(Span place) const { return validate::node_at(document_, place); }
  json::NodeId node_around(Span place) const { return validate::node_around(document_, place); }
  /// The object or array that holds a value or key; json::kNoNode for the root.
  json::NodeId parent(json::NodeId node) { return tree().parent(node); }
  /// Whether no fix has changed the value in this run; from now on one has.
  bool claim(json::NodeId node);
  /// Whether a fix has changed the value in this run.
  bool is_claimed(json::NodeId node);
  /// Whether claim() or is_claimed() met a changed value since the last call of this.
  bool take_was_claimed() { return std::exchange(claimed_.was_met, false); }
  /// Says that this fix is the same as all others that say so of `node`: one is made with all.
  void share(json::NodeId node) { shared_ = node; }
  /// What share() was told since the last call of this, or json::kNoNode.
  json::NodeId take_shared() { return std::exchange(shared_, json::kNoNode); }
  /// The position of an object in the array of the root that it is an element of, or UINT32_MAX.
  std::uint32_t index_of(json::NodeId object);

  /// Takes a member out, by its value. False: it is no member, or changed already.
  bool remove_member(json::NodeId value);
  bool replace_scalar(json::NodeId value, std::string json);
  /// Gives a value another JSON text.
  bool replace(json::NodeId value, std::string_view json);
  bool append_member(json::NodeId object, std::string_view name, std::string_view json);
  /// Puts text in the place of a stretch of the text.
  void replace_text(Span span, std::string text) { editor_.replace_text(span, std::move(text)); }
  json::Editor& editor() { return editor_; }
  change::NameList& extensions_used() { return names_.used; }
  change::NameList& extensions_required() { return names_.required; }
  /// What a buffer holds from now on, to be changed in place; null where its bytes are missing
  /// or too many.
  std::string* content(std::uint32_t buffer);
  /// Takes out the value of a JSON pointer, in a stage where nothing else is changed.
  void delete_value(std::string pointer) { deleted_.insert(std::move(pointer)); }
  /// The container is to be written anew, with right lengths and padding.
  void rewrite_container() { rewrites_container_ = true; }

  /// What all fixes come to, placed. An Error says why not.
  Result<change::Change> take();

 private:
  Result<change::Change> take_deletion();

  const model::OpenedAsset& opened_;
  const json::Document& document_;
  const schema::Set& schemas_;
  model::Asset elements_;
  json::Editor editor_;
  struct {
    change::NameList used, required;
  } names_;
  struct {
    change::BufferContents changed;
    std::uint64_t bytes_left;  ///< for more of them
  } contents_;
  struct {
    std::vector<bool> nodes;  ///< empty until a value is claimed
    bool was_met = false;
  } claimed_;
  json::NodeId shared_ = json::kNoNode;
  std::set<std::string> deleted_;  ///< JSON pointers
  template <class Table>
  static constexpr char kTableKey = 0;  ///< its address tells tables apart
  std::map<const void*, std::shared_ptr<void>> tables_;
  bool rewrites_container_ = false;
};

/// The fix of rules about members that are better not there: `place` is the value or the name.
bool remove_marked(Fixing& fixing, Span place);

/// `numbers` without those that were there before, in the order of the first ones.
std::string without_repeats(const json::Document& document, json::NodeId numbers);

}  // namespace gltfx::validate
