// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "container/uri.hpp"
#include "interop/model_fields.hpp"
#include "interop/model_text.hpp"
#include "interop/values.hpp"
#include "model/fields.hpp"

namespace gltfx::interop {
namespace {

using json::NodeId;

/// Reads one object. Members that were not read before finish() have no field in tinygltf.
class ModelReader {
 public:
  template <class T>
  using Field = T;

  ModelReader(const json::Document& document, NodeId object, const Path& path, Notes& notes)
      : document_(document), object_(object), path_(path), notes_(notes) {}

  void text(std::string_view name, std::string& to, std::string_view absent = {}) {
    const NodeId value = take_if(name, [&](NodeId id) { return document_.is_string(id); });
    to = value == json::kNoNode ? std::string(absent) : document_.string(value);
  }
  void required_text(std::string_view name, std::string& to) { text(name, to); }

  void index(std::string_view name, int& to) { integer(name, to, -1); }
  void integer(std::string_view name, int& to, int absent) {
    to = absent;
    if (const auto value = unsigned_number(name)) to = as_int(*value, Path(path_, name));
  }
  void size(std::string_view name, std::size_t& to) {
    if (const auto value = unsigned_number(name)) to = static_cast<std::size_t>(*value);
  }
  void mode(std::string_view name, int& to) { integer(name, to, kTriangles); }

  void number(std::string_view name, double& to, double absent) {
    const NodeId value = take_if(name, [&](NodeId id) { return document_.is_number(id); });
    to = value == json::kNoNode ? absent : document_.number(value).value;
  }
  void required_number(std::string_view name, double& to) { number(name, to, 0); }

  void flag(std::string_view name, bool& to) {
    const NodeId value = take_if(name, [&](NodeId id) { return document_.is_boolean(id); });
    to = value != json::kNoNode && document_.kind(value) == json::Kind::true_value;
  }

  void numbers(std::string_view name, std::vector<double>& to, std::vector<double> absent = {}) {
    const NodeId array = take_if(name, [&](NodeId id) { return is_number_array(id); });
    if (array == json::kNoNode) {
      to = std::move(absent);
      return;
    }
    to.clear();
    for (json::NumberCursor at(document_, array); at.valid(); at.advance()) {
      to.push_back(at.number().value);
    }
  }

  void indices(std::string_view name, std::vector<int>& to) {
    const NodeId array = take_if(name, [&](NodeId id) { return is_number_array(id); });
    if (array == json::kNoNode) return;
    const Path path(path_, name);
    for (json::NumberCursor at(document_, array); at.valid(); at.advance()) {
      to.push_back(as_int(at.number().value, Path(path, to.size())));
    }
  }

  void attributes(std::string_view name, std::map<std::string, int>& to) {
    const NodeId object = take_if(name, [&](NodeId id) { return document_.is_object(id); });
    if (object != json::kNoNode) read_attributes(object, Path(path_, name), to);
  }

  void targets(std::string_view name, std::vector<std::map<std::string, int>>& to) {
    const Path list(path_, name);
    for (const NodeId element : elements(name)) {
      const Path path(list, to.size());
      read_attributes(element, path, to.emplace_back());
    }
  }

  void element_type(std::string_view name, int& to) {
    std::string type;
    text(name, type);
    for (const auto& [known, number] : kElementTypes) {
      if (known == type) to = number;
    }
  }

  /// Reads members that tinygltf stores in the enclosing object.
  template <class Read>
  void part(std::string_view name, const Read& read) {
    const NodeId object = take_if(name, [&](NodeId id) { return document_.is_object(id); });
    if (object == json::kNoNode) return;
    const Path path(path_, name);
    ModelReader inner(document_, object, path, notes_);
    read(inner);
    inner.finish();
  }
  template <class Read>
  void section(std::string_view name, bool& present, const Read& read) {
    present = document_.find(object_, name) != json::kNoNode;
    part(name, read);
  }

  template <class T>
  void object(std::string_view name, T& to, bool) {
    part(name, [&](ModelReader& inner) { describe(inner, to); });
  }
  template <class T>
  void optional_object(std::string_view name, T& to) {
    object(name, to, true);
  }
  template <class T>
  void objects(std::string_view name, std::vector<T>& to) {
    const Path list(path_, name);
    for (const NodeId element : elements(name)) {
      const Path path(list, to.size());
      ModelReader inner(document_, element, path, notes_);
      describe(inner, to.emplace_back());
      inner.finish();
    }
  }

  void extensions(tinygltf::ExtensionMap& to) {
    const NodeId object = take_if("extensions", [&](NodeId id) { return document_.is_object(id); });
    if (object == json::kNoNode) return;
    const Path list(path_, "extensions");
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      const Path path(list, name);
      to.insert_or_assign(std::string(name), read_value(document_, member.value, path, notes_));
    }
  }
  void extras(tinygltf::Value& to) {
    const auto has_value = [&](NodeId id) { return document_.kind(id) != json::Kind::null; };
    const NodeId value = take_if("extras", has_value);
    if (value != json::kNoNode) to = read_value(document_, value, Path(path_, "extras"), notes_);
  }

