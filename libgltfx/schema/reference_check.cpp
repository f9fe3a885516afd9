// SPDX-License-Identifier: Apache-2.0
// Checks that need all files: targets of references, properties that scale a slot, shapes that
// contain themselves.
#include <algorithm>

#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "schema/build.hpp"

namespace gltfx::schema {
namespace {

constexpr int kDeepestNesting = 40;  // nested combinators; the walk recurses on these only
// Maximum number of schemas for one value, each counted as often as combinators lead to it.
constexpr std::uint32_t kMostShapes = 1000;

class ReferenceCheck {
 public:
  explicit ReferenceCheck(Build& build) : build_(build), set_(build.set) {}

  void run() {
    const auto count = static_cast<ShapeId>(set_.shapes.size());
    for (ShapeId id = 0; id < count; ++id) {
      if (set_.shapes[id].ref) target(id, *set_.shapes[id].ref, "ref");
      if (set_.shapes[id].may_refer) target(id, *set_.shapes[id].may_refer, "mayRefer");
      if (set_.shapes[id].ref_name) target(id, *set_.shapes[id].ref_name, "refName");
    }
    for (TypeId id = 0; id < set_.types.size(); ++id) slots(set_.types[id]);
    for (SourceId id = 0; id < build_.sources.size(); ++id) {
      if (!build_.sources[id].is_extension()) continue;
      strength(id);
      generations(id);
      const std::size_t errors = build_.errors.size();
      upgrade(id);
      if (build_.errors.size() > errors && is_outdated(id)) {
        build_.errors.keep(errors);
        set_.extensions[build_.extension_of[id]].upgrade = {};
      }
    }
    nesting();
  }

 private:
  Site word(ShapeId shape, std::string_view name) const {
    const Site schema = build_.shape_sites[shape];
    return build_.member(build_.member(schema, "x-gltfx"), name);
  }

  // The position of a path of names: an object type or a shape.
  struct Place {
    TypeId type = kNone;
    ShapeId shape = kNone;
  };

  void target(ShapeId id, Target& target, std::string_view which) {
    const Site at = word(id, which);
    if (!at.exists()) return;  // a copy: checked at the original
    Place place{set_.find_type("glTF"), kNone};
    if (target.base == Target::Base::enclosing) {
      const std::string type = target.text.substr(0, target.text.find('/'));
      place.type = set_.find_type(type);
      if (place.type == kNone) return unknown(at, type, "not an object type", type_names());
      target.enclosing = set_.types[place.type].origin;
    } else if (place.type == kNone) {
      return;  // files without the root of glTF: nothing to check against
    }
    for (std::size_t i = 0; i < target.steps.size(); ++i) {
      if (!step(place, target.steps, i, at)) return;
    }
    if (which != "refName" && !is_array(place.shape)) {
      build_.errors.add(at, quoted(target.text) + " is not an array");
    }
  }

  bool is_array(ShapeId shape) const {
    return shape == kNone || set_.shapes[shape].types == 0 ||
           (set_.shapes[shape].types & kArray) != 0;
  }

  // One step of a target; `extensions` and a name together lead into an extension's object.
  bool step(Place& place, const std::vector<std::string>& steps, std::size_t& i, Site at) {
    const std::string& name = steps[i];
    if (name == "*") return element(place, at);
    if (name == "extensions" && i + 1 < steps.size()) return extension(place, steps[++i], at);
    const Property* property = set_.find_property(place.type, name);
    if (property == nullptr) {
      const ShapeId values = place.shape == kNone ? kNone : set_.shapes[place.shape].values;
      if (values == kNone)
        return unknown(at, name, "not a member there", member_names(place.type)), false;
      return enter(place, values);
    }
    return enter(place, property->shape);
  }

  bool enter(Place& place, ShapeId shape) {
    place = {shape == kNone ? kNone : set_.shapes[shape].type, shape};
    return true;
  }

  bool element(Place& place, Site at) {
    const ShapeId items = place.shape == kNone ? kNone : set_.shapes[place.shape].items;
    if (items == kNone) {
      build_.errors.add(at, "'*' requires an array");
      return false;
    }
    return enter(place, items);
  }

  bool extension(Place& place, const std::string& name, Site at) {
    const ExtensionId id = set_.find_extension(name);
    if (id == kNone) return unknown(at, name, "not a known extension", extension_names()), false;
    const ShapeId object = set_.extensions[id].shape_on(place.type);
    if (object != kNone) return enter(place, object);
    build_.errors.add(at, quoted(name) + " has no object at this place");
    return false;
  }

  void unknown(Site at, std::string_view name, std::string_view what,
               const std::vector<std::string_view>& known) {
    if (build_.errors.is_full()) return;
    build_.errors.add(at, quoted(name) + " is " + std::string(what) + did_you_mean(name, known));
  }

  std::vector<std::string_view> member_names(TypeId type) const {
    std::vector<std::string_view> names;
    if (type == kNone) return names;
    for (const Property& property : set_.types[type].properties) names.push_back(property.name);
    return names;
  }

