// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <tiny_gltf.h>

#include "interop/model_fields.hpp"
#include "interop/model_text.hpp"
#include "interop/values.hpp"
#include "json/writer.hpp"

namespace gltfx::interop {
namespace {

struct StorageTables {
  const std::vector<Storage>& buffers;
  const std::vector<Storage>& images;
};

/// Writes the members of one object, those that are not the default.
class ModelWriter {
 public:
  template <class T>
  using Field = const T;

  ModelWriter(json::Writer& writer, const StorageTables& tables, const Path& path, Notes& notes)
      : writer_(writer), tables_(tables), path_(path), notes_(notes) {}

  void text(std::string_view name, const std::string& value, std::string_view absent = {}) {
    if (!value.empty() && value != absent) writer_.member(name, value);
  }
  void required_text(std::string_view name, const std::string& value) {
    writer_.member(name, value);
  }

  void index(std::string_view name, int value) {
    if (value >= 0) integer(name, value, -1);
  }
  void integer(std::string_view name, int value, int absent) {
    if (value == absent) return;
    writer_.key(name);
    writer_.integer(value);
  }
  void size(std::string_view name, std::size_t value) {
    if (value != 0) writer_.member(name, std::uint64_t{value});
  }
  void mode(std::string_view name, int value) {
    if (value >= 0) integer(name, value, kTriangles);
  }

  void number(std::string_view name, double value, double absent) {
    if (value != absent) required_number(name, value);
  }
  void required_number(std::string_view name, double value) {
    writer_.key(name);
    writer_.number(value);
  }

  void flag(std::string_view name, bool value) {
    if (value) writer_.member(name, true);
  }

  void numbers(std::string_view name, const std::vector<double>& values,
               const std::vector<double>& absent = {}) {
    if (values.empty() || values == absent) return;
    writer_.key(name);
    writer_.begin_array();
    for (const double value : values) writer_.number(value);
    writer_.end_array();
  }

  void indices(std::string_view name, const std::vector<int>& values) {
    if (values.empty()) return;
    writer_.key(name);
    writer_.begin_array();
    for (const int value : values) writer_.integer(value);
    writer_.end_array();
  }

  void attributes(std::string_view name, const std::map<std::string, int>& values) {
    writer_.key(name);
    write_attributes(values);
  }

  void targets(std::string_view name, const std::vector<std::map<std::string, int>>& values) {
    if (values.empty()) return;
    writer_.key(name);
    writer_.begin_array();
    for (const auto& each : values) write_attributes(each);
    writer_.end_array();
  }

  void element_type(std::string_view name, int value) {
    for (const auto& [known, number] : kElementTypes) {
      if (number == value) writer_.member(name, known);
    }
  }

  template <class Write>
  void part(std::string_view name, const Write& write) {
    writer_.key(name);
    const Path path(path_, name);
    nest(path, writer_, write);
  }
  template <class Write>
  void section(std::string_view name, bool present, const Write& write) {
    if (present) part(name, write);
  }
  template <class T>
  void object(std::string_view name, const T& value, bool present) {
    section(name, present, [&](ModelWriter& inner) { describe(inner, value); });
  }
  /// Left out when it has only defaults.
  template <class T>
  void optional_object(std::string_view name, const T& value) {
    std::string json;
    json::Writer own(json);
    const Path path(path_, name);
    nest(path, own, [&](ModelWriter& inner) { describe(inner, value); });
    if (json == "{}") return;
    writer_.key(name);
    writer_.raw(json);
  }
  template <class T>
  void objects(std::string_view name, const std::vector<T>& values) {
    if (values.empty()) return;
    writer_.key(name);
    writer_.begin_array();
    const Path list(path_, name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Path path(list, i);
      nest(path, writer_, [&](ModelWriter& inner) { describe(inner, values[i]); });
    }
    writer_.end_array();
  }

  void extensions(const tinygltf::ExtensionMap& values) {
    if (values.empty()) return;
    writer_.key("extensions");
    writer_.begin_object();
    const Path list(path_, "extensions");
    for (const auto& [name, value] : values) {
      writer_.key(name);
      write_value(writer_, value, Path(list, name), notes_);
    }
    writer_.end_object();
  }
  void extras(const tinygltf::Value& value) {
    if (value.Type() == tinygltf::NULL_TYPE) return;
    writer_.key("extras");
    write_value(writer_, value, Path(path_, "extras"), notes_);
  }

  void extension_names(const tinygltf::Model& model) {
    std::vector<std::string> used = model.extensionsUsed;
    const bool named = std::find(used.begin(), used.end(), kLightsExtension) != used.end();
    if (!model.lights.empty() && !named) used.emplace_back(kLightsExtension);
    texts("extensionsUsed", used);
    texts("extensionsRequired", model.extensionsRequired);
  }
  void root_extensions(const tinygltf::Model& model) {
    if (model.lights.empty()) {
      extensions(model.extensions);
      return;
    }
    writer_.key("extensions");
    writer_.begin_object();
    const Path list(path_, "extensions");
    for (const auto& [name, value] : model.extensions) {
      if (name == kLightsExtension) continue;
      writer_.key(name);
      write_value(writer_, value, Path(list, name), notes_);
    }
    writer_.key(kLightsExtension);
    write_lights(model, Path(list, kLightsExtension));
    writer_.end_object();
  }

  void storage(const tinygltf::Buffer& buffer) {
    writer_.member("byteLength", std::uint64_t{buffer.data.size()});
    text("uri", tables_.buffers[path_.index()].uri);
  }
  void storage(const tinygltf::Image&) {
    const Storage& storage = tables_.images[path_.index()];
    text("mimeType", storage.media_type);
    text("uri", storage.uri);
  }

  void parameters(const tinygltf::Material&) {}

 private:
  template <class Write>
  void nest(const Path& path, json::Writer& writer, const Write& write) {
    writer.begin_object();
    ModelWriter inner(writer, tables_, path, notes_);
    write(inner);
    writer.end_object();
  }

  void texts(std::string_view name, const std::vector<std::string>& values) {
    if (values.empty()) return;
    writer_.key(name);
    writer_.begin_array();
    for (const std::string& value : values) writer_.string(value);
    writer_.end_array();
  }

  void write_attributes(const std::map<std::string, int>& values) {
    writer_.begin_object();
    for (const auto& [name, value] : values) {
      writer_.key(name);
      writer_.integer(value);
    }
    writer_.end_object();
  }

  // The other members of the extension are among the extensions.
  void write_lights(const tinygltf::Model& model, const Path& path) {
    writer_.begin_object();
    const auto known = model.extensions.find(std::string(kLightsExtension));
    if (known != model.extensions.end() && known->second.IsObject()) {
      for (const auto& [name, value] : known->second.Get<tinygltf::Value::Object>()) {
        if (name == "lights") continue;
        writer_.key(name);
        write_value(writer_, value, Path(path, name), notes_);
      }
    }
    ModelWriter(writer_, tables_, path, notes_).objects("lights", model.lights);
    writer_.end_object();
  }

  json::Writer& writer_;
  const StorageTables& tables_;
  const Path& path_;
  Notes& notes_;
};

}  // namespace

std::string write_model(const tinygltf::Model& model, const std::vector<Storage>& buffers,
                        const std::vector<Storage>& images, Notes& notes) {
  std::string json;
  json::Writer writer(json);
  const Path root;
  const StorageTables tables{buffers, images};
  writer.begin_object();
  ModelWriter all(writer, tables, root, notes);
  describe(all, model);
  writer.end_object();
  return json;
}

}  // namespace gltfx::interop
