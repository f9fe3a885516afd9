// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/number.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "schema/shape_builder.hpp"

namespace gltfx::schema {
namespace {

std::string text_of(const Build& build, Site at) {
  return at.exists() ? build.text(at) : std::string();
}

template <class Read>
void each_element(const Build& build, Site list, const Read& read) {
  if (!list.exists()) return;
  for (const json::NodeId element : build.document(list).elements(list.node)) {
    read(Site{list.source, element});
  }
}

std::vector<Relation> read_others(const Build& build, Site list) {
  std::vector<Relation> others;
  each_element(build, list, [&](Site relation) {
    others.push_back({build.text(build.member(relation, "extension")),
                      build.text(build.member(relation, "because")), false});
  });
  return others;
}

UpgradeStep::Kind kind_of(std::string_view word) {
  if (word == "copy") return UpgradeStep::Kind::copy;
  return word == "place" ? UpgradeStep::Kind::place : UpgradeStep::Kind::move;
}

UpgradeStep read_step(const Build& build, Site at) {
  UpgradeStep step;
  step.kind = kind_of(build.text(build.member(at, "step")));
  step.from = text_of(build, build.member(at, "from"));
  step.to = build.text(build.member(at, "to"));
  const Site otherwise = build.member(at, "otherwise");
  if (otherwise.exists()) step.otherwise = build.document(otherwise).raw(otherwise.node);
  const Site take = build.member(at, "take");
  if (take.exists()) step.take = build.document(take).unsigned_integer(take.node).value_or(0);
  step.swizzle = text_of(build, build.member(at, "swizzle"));
  step.accept_index = build.member(at, "accept").exists();
  step.generations = read_names(build, build.member(at, "generations"));
  return step;
}

class ExtensionBuilder {
 public:
  ExtensionBuilder(Build& build, SourceId source)
      : build_(build),
        source_(source),
        root_{source, build.sources[source].document.root()},
        annotation_(build.member(root_, "x-gltfx")) {}

  void run() {
    Extension extension = facts();
    add_homes(extension);
    build_.set.extensions[build_.extension_of[source_]] = std::move(extension);
  }

 private:
  Site word(std::string_view name) const { return build_.member(annotation_, name); }
  std::string text(Site at) const { return at.exists() ? build_.text(at) : std::string(); }
  bool flag(Site at) const {
    return at.exists() && build_.document(at).kind(at.node) == json::Kind::true_value;
  }

  Extension facts() {
    Extension extension;
    extension.name = text(word("extension"));
    if (extension.name != build_.sources[source_].short_name()) {
      build_.errors.add(
          word("extension"),
          "the $id of this file is for a different extension than " + quoted(extension.name));
    }
    extension.title = text(build_.member(root_, "title"));
    extension.description = text(build_.member(root_, "description"));
    extension.spec = text(word("spec"));
    extension.status = status();
    extension.revision = text(word("revision"));
    if (extension.status == Status::draft && extension.revision.empty()) {
      build_.errors.add(word("status"), "a draft must have 'revision': the date of its text");
    }
    extension.excludes = relations(word("excludes"));
    extension.requires_ = relations(word("requires"));
    extension.overridden_by = relations(word("overriddenBy"));
    extension.strength = text(word("strength"));
    extension.standalone = flag(word("standalone"));
    extension.undrawn = flag(word("undrawn"));
    extension.khronos_validator = flag(word("khronosValidator"));
    extension.must_be_required = must_be_required();
    extension.fallback = text(word("fallback"));
    extension.fallback_extensions = read_names(build_, word("fallbackExtensions"));
    extension.optional_with_fallback = flag(word("optionalWithFallback"));
    extension.image_mime_types = read_names(build_, word("imageMimeTypes"));
    extension.vertex_attributes = semantics(word("vertexAttributes"));
    extension.morph_attributes = semantics(word("morphAttributes"));
    extension.instance_attributes = semantics(word("instanceAttributes"));
    extension.successor = text(word("successor"));
    extension.generations = generations();
    if (word("upgrade").exists()) extension.upgrade = read_upgrade(build_, word("upgrade"));
    extension.enum_additions = enum_additions();
    extension.from_user = build_.sources[source_].from_user;
    return extension;
  }