  std::vector<std::string_view> type_names() const {
    std::vector<std::string_view> names;
    for (const ObjectType& type : set_.types) names.push_back(type.name);
    return names;
  }

  std::vector<std::string_view> extension_names() const {
    std::vector<std::string_view> names;
    for (const Extension& extension : set_.extensions) names.push_back(extension.name);
    return names;
  }

  void slots(const ObjectType& type) {
    for (const Property& property : type.properties) {
      if (property.shape == kNone || !set_.shapes[property.shape].slot) continue;
      scaled_by(type, *set_.shapes[property.shape].slot, word(property.shape, "slot"));
    }
  }

  void scaled_by(const ObjectType& type, const Slot& slot, Site at) {
    if (!slot.scaled_by.empty()) factor(type, slot.scaled_by, build_.member(at, "scaledBy"));
    const Site factors = build_.member(at, "factors");
    for (const auto& [channels, name] : slot.factors) {
      factor(type, name, build_.member(factors, channels));
    }
  }

  void factor(const ObjectType& type, const std::string& name, Site place) {
    const auto is_factor = [&](const Property& p) { return p.name == name; };
    const bool known = std::any_of(type.properties.begin(), type.properties.end(), is_factor);
    if (known || type.origin != set_.shapes[type.shape].type || !place.exists()) return;
    std::vector<std::string_view> names;
    for (const Property& property : type.properties) names.push_back(property.name);
    unknown(place, name, "not a property of the same object", names);
  }

  void strength(SourceId id) {
    const Extension& extension = set_.extensions[build_.extension_of[id]];
    if (extension.strength.empty() || extension.attachment_points.empty()) return;
    const Site root{id, build_.sources[id].document.root()};
    has_member(object_type(extension), extension.strength,
               build_.member(build_.member(root, "x-gltfx"), "strength"));
  }

  // Members in the conditions of generations must exist on the extension's object.
  void generations(SourceId id) {
    const Extension& extension = set_.extensions[build_.extension_of[id]];
    if (extension.attachment_points.empty()) return;
    const TypeId type = set_.shapes[extension.attachment_points.front().second].type;
    const Source& source = build_.sources[id];
    const Site list =
        build_.member(build_.member({id, source.document.root()}, "x-gltfx"), "generations");
    if (!list.exists()) return;
    std::size_t at = 0;
    for (const json::NodeId element : source.document.elements(list.node)) {
      generation(extension.generations[at++], type, {id, element});
    }
  }

  void generation(const Generation& generation, TypeId type, Site at) {
    const auto known = [&](const std::string& name, Site place) {
      if (set_.find_property(type, name) != nullptr) return;
      unknown(place, name, "not a property of the extension object", member_names(type));
    };
    for (const std::string& name : generation.with) known(name, build_.member(at, "with"));
    for (const std::string& name : generation.without) known(name, build_.member(at, "without"));
    for (const auto& [name, slot] : generation.slots) {
      const Site place = build_.member(build_.member(at, "slots"), name);
      known(name, place);
      scaled_by(set_.types[type], slot, place);
    }
  }

  TypeId object_type(const Extension& extension) const {
    return set_.shapes[extension.attachment_points.front().second].type;
  }

  // A built-in upgrade may lead to an extension that a user's file describes differently: the
  // upgrade is then dropped.
  bool is_outdated(SourceId id) const {
    return !build_.sources[id].from_user &&
           std::any_of(build_.sources.begin(), build_.sources.end(),
                       [](const Source& source) { return source.from_user; });
  }

  // The sources of an upgrade must exist on the extension's object, its targets on the successor's.
  void upgrade(SourceId id) {
    const Extension& extension = set_.extensions[build_.extension_of[id]];
    const Site root{id, build_.sources[id].document.root()};
    const Site at = build_.member(build_.member(root, "x-gltfx"), "upgrade");
    if (!at.exists() || extension.attachment_points.empty()) return;
    const Upgrade& upgrade = extension.upgrade;
    for (const UpgradeStay& stay : upgrade.stays) {
      known_generations(extension, stay.generations, build_.member(at, "stays"));
    }
    if (upgrade.to.empty()) {
      const bool alone = upgrade.conversion.empty() && upgrade.stays.empty();
      if (alone) build_.errors.add(at, "'to' is missing");
      return;
    }
    const Extension* successor = described(upgrade.to, build_.member(at, "to"));
    if (successor == nullptr) return;
    const TypeId own = object_type(extension);
    upgrade_steps(extension, own, object_type(*successor), build_.member(at, "steps"));
    for (const std::string& name : upgrade.alternatives) {
      const Extension* other = described(name, build_.member(at, "alternatives"));
      if (other != nullptr) {
        upgrade_steps(extension, own, object_type(*other), build_.member(at, "steps"));
      }
    }
  }

  const Extension* described(const std::string& name, Site at) {
    const auto found = set_.extension_ids.find(name);
    if (found != set_.extension_ids.end() &&
        !set_.extensions[found->second].attachment_points.empty()) {
      return &set_.extensions[found->second];
    }
    unknown(at, name, "not a known extension", extension_names());
    return nullptr;
  }

