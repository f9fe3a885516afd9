// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "schema/extension_names.hpp"
#include "schema/form_check.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {

const TargetArray* CheckResult::target(std::string_view pointer) const {
  const auto found =
      std::find_if(targets.begin(), targets.end(),
                   [pointer](const TargetArray& array) { return array.pointer == pointer; });
  return found == targets.end() ? nullptr : &*found;
}

const TargetArray* CheckResult::root_target(std::string_view name) const {
  const auto found = std::find_if(targets.begin(), targets.end(), [name](const TargetArray& array) {
    return array.pointer.size() == name.size() + 1 && array.pointer.ends_with(name);
  });
  return found == targets.end() ? nullptr : &*found;
}

bool has_coverage(const Set& set, const SlotUse& use) {
  if (use.slot == nullptr || use.owner_type == kNone) return false;
  const auto* factor = set.find_property(use.owner_type, use.slot->scaled_by);
  return factor != nullptr && factor->parameter == "base_color";
}

Walker::Walker(const json::Document& document, const Set& set, const CheckOptions& options,
               Sink& schema_sink, Sink& reference_sink, const ObjectVisitor& visitor)
    : document_(document),
      set_(set),
      tables_(set.walk_tables()),
      options_(options),
      version_(options.deviations.draft_names_are_unexpected ? kVersion2
                                                             : judged_version(document, set)),
      schema_sink_(schema_sink),
      reference_sink_(reference_sink),
      visitor_(visitor),
      values_(document),
      names_(document, set),
      targets_(document, set),
      holds_(document, set, names_),
      seen_(document.key_count(), false),
      declared_(document.key_count(), Declared::unseen) {}

CheckResult Walker::run() {
  const json::NodeId root = document_.root();
  if (!document_.is_object(root)) {
    report({}, Code::TYPE_MISMATCH, document_.span(root),
           "The document is " + shown(values_, {root}) + "; it must be an object.",
           "write an object with at least \"asset\": { \"version\": \"2.0\" }");
    return std::move(result_);
  }
  read_declarations();
  const TypeId type = options_.root != kNone ? options_.root : tables_.root;
  if (type != kNone) push(set_.type(type).shape, root, {}, Mode::object, false);
  while (top_ != nullptr) {
    switch (top_->mode) {
      case Mode::object:
        object_step(*top_);
        break;
      case Mode::array:
        array_step(*top_);
        break;
      case Mode::extensions:
        extensions_step(*top_);
        break;
    }
  }
  targets_.move_to(result_);
  return std::move(result_);
}

void Walker::push(ShapeId shape, json::NodeId node, const Path& path, Mode mode, bool further) {
  Frame* frame = top_ == nullptr ? (frames_.empty() ? nullptr : &frames_.front()) : top_->child;
  if (frame == nullptr) {
    frame = &frames_.emplace_back();
    if (top_ != nullptr) top_->child = frame;
  }
  frame->path = path;
  frame->parent = top_;
  frame->node = node;
  frame->at = node + 1;
  frame->extensions = frame->extras = json::kNoNode;
  frame->shape = shape;
  frame->type = shape == kNone ? kNone : tables_.shapes[shape].type;
  frame->index = 0;
  frame->scratch = static_cast<std::uint32_t>(members_.size());
  frame->pending = static_cast<std::uint32_t>(pending_.size());
  frame->mode = mode;
  frame->stage = Stage::enter;
  frame->reported = 0;
  frame->further = further;
  frame->again = further || (top_ != nullptr && top_->again);
  frame->unset = false;
  frame->constrained = false;
  top_ = frame;
}

// Puts a container on the walk. A container that several shapes of one value lead to is walked for
// each shape, but only once for the same shape.
bool Walker::walk(ShapeId shape, json::NodeId node, Step step, Mode mode) {
  const bool further = step.kind == Step::Kind::same;
  if (further || top_->again) {
    const std::uint64_t key = (std::uint64_t{shape} << 32U) | node;
    if (!walked_.insert(key).second) return false;
  }
  push(shape, node, path_of(node, step), mode, further);
  return true;
}

void Walker::pop() {
  if (top_->unset && !top_->further) discard(*top_);
  // No frame above is walked again, so these keys are not used any more.
  constexpr std::size_t kMostWalked = 1U << 12U;
  if (!top_->again && walked_.size() > kMostWalked) walked_ = {};
  members_.resize(top_->scratch);
  pending_.resize(top_->pending);
  top_ = top_->parent;
}

Path Walker::path_of(json::NodeId node, Step step) const {
  switch (step.kind) {
    case Step::Kind::member:
      return {top_->path, key_of(node)};
    case Step::Kind::element:
      return {top_->path, step.index};
    case Step::Kind::same:
      break;
  }
  return top_->path;
}

void Walker::report(const Path& path, Code code, Span span, std::string message, std::string help,
                    std::optional<Severity> severity) {
  Finding finding(code);
  finding.message = std::move(message);
  finding.help = std::move(help);
  finding.span = span;
  finding.severity = severity;
  schema_sink_.report(path, std::move(finding));
}

void Walker::drop(json::NodeId value) {
  if (options_.shown == nullptr) return;
  options_.shown->hide(value);
  result_.has_open_references = true;
}

// With a container that counts as absent, the array around it is absent too.
void Walker::discard(const Frame& frame) {
  if (frame.parent == nullptr) return;
  if (frame.parent->mode == Mode::array) {
    frame.parent->unset = true;
  } else {
    drop(frame.node);
  }
}

// "did you mean 'x'?", or an empty text.
std::string Walker::did_you_mean(std::string_view word,
                                 const std::vector<std::string_view>& known) {
  if (known.size() > comparisons_left_) return {};
  comparisons_left_ -= known.size();
  const std::string_view near = nearest(word, known);
  return near.empty() ? std::string() : "did you mean " + quoted(near) + "?";
}

Span Walker::opening(json::NodeId object) const {
  const Span span = document_.span(object);
  return {span.begin, span.begin + 1};
}

CheckResult check(const json::Document& document, const Set& set, const CheckOptions& options,
                  Sink& schema_sink, Sink& reference_sink, const ObjectVisitor& visitor) {
  if (document.empty()) return {};
  return Walker(document, set, options, schema_sink, reference_sink, visitor).run();
}

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
  // The maximum number of names that are compared with all known ones.
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
    // Otherwise rules after the walk report it: they have the names in use and the extensions used.
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