  Status status() const {
    const auto names = listed_values(Form::status);
    const auto found = std::find(names.begin(), names.end(), text(word("status")));
    return found == names.end() ? Status::vendor : static_cast<Status>(found - names.begin());
  }

  MustBeRequired must_be_required() const {
    const std::string name = text(word("mustBeRequired"));
    if (name == "always") return MustBeRequired::always;
    if (name == "without-fallback") return MustBeRequired::without_fallback;
    return name == "recommended" ? MustBeRequired::recommended : MustBeRequired::optional;
  }

  std::vector<Relation> relations(Site list) const {
    std::vector<Relation> all;
    if (!list.exists()) return all;
    for (const json::NodeId element : build_.document(list).elements(list.node)) {
      const Site at{source_, element};
      all.push_back({text(build_.member(at, "extension")), text(build_.member(at, "because")),
                     text(build_.member(at, "severity")) == "error"});
    }
    return all;
  }

  std::vector<AttributeFormat> semantics(Site map) const {
    std::vector<AttributeFormat> all;
    if (!map.exists()) return all;
    const json::Document& document = build_.document(map);
    for (const auto& member : document.members(map.node)) {
      const Site at{source_, member.value};
      all.push_back({std::string(document.key(member.key_id)),
                     read_names(build_, build_.member(at, "types")),
                     read_names(build_, build_.member(at, "components")),
                     flag(build_.member(at, "required"))});
    }
    return all;
  }

  std::vector<Generation> generations() const {
    std::vector<Generation> all;
    const Site list = word("generations");
    if (!list.exists()) return all;
    for (const json::NodeId element : build_.document(list).elements(list.node)) {
      const Site at{source_, element};
      Generation generation{text(build_.member(at, "name")),
                            text(build_.member(at, "description")),
                            read_names(build_, build_.member(at, "with")),
                            read_names(build_, build_.member(at, "without")),
                            {}};
      const Site slots = build_.member(at, "slots");
      if (slots.exists()) {
        for (const auto& member : build_.document(slots).members(slots.node)) {
          generation.slots.emplace_back(build_.document(slots).key(member.key_id),
                                        read_slot(build_, {source_, member.value}));
        }
      }
      all.push_back(std::move(generation));
    }
    return all;
  }

  std::vector<std::pair<std::string, std::vector<std::string>>> enum_additions() const {
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    const Site map = word("enumAdditions");
    if (!map.exists()) return all;
    for (const auto& member : build_.document(map).members(map.node)) {
      std::vector<std::string> values;
      for (const Literal& literal : read_literals(build_, {source_, member.value})) {
        const bool number = literal.kind == Literal::Kind::number;
        values.push_back(number ? number_text(literal.number) : literal.string);
      }
      all.emplace_back(build_.document(map).key(member.key_id), std::move(values));
    }
    return all;
  }

  void add_homes(Extension& extension) {
    const Site on = word("on");
    const json::Document& document = build_.document(on);
    if (document.kind(on.node) == json::Kind::array) {
      for (const json::NodeId home : document.elements(on.node)) {
        add_attachment_point(extension, document.string(home), home, root_);
      }
      return;
    }
    for (const auto& member : document.members(on.node)) {
      const std::string place = document.string(member.value);
      const Site schema = place == "#" ? root_ : build_.resolve({source_, member.value});
      if (schema.exists()) {
        add_attachment_point(extension, std::string(document.key(member.key_id)), member.key,
                             schema);
      }
    }
  }

  void add_attachment_point(Extension& extension, const std::string& home, json::NodeId at,
                            Site schema) {
    const TypeId host = build_.set.find_type(home);
    if (host == kNone) return unknown_attachment_point(home, at);
    const ShapeId definition = build_.shape_of(schema);
    if (!build_.may_copy(object_size(definition), {source_, at})) return;
    extension.attachment_points.emplace_back(host,
                                             object_at(definition, home + "." + extension.name));
  }

