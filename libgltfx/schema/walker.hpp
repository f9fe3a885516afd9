// SPDX-License-Identifier: Apache-2.0
/// The implementation of check(): one pass over a document with an explicit stack of frames.
///
/// Most values are plain and valid: their ShapePlan checks them with a comparison or two. Paths and
/// messages are made only for findings. Members of an object are first sorted in the order of its
/// type's properties, so that findings come in that order.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "schema/check.hpp"
#include "schema/document_names.hpp"
#include "schema/holds.hpp"
#include "schema/home.hpp"
#include "schema/reference_targets.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {

class Walker {
 public:
  Walker(const json::Document& document, const Set& set, const CheckOptions& options,
         Sink& schema_sink, Sink& reference_sink, const ObjectVisitor& visitor);
  CheckResult run();

 private:
  /// The stage of the walk of an object.
  enum class Stage : std::uint8_t { enter, properties, others, extensions, leave };
  enum class Mode : std::uint8_t { object, array, extensions };

  /// A container on the walk. Frames are reused.
  struct Frame {
    Path path;
    Frame* parent = nullptr;
    Frame* child = nullptr;
    json::NodeId node = json::kNoNode;
    json::NodeId at = json::kNoNode;  ///< next element or member
    json::NodeId extensions = json::kNoNode;
    json::NodeId extras = json::kNoNode;
    ShapeId shape = kNone;
    TypeId type = kNone;
    std::uint32_t index = 0;     ///< of the next property or element
    std::uint32_t scratch = 0;   ///< start of its members in members_
    std::uint32_t pending = 0;   ///< size of pending_ when it was entered
    std::uint32_t reported = 0;  ///< properties that MemberVisitor::behind() was called for
    Mode mode = Mode::object;
    Stage stage = Stage::enter;
    bool further = false;        ///< another shape for a value that has been walked already
    bool again = false;          ///< further, or below such a frame
    MemberVisitor::Calls calls;  ///< of CheckOptions::members
    bool constrained = false;
    bool unset = false;                 ///< an array that counts as absent
    std::vector<ExtensionId> siblings;  ///< Mode::extensions: those in the Set, in document order
    std::vector<bool> checked;  ///< by sibling: its relations were checked; repeats are skipped
  };

  /// The position of a value below the current frame.
  struct Step {
    enum class Kind : std::uint8_t { member, element, same } kind = Kind::member;
    std::uint64_t index = 0;
  };

  // walk.cpp: frames
  void push(ShapeId shape, json::NodeId node, const Path& path, Mode mode, bool further);
  bool walk(ShapeId shape, json::NodeId node, Step step, Mode mode);
  void pop();
  Path path_of(json::NodeId node, Step step) const;
  std::string_view key_of(json::NodeId value) const {
    return document_.key(document_.node(value - 1).next);
  }

  // walk_object.cpp
  void object_step(Frame& frame);
  void enter_object(Frame& frame);
  void gather(Frame& frame);
  bool properties(Frame& frame);
  bool root_property(Frame& frame);
  bool pending_shapes(Frame& frame);
  bool property(Frame& frame, std::uint32_t index, json::NodeId value);
  void behind(Frame& frame);
  bool is_known(const PropertyPlan& plan, json::NodeId value) const;
  bool is_allowed(ShapeId id, json::NodeId value) const;
  bool is_in_force(const PropertyPlan& plan) const;
  void advise(const Frame& frame, std::uint32_t index, json::NodeId value);
  bool follows_earlier_draft(const Frame& frame) const;
  void missing(Frame& frame, std::uint32_t index);
  bool others(Frame& frame);
  ShapeId other_shape(const Frame& frame, std::string_view name) const;
  bool entry(const Frame& frame, ShapeId shape, json::KeyId key, json::NodeId value);
  bool count_members(const Frame& frame);
  void member_names(const Frame& frame);
  void member_name(const Frame& frame, const Shape& shape, json::NodeId value);
  void leave(Frame& frame);
  void record_slot(const Frame& frame, std::uint32_t index, json::NodeId value);
  bool stops_at_asset(const Frame& frame);

  // walk_unknown.cpp
  void other_name(Frame& frame, json::KeyId key, json::NodeId value);
  void unexpected(Frame& frame, json::KeyId key, json::NodeId value);
  std::vector<std::string_view> known_names(const ObjectType& type) const;
  std::string version_help(const Property* property, std::string_view name) const;
  bool is_explained(std::string_view name) const;
  Home home_of(const Frame& frame, std::string_view name);
  void renamed(const Frame& frame, const Property& property, json::NodeId value);

  // walk_value.cpp: true when a frame was pushed
  bool value(ShapeId shape, json::NodeId node, Step step);
  bool in_full(ShapeId shape, json::NodeId node, Step step);
  void check(ShapeId shape, Value value, const Path& path);
  bool may_be_absent(const Path& path) const;
  bool check_type(ShapeId id, Value value, const Path& path);
  void check_literals(ShapeId id, Value value, const Path& path);
  void check_number(ShapeId id, Value value, const Path& path);
  void check_text(ShapeId id, Value value, const Path& path);
  bool is_added(ShapeId shape, Value value) const;
  bool is_small_index(json::NodeId node, std::uint64_t& index) const;

