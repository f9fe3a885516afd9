// SPDX-License-Identifier: Apache-2.0
// extensionsUsed and extensionsRequired.
#include <cstddef>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "schema/extension_names.hpp"
#include "schema/form_check.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {

void Walker::read_declarations() {
  const auto read = [&](std::string_view member, json::KeyTable& names,
                        std::vector<std::string>& list) {
    const json::NodeId node = document_.find(document_.root(), member);
    if (node == json::kNoNode) return;
    const auto elements = document_.elements(node);
    bool only_strings = true;
    for (const json::NodeId element : elements) only_strings &= document_.is_string(element);
    if (deviations().broken_values_are_absent && !only_strings) return;
    for (const json::NodeId element : elements) {
      if (document_.is_string(element) && document_.insert_string(element, names))
        list.push_back(document_.string(element));
    }
  };
  read("extensionsUsed", used_, result_.extensions_used);
  read("extensionsRequired", required_, result_.extensions_required);
  // Names are compared with all known ones: that many of them are.
  constexpr std::size_t kMostCompared = 50;
  const std::vector<std::string>& names = result_.extensions_used;
  for (std::size_t i = 0; i < names.size() && adding_extension_.empty(); ++i) {
    const bool adds =
        i < kMostCompared ? may_add_values(set_, names[i]) : set_.find_extension(names[i]) == kNone;
    if (adds) adding_extension_ = names[i];
  }
}

bool Walker::is_declared(json::KeyId key) {
  if (declared_[key] == Declared::unseen) {
    declared_[key] = is_declared(document_.key(key)) ? Declared::yes : Declared::no;
  }
  return declared_[key] == Declared::yes;
}

void Walker::declarations() {
  const auto each = [&](std::string_view member, const auto& look_at) {
    const json::NodeId node = document_.find(document_.root(), member);
    if (node == json::kNoNode) return;
    const Path root;
    const Path list(root, member);
    std::uint64_t index = 0;
    for (const json::NodeId element : document_.elements(node)) {
      const Path path(list, index++);
      if (document_.is_string(element))
        look_at(path, document_.string(element), document_.span(element));
    }
  };
  each("extensionsUsed", [&](const Path& path, const std::string& name, Span span) {
    // Otherwise rules behind the walk say so: they know what names are in use, and what is used.
    const bool alone = deviations().extension_names_are_judged_alone;
    if (alone && !is_extension_name(name)) {
      report(path, Code::INVALID_EXTENSION_NAME_FORMAT, span,
             quoted(name) + " is not a valid extension name; it must have the form PREFIX_name.");
    }
    const ExtensionId id = set_.find_extension(name);
    if (alone && !looks_into(id, name)) {
      report(path, Code::UNSUPPORTED_EXTENSION, span,
             quoted(name) + " is unknown; its content is not checked.");
    }
    if (!looks_into(id, name) || is_required(name)) return;
    if (set_.extensions()[id].must_be_required != MustBeRequired::always) return;
    report(path, Code::NON_REQUIRED_EXTENSION, span,
           quoted(name) + " must be in 'extensionsRequired': loaders without it misread the asset.",
           "add \"" + name + "\" to \"extensionsRequired\"");
  });
  each("extensionsRequired", [&](const Path& path, const std::string& name, Span span) {
    if (is_declared(name)) return;
    report(path, Code::UNUSED_EXTENSION_REQUIRED, span,
           quoted(name) + " is required, but not in 'extensionsUsed'.",
           "add \"" + printable(name) + "\" to \"extensionsUsed\"");
  });
}

}  // namespace gltfx::schema