  void unknown_attachment_point(const std::string& home, json::NodeId at) {
    if (build_.errors.is_full()) return;
    std::vector<std::string_view> known;
    for (const ObjectType& type : build_.set.types) known.push_back(type.name);
    build_.errors.add({source_, at},
                      quoted(home) + " is not an object type" + did_you_mean(home, known));
  }

  // Bytes of the object that a definition describes, roughly.
  std::uint64_t object_size(ShapeId definition) const {
    if (definition == kNone || build_.set.shapes[definition].type == kNone) return sizeof(Shape);
    std::uint64_t size = sizeof(Shape) + build_.set.shapes[definition].description.size();
    for (const Property& property :
         build_.set.types[build_.set.shapes[definition].type].properties) {
      size += sizeof(Property) + property.name.size() + property.default_json.size() +
              property.description.size();
    }
    return size;
  }

  // The object that a definition describes gets a separate type on each host. The first is the
  // definition's own type, further ones are copies.
  ShapeId object_at(ShapeId definition, const std::string& name) {
    SetParts& set = build_.set;
    Shape shape = definition == kNone ? Shape() : set.shapes[definition];
    shape.types = kObject;
    const bool has_type = shape.type != kNone;
    const bool is_own = has_type && set.types[shape.type].extension == build_.extension_of[source_];
    if (is_own && std::find(renamed_.begin(), renamed_.end(), shape.type) == renamed_.end()) {
      renamed_.push_back(shape.type);
      set.types[shape.type].name = name;
      set.shapes[definition].label = name;
      set.shapes[definition].types = kObject;
      set.type_ids.insert_or_assign(name, shape.type);
      return definition;
    }
    ObjectType type = has_type ? set.types[shape.type] : ObjectType();
    if (!has_type) type.open = true;
    type.name = name;
    type.shape = static_cast<ShapeId>(set.shapes.size());
    const auto id = static_cast<TypeId>(set.types.size());
    if (!has_type) type.origin = id;
    type.extension = build_.extension_of[source_];
    shape.type = id;
    shape.label = name;
    set.type_ids.insert_or_assign(name, id);
    set.types.push_back(std::move(type));
    build_.shape_sites.push_back(definition == kNone ? Site{} : build_.shape_sites[definition]);
    set.shapes.push_back(std::move(shape));
    return static_cast<ShapeId>(set.shapes.size() - 1);
  }

  Build& build_;
  SourceId source_;
  Site root_, annotation_;
  std::vector<TypeId> renamed_;
};

}  // namespace

Upgrade read_upgrade(const Build& build, Site at) {
  Upgrade upgrade;
  const auto word = [&](std::string_view name) { return build.member(at, name); };
  upgrade.to = text_of(build, word("to"));
  upgrade.alternatives = read_names(build, word("alternatives"));
  upgrade.opt_in = text_of(build, word("optIn"));
  upgrade.together = word("together").exists() &&
                     build.document(at).kind(word("together").node) == json::Kind::true_value;
  upgrade.conversion = text_of(build, word("convert"));
  upgrade.hidden_by = read_others(build, word("hiddenBy"));
  upgrade.blocked_by = read_others(build, word("blockedBy"));
  each_element(build, build.member(at, "steps"),
               [&](Site step) { upgrade.steps.push_back(read_step(build, step)); });
  each_element(build, build.member(at, "losses"), [&](Site loss) {
    upgrade.losses.push_back({text_of(build, build.member(loss, "vertexAttribute")),
                              read_names(build, build.member(loss, "generations")),
                              build.text(build.member(loss, "because"))});
  });
  each_element(build, word("stays"), [&](Site stay) {
    upgrade.stays.push_back({read_names(build, build.member(stay, "generations")),
                             build.text(build.member(stay, "because"))});
  });
  return upgrade;
}

void build_extensions(Build& build) {
  for (SourceId id = 0; id < build.sources.size(); ++id) {
    if (build.sources[id].is_extension()) ExtensionBuilder(build, id).run();
  }
}

}  // namespace gltfx::schema
