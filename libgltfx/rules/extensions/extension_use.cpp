// SPDX-License-Identifier: Apache-2.0
// The lists of extensions, compared with the extensions that the asset uses.
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/core/attribute_formats.hpp"
#include "rules/core/use.hpp"
#include "rules/fix.hpp"
#include "schema/extension_names.hpp"
#include "schema/form_check.hpp"
#include "schema/phrases.hpp"

namespace gltfx::validate {
namespace {

json::KeyTable as_set(const std::vector<std::string>& names) {
  json::KeyTable set;
  for (const std::string& name : names) set.insert(name);
  return set;
}

// The number of extensions with separate findings; equal findings on further ones are folded.
constexpr std::uint64_t kMostTold = 50;

// The three lists as tables.
struct Names {
  json::KeyTable used, required, seen, without_fallback;
  std::string_view unseen;                                          ///< see unseen_user()
  std::unordered_map<std::string_view, std::string_view> misspelt;  ///< to what is meant
  std::vector<std::string> required_unknown;                        ///< to the correct name
  explicit Names(const Context& context)
      : used(as_set(context.checked.extensions_used)),
        required(as_set(context.checked.extensions_required)),
        seen(as_set(context.checked.extensions_seen)),
        without_fallback(as_set(context.checked.without_fallback)),
        unseen(unseen_user(context)) {
    std::uint64_t compared = 0;
    for (const std::string& name : context.checked.extensions_used) {
      if (context.schemas.find_extension(name) != schema::kNone) continue;
      const std::string_view meant = compared++ < kMostTold
                                         ? schema::misspelt_extension(context.schemas, name)
                                         : std::string_view();
      if (!meant.empty()) misspelt.emplace(name, meant);
      if (meant.empty() && required.contains(name)) required_unknown.push_back(name);
    }
  }
};

// One entry of extensionsUsed, or an extension that is used without being declared.
struct Entry {
  const Context& context;
  const Names& names;
  const Path& path;
  Span span;
  std::string name;

