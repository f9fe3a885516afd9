// SPDX-License-Identifier: Apache-2.0
/// Compares the objects of two assets by their members and the targets of their references.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "prove/differences.hpp"
#include "prove/node_pairs.hpp"
#include "prove/placed_meshes.hpp"
#include "prove/side.hpp"
#include "prove/storage.hpp"

namespace gltfx::prove {

/// Values that are to be equal, as classes: what is in one class need not be compared again, so
/// that there are no more comparisons than values (J. Hopcroft and R. Karp, A Linear Algorithm for
/// Testing Equivalence of Finite Automata, 1971).
class EqualValues {
 public:
  /// Merges the classes of two values; false: they were in one class already.
  bool join(const Pair& pair);
  bool are_joined(const Pair& pair);

 private:
  std::uint64_t find(std::uint64_t value);
  std::unordered_map<std::uint64_t, std::uint64_t> above_;
};

/// Data to compare after all objects.
struct Payloads {
  std::vector<Pair> primitives;
  std::vector<Pair> images;
  std::vector<Pair> channels;  ///< AnimationComparison::curves
};

/// One walk over both assets. Iterative. Keeps references to all arguments.
class ObjectWalk {
 public:
  ObjectWalk(const Side& before, const Side& after, const NodePairs& nodes,
             const PlacedMeshes& placed, const MeaningRequest& request, Differences& found);

  Payloads run();

 private:
  using Names = std::set<std::string, std::less<>>;
  using Members = std::vector<std::pair<std::string_view, json::NodeId>>;
  /// A value of `before`: a node, or a number in an array.
  struct Place {
    json::NodeId value = json::kNoNode;
    std::optional<std::uint64_t> element = std::nullopt;
  };

  void drain();
  void compare(const Pair& pair);
  void compare_arrays(const Pair& pair);
  void compare_numbers(const Pair& pair);
  void compare_objects(const Pair& pair);
  void take_mesh_child(const Pair& pair, Members& ours, Members& theirs);
  void compare_members(const Pair& pair, const Members& ours, const Members& theirs);
  Members members(const Side& side, json::NodeId object) const;
  bool is_compared(const Side& side, json::NodeId object, std::string_view name,
                   json::NodeId value) const;
  bool is_of_version(schema::TypeId type, std::string_view name) const;
  bool is_of_copies(const Side& side, json::NodeId object) const;
  bool is_mere_storage(const Side& side, std::string_view name, json::NodeId value) const;

  /// Precondition: `ours` has a target.
  void compare_links(const Place& place, const Link& ours, const Link* theirs);
  void compare_pointers(const Place& place, const Link& ours, const Link& theirs);
  void follow(const Place& place, const Pair& pair);
  // Whether both could be read.
  bool compare_payloads(const Place& place, const Pair& pair);
  bool compare_accessors(const Place& place, const Pair& pair);
  bool compare_views(const Place& place, const Pair& pair);
  void compare_textures(const Pair& pair);
  void compare_accessor_members(const Pair& pair);
  void compare_declared(std::string_view list);
  void note_local_tables(const Pair& pair);
  void compare_unused();
  void compare_unused(const std::string& pointer, const Pair& arrays);
  std::vector<json::NodeId> unused(const Side& side, json::NodeId array,
                                   const std::unordered_set<json::NodeId>& reached) const;

  void differ(const Place& place, std::string what, double amount = 0);

  const Side& before_;
  const Side& after_;
  const NodePairs& nodes_;
  const PlacedMeshes& placed_;
  const MeaningRequest& request_;
  Differences& found_;
  const Types types_;
  const Names storage_;
  std::deque<Pair> open_;
  Payloads payloads_;
  /// Tables outside of the root.
  struct {
    std::unordered_set<json::NodeId> here, there;
    /// With their owners in `before`; kNoNode: only the other one has it.
    std::vector<std::pair<json::NodeId, Pair>> pairs;
  } local_;
  /// What is known of values so far.
  struct {
    EqualValues contents, accessor_members;
    std::set<std::pair<json::NodeId, json::NodeId>> unread;  ///< pairs that nothing says are equal
    std::unordered_set<json::NodeId> reached_here, reached_there;
    /// Values that pointers lead to keep their identity, as nodes do: the first partner counts.
    std::unordered_set<json::NodeId> pointed_here, pointed_there;
    std::unordered_map<json::NodeId, json::NodeId> partners_here, partners_there;
  } known_;
};

}  // namespace gltfx::prove