  // walk_array.cpp
  bool array(ShapeId shape, json::NodeId node, Step step);
  void number_array(ShapeId shape, json::NodeId node, Step step);
  void unit_length(const Shape& shape, json::NodeId node, const Path& path);
  bool is_vector(const Shape& shape) const;
  void numbers(ShapeId items, json::NodeId node, const Shape& shape, Step step);
  class Repeats;
  std::uint64_t count_elements(const Shape& shape, json::NodeId node) const;
  bool plain_indices(ShapeId items, json::NodeId node, bool unique);
  void array_step(Frame& frame);
  void count_items(const Shape& shape, std::uint64_t size, Value value, const Path& path);
  void unique_items(const Frame& frame);
  bool bad_index(ShapeId shape, Value value, const Path& path);
  bool bad_element(ShapeId items, Value value, const Path& array, std::uint64_t index,
                   bool& reported);
  bool invalid_elements(Frame& frame);

  // walk_reference.cpp
  bool discard_reference(ShapeId shape);
  void refer(ShapeId shape, std::uint64_t index, Value value, const Path& path);
  void look_at_element(ShapeId shape, ReferenceTargets::Array& array, std::uint64_t index,
                       Value value, const Path& path);
  void fit_element(ShapeId shape, ReferenceTargets::Array& array, std::uint64_t index, Value value,
                   const Path& path);
  bool is_elsewhere(const Target& target) const;
  void refer_name(ShapeId shape, std::string_view name, Value value, const Path& path);
  ReferenceTargets::Array* array_of(const TargetPlan& plan, std::uint32_t target);
  bool lacks_root_extension(const Target& target) const;

  void constraints(const Frame& frame);
  void combine(ShapeId shape, Value value, const Path& path, bool walked);
  void further(ShapeId shape, Value value, const Path& path, bool walked);
  void alternatives(ShapeId shape, const std::vector<ShapeId>& branches, bool exactly_one,
                    Value value, const Path& path, bool walked);
  void no_alternative(const std::vector<ShapeId>& branches, bool exactly_one, Value value,
                      const Path& path);
  void forbidden(const Shape& shape, Value value, const Path& path);
  void dependencies(const Frame& frame);
  std::vector<std::string> required_only(ShapeId shape) const;

  // walk_extension.cpp
  bool push_extensions(Frame& host);
  void extensions_step(Frame& frame);
  bool extension_member(Frame& frame, json::KeyId key, json::NodeId value);
  std::string undeclared_help(ExtensionId id, std::string_view name);
  ShapeId shape_on(const Frame& host, ExtensionId extension, const Path& path, json::NodeId value);
  void neighbours(Frame& frame, ExtensionId id, const Path& path, json::NodeId value);
  void exclusions(const Frame& frame, ExtensionId id, const Path& path, json::NodeId value);
  void companions(const Frame& frame, ExtensionId id, const Path& path, json::NodeId value);
  void standalone(const Frame& frame, ExtensionId id, const Path& path, json::NodeId value);
  void fallback(const Frame& frame, ExtensionId id, const Path& path, json::NodeId value);
  bool is_present(const Frame& frame, const RelationPlan& relation) const;
  bool excludes(ExtensionId one, ExtensionId other) const;
  bool has_effect(const Frame& frame, const RelationPlan& relation) const;
  bool looks_into(ExtensionId id, std::string_view name) const;

  // walk.cpp
  void read_declarations();
  void declarations();
  /// is_declared() of a member's name, looked up once.
  bool is_declared(json::KeyId key);
  bool is_declared(std::string_view name) const { return used_.contains(name); }
  bool is_required(std::string_view name) const { return required_.contains(name); }

  const Deviations& deviations() const { return options_.deviations; }
  bool is_hidden(json::NodeId value) const { return document_.is_hidden(value); }
  void drop(json::NodeId value);
  void discard(const Frame& frame);
  void report(const Path& path, Code code, Span span, std::string message, std::string help = {},
              std::optional<Severity> severity = {});
  /// A value outside a list.
  void report_unlisted(const Path& path, Span span, std::string message, std::string help);
  Span opening(json::NodeId object) const;
  std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& known);

  const json::Document& document_;
  const Set& set_;
  const Set::WalkTables& tables_;
  CheckOptions options_;
  Version version_;  ///< that the document is judged by
  Sink& schema_sink_;
  Sink& reference_sink_;
  const ObjectVisitor& visitor_;
  Values values_;
  DocumentNames names_;
  ReferenceTargets targets_;
  Holds holds_;
  CheckResult result_;
  std::deque<Frame> frames_;
  Frame* top_ = nullptr;
  std::vector<json::NodeId> members_;  ///< of all open objects, by property; see Frame::scratch
  std::vector<ShapeId> pending_;       ///< further shapes to walk, of all open frames
  std::unordered_set<std::uint64_t> walked_;  ///< shape and node of Frame::again
  json::KeyTable used_, required_;
  std::string adding_extension_;  ///< one that is declared and may add values; or empty
  std::vector<bool> seen_;        ///< by KeyId: an extension object of that name was found
  std::vector<std::uint32_t>
      stamps_;  ///< by index: the last long list of indices that contained it
  std::uint32_t stamp_ = 0;
  enum class Declared : std::uint8_t { unseen, no, yes };
  std::vector<Declared> declared_;          ///< by KeyId
  bool unset_ = false;                      ///< the value just judged counts as absent
  std::size_t comparisons_left_ = 200'000;  ///< of suggestions: each costs a microsecond
};

}  // namespace gltfx::schema
