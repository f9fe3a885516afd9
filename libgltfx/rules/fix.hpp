// SPDX-License-Identifier: Apache-2.0
/// The state that fixes of rules share: the asset, and the changes that they collect.
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

/// The innermost value or key that contains the first byte of `place`, or json::kNoNode.
json::NodeId node_around(const json::Document& document, Span place);
/// The value or key that begins at the start of `place`, or json::kNoNode.
json::NodeId node_at(const json::Document& document, Span place);

/// What a finding is about.
struct Subject {
  /// The marked value, or that of the member whose name is marked. json::kNoNode: a number of a
  /// number_array.
  json::NodeId value = json::kNoNode;
  json::NodeId owner = json::kNoNode;  ///< the object or array that contains it
  std::string_view name = {};          ///< of a member; empty: an element
  bool is_name = false;                ///< the name of the member is marked
  std::uint32_t begin = 0;             ///< first byte of the mark

  /// The value, or the array of the number.
  json::NodeId node() const { return value != json::kNoNode ? value : owner; }
};

/// The changes of one asset, as collected by fixes. Each value is changed once: a fix that finds it
/// changed leaves it to the next run over the new asset.
class Fixing {
 public:
  /// `content_bytes`: the maximum number of bytes in the buffers that fixes change; a changed
  /// buffer counts as a whole.
  Fixing(const model::OpenedAsset& opened, const schema::Set& schemas,
         std::uint64_t content_bytes = UINT64_MAX);

  const json::Document& document() const { return document_; }
  const schema::Set& schemas() const { return schemas_; }
  const model::OpenedAsset& opened() const { return opened_; }
  const model::Asset& elements() const { return elements_; }
  const model::Views& views() const { return opened_.views(); }
  /// Bytes of buffers and images, loaded on the first call.
  const model::ResourceData& resources();

  /// The parents of values; made on the first call, like all tables.
  const graph::Tree& tree();
  /// References between objects; made by a walk over the whole document.
  const graph::Graph& graph();

  /// A table shared by the fixes of one run, made from this object on the first call.
  template <class Table>
  Table& table() {
    auto& made = tables_[&kTableKey<Table>];
    if (!made) made = std::make_shared<Table>(*this);
    return *static_cast<Table*>(made.get());
  }

  /// Makes the fix of a finding, also the unsafe one if that is allowed and there is one; as
  /// FixFunction.
  bool fix(const Site& site, bool unsafe = false);

  /// The object or array that holds a value or key; json::kNoNode for the root.
  json::NodeId parent(json::NodeId node) {
    return node == json::kNoNode ? node : tree().parent(node);
  }
  /// The name of the member with that value, or empty.
  std::string_view member_name(json::NodeId value) {
    return tree().is_member(value) ? tree().name(value) : std::string_view();
  }
  /// True if no fix has changed the value in this run yet; marks it as changed.
  bool claim(json::NodeId node);
  /// Whether a fix has changed the value in this run.
  bool is_claimed(json::NodeId node);
  /// Whether claim() or is_claimed() found a changed value since the last call of this function.
  bool take_was_claimed() { return std::exchange(claimed_.was_met, false); }
  /// Declares that this fix is the same as all others with this `node`: making one makes all.
  void share(json::NodeId node) { requests_.shared = node; }
  /// The argument of share() since the last call of this function, or json::kNoNode.
  json::NodeId take_shared() { return std::exchange(requests_.shared, json::kNoNode); }
  /// The index of the object in a root array that `value` is or, as a number, refers to.
  std::optional<std::uint32_t> index(model::RootArray array, json::NodeId value);

  /// Deletes a member, given its value. False: it is not a member, or already changed.
  bool remove_member(json::NodeId value);
  bool replace_scalar(json::NodeId value, std::string json);
  /// Replaces a value by another JSON text.
  bool replace(json::NodeId value, std::string_view json);
  bool append_member(json::NodeId object, std::string_view name, std::string_view json);
  /// Replaces a span of the text.
  void replace_text(Span span, std::string text) { editor_.replace_text(span, std::move(text)); }
  json::Editor& editor() { return editor_; }
  change::NameList& extensions_used() { return names_.used; }
  change::NameList& extensions_required() { return names_.required; }
  /// The new content of a buffer, to be changed in place; null if its bytes are missing or too
  /// many.
  std::string* content(std::uint32_t buffer);
  /// Deletes the value of a JSON pointer, in a stage without other changes.
  void delete_value(std::string pointer) { deleted_.insert(std::move(pointer)); }
  /// Requests that an image, by index, is converted to a format that the asset allows. The caller
  /// of the fixes does that: the code for it is in another module of this layer.
  void convert_image(std::uint32_t image) { requests_.image = image; }
  /// The argument of convert_image() since the last call of this function.
  std::optional<std::uint32_t> take_image() { return std::exchange(requests_.image, std::nullopt); }
  /// Requests that the container is written anew, with correct lengths and padding.
  void rewrite_container() { rewrites_container_ = true; }

  /// The combined changes of all fixes. The Error gives the reason if there are none.
  Result<change::Change> take();

 private:
  std::optional<Subject> subject_at(Span place);
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
    std::uint64_t bytes_left;  ///< remaining for further buffers
  } contents_;
  struct {
    std::vector<bool> nodes;  ///< empty until a value is claimed
    bool was_met = false;
  } claimed_;
  struct {
    json::NodeId shared = json::kNoNode;
    std::optional<std::uint32_t> image = std::nullopt;
  } requests_;                     ///< of the last fix
  std::set<std::string> deleted_;  ///< JSON pointers
  template <class Table>
  static constexpr char kTableKey = 0;  ///< its address tells tables apart
  std::map<const void*, std::shared_ptr<void>> tables_;
  bool rewrites_container_ = false;
};

/// The fix of rules about members that should be absent.
bool remove_marked(Fixing& fixing, const Subject& subject);

/// `numbers` without repeats, in the order of first occurrence.
std::string without_repeats(const json::Document& document, json::NodeId numbers);

}  // namespace gltfx::validate
