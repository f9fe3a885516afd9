// SPDX-License-Identifier: Apache-2.0
#include "upgrade/generation.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::upgrade {
namespace {

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

// What speaks for the first generation that fits.
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
  // A name that is another extension's says nothing of this one.
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