  void upgrade_steps(const Extension& extension, TypeId own, TypeId new_type, Site list) {
    if (!list.exists()) return;
    std::size_t index = 0;
    for (const json::NodeId element : build_.document(list).elements(list.node)) {
      const UpgradeStep& step = extension.upgrade.steps[index++];
      const Site at{list.source, element};
      const bool place = step.kind == UpgradeStep::Kind::place;
      if (step.from.empty() && (!place || step.otherwise.empty())) {
        build_.errors.add(at, "'from' is missing");
      }
      if (step.kind != UpgradeStep::Kind::copy && !step.from.empty()) {
        has_member(own, step.from, build_.member(at, "from"));
      }
      if (place) {
        has_place(extension.attachment_points.front().first, step.to, build_.member(at, "to"));
      } else {
        has_member(new_type, step.to, build_.member(at, "to"));
      }
      known_generations(extension, step.generations, build_.member(at, "generations"));
    }
  }

  void known_generations(const Extension& extension, const std::vector<std::string>& wanted,
                         Site at) {
    std::vector<std::string_view> names;
    for (const Generation& known : extension.generations) names.push_back(known.name);
    for (const std::string& name : wanted) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      unknown(at, name, "not a generation of the extension", names);
    }
  }

  // A path of members from an object of that type.
  void has_place(TypeId home, const std::string& path, Site at) {
    std::vector<std::string> steps;
    for (std::size_t from = 0; from <= path.size();) {
      const std::size_t end = std::min(path.find('/', from), path.size());
      steps.push_back(path.substr(from, end - from));
      from = end + 1;
    }
    Place place{home, kNone};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!step(place, steps, i, at)) return;
    }
  }

  void has_member(TypeId type, const std::string& name, Site at) {
    if (type != kNone && set_.find_property(type, name) != nullptr) return;
    unknown(at, name, "not a property of the extension object",
            type == kNone ? std::vector<std::string_view>() : member_names(type));
  }

  // Shapes that apply to one value together: a cycle among them would never end.
  std::vector<ShapeId> in_place(const Shape& shape) const {
    std::vector<ShapeId> all;
    for (const auto* list : {&shape.all_of, &shape.any_of, &shape.one_of}) {
      all.insert(all.end(), list->begin(), list->end());
    }
    all.push_back(shape.not_shape);
    for (const Condition& condition : shape.conditions) {
      all.insert(all.end(), {condition.if_shape, condition.then_shape, condition.else_shape});
    }
    all.erase(std::remove(all.begin(), all.end(), kNone), all.end());
    return all;
  }

  // Depth first with an explicit stack: finds the nesting depth of combinators, and cycles.
  void nesting() {
    std::vector<int> depth(set_.shapes.size(), 0);  // 0: not seen, -1: on the way, else depth
    std::vector<std::uint32_t> work(set_.shapes.size(), 0);
    for (ShapeId start = 0; start < set_.shapes.size(); ++start) {
      if (depth[start] == 0) nesting_from(start, depth, work);
    }
  }

  void nesting_from(ShapeId start, std::vector<int>& depth, std::vector<std::uint32_t>& work) {
    std::vector<ShapeId> stack{start};
    while (!stack.empty()) {
      const ShapeId id = stack.back();
      const std::vector<ShapeId> inside = in_place(set_.shapes[id]);
      if (depth[id] == 0) {
        depth[id] = -1;
        for (const ShapeId next : inside) {
          if (depth[next] == -1) return error_at(id, "this schema contains itself");
          if (depth[next] == 0) stack.push_back(next);
        }
        continue;
      }
      stack.pop_back();
      if (depth[id] != -1) continue;
      depth[id] = 1;
      for (const ShapeId next : inside) depth[id] = std::max(depth[id], depth[next] + 1);
      if (depth[id] == kDeepestNesting) error_at(id, "combinators are nested too deeply");
      work[id] = work_of(id, inside, work);
    }
  }

  // Reported once: schemas that contain such a schema are not reported again.
  std::uint32_t work_of(ShapeId id, const std::vector<ShapeId>& inside,
                        const std::vector<std::uint32_t>& work) {
    bool reported = false;
    std::uint64_t sum = 1;
    for (const ShapeId next : inside) {
      sum += work[next];
      reported = reported || work[next] > kMostShapes;
    }
    if (sum > kMostShapes && !reported) {
      error_at(id, "combinators check one value against more than " + std::to_string(kMostShapes) +
                       " schemas here");
    }
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, kMostShapes + 1));
  }

  void error_at(ShapeId shape, std::string message) {
    const Site site = build_.shape_sites[shape];
    if (site.exists()) build_.errors.add(site, std::move(message));
  }

  Build& build_;
  SetParts& set_;
};

}  // namespace

void check_references(Build& build) { ReferenceCheck(build).run(); }

}  // namespace gltfx::schema