  void extension_names(tinygltf::Model& model) {
    texts("extensionsUsed", model.extensionsUsed);
    texts("extensionsRequired", model.extensionsRequired);
  }
  void root_extensions(tinygltf::Model& model) {
    extensions(model.extensions);
    const NodeId object = model::extension_object(document_, object_, kLightsExtension);
    if (object == json::kNoNode) return;
    const Path all(path_, "extensions");
    const Path lights(all, kLightsExtension);
    // Its other members stay in the map of extensions.
    ModelReader(document_, object, lights, notes_).objects("lights", model.lights);
  }

  void storage(tinygltf::Buffer& buffer) {
    take("byteLength");
    text("uri", buffer.uri);
    if (is_data(buffer.uri)) buffer.uri.clear();
  }
  void storage(tinygltf::Image& image) {
    text("mimeType", image.mimeType);
    text("uri", image.uri);
    if (!is_data(image.uri)) return;
    const auto data = container::split_data_uri(image.uri);
    if (image.mimeType.empty() && data) image.mimeType = data->media_type;
    image.uri.clear();
  }

  /// Fills the older fields: properties by name, with one field per type.
  void parameters(tinygltf::Material& material) {
    const NodeId pbr = document_.find(object_, "pbrMetallicRoughness");
    if (pbr != json::kNoNode && document_.is_object(pbr)) add_parameters(pbr, material.values);
    add_parameters(object_, material.additionalValues);
  }

  void finish() {
    for (const auto member : document_.members(object_)) {
      if (std::find(taken_.begin(), taken_.end(), member.value) != taken_.end()) continue;
      notes_.lost(Path(path_, document_.key(member.key_id)), "has no place in tinygltf");
    }
  }

 private:
  NodeId take(std::string_view name) {
    return take_if(name, [](NodeId) { return true; });
  }
  template <class Fits>
  NodeId take_if(std::string_view name, const Fits& fits) {
    const NodeId value = document_.find(object_, name);
    if (value == json::kNoNode || !fits(value)) return json::kNoNode;
    taken_.push_back(value);
    return value;
  }

  bool is_number_array(NodeId id) const { return document_.kind(id) == json::Kind::number_array; }
  static bool is_data(std::string_view uri) {
    return container::classify_uri(uri).kind == container::UriKind::data;
  }

  std::optional<double> unsigned_number(std::string_view name) {
    const auto fits = [&](NodeId id) {
      return document_.is_number(id) && document_.unsigned_integer(id).has_value();
    };
    const NodeId value = take_if(name, fits);
    if (value == json::kNoNode) return std::nullopt;
    return document_.number(value).value;
  }
  int as_int(double value, const Path& path) {
    if (value >= 0 && value <= std::numeric_limits<int>::max()) return static_cast<int>(value);
    notes_.fail(fmt::format("{} is beyond the numbers that tinygltf holds", path.pointer()));
    return -1;
  }

  // The elements of an array of objects; none when there is no such array.
  std::vector<NodeId> elements(std::string_view name) {
    std::vector<NodeId> found;
    const auto fits = [&](NodeId id) { return document_.kind(id) == json::Kind::array; };
    const NodeId array = take_if(name, fits);
    if (array == json::kNoNode) return found;
    for (const NodeId element : document_.elements(array)) {
      if (document_.is_object(element)) found.push_back(element);
    }
    return found;
  }

  void texts(std::string_view name, std::vector<std::string>& to) {
    const auto fits = [&](NodeId id) { return document_.kind(id) == json::Kind::array; };
    const NodeId array = take_if(name, fits);
    if (array == json::kNoNode) return;
    for (const NodeId element : document_.elements(array)) {
      if (document_.is_string(element)) to.push_back(document_.string(element));
    }
  }

  void read_attributes(NodeId object, const Path& path, std::map<std::string, int>& to) {
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (!document_.is_number(member.value)) continue;
      const double value = document_.number(member.value).value;
      to.insert_or_assign(std::string(name), as_int(value, Path(path, name)));
    }
  }

  void add_parameters(NodeId object, tinygltf::ParameterMap& to) {
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (name == "name" || name == "extensions" || name == "extras") continue;
      if (object == object_ && name == "pbrMetallicRoughness") continue;
      to.insert_or_assign(std::string(name), parameter(member.value));
    }
  }

  tinygltf::Parameter parameter(NodeId value) {
    tinygltf::Parameter to;
    if (document_.is_string(value)) to.string_value = document_.string(value);
    if (document_.is_number(value)) to.number_value = document_.number(value).value;
    to.has_number_value = document_.is_number(value);
    to.bool_value = document_.kind(value) == json::Kind::true_value;
    if (is_number_array(value)) {
      for (json::NumberCursor at(document_, value); at.valid(); at.advance()) {
        to.number_array.push_back(at.number().value);
      }
    }
    if (!document_.is_object(value)) return to;
    for (const auto member : document_.members(value)) {
      if (!document_.is_number(member.value)) continue;
      to.json_double_value.insert_or_assign(std::string(document_.key(member.key_id)),
                                            document_.number(member.value).value);
    }
    return to;
  }

  const json::Document& document_;
  NodeId object_;
  const Path& path_;
  Notes& notes_;
  std::vector<NodeId> taken_;
};

}  // namespace

void read_model(const json::Document& document, tinygltf::Model& model, Notes& notes) {
  const Path root;
  ModelReader reader(document, document.root(), root, notes);
  describe(reader, model);
  reader.finish();
}

}  // namespace gltfx::interop
