// SPDX-License-Identifier: Apache-2.0
#include "schema/compile.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/number.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "schema/build.hpp"
#include "schema/form_check.hpp"
#include "schema/shape_builder.hpp"
#include "schema/source.hpp"

namespace gltfx::schema {
namespace {

// Checks one file with a list of objects still to check.
class FileCheck {
 public:
  FileCheck(const Source& source, SourceId id, ErrorList& errors)
      : source_(source), document_(source.document), forms_(document_), id_(id), errors_(errors) {}

  void run() {
    open_.push_back({document_.root(), Context::file});
    while (!open_.empty()) {
      const Open next = open_.back();
      open_.pop_back();
      object(next);
    }
  }

 private:
  struct Open {
    json::NodeId node;
    Context context;
  };

  void error(json::NodeId node, std::string message) {
    errors_.add({id_, node}, std::move(message));
  }

  void object(const Open& at) {
    const bool may_be_flag = at.context == Context::schema;
    if (may_be_flag && document_.is_boolean(at.node)) return;
    if (!document_.is_object(at.node)) {
      return error(at.node, std::string(context_name(at.context)) + " must be an object" +
                                (may_be_flag ? ", true or false" : ""));
    }
    for (const auto& member : document_.members(at.node)) {
      const std::string_view name = document_.key(member.key_id);
      if (const Word* word = find(at.context, name)) {
        value(*word, member.value);
      } else {
        unknown(at.context, name, member.key);
      }
    }
    for (const Word& word : words(at.context)) {
      if (word.required && document_.find(at.node, word.name) == json::kNoNode) {
        error(at.node,
              quoted(word.name) + " is missing in " + std::string(context_name(at.context)));
      }
    }
    if (at.context == Context::file && source_.is_extension() &&
        document_.find(at.node, "x-gltfx") == json::kNoNode) {
      error(at.node, "'x-gltfx' is missing");
    }
    if (at.context == Context::file || at.context == Context::schema) limits(at.node);
  }

  static const Word* find(Context context, std::string_view name) {
    const auto known = words(context);
    const auto word =
        std::find_if(known.begin(), known.end(), [name](const Word& w) { return w.name == name; });
    return word == known.end() ? nullptr : &*word;
  }

  void unknown(Context context, std::string_view name, json::NodeId key) {
    if (errors_.is_full()) return;
    std::vector<std::string_view> known;
    for (const Word& word : words(context)) known.push_back(word.name);
    std::string hint = did_you_mean(name, known);
    if (hint.empty()) hint = fmt::format(" Allowed: {}.", fmt::join(known, ", "));
    error(key, quoted(name) + " is not a member of " + std::string(context_name(context)) + hint);
  }

  // Simple forms are checked at once; objects of the vocabulary are put on the list.
  void value(const Word& word, json::NodeId node) {
    switch (word.form) {
      case Form::schema:
        open_.push_back({node, Context::schema});
        return;
      case Form::schemas:
        return each_element(node, word, Context::schema);
      case Form::schema_map:
        return each_member(node, word, Context::schema);
      case Form::pattern_map:
        return pattern_map(node, word);
      case Form::annotation:
        open_.push_back({node, is_extension_root(node) ? Context::extension : Context::word});
        return;
      case Form::versions:
        return each_element(node, word, Context::version);
      case Form::advice:
        open_.push_back({node, Context::advice});
        return;
      case Form::slot:
        open_.push_back({node, Context::slot});
        return;
      case Form::slot_map:
        return each_member(node, word, Context::slot);
      case Form::relations:
        return each_element(node, word, Context::relation);
      case Form::companions:
        return each_element(node, word, Context::companion);
      case Form::generations:
        return each_element(node, word, Context::generation);
      case Form::upgrade:
        open_.push_back({node, Context::upgrade});
        return;
      case Form::upgrade_steps:
        return each_element(node, word, Context::upgrade_step);
      case Form::upgrade_losses:
        return each_element(node, word, Context::upgrade_loss);
      case Form::upgrade_stays:
        return each_element(node, word, Context::upgrade_stay);
      case Form::semantics:
        return each_member(node, word, Context::attribute);
      default:
        if (const auto flaw = forms_.flaw(word.form, node)) {
          error(flaw->node, quoted(word.name) + " " + flaw->message);
        }
    }
  }

