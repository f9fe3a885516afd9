// SPDX-License-Identifier: Apache-2.0
#include "steps/flat_root.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "steps/json_edits.hpp"

namespace gltfx::steps {
namespace {

// The value of a list's key, or json::kNoNode.
json::NodeId find_key(const json::Document& document, std::string_view key) {
  json::NodeId at = document.root();
  const auto steps = split_pointer(key);
  if (!steps) return json::kNoNode;
  for (const std::string& step : *steps) at = document.find(at, step);
  return at;
}

std::string copyright_of(const json::Document& document) {
  return model::string_member(document, document.find(document.root(), "asset"), "copyright");
}

void add_names(const json::Document& other, std::string_view member, change::NameList& names) {
  const json::NodeId list = other.find(other.root(), member);
  if (list == json::kNoNode || other.kind(list) != json::Kind::array) return;
  for (const json::NodeId name : other.elements(list)) {
    if (other.is_string(name)) names.add(other.string(name));
  }
}

bool is_inside(const json::Document& document, json::NodeId value, json::NodeId whole) {
  return whole != json::kNoNode && value > whole && value < document.next(whole);
}

}  // namespace

FlatRoot::FlatRoot(const graph::Graph& graph)
    : graph_(graph),
      document_(graph.tree().document()),
      editor_(document_),
      used_(document_, "extensionsUsed"),
      required_(document_, "extensionsRequired"),
      copyright_(copyright_of(document_)) {}

void FlatRoot::add_list(const json::Document& other, const std::string& key) {
  const json::NodeId list = find_key(other, key);
  if (list == json::kNoNode || other.kind(list) != json::Kind::array) return;
  for (const json::NodeId element : other.elements(list)) {
    lists_[key].emplace_back(other.raw(element));
  }
}

std::optional<Error> FlatRoot::add_asset(const json::Document& other) {
  add_names(other, "extensionsUsed", used_);
  add_names(other, "extensionsRequired", required_);
  const std::string copyright = copyright_of(other);
  if (!copyright.empty() && copyright_.find(copyright) == std::string::npos) {
    copyright_ += (copyright_.empty() ? "" : "; ") + copyright;
  }
  const json::NodeId extensions = model::object_member(other, other.root(), "extensions");
  if (extensions == json::kNoNode) return std::nullopt;
  for (const auto extension : other.members(extensions)) {
    if (!other.is_object(extension.value)) continue;
    const std::string name(other.key(extension.key_id));
    extensions_.try_emplace(name);
    for (const auto member : other.members(extension.value)) {
      if (other.kind(member.value) == json::Kind::array) continue;
      if (auto trouble = add_member(name, other.key(member.key_id), other.raw(member.value)))
        return trouble;
    }
  }
  return std::nullopt;
}

std::optional<Error> FlatRoot::add_member(const std::string& extension, std::string_view name,
                                          std::string_view json) {
  const auto check = [&](std::string_view present) -> std::optional<Error> {
    if (present == json) return std::nullopt;
    return Error{fmt::format("the assets have different values of {} in {}", printable(name),
                             printable(extension))};
  };
  const json::NodeId extensions = document_.find(document_.root(), "extensions");
  const json::NodeId present = document_.find(document_.find(extensions, extension), name);
  if (present != json::kNoNode) return check(document_.raw(present));
  Members& members = extensions_[extension];
  const auto known = std::find_if(members.begin(), members.end(),
                                  [&](const auto& member) { return member.first == name; });
  if (known != members.end()) return check(known->second);
  members.emplace_back(name, json);
  return std::nullopt;
}

std::optional<Error> FlatRoot::finish(const model::AssetInTree& own, ConvertStep& row) {
  if (!used_.can_change() || !required_.can_change()) {
    return Error{"extensionsUsed or extensionsRequired is not a list of names"};
  }
  if (auto trouble = put_lists()) return trouble;
  put_extensions();
  put_copyright();
  drop_files(own, row);
  used_.apply(editor_);
  required_.apply(editor_);
  return std::nullopt;
}

std::optional<Error> FlatRoot::put_lists() {
  for (const auto& [key, elements] : lists_) {
    const auto steps = split_pointer(key);
    const json::NodeId list = find_key(document_, key);
    if (list != json::kNoNode) {
      if (document_.kind(list) != json::Kind::array) {
        return Error{fmt::format("{} is not a list of objects", printable(key))};
      }
      for (const std::string& element : elements) editor_.append_element(list, element);
      continue;
    }
    std::string text = fmt::format("[{}]", fmt::join(elements, ","));
    if (steps->size() == 1) {
      editor_.append_member(document_.root(), steps->front(), text);
    } else {
      extensions_[(*steps)[1]].emplace_back(steps->back(), std::move(text));
    }
  }
  return std::nullopt;
}

void FlatRoot::put_extensions() {
  const json::NodeId extensions = document_.find(document_.root(), "extensions");
  std::vector<std::string> added;
  for (const auto& [name, members] : extensions_) {
    const json::NodeId object = document_.find(extensions, name);
    std::vector<std::string> texts;
    for (const auto& [member, json] : members) {
      if (object != json::kNoNode) editor_.append_member(object, member, json);
      texts.push_back(fmt::format("{}:{}", json::string_value(member), json));
    }
    if (object != json::kNoNode) continue;
    const std::string text = fmt::format("{{{}}}", fmt::join(texts, ","));
    if (extensions != json::kNoNode) editor_.append_member(extensions, name, text);
    added.push_back(fmt::format("{}:{}", json::string_value(name), text));
  }
  if (extensions != json::kNoNode || added.empty()) return;
  editor_.append_member(document_.root(), "extensions",
                        fmt::format("{{{}}}", fmt::join(added, ",")));
}

void FlatRoot::put_copyright() {
  const json::NodeId asset = model::object_member(document_, document_.root(), "asset");
  if (asset == json::kNoNode || copyright_ == copyright_of(document_)) return;
  const json::NodeId present = document_.find(asset, "copyright");
  const std::string text = json::string_value(copyright_);
  if (present == json::kNoNode) {
    editor_.append_member(asset, "copyright", text);
  } else {
    editor_.replace(asset, present, text);
  }
}

bool FlatRoot::is_used_elsewhere(json::NodeId file) const {
  const json::NodeId files = document_.find(document_.root(), "files");
  const json::NodeId assets = document_.find(document_.root(), "externalAssets");
  for (const graph::Use& use : graph_.users(file)) {
    if (!is_inside(document_, use.at.node, files) && !is_inside(document_, use.at.node, assets))
      return true;
  }
  return false;
}

// Files of external assets go with these, if no other file is in the list.
void FlatRoot::drop_files(const model::AssetInTree& own, ConvertStep& row) {
  std::set<std::uint64_t> gone;
  std::vector<std::uint64_t> open;
  for (std::uint32_t i = 0; i < own.external_assets().size(); ++i) {
    if (const auto file = own.file_of(i)) open.push_back(*file);
  }
  while (!open.empty()) {
    const std::uint64_t file = open.back();
    open.pop_back();
    if (file >= own.files().size() || !gone.insert(file).second) continue;
    const json::NodeId aliases = document_.find(own.files()[file], "aliases");
    if (aliases == json::kNoNode || document_.kind(aliases) != json::Kind::array) continue;
    for (const json::NodeId alias : document_.elements(aliases)) {
      if (const auto target = model::unsigned_member(document_, alias, "file"))
        open.push_back(*target);
    }
  }
  const json::NodeId root = document_.root();
  remove_member(document_, editor_, root, "externalAssets");
  const bool all = gone.size() == own.files().size() &&
                   std::none_of(own.files().begin(), own.files().end(),
                                [this](json::NodeId file) { return is_used_elsewhere(file); });
  if (all) {
    remove_member(document_, editor_, root, "files");
  } else {
    row.left.push_back({"/files", "it also has files that are no external assets"});
  }
}

}  // namespace gltfx::steps
