// SPDX-License-Identifier: Apache-2.0
// Stores equal objects once: the first one stays, and all references are set to it.
#include <algorithm>
#include <array>
#include <set>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "graph/equal_objects.hpp"
#include "graph/renumber.hpp"
#include "json/edit.hpp"
#include "model/draco.hpp"
#include "model/fields.hpp"
#include "report/wording.hpp"
#include "steps/dedup_content.hpp"
#include "steps/image_use.hpp"
#include "steps/references.hpp"

namespace gltfx::steps {
namespace {

using json::NodeId;
using model::AccessorUse;
using model::RootArray;
using Pairs = std::vector<std::pair<NodeId, NodeId>>;

constexpr std::uint8_t bit(AccessorUse use) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(use));
}

/// Finds the equal objects of an asset.
class DedupRun {
 public:
  explicit DedupRun(const StepInput& input)
      : input_(input),
        document_(input.asset.document()),
        graph_(document_, input.schemas, true),
        tree_(graph_.tree()),
        elements_(document_),
        content_(input, graph_, elements_),
        equal_(graph_),
        editor_(document_) {
    for (const graph::PointerText& pointer : graph_.pointers()) {
      for (const NodeId value : pointer.way) apart_.insert(tree_.root_element(value));
    }
    for (const model::Mesh& mesh : views().meshes) {
      for (const model::Primitive& primitive : mesh.primitives) keep_decoded_apart(primitive);
    }
  }

  Result<StepOutcome> run() {
    merge_images();
    merge_described(RootArray::samplers);
    merge_plain_accessors(false);
    find_unused_views();
    merge_views();
    merge_plain_accessors(true);
    merge_other_accessors();
    merge_described(RootArray::textures);
    merge_described(RootArray::materials);
    if (content_.is_exhausted()) {
      outcome_.row.left.push_back({{}, "objects share too many bytes to compare all of them"});
    }
    if (equal_.empty()) return std::move(outcome_);
    find_unused_views();
    const auto is_gone = [this](NodeId element) { return this->is_gone(element); };
    if (auto note = find_unknown_index(graph_, is_gone)) {
      StepOutcome refused;
      refused.row.refused.push_back(*std::move(note));
      return refused;
    }
    describe_merged();
    write();
    if (auto note = find_indices_in_extras(graph_)) outcome_.row.left.push_back(*std::move(note));
    outcome_.change.edits = editor_.take();
    outcome_.freedom.unused = true;
    return std::move(outcome_);
  }

 private:
  const model::Views& views() const { return input_.asset.views(); }
  NodeId list(RootArray array) const {
    return document_.find(document_.root(), model::root_array_name(array));
  }
  std::uint32_t index(NodeId element) const { return tree_.position(element); }
  bool is_gone(NodeId element) const {
    return equal_.is_merged(element) || unused_views_.contains(element);
  }

  // The content of accessors that a decoder fills is not known here.
  void keep_decoded_apart(const model::Primitive& primitive) {
    if (primitive.node == json::kNoNode) return;
    const NodeId extensions = document_.find(primitive.node, "extensions");
    if (document_.find(extensions, model::kDracoExtension) == json::kNoNode) return;
    const auto keep = [this](const std::optional<std::uint32_t>& accessor) {
      if (accessor) apart_.insert(views().accessors[*accessor].node);
    };
    keep(primitive.indices);
    for (const model::Attribute& attribute : primitive.attributes) keep(attribute.accessor);
  }

  // The objects of a list that may be merged.
  std::vector<NodeId> objects(RootArray array) const {
    std::vector<NodeId> found;
    for (const NodeId element : elements_.elements(array)) {
      if (element != json::kNoNode && !apart_.contains(element) && !equal_.is_merged(element)) {
        found.push_back(element);
      }
    }
    return found;
  }

  void merge(RootArray array, const Pairs& pairs) {
    if (pairs.empty()) return;
    std::optional<std::string> doubt = find_index_doubt(graph_, list(array));
    const bool has_views = array == RootArray::images || array == RootArray::accessors;
    if (!doubt && has_views && list(RootArray::buffer_views) != json::kNoNode) {
      doubt = find_index_doubt(graph_, list(RootArray::buffer_views));
    }
    if (doubt) {
      outcome_.row.refused.push_back({tree_.pointer(list(array)), *std::move(doubt)});
      return;
    }
    for (const auto& [element, first] : pairs) equal_.merge(element, first);
  }

  void merge_described(RootArray array) {
    graph::ContentGroups groups;
    for (const NodeId element : objects(array)) {
      std::string text;
      equal_.describe(element, nullptr, text);
      groups.add(element, std::move(text));
    }
    merge(array, groups.find());
  }