  bool is_extension_root(json::NodeId annotation) const {
    return source_.is_extension() && document_.find(document_.root(), "x-gltfx") == annotation;
  }

  void each_element(json::NodeId node, const Word& word, Context context) {
    if (document_.kind(node) != json::Kind::array || document_.array_size(node) == 0) {
      return error(node, quoted(word.name) + " must be a list with at least one element");
    }
    for (const json::NodeId element : document_.elements(node)) open_.push_back({element, context});
  }

  void each_member(json::NodeId node, const Word& word, Context context) {
    if (!document_.is_object(node)) return error(node, quoted(word.name) + " must be an object");
    for (const auto& member : document_.members(node)) open_.push_back({member.value, context});
  }

  void pattern_map(json::NodeId node, const Word& word) {
    each_member(node, word, Context::schema);
    if (!document_.is_object(node)) return;
    for (const auto& member : document_.members(node)) {
      if (const auto flaw = pattern_flaw(document_.key(member.key_id))) error(member.key, *flaw);
    }
  }

  // A lower limit above the upper limit allows no value.
  void limits(json::NodeId schema) {
    constexpr std::array<std::array<std::string_view, 2>, 7> kPairs{
        {{"minimum", "maximum"},
         {"exclusiveMinimum", "maximum"},
         {"minimum", "exclusiveMaximum"},
         {"exclusiveMinimum", "exclusiveMaximum"},
         {"minLength", "maxLength"},
         {"minItems", "maxItems"},
         {"minProperties", "maxProperties"}}};
    for (const auto& [low, high] : kPairs) {
      const json::NodeId from = document_.find(schema, low);
      const json::NodeId to = document_.find(schema, high);
      if (from == json::kNoNode || to == json::kNoNode) continue;
      if (!document_.is_number(from) || !document_.is_number(to)) continue;
      const double least = document_.number(from).value;
      const double most = document_.number(to).value;
      const bool open = low.substr(0, 2) == "ex" || high.substr(0, 2) == "ex";
      if (least > most || (open && least == most)) {
        errors_.add_at_key({id_, to}, quoted(high) + " (" + number_text(most) + ") contradicts " +
                                          quoted(low) + " (" + number_text(least) + ")");
      }
    }
  }

  const Source& source_;
  const json::Document& document_;
  FormCheck forms_;
  SourceId id_;
  ErrorList& errors_;
  std::vector<Open> open_;
};

// Adds an error for every word that is not in the vocabulary and every value of a wrong form.
// Afterwards the compiler may rely on the forms. Iterative.
void check_vocabulary(const std::vector<Source>& sources, ErrorList& errors) {
  for (SourceId id = 0; id < sources.size(); ++id) FileCheck(sources[id], id, errors).run();
}

}  // namespace

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

// The versions of glTF are in the file of its root object.
void read_versions(Build& build) {
  const auto root = build.by_id.find("gltfx:core/glTF");
  if (root == build.by_id.end()) return;
  const Site file{root->second, build.sources[root->second].document.root()};
  const Site list = build.member(build.member(file, "x-gltfx"), "versions");
  if (!list.exists()) return;
  const auto statuses = listed_values(Form::status);
  for (const json::NodeId element : build.document(list).elements(list.node)) {
    const Site at{list.source, element};
    const Site revision = build.member(at, "revision");
    VersionText text;
    text.version = read_version(build, build.member(at, "version"));
    const std::string status = build.text(build.member(at, "status"));
    text.status =
        static_cast<Status>(std::find(statuses.begin(), statuses.end(), status) - statuses.begin());
    if (revision.exists()) text.revision = build.text(revision);
    text.explained = read_names(build, build.member(at, "explained"));
    if (!build.set.versions.empty() && text.version <= build.set.versions.back().version) {
      build.errors.add(at, "versions must be in ascending order");
    }
    if (text.status == Status::draft && text.revision.empty()) {
      build.errors.add(at, "a draft must have 'revision': the date of its text");
    }
    build.set.versions.push_back(std::move(text));
  }
}

Compiled compile(const std::vector<SourceFile>& files) {
  Compiled result;
  const std::vector<Source> sources = load_sources(files, result.errors);
  ErrorList errors(sources);
  check_vocabulary(sources, errors);
  Build build(sources, errors);
  // Each stage relies on the previous one.
  for (const auto stage :
       {register_sources, read_versions, build_shapes, build_extensions, check_references}) {
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
