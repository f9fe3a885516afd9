// SPDX-License-Identifier: Apache-2.0
#include "upgrade/carriers.hpp"

#include <algorithm>
#include <utility>

namespace gltfx::upgrade {
namespace {

class Search {
 public:
  Search(const json::Document& document, const schema::Set& set, const schema::Extension& extension)
      : document_(document), set_(set), extension_(extension) {}

  std::vector<Carrier> run() {
    const schema::TypeId root = set_.find_type("glTF");
    if (root == schema::kNone) return {};
    if (is_home(root)) {
      Carrier carrier;
      carrier.type = root;
      add(std::move(carrier), document_.root());
    }
    for (const schema::Property& property : set_.type(root).properties) {
      if (property.shape == schema::kNone) continue;
      const schema::Shape& shape = set_.shape(property.shape);
      Carrier carrier;
      carrier.array = property.name;
      const json::NodeId value = document_.find(document_.root(), property.name);
      if (value == json::kNoNode) continue;
      if (is_home(shape.type)) {
        carrier.single = true;
        carrier.type = shape.type;
        add(std::move(carrier), value);
      } else if (shape.items != schema::kNone && is_home(set_.shape(shape.items).type)) {
        carrier.type = set_.shape(shape.items).type;
        add_elements(std::move(carrier), value);
      }
    }
    return std::move(carriers_);
  }

 private:
  bool is_home(schema::TypeId type) const {
    return type != schema::kNone &&
           std::any_of(extension_.attachment_points.begin(), extension_.attachment_points.end(),
                       [type](const auto& home) { return home.first == type; });
  }

  void add_elements(Carrier carrier, json::NodeId list) {
    if (document_.kind(list) != json::Kind::array) return;
    for (const json::NodeId element : document_.elements(list)) {
      add(carrier, element);
      ++carrier.index;
    }
  }

  void add(Carrier carrier, json::NodeId host) {
    carrier.host = host;
    carrier.extensions = document_.find(host, "extensions");
    carrier.object = document_.find(carrier.extensions, extension_.name);
    if (carrier.object != json::kNoNode) carriers_.push_back(std::move(carrier));
  }

  const json::Document& document_;
  const schema::Set& set_;
  const schema::Extension& extension_;
  std::vector<Carrier> carriers_;
};

}  // namespace

std::vector<Carrier> carriers_of(const json::Document& document, const schema::Set& set,
                                 const schema::Extension& extension) {
  return Search(document, set, extension).run();
}

}  // namespace gltfx::upgrade