  // Describes an element without some of its direct members.
  std::string describe_without(NodeId element,
                               std::initializer_list<std::string_view> names) const {
    std::set<NodeId> out;
    for (const std::string_view name : names) out.insert(document_.find(element, name));
    std::string text;
    equal_.describe(
        element, [&](NodeId value) { return out.contains(value); }, text);
    return text;
  }

  // Names and the storage of bytes may differ. Declared formats and color spaces must not.
  void merge_images() {
    graph::ContentGroups groups;
    const std::vector<ImageUse> uses = image_uses(elements_, graph_);
    for (const NodeId image : objects(RootArray::images)) {
      const auto& kind = uses[index(image)].kind;
      const char space = !kind ? '?' : *kind == ImageClass::color ? 'c' : 'd';
      groups.add(image, space + describe_without(image, {"name", "uri", "bufferView", "mimeType"}));
    }
    Pairs pairs = groups.find([this](NodeId image) { return content_.hash_of_image(index(image)); },
                              [this](NodeId one, NodeId other) {
                                const std::string ours = media_type(one),
                                                  theirs = media_type(other);
                                if (!ours.empty() && !theirs.empty() && ours != theirs)
                                  return false;
                                return content_.same_images(index(one), index(other));
                              });
    merge(RootArray::images, pairs);
  }
  std::string media_type(NodeId image) const {
    return model::string_member(document_, image, "mimeType");
  }

  // The kinds of objects that refer to an element, as text.
  std::string users_of(NodeId element) const {
    std::set<std::string> kinds;
    for (const graph::Use& use : graph_.users(element)) {
      const NodeId user = tree_.root_element(use.at.node);
      if (user != json::kNoNode && is_gone(user)) continue;
      kinds.insert(kind_of(use, user));
    }
    std::string text;
    for (const std::string& kind : kinds) text += kind + ';';
    return text;
  }
  std::string kind_of(const graph::Use& use, NodeId user) const {
    NodeId holder = use.at.node;
    while (holder != json::kNoNode && graph_.type(holder) == schema::kNone)
      holder = tree_.parent(holder);
    std::string kind = holder == json::kNoNode ? "" : std::to_string(graph_.type(holder));
    const bool by_accessor =
        user != json::kNoNode && user == holder && tree_.parent(user) == list(RootArray::accessors);
    if (by_accessor) kind += fmt::format(" {}", views().usage.accessor(index(user)).kinds);
    return kind;
  }

  // Compares elements, not their storage. Sparse accessors follow after the views of their
  // replacements are merged.
  void merge_plain_accessors(bool sparse) {
    graph::ContentGroups groups;
    for (const NodeId element : objects(RootArray::accessors)) {
      const model::Accessor& accessor = views().accessors[index(element)];
      if (!content_.has_elements(index(element))) continue;
      if (sparse != (accessor.sparse != json::kNoNode)) continue;
      const std::string members = describe_without(
          element, {"bufferView", "byteOffset", "type", "componentType", "normalized", "count"});
      const model::Format& format = accessor.format;
      groups.add(element, fmt::format("{} {} {} {} {} {}", static_cast<unsigned>(format.type),
                                      static_cast<unsigned>(format.component), format.normalized,
                                      *accessor.count, use(element), members));
    }
    merge(RootArray::accessors,
          groups.find([this](NodeId element) { return content_.hash_of_accessor(index(element)); },
                      [this](NodeId one, NodeId other) {
                        return content_.same_accessors(index(one), index(other));
                      }));
  }
  std::string use(NodeId accessor) const {
    return fmt::format("{} {}", views().usage.accessor(index(accessor)).kinds, users_of(accessor));
  }

  // Accessors whose elements are unknown are compared by their JSON.
  void merge_other_accessors() {
    graph::ContentGroups groups;
    for (const NodeId element : objects(RootArray::accessors)) {
      if (content_.has_elements(index(element))) continue;
      std::string text = use(element);
      equal_.describe(element, nullptr, text);
      groups.add(element, std::move(text));
    }
    merge(RootArray::accessors, groups.find());
  }

  void merge_views() {
    if (!content_.knows_views()) return;
    graph::ContentGroups groups;
    for (const NodeId view : objects(RootArray::buffer_views)) {
      if (unused_views_.contains(view) || is_packed_for_one(view)) continue;
      std::set<NodeId> places;
      for (const change::BufferUser& user : content_.buffer_users(view)) {
        places.insert(document_.find(user.object, "buffer"));
        places.insert(document_.find(user.object, "byteOffset"));
      }
      if (places.empty()) continue;
      std::string text = users_of(view);
      equal_.describe(
          view, [&](NodeId value) { return places.contains(value); }, text);
      groups.add(view, std::move(text));
    }
    merge(
        RootArray::buffer_views,
        groups.find([this](NodeId view) { return content_.hash_of_view(view); },
                    [this](NodeId one, NodeId other) { return content_.same_views(one, other); }));
  }

