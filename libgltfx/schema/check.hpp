// SPDX-License-Identifier: Apache-2.0
/// One walk over a document that checks it against a Set: types, ranges, unknown and missing
/// members, exclusions, companions, attachment points of extensions, and every index.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json_pointer.hpp"
#include "base/sink.hpp"
#include "json/document.hpp"
#include "schema/deviations.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// The part of the checks that a walk does.
enum class Part : std::uint8_t {
  all,
  form,        ///< all except references between objects; those of the root object count as form
  references,  ///< indices and their targets; findings on form go to the sink as well
};

/// How a member is treated.
enum class Reading : std::uint8_t {
  check,  ///< the walk checks it
  keep,   ///< the walk does not check it
  drop,   ///< the member is hidden
};

/// Callbacks for the members of an object, in their order. Paths are only valid during the call.
class MemberVisitor {
 public:
  virtual ~MemberVisitor() = default;
  /// The callbacks for objects of a type.
  struct Calls {
    static constexpr std::uint32_t kLast = 63;
    bool before = false;
    std::uint64_t behind = 0;  ///< bit i: after property i; bit kLast: after all from there on
  };
  /// Called once for each object.
  virtual Calls calls(const ObjectType& type) = 0;
  /// Before a member that is present.
  virtual Reading before(const ObjectType& type, std::string_view member, json::NodeId object,
                         json::NodeId value, const Path& object_path) = 0;
  /// After the place of a member, present or not.
  virtual void behind(const ObjectType& type, std::string_view member, json::NodeId object,
                      const Path& object_path) = 0;
  /// Before a member of an object that is a map of names.
  virtual void entry(std::string_view name, json::NodeId value, const Path& map_path) = 0;

 protected:
  MemberVisitor() = default;
  MemberVisitor(const MemberVisitor&) = default;
  MemberVisitor& operator=(const MemberVisitor&) = default;
};

/// An index, JSON pointer or name of the document, also a broken one.
struct ReferenceUse {
  enum class Kind : std::uint8_t { index, pointer, name };
  Kind kind = Kind::index;
  json::NodeId value = json::kNoNode;  ///< the number or string, or the number_array of the number
  const Target* target = nullptr;      ///< null for a pointer; lives in the Set
  // Members of an index:
  /// Pointer to the array, such as "/textures"; empty for one that is not reached from the root, or
  /// when it may be one of several.
  std::string_view array;
  std::uint64_t index = 0;
  Span span;                          ///< of the number
  json::NodeId list = json::kNoNode;  ///< the array; kNoNode: missing, or one of several
};
using ReferenceVisitor = std::function<void(const ReferenceUse&)>;

struct CheckOptions {
  Deviations deviations = {};
  Part part = Part::all;
  /// The document that is checked, in which the walk hides members with a broken value:
  /// Deviations::broken_values_are_absent. Null: members are not hidden.
  json::Document* shown = nullptr;
  MemberVisitor* members = nullptr;              ///< may be null
  const ReferenceVisitor* references = nullptr;  ///< Part::all
  bool slots = true;                             ///< whether CheckResult::slots are filled
  TypeId root = kNone;                           ///< type of the root object; none: that of glTF
};

/// A texture slot that is filled.
struct SlotUse {
  json::NodeId texture_info = json::kNoNode;
  json::NodeId owner = json::kNoNode;  ///< object that holds the slot
  TypeId owner_type = kNone;
  ShapeId shape = kNone;       ///< the slot's shape (has `slot`)
  const Slot* slot = nullptr;  ///< of the shape, or of the extension's generation; lives in the Set
  std::string pointer;         ///< of the texture info
};

/// Whether the alpha channel of the slot is the coverage of its material, which `alphaMode` may
/// ignore (section 3.9.4): that of a base color.
bool has_coverage(const Set& set, const SlotUse& use);

/// Elements with references: one flag per element of a target array.
class UsedElements {
 public:
  void resize(std::size_t count) { used_.resize(count, 0); }
  void mark(std::uint64_t index, bool by_extension) {
    used_[index] = static_cast<std::uint8_t>(used_[index] | (by_extension ? 3 : 1));
  }
  void mark_all() { all_ = true; }
  bool contains(std::uint64_t index) const {
    return index < used_.size() && (all_ || used_[index] != 0);
  }
  /// Whether the object of an extension refers to it.
  bool is_used_by_extension(std::uint64_t index) const {
    return index < used_.size() && (all_ || (used_[index] & 2) != 0);
  }
  std::size_t size() const { return used_.size(); }

 private:
  std::vector<std::uint8_t> used_;
  bool all_ = false;
};

/// An array that references point into.
struct TargetArray {
  std::string pointer;  ///< "/accessors", "/extensions/KHR_lights_punctual/lights"
  json::NodeId node = json::kNoNode;
  UsedElements used;
};

/// Results of the walk in addition to the findings.
struct CheckResult {
  std::vector<TargetArray> targets;  ///< arrays of the document that references may point into
  /// Arrays inside an object that references of its other members point into (the samplers of an
  /// animation): those with references, in the order of the first reference.
  std::vector<TargetArray> local_targets;
  std::vector<SlotUse> slots;
  std::vector<std::string>
      extensions_seen;  ///< names of extension objects found anywhere, once each
  /// Extensions whose host must have a fallback member: those with an object without it, once each.
  std::vector<std::string> without_fallback;
  std::vector<std::string> extensions_used;      ///< as declared, once each
  std::vector<std::string> extensions_required;  ///< as declared, once each
  /// Part::form: a walk for Part::references may find more, because references were left for it or
  /// because members are hidden now.
  bool has_open_references = false;
  /// Deviations::other_versions_end_the_walk ended the walk.
  bool stopped_at_asset = false;

  /// The element of `targets` with that pointer, or null.
  const TargetArray* target(std::string_view pointer) const;
  /// The target that is a member of the root object, or null.
  const TargetArray* root_target(std::string_view name) const;
};

/// Called for each object with a type, after its members: for rules that need several members of
/// one object. `path` is only valid during the call.
using ObjectVisitor =
    std::function<void(const ObjectType& type, json::NodeId object, const Path& path)>;

/// Checks a whole document. Findings about the document's form go to `schema_sink`, those about
/// references between objects to `reference_sink`, which is reported after it. Iterative; linear in
/// the document.
CheckResult check(const json::Document& document, const Set& set, const CheckOptions& options,
                  Sink& schema_sink, Sink& reference_sink, const ObjectVisitor& visitor = {});

class NoFindings final : public Sink {
 public:
  void report(const Path& path, Finding finding) override {
    static_cast<void>(path);
    static_cast<void>(finding);
  }
  bool is_enabled() const override { return false; }
};

}  // namespace gltfx::schema
