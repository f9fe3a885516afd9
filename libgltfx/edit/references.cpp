// SPDX-License-Identifier: Apache-2.0
#include "edit/references.hpp"

#include "base/fork.hpp"
#include "schema/check.hpp"

namespace gltfx::edit {
namespace {

std::string first_unknown(const schema::CheckResult& result, const schema::Set& set) {
  for (const std::string& name : result.extensions_seen) {
    if (set.find_extension(name) == schema::kNone) return name;
  }
  return {};
}

}  // namespace

References::References(const json::Document& document, const schema::Set& set) {
  std::string_view array;  // of the reference before
  std::vector<Reference>* list = nullptr;
  const schema::ReferenceVisitor visit = [&](const schema::ReferenceUse& use) {
    if (use.array.empty()) return;
    if (use.array != array) list = &by_array_[std::string(use.array.substr(1))];
    array = use.array;
    list->push_back({use.index, use.span});
  };
  schema::CheckOptions options;
  options.references = &visit;
  options.slots = false;
  schema::NoFindings nobody;
  unknown_ = first_unknown(schema::check(document, set, options, nobody, nobody), set);
}

const std::vector<Reference>& References::to(std::string_view array) const {
  const auto found = by_array_.find(array);
  return found == by_array_.end() ? empty_value<std::vector<Reference>>() : found->second;
}

}  // namespace gltfx::edit
