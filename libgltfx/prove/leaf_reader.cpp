// SPDX-License-Identifier: Apache-2.0
#include "prove/leaf_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "json/parse.hpp"
#include "model/texture.hpp"
#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

Hash128 below(const Hash128& path, std::string_view name) {
  return hash_of_all(path, hash_content(name));
}
Hash128 below(const Hash128& path, std::uint64_t position) { return hash_of_all(path, position); }

Hash128 hash_number(double value) {
  if (value == 0) value = 0;  // both zeros
  return hash_of_all('n', value);
}

bool is_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Hash128 hash_json(const json::Document& document, json::NodeId value) {
  Hash128 sum;
  switch (document.kind(value)) {
    case json::Kind::number:
      return hash_number(document.number(value).value);
    case json::Kind::string: {
      std::string buffer;
      return hash_of_all('s', hash_content(document.string(value, buffer)));
    }
    case json::Kind::number_array: {
      std::uint64_t position = 0;
      for (json::NumberCursor at(document, value); at.valid(); at.advance()) {
        add_to_sum(sum, hash_of_all(position++, hash_number(at.number().value)));
      }
      return hash_of_all('a', sum);
    }
    case json::Kind::array: {
      std::uint64_t position = 0;
      for (const json::NodeId element : document.elements(value)) {
        add_to_sum(sum, hash_of_all(position++, hash_json(document, element)));
      }
      return hash_of_all('a', sum);
    }
    case json::Kind::object:
      for (const auto member : document.members(value)) {
        add_to_sum(sum, hash_of_all(hash_content(document.key(member.key_id)),
                                    hash_json(document, member.value)));
      }
      return hash_of_all('o', sum);
    default:
      return hash_content(document.raw(value));
  }
}

LeafReader::LeafReader(const Content& content, std::vector<Leaf>& leaves)
    : content_(content),
      side_(content.side()),
      document_(side_.document()),
      types_(content.types()),
      storage_(content.storage()),
      leaves_(leaves) {}

void LeafReader::add(json::NodeId at, const Hash128& path, const Hash128& value, LeafKind kind) {
  leaves_.push_back({path, value, at, {}, kind});
}

void LeafReader::read(json::NodeId object) {
  if (side_.type(object) == types_.texture) read_texture(object, {});
  read_object(object, {});
}

void LeafReader::read_root() { read_object(document_.root(), {}); }

// What other comparisons cover, and what only describes storage.
bool LeafReader::is_left_out(schema::TypeId type, std::string_view name, json::NodeId value) const {
  if (content_.is_list(value)) return true;
  if (type == types_.root) {
    return is_of(name, {"extensionsUsed", "extensionsRequired", "accessors", "buffers",
                        "bufferViews", "samplers"});
  }
  if (type == types_.node) {
    return is_of(name, {"children", "matrix", "translation", "rotation", "scale"});
  }
  if (type == types_.primitive) {
    return is_of(name, {"attributes", "indices", "mode", "targets", "material"});
  }
  if (type == types_.texture) return is_of(name, {"source", "sampler"});
  if (type == types_.image) return is_of(name, {"uri", "bufferView", "mimeType"});
  if (type == types_.skin) return is_of(name, {"joints", "inverseBindMatrices"});
  if (type == types_.animation) return is_of(name, {"channels", "samplers"});
  if (type == types_.channel) return name == "sampler";
  return type == types_.scene && name == "nodes";
}

bool LeafReader::is_default(schema::TypeId type, std::string_view name, json::NodeId value) {
  const schema::Property* property = side_.graph().set().find_property(type, name);
  if (property == nullptr || property->default_json.empty()) return false;
  const auto [at, is_new] = defaults_.try_emplace(property);
  if (is_new) {
    const json::Parsed parsed = json::parse(std::string_view(property->default_json));
    if (!parsed.document.empty()) at->second = hash_json(parsed.document, 0);
  }
  return at->second == hash_json(document_, value);
}

void LeafReader::read_object(json::NodeId object, const Hash128& path) {
  const schema::TypeId type = side_.graph().type(object);
  const schema::TypeId origin = side_.type(object);
  if (origin == types_.primitive) {
    read_coded_mode(object, path);
    read_contradictions(object, path);
  }
  if (origin == types_.node) {
    read_broken_places(object, path);
    read_broken_indices(object, "children", path);
  }
  if (origin == types_.scene) read_broken_indices(object, "nodes", path);
  for (const auto member : document_.members(object)) {
    const std::string_view name = document_.key(member.key_id);
    if (type == schema::kNone) {
      read_value(member.value, below(path, name), LeafKind::value);
    } else if (!is_left_out(origin, name, member.value)) {
      read_member(type, name, member.value, below(path, name));
    }
  }
}

