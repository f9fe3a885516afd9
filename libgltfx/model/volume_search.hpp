// SPDX-License-Identifier: Apache-2.0
/// A pass over bounding volumes: finds what they should enclose, and what they miss.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/posed_mesh.hpp"
#include "model/volume_contents.hpp"

namespace gltfx::model {

/// Work in proportion to the bytes of an asset.
std::uint64_t work_for(const GeometrySource& source);

/// What is left for all volumes of an asset.
struct VolumeBudget {
  MemoryBudget clip_bytes;  ///< for transforms that are kept
  std::uint64_t work = 0;   ///< boxes and vertices
  std::uint64_t pairs = 0;  ///< of volumes and nodes
};

/// An asset: its nodes at rest, and its animations.
struct VolumeScope {
  VolumeScope(const GeometrySource& source, const schema::Set& schemas, std::size_t order,
              VolumeBudget& budget);

  const GeometrySource& source;
  std::size_t order;  ///< among all
  const SceneGraph graph;
  RestNodes rest;
  std::vector<std::vector<NodeIndex>> children;  ///< by node
  std::vector<std::unique_ptr<ClipMoments>> clips;
  /// Of an external asset: the nodes that draw something and are moved by an animation.
  std::vector<NodeIndex> moved;
};

/// The assets that searches look at; made at first use.
class VolumeScopes {
 public:
  /// Keeps references; `more` may be null.
  VolumeScopes(const GeometrySource& source, const schema::Set& schemas, MorePoints* more);

  VolumeScope& own() { return own_; }
  /// Null: its nodes are no forest, or there is too much work.
  VolumeScope* of(const MovingPart& part);
  MorePoints* more() { return more_; }
  VolumeBudget& budget() { return budget_; }

 private:
  std::vector<NodeIndex> moved_nodes(VolumeScope& scope, const MovingPart& part);

  const schema::Set& schemas_;
  MorePoints* more_;
  VolumeBudget budget_;
  VolumeScope own_;
  std::map<const GeometrySource*, std::unique_ptr<VolumeScope>> others_;  ///< may be null
};

class VolumeSearch {
 public:
  explicit VolumeSearch(VolumeScopes& scopes);

  void add(NodeIndex node, const BoundingVolume& volume);
  void judge();
  std::vector<VolumeVerdict>& verdicts() { return verdicts_; }
  /// Shows all that the one volume of the search should enclose. False: some of it is not known.
  bool show(PointWatcher& watcher, bool poses);
  /// Whether an animation moves something against a volume.
  bool moves();

 private:
  /// An asset whose nodes are looked at, below a node with a volume.
  struct Part {
    VolumeScope* scope = nullptr;
    const MovingPart* external = nullptr;  ///< null: the asset itself
    NodeIndex holder = 0;                  ///< the node that has the external asset
    Affine to_upper;                       ///< of an external asset, at rest
  };
  /// A node below a volume, or its own.
  struct Pair {
    std::size_t slot = 0;  ///< of the verdict
    NodeIndex upper = 0, node = 0;
    bool has_mesh = false;  ///< else points of another asset
    const Part* part = nullptr;

    const Node& described() const { return part->scope->source.views.nodes[node]; }
    bool is_external() const { return part->external != nullptr; }
  };
  /// Nodes that draw one mesh with one skin.
  struct Group {
    std::optional<PointBlocks> read;
    const PointBlocks* blocks = nullptr;
    bool tried = false;
    bool morphs = false;
    Box bounds;  ///< as accessors state them; empty: unknown
  };
  struct Shown {
    const Pair& pair;
    PosedMesh& mesh;
    Group& group;
  };

  bool collect(NodeIndex upper, std::size_t slot);
  bool collect_moving(NodeIndex upper, NodeIndex holder, std::size_t slot);
  MorePoints* more_of(const Pair& pair) const;
  static PosedMesh posed(const Pair& pair);
  void for_each_group(const std::function<void(const Pair&, Group&)>& use);
  void prepare(std::span<const Pair> pairs, Group& group) const;
  bool read(const Shown& shown);
  static std::optional<std::vector<Affine>> copies_of(const Shown& shown);
  bool show(const Shown& shown, const PosedMoment& at, PointWatcher& watcher);
  void judge(const Pair& pair, Group& group);
  void play(const Shown& shown, ClipMoments& clip);
  std::optional<VolumeMiss> look(const Shown& shown, const PosedMoment& at, double beyond);
  void climb(const Shown& shown, ClipMoments& clip, std::size_t moment, double height);

  VolumeScopes& scopes_;
  VolumeBudget& budget_;
  Part own_;
  std::deque<Part> external_;
  std::vector<Pair> pairs_;
  std::vector<VolumeVerdict> verdicts_;
  std::vector<const BoundingVolume*> volumes_;  ///< by verdict
  std::vector<Affine> matrices_;
};

}  // namespace gltfx::model
