// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/generation.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::upgrade {
namespace {

class Search {
 public:
  Search(const json::Document& document, const schema::Set& set, const schema::Extension& extension)
      : document_(document), set_(set), extension_(extension) {}

  std::vector<Host> run() {
    const schema::TypeId root = set_.find_type("glTF");
    if (root == schema::kNone) return {};
    if (is_home(root)) {
      Host host;
      host.type = root;
      add(std::move(host), document_.root());
    }
    for (const schema::Property& property : set_.type(root).properties) {
      if (property.shape == schema::kNone) continue;
      const schema::Shape& shape = set_.shape(property.shape);
      Host host;
      host.array = property.name;
      const json::NodeId value = document_.find(document_.root(), property.name);
      if (value == json::kNoNode) continue;
      if (is_home(shape.type)) {
        host.single = true;
        host.type = shape.type;
        add(std::move(host), value);
      } else if (shape.items != schema::kNone && is_home(set_.shape(shape.items).type)) {
        host.type = set_.shape(shape.items).type;
        add_elements(std::move(host), value);
      }
    }
    return std::move(hosts_);
  }

 private:
  bool is_home(schema::TypeId type) const {
    return type != schema::kNone &&
           std::any_of(extension_.attachment_points.begin(), extension_.attachment_points.end(),
                       [type](const auto& home) { return home.first == type; });
  }

  void add_elements(Host host, json::NodeId list) {
    if (document_.kind(list) != json::Kind::array) return;
    for (const json::NodeId element : document_.elements(list)) {
      add(host, element);
      ++host.index;
    }
  }

  void add(Host host, json::NodeId node) {
    host.node = node;
    host.extensions = document_.find(node, "extensions");
    host.object = document_.find(host.extensions, extension_.name);
    if (host.object != json::kNoNode) hosts_.push_back(std::move(host));
  }

  const json::Document& document_;
  const schema::Set& set_;
  const schema::Extension& extension_;
  std::vector<Host> hosts_;
};

using Names = std::vector<std::string>;

// The first of the names that the object has, or empty.
std::string present(const json::Document& document, json::NodeId object, const Names& names) {
  const auto has = [&](const std::string& name) {
    return document.find(object, name) != json::kNoNode;
  };
  const auto found = std::find_if(names.begin(), names.end(), has);
  return found == names.end() ? std::string() : *found;
}

bool fits(const json::Document& document, json::NodeId object,
          const schema::Generation& generation) {
  const bool with = generation.with.empty() || !present(document, object, generation.with).empty();
  return with && present(document, object, generation.without).empty();
}

// The reason for the first generation that fits.
std::string reason(const json::Document& document, const schema::Extension& extension,
                   json::NodeId object, const schema::Generation& chosen) {
  for (const schema::Generation& other : extension.generations) {
    const std::string name = present(document, object, other.without);
    if (!name.empty()) return "it has " + name;
  }
  if (!chosen.with.empty()) return "it has " + present(document, object, chosen.with);
  Names others;
  for (const schema::Generation& other : extension.generations) {
    if (&other != &chosen && fits(document, object, other)) others.push_back(other.name);
  }
  std::string text = fmt::format("it has no {}", join_or(chosen.without));
  if (!others.empty()) text += fmt::format("; it may also be {}", join_or(others));
  return text;
}

Decision decide_by_name(const json::Document& document, const schema::Extension& extension,
                        json::NodeId object, std::string_view wanted) {
  for (const schema::Generation& generation : extension.generations) {
    if (!is_called(generation, wanted)) continue;
    if (fits(document, object, generation)) {
      return {&generation, fmt::format("--generation {}", wanted), {}};
    }
    const std::string other = present(document, object, generation.without);
    return {nullptr,
            {},
            fmt::format("it does not match {}: {}", generation.name,
                        other.empty() ? "a required member is missing" : "it has " + other)};
  }
  return {};
}

}  // namespace

std::vector<Host> hosts_of(const json::Document& document, const schema::Set& set,
                           const schema::Extension& extension) {
  return Search(document, set, extension).run();
}

bool is_called(const schema::Generation& generation, std::string_view word) {
  std::string_view rest = generation.name;
  while (true) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    if (rest.substr(0, end) == word) return true;
    if (end == rest.size()) return false;
    rest.remove_prefix(end + 1);
  }
}

Decision decide_generation(const json::Document& document, const schema::Extension& extension,
                           json::NodeId object, std::string_view wanted) {
  if (extension.generations.empty()) return {};
  // If a name belongs to another extension, it does not apply to this one.
  const bool named = std::any_of(extension.generations.begin(), extension.generations.end(),
                                 [&](const auto& one) { return is_called(one, wanted); });
  if (named) return decide_by_name(document, extension, object, wanted);
  for (const schema::Generation& generation : extension.generations) {
    if (fits(document, object, generation)) {
      return {&generation, reason(document, extension, object, generation), {}};
    }
  }
  return {nullptr, {}, "it does not match any known draft"};
}

}  // namespace gltfx::upgrade