void LeafReader::read_member(schema::TypeId type, std::string_view name, json::NodeId value,
                             const Hash128& path) {
  if (name == "extras") return read_plain(value, path, LeafKind::extras);
  if (name == "extensions" && document_.is_object(value)) return read_extensions(value, path);
  const bool is_name = name == "name" && document_.is_string(value);
  if (is_name) return add(value, path, hash_json(document_, value), LeafKind::name);
  if (side_.link(value) == nullptr && is_default(type, name, value)) return;
  read_value(value, path, LeafKind::value);
}

void LeafReader::read_extensions(json::NodeId list, const Hash128& path) {
  for (const auto member : document_.members(list)) {
    const std::string_view name = document_.key(member.key_id);
    const Hash128 place = below(path, name);
    if (storage_.contains(name)) {
      read_codec_extras(member.value, place);
      continue;
    }
    const bool known =
        document_.is_object(member.value) && side_.graph().type(member.value) != schema::kNone;
    if (!known) {
      read_plain(member.value, place, LeafKind::foreign);
      continue;
    }
    add(member.value, place, hash_content("present"), LeafKind::present);
    read_object(member.value, place);
  }
}

// Of an extension that only stores data, what an application may have put there.
void LeafReader::read_codec_extras(json::NodeId extension, const Hash128& path) {
  if (!document_.is_object(extension)) return;
  const json::NodeId extras = document_.find(extension, "extras");
  if (extras != json::kNoNode) read_plain(extras, below(path, "extras"), LeafKind::extras);
}

void LeafReader::read_value(json::NodeId value, const Hash128& path, LeafKind kind) {
  if (content_.is_list(value)) return;
  if (document_.kind(value) != json::Kind::number_array && add_link(value, 0, path)) return;
  switch (document_.kind(value)) {
    case json::Kind::object:
      return read_object(value, path);
    case json::Kind::number_array:
      return read_numbers(value, path);
    case json::Kind::array: {
      std::uint64_t position = 0;
      for (const json::NodeId element : document_.elements(value)) {
        read_value(element, below(path, position++), kind);
      }
      return;
    }
    default:
      add(value, path, hash_json(document_, value), kind);
  }
}

void LeafReader::read_numbers(json::NodeId array, const Hash128& path) {
  if (!side_.graph().is_list_of_references(array)) {
    return add(array, path, hash_json(document_, array), LeafKind::value);
  }
  std::uint64_t position = 0;
  for (json::NumberCursor at(document_, array); at.valid(); at.advance(), ++position) {
    if (!add_link(array, position, below(path, position))) {
      add(array, below(path, position), hash_number(at.number().value), LeafKind::value);
    }
  }
}

// Values that no schema describes.
void LeafReader::read_plain(json::NodeId value, const Hash128& path, LeafKind kind) {
  std::uint64_t position = 0;
  if (document_.kind(value) == json::Kind::object) {
    bool empty = true;
    for (const auto member : document_.members(value)) {
      read_plain(member.value, below(path, document_.key(member.key_id)), kind);
      empty = false;
    }
    if (!empty) return;
  } else if (document_.kind(value) == json::Kind::array) {
    for (const json::NodeId element : document_.elements(value)) {
      read_plain(element, below(path, position++), kind);
    }
    if (position > 0) return;
  }
  add(value, path, hash_json(document_, value), kind);
}

bool LeafReader::add_link(json::NodeId at, std::uint64_t element, const Hash128& path) {
  const Link* link = side_.link(at, element);
  if (link == nullptr || link->target == json::kNoNode) return false;
  Leaf leaf{path, {}, at, {}, LeafKind::value};
  if (link->pointer == nullptr) {
    leaf.target = content_.find(link->target);
    if (!leaf.target) {
      const schema::TypeId type = side_.type(link->target);
      bool readable = false;
      if (type == types_.accessor) {
        leaf.value = content_.elements(side_.index(link->target), readable);
      } else if (type == types_.buffer_view) {
        leaf.value = content_.bytes(side_.index(link->target));
      } else {
        leaf.value = hash_of_all('i', std::uint64_t{side_.tree().position(link->target)});
      }
    }
  } else {
    // The first object of a list on the way, and the steps after it.
    const graph::PointerText& pointer = *link->pointer;
    std::size_t after = 0;
    for (std::size_t i = 0; i < pointer.way.size() && !leaf.target; ++i) {
      leaf.target = content_.find(pointer.way[i]);
      if (leaf.target) after = i + 1;
    }
    Hash128 rest;
    for (std::size_t i = after; i < pointer.steps.size(); ++i) rest = below(rest, pointer.steps[i]);
    leaf.value = rest;
  }
  leaves_.push_back(leaf);
  return true;
}