  // Vertex attributes can only share a view that has a stride (glTF 2.0 section 3.6.2.4).
  bool is_packed_for_one(NodeId view) const {
    if (views().buffer_views[index(view)].byte_stride) return false;
    const auto users = graph_.users(view);
    return std::any_of(users.begin(), users.end(), [&](const graph::Use& use) {
      const NodeId user = tree_.root_element(use.at.node);
      const bool is_accessor =
          user != json::kNoNode && tree_.parent(user) == list(RootArray::accessors);
      if (!is_accessor || equal_.is_merged(user) || tree_.parent(use.at.node) != user) return false;
      return (views().usage.accessor(index(user)).kinds & bit(AccessorUse::vertex_attribute)) != 0;
    });
  }

  // Finds views whose users, including those of equal views, are all merged.
  void find_unused_views() {
    std::unordered_set<NodeId> live;
    const auto is_live = [this](const graph::Use& use) {
      const NodeId user = tree_.root_element(use.at.node);
      return user == json::kNoNode || !equal_.is_merged(user);
    };
    for (const NodeId view : elements_.elements(RootArray::buffer_views)) {
      if (view == json::kNoNode) continue;
      const auto users = graph_.users(view);
      if (std::any_of(users.begin(), users.end(), is_live)) live.insert(equal_.first(view));
    }
    for (const NodeId view : objects(RootArray::buffer_views)) {
      if (!graph_.users(view).empty() && !live.contains(view)) unused_views_.insert(view);
    }
  }

  void describe_merged() {
    constexpr std::array<std::pair<RootArray, std::string_view>, 6> kNouns{
        {{RootArray::accessors, "accessor"},
         {RootArray::buffer_views, "buffer view"},
         {RootArray::images, "image"},
         {RootArray::samplers, "sampler"},
         {RootArray::textures, "texture"},
         {RootArray::materials, "material"}}};
    for (const auto& [array, noun] : kNouns) {
      std::uint64_t count = 0;
      for (const NodeId element : elements_.elements(array)) {
        if (element == json::kNoNode || !is_gone(element)) continue;
        ++count;
        if (array == RootArray::images) note_name(element);
      }
      if (count == 0) continue;
      std::string& what = outcome_.row.what;
      what += fmt::format("{}{}", what.empty() ? "" : ", ", report::counted(count, noun));
    }
  }

  void note_name(NodeId image) {
    const std::string name = model::string_member(document_, image, "name");
    const std::string kept = model::string_member(document_, equal_.first(image), "name");
    if (name == kept) return;
    outcome_.freedom.image_names = true;
    if (name.empty()) return;
    outcome_.row.losses.push_back({fmt::format("the name of {}", tree_.pointer(image)), 0, 0, {}});
  }

  void write() {
    std::unordered_map<NodeId, std::vector<std::uint64_t>> gone;  // positions, by list
    const auto take_out = [&](NodeId element) {
      const NodeId from = tree_.parent(element);
      editor_.remove(from, element);
      gone[from].push_back(tree_.position(element));
    };
    for (const auto& [element, first] : equal_.all()) take_out(element);
    for (const NodeId view : unused_views_) take_out(view);
    for (auto& [from, positions] : gone) {
      std::sort(positions.begin(), positions.end());
      if (positions.size() == tree_.size(from)) editor_.remove(document_.root(), from - 1);
    }
    auto edits = graph::renumber(
        graph_,
        [&](NodeId from, std::uint64_t position) {
          const auto found = gone.find(from);
          if (found == gone.end()) return position;
          const std::uint64_t now = tree_.position(equal_.first(tree_.element(from, position)));
          const auto behind = std::lower_bound(found->second.begin(), found->second.end(), now);
          return now - static_cast<std::uint64_t>(behind - found->second.begin());
        },
        [this](graph::Place at) {
          const NodeId element = tree_.root_element(at.node);
          return element != json::kNoNode && is_gone(element);
        });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
  }

  const StepInput& input_;
  const json::Document& document_;
  const graph::Graph graph_;
  const graph::Tree& tree_;
  const model::Asset elements_;
  DedupContent content_;
  graph::EqualObjects equal_;
  std::unordered_set<NodeId> apart_;  ///< elements that are equal to no other
  std::unordered_set<NodeId> unused_views_;
  json::Editor editor_;
  StepOutcome outcome_;
};

}  // namespace

StepDescription dedup_step();
StepDescription dedup_step() {
  return {"dedup",
          "stores equal accessors, buffer views, images, samplers, textures and materials once",
          "meshes, nodes, all elements, and objects with different names or `extras`",
          "the `name` of an image whose bytes equal those of another",
          [](const ConvertOptions& options) { return options.dedup || options.shrink; },
          [](const StepInput& input) { return DedupRun(input).run(); }};
}

}  // namespace gltfx::steps
