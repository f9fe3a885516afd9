// SPDX-License-Identifier: Apache-2.0
#include "schema/compile.hpp"

#include "base/hash.hpp"
#include "base/text.hpp"
#include "schema/build.hpp"
#include "schema/vocabulary_check.hpp"

namespace gltfx::schema {

ShapeId Build::shape_of(Site at) const {
  for (int steps = 0; at.exists() && steps <= kLongestChain; ++steps) {
    const auto known = shape_at.find(key(at));
    if (known != shape_at.end()) return known->second;
    const Site reference = member(at, "$ref");
    if (!reference.exists()) break;
    at = const_cast<Build*>(this)->resolve(reference);
  }
  return kNone;
}

bool Build::may_copy(std::uint64_t bytes, Site at) {
  constexpr std::uint64_t kMost = std::uint64_t{64} << 20U;
  copied_ += bytes;
  if (copied_ <= kMost) return true;
  errors.add(at, "the repeated schemas are too large in total");
  return false;
}

template <class Map>
Site Build::unresolved(Site reference, std::string message, std::string_view word,
                       const Map& known) {
  if (errors.is_full()) return {};
  std::vector<std::string_view> names;
  for (const auto& entry : known) names.push_back(entry.first);
  errors.add(reference, std::move(message) + did_you_mean(word, names));
  return {};
}

Site Build::resolve(Site reference) {
  const std::string text = this->text(reference);
  const std::size_t hash = std::min(text.find('#'), text.size());
  SourceId source = reference.source;
  if (hash != 0) {
    const auto file = by_id.find(std::string_view(text).substr(0, hash));
    if (file == by_id.end()) {
      return unresolved(reference, "unknown schema " + quoted(text.substr(0, hash)), text, by_id);
    }
    source = file->second;
  }
  const Site root{source, sources[source].document.root()};
  if (hash == text.size()) return root;
  constexpr std::size_t kPrefix = std::string_view("#/$defs/").size();
  const std::string name = text.substr(hash + kPrefix);
  const auto found = defs[source].find(name);
  if (found != defs[source].end()) return {source, found->second};
  return unresolved(reference, quoted(name) + " is not among $defs", name, defs[source]);
}

namespace {

std::unordered_map<std::string_view, json::NodeId> definitions(const Source& source) {
  std::unordered_map<std::string_view, json::NodeId> nodes;
  const json::Document& document = source.document;
  const json::NodeId defs = document.find(document.root(), "$defs");
  if (defs == json::kNoNode) return nodes;
  for (const auto& member : document.members(defs)) {
    nodes.emplace(document.key(member.key_id), member.value);
  }
  return nodes;
}

}  // namespace

void register_sources(Build& build) {
  for (SourceId id = 0; id < build.sources.size(); ++id) {
    const Source& source = build.sources[id];
    const auto [first, is_new] = build.by_id.emplace(source.id, id);
    if (!is_new) {
      build.errors.add(
          build.member({id, source.document.root()}, "$id"),
          "this $id is already used by " + quoted(build.sources[first->second].name, 200));
    }
    build.defs.push_back(definitions(source));
    build.extension_of.push_back(kNone);
    if (!is_new || !source.is_extension()) continue;
    build.extension_of.back() = static_cast<ExtensionId>(build.set.extensions.size());
    build.set.extensions.emplace_back();
    build.set.extension_ids.emplace(source.short_name(), build.extension_of.back());
  }
}

Compiled compile(const std::vector<SourceFile>& files) {
  Compiled result;
  const std::vector<Source> sources = load_sources(files, result.errors);
  ErrorList errors(sources);
  check_vocabulary(sources, errors);
  Build build(sources, errors);
  // Each stage relies on the one before.
  for (const auto stage : {register_sources, build_shapes, build_extensions, check_references}) {
    if (!errors.empty() || !result.errors.empty()) break;
    stage(build);
  }
  for (SchemaError& error : errors.take()) result.errors.push_back(std::move(error));
  if (!result.errors.empty()) return result;
  drop_common_members(build.set);
  HashParts texts;
  for (const SourceFile& file : files) texts.add(file.text);
  result.set = SetWriter::close(std::move(build.set), texts.finish());
  return result;
}

}  // namespace gltfx::schema