// A bitstream holds triangles, whatever the mode is; two of them have it in common, or not.
void LeafReader::read_coded_mode(json::NodeId primitive, const Hash128& path) {
  const json::NodeId extensions = document_.find(primitive, "extensions");
  if (extensions == json::kNoNode || !document_.is_object(extensions)) return;
  for (const auto member : document_.members(extensions)) {
    if (!storage_.contains(document_.key(member.key_id))) continue;
    const json::NodeId mode = document_.find(primitive, "mode");
    constexpr double kTriangles = 4;
    add(mode == json::kNoNode ? primitive : mode, below(path, "mode"),
        mode == json::kNoNode ? hash_number(kTriangles) : hash_json(document_, mode),
        LeafKind::aside);
    return;
  }
}

// Accessors describe the attributes of a bitstream: those of another format.
void LeafReader::read_contradictions(json::NodeId object, const Hash128& path) {
  const model::Primitive primitive = model::read_primitive(side_.asset(), object);
  const auto draco = model::read_draco(side_.asset(), primitive);
  const codec::DracoMesh* mesh = draco ? side_.source().draco.mesh(draco->buffer_view) : nullptr;
  if (mesh == nullptr) return;
  for (const model::Attribute& attribute : primitive.attributes) {
    const auto id = model::draco_id(side_.asset(), *draco, attribute.name);
    const auto* values = id ? model::find_attribute(*mesh, *id) : nullptr;
    if (values == nullptr || !attribute.accessor) continue;
    const model::Format& said = side_.views().accessors[*attribute.accessor].format;
    const model::Format stored = model::format_of(*values, false);
    if (said.type == stored.type && said.component == stored.component) continue;
    add(attribute.value, below(below(path, "attributes"), attribute.name),
        hash_of_all(static_cast<int>(said.type), static_cast<int>(said.component)),
        LeafKind::value);
  }
}

// Of a transform: what is not that many numbers, and parts beside a matrix.
void LeafReader::read_broken_places(json::NodeId node, const Hash128& path) {
  constexpr std::pair<std::string_view, std::size_t> kTransformParts[] = {
      {"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}};
  const bool has_matrix = document_.find(node, "matrix") != json::kNoNode;
  for (const auto& [name, count] : kTransformParts) {
    const json::NodeId value = document_.find(node, name);
    if (value == json::kNoNode) continue;
    const bool numbers = document_.kind(value) == json::Kind::number_array;
    if (numbers && document_.array_size(value) == count && (name == "matrix" || !has_matrix)) {
      continue;
    }
    add(value, below(path, name), hash_json(document_, value), LeafKind::value);
  }
}

// Of a list of nodes: what leads to none, or again to the same.
void LeafReader::read_broken_indices(json::NodeId object, std::string_view name,
                                     const Hash128& path) {
  const json::NodeId list = document_.find(object, name);
  if (list == json::kNoNode) return;
  if (document_.kind(list) != json::Kind::number_array) {
    const bool empty = document_.is_array(list) && document_.array_size(list) == 0;
    if (!empty) add(list, below(path, name), hash_json(document_, list), LeafKind::value);
    return;
  }
  std::uint64_t position = 0;
  std::uint64_t broken = 0;
  std::unordered_set<json::NodeId> seen;
  for (json::NumberCursor at(document_, list); at.valid(); at.advance(), ++position) {
    const Link* link = side_.link(list, position);
    const bool leads = link != nullptr && link->target != json::kNoNode;
    if (leads && seen.insert(link->target).second) continue;
    add(list, below(below(path, name), broken++),
        leads ? hash_content("repeated") : hash_number(at.number().value), LeafKind::value);
  }
}

// The images that readers of all formats and of no extension show, and the values of the sampler.
void LeafReader::read_texture(json::NodeId texture, const Hash128& path) {
  const auto& images = side_.asset().elements(model::RootArray::images);
  const auto shown = model::read_texture(side_.asset(), texture).images;
  const json::NodeId source = document_.find(texture, "source");
  const auto plain = side_.asset().index(texture, "source", model::RootArray::images);
  if (!shown.empty()) {
    leaves_.push_back({below(path, "source"),
                       {},
                       plain == shown.front() ? source : texture,
                       content_.find(images[shown.front()]),
                       LeafKind::value});
  }
  if (plain) {
    leaves_.push_back({below(path, "plain source"),
                       {},
                       source,
                       content_.find(images[*plain]),
                       *plain == shown.front() ? LeafKind::aside : LeafKind::value});
  } else if (source != json::kNoNode) {
    read_plain(source, below(path, "plain source"), LeafKind::value);
  }
  const auto sampler = side_.asset().index(texture, "sampler", model::RootArray::samplers);
  if (!sampler) {
    const json::NodeId broken = document_.find(texture, "sampler");
    if (broken != json::kNoNode) read_plain(broken, below(path, "sampler"), LeafKind::value);
    return;
  }
  read_object(side_.asset().elements(model::RootArray::samplers)[*sampler], below(path, "sampler"));
}

}  // namespace gltfx::prove