  void report(Code code, std::string message, std::string help = {}) const {
    Finding finding(code);
    finding.message = std::move(message);
    finding.help = std::move(help);
    finding.span = span;
    if (path.is_index() && path.index() < kMostTold) finding.about = name;
    context.link_sink.report(path, std::move(finding));
  }
};

// 'A', 'B' and 3 others.
std::string names_text(std::vector<std::string> names) {
  constexpr std::size_t kMostNamed = 5;
  if (names.size() <= kMostNamed + 1) return schema::all_of_phrase(names);
  const std::size_t others = names.size() - kMostNamed;
  names.resize(kMostNamed);
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}, ", gltfx::quoted(name));
  return fmt::format("{}and {} others", text, others);
}

// All required unknown extensions get one finding: there are no details to report about each.
void report_unknown(const Entry& entry) {
  const auto misspelt = entry.names.misspelt.find(entry.name);
  if (misspelt != entry.names.misspelt.end()) {
    entry.report(Code::EXTENSION_NAME_MISSPELT,
                 fmt::format("{} is not a known extension.", gltfx::quoted(entry.name)),
                 fmt::format("did you mean {}?", gltfx::quoted(misspelt->second)));
    return;
  }
  if (!schema::is_extension_name(entry.name) && !schema::is_known_without_schema(entry.name)) {
    entry.report(Code::INVALID_EXTENSION_NAME_FORMAT,
                 fmt::format("{} is not a valid extension name; it must have the form PREFIX_name.",
                             gltfx::quoted(entry.name)));
  }
  if (entry.names.required.contains(entry.name)) {
    if (entry.name != entry.names.required_unknown.front()) return;
    entry.report(Code::UNSUPPORTED_EXTENSION_REQUIRED,
                 fmt::format("The asset requires {}, which is unknown; its content is not checked.",
                             names_text(entry.names.required_unknown)));
  } else {
    entry.report(
        Code::UNSUPPORTED_EXTENSION,
        fmt::format("{} is unknown; its content is not checked.", gltfx::quoted(entry.name)));
  }
}

std::string successor_help(const schema::Extension& extension) {
  const schema::Upgrade& upgrade = extension.upgrade;
  if (upgrade.to.empty() && upgrade.does_something()) return "run 'gltfx upgrade' to remove it";
  if (extension.successor.empty()) return {};
  const bool fixable = extension.upgrade.to == extension.successor;
  if (!fixable) return fmt::format("use {}", extension.successor);
  const bool on_request = !extension.upgrade.opt_in.empty();
  return fmt::format("run 'gltfx upgrade{}{}' to convert it to {}", on_request ? " --only " : "",
                     on_request ? extension.name : "", extension.successor);
}

void report_status(const Entry& entry, const schema::Extension& extension) {
  switch (extension.status) {
    case schema::Status::legacy:
      entry.report(Code::EXTENSION_LEGACY,
                   fmt::format("{} is a legacy extension; it was replaced before its release.",
                               extension.name),
                   successor_help(extension));
      break;
    case schema::Status::archived:
      entry.report(Code::EXTENSION_ARCHIVED, fmt::format("{} is archived.", extension.name),
                   successor_help(extension));
      break;
    case schema::Status::draft:
      entry.report(Code::EXTENSION_DRAFT,
                   fmt::format("{} is a draft and can still change.", extension.name),
                   successor_help(extension));
      break;
    default:
      break;
  }
}

// An extension has either objects or only formats of attributes.
bool is_unused(const Entry& entry, const schema::Extension& extension) {
  if (!extension.attachment_points.empty()) return !entry.names.seen.contains(extension.name);
  const bool formats = !extension.vertex_attributes.empty() || !extension.morph_attributes.empty();
  const Context& context = entry.context;
  return formats && model::count_with_added_format(context.asset, context.views, extension) == 0;
}

void report_use(const Entry& entry, const schema::Extension& extension) {
  if (is_unused(entry, extension)) {
    // It may be used inside an extension without a schema, such as a transform of its textures.
    if (!entry.names.unseen.empty()) return;
    entry.report(Code::EXTENSION_UNUSED,
                 fmt::format("{} is declared but not used.", extension.name));
  } else if (extension.must_be_required == schema::MustBeRequired::recommended &&
             !entry.names.required.contains(extension.name)) {
    entry.report(
        Code::EXTENSION_SHOULD_BE_REQUIRED,
        fmt::format("{} has no fallback, but is not in extensionsRequired.", extension.name));
  } else if (extension.optional_with_fallback && entry.names.required.contains(extension.name) &&
             !entry.names.without_fallback.contains(extension.name)) {
    entry.report(Code::EXTENSION_REQUIRED_WITH_FALLBACK,
                 fmt::format("{} is in extensionsRequired, but {} is always present as a fallback.",
                             extension.name, gltfx::quoted(extension.fallback)));
  }
}

void check_entry(const Entry& entry, bool declared) {
  const schema::ExtensionId id = entry.context.schemas.find_extension(entry.name);
  if (id == schema::kNone) {
    if (declared) report_unknown(entry);
    return;
  }
  const schema::Extension& extension = entry.context.schemas.extensions()[id];
  report_status(entry, extension);
  if (declared) report_use(entry, extension);
}

void check_declared(const Context& context, const Names& names) {
  const json::Document& document = context.document;
  const json::NodeId list = document.find(document.root(), "extensionsUsed");
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return;
  const Path root;
  const Path used(root, "extensionsUsed");
  json::KeyTable done;
  std::uint64_t index = 0;
  for (const json::NodeId element : document.elements(list)) {
    const Path path(used, index++);
    if (!document.is_string(element) || !document.insert_string(element, done)) continue;
    check_entry({context, names, path, document.span(element), document.string(element)}, true);
  }
}

void check_undeclared(const Context& context, const Names& names) {
  const Path root;
  for (const std::string& name : context.checked.extensions_seen) {
    if (names.used.contains(name)) continue;
    check_entry({context, names, root, Span{}, name}, false);
  }
}

void check_extension_use(const Context& context) {
  const Names names(context);
  check_declared(context, names);
  check_undeclared(context, names);
}

// --- Fixes: `place` is the name in extensionsUsed ---

std::string name_of(const Fixing& fixing, const Subject& subject) {
  const bool text = subject.value != json::kNoNode && fixing.document().is_string(subject.value);
  return text ? fixing.document().string(subject.value) : std::string();
}

// An object of that name in a wrong place may be the intended use.
bool forget(Fixing& fixing, const Subject& subject) {
  const std::string name = name_of(fixing, subject);
  if (name.empty() || !fixing.extensions_used().has(name)) return false;
  if (fixing.document().key_id(name) != json::kNoKey) return false;
  while (fixing.extensions_used().has(name)) fixing.extensions_used().remove(name);
  while (fixing.extensions_required().has(name)) fixing.extensions_required().remove(name);
  return true;
}

bool require(Fixing& fixing, const Subject& subject) {
  const std::string name = name_of(fixing, subject);
  change::NameList& list = fixing.extensions_required();
  if (name.empty() || list.has(name) || !list.can_change()) return false;
  list.add(name);
  return true;
}

bool make_optional(Fixing& fixing, const Subject& subject) {
  const std::string name = name_of(fixing, subject);
  if (name.empty() || !fixing.extensions_required().has(name)) return false;
  fixing.extensions_required().remove(name);
  return true;
}

// Every object of that name gets the correct name.
bool rename_misspelt(Fixing& fixing, const Subject& subject) {
  const json::Document& document = fixing.document();
  const std::string name = name_of(fixing, subject);
  const std::string_view meant = schema::misspelt_extension(fixing.schemas(), name);
  if (meant.empty() || document.key_id(meant) != json::kNoKey) return false;
  fixing.extensions_used().replace(name, meant);
  if (fixing.extensions_required().has(name)) fixing.extensions_required().replace(name, meant);
  const json::KeyId key = document.key_id(name);
  const json::KeyId extensions = document.key_id("extensions");
  for (json::NodeId id = 0; id < document.node_count(); ++id) {
    if (document.kind(id) != json::Kind::key || document.node(id).next != key) continue;
    const json::NodeId holder = fixing.parent(id);
    if (holder == 0 || document.kind(holder - 1) != json::Kind::key) continue;
    if (document.node(holder - 1).next == extensions) fixing.editor().rename(id, meant);
  }
  return true;
}

constexpr FixEntry kUseFixes[] = {
    {Code::EXTENSION_NAME_MISSPELT, rename_misspelt},
    {Code::EXTENSION_UNUSED, forget},
    {Code::EXTENSION_SHOULD_BE_REQUIRED, require},
    {Code::EXTENSION_REQUIRED_WITH_FALLBACK, make_optional},
};

}  // namespace

const RuleGroup& extension_use_rules() {
  static constexpr LinkRule kLinkRules[] = {check_extension_use};
  static constexpr RuleGroup group{
      .additional = true, .link_rules = kLinkRules, .fixes = kUseFixes};
  return group;
}

}  // namespace gltfx::validate
