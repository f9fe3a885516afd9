// SPDX-License-Identifier: Apache-2.0
// A legacy object next to its successor, which readers use.
#include <fmt/format.h>

#include "base/text.hpp"
#include "json/equal.hpp"
#include "json/parse.hpp"
#include "steps/upgrade/generation.hpp"
#include "steps/upgrade/object_plan.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::size_t kShown = 120;  // code points of a value

// The text of a value; for a list, only its first numbers if `take` is not 0.
std::string text_of(const json::Document& document, json::NodeId value,
                    const schema::UpgradeStep& step) {
  if (step.accept_index && document.is_number(value)) {
    return fmt::format(R"({{"index":{}}})", document.raw(value));
  }
  std::vector<json::Number> numbers = numbers_of(document, value);
  if (step.take == 0 || numbers.size() <= step.take) return std::string(document.raw(value));
  numbers.resize(step.take);
  std::string list;
  for (const json::Number& number : numbers) {
    list.append(1, list.empty() ? '[' : ',').append(number.span.in(document.text()));
  }
  return list.append(1, ']');
}

bool is_same(const std::string& one, const std::string& other) {
  if (one.empty() || other.empty()) return one == other;
  const json::Parsed both = json::parse(fmt::format(R"({{"a":{},"b":{}}})", one, other));
  const json::NodeId root = both.document.root();
  return json::equal(both.document, both.document.find(root, "a"), both.document.find(root, "b"));
}

std::string shown(const std::string& json) {
  return json.empty() ? "missing" : quoted(json, kShown);
}

}  // namespace

// The successor, or another possible successor, if the host already has it.
const schema::Extension* ObjectPlan::replacement() {
  if (extension_.upgrade.to.empty() || joins()) return nullptr;
  std::vector<std::string> names{successor_.name, extension_.upgrade.to};
  const auto& others = extension_.upgrade.alternatives;
  names.insert(names.end(), others.begin(), others.end());
  for (const std::string& name : names) {
    if (!has_beside(name) || is_blocked_by(name)) continue;
    return &context_.set.extensions()[context_.set.find_extension(name)];
  }
  return nullptr;
}

void ObjectPlan::check_duplicate(const schema::Extension& other) {
  const auto given = context_.given.find({host_.node, other.name});
  const bool is_new = given != context_.given.end();
  const json::NodeId object = is_new ? given->second : document_.find(host_.extensions, other.name);
  if (!is_new && !context_.holds(other.shape_on(host_.type), {object})) {
    return refuse(
        fmt::format("the object also has {}, but it is invalid; see 'gltfx validate'", other.name));
  }
  check_removal(fmt::format("the object already has {}, which viewers use", other.name));
  if (!action_.removed || object == json::kNoNode) return;
  if (!is_new && other.name == successor_.name && !extension_.upgrade.steps.empty()) {
    note_differences(object);
  } else if (!json::equal(document_, host_.object, object)) {
    action_.notes.push_back(
        fmt::format("its own values are {}", quoted(document_.raw(host_.object), kShown)));
  }
}

void ObjectPlan::note_differences(json::NodeId other) {
  const Decision decision =
      decide_generation(document_, extension_, host_.object, context_.options.generation);
  if (decision.generation != nullptr) {
    action_.generation = decision.generation->name;
    action_.decision = decision.because;
  }
  for (const schema::UpgradeStep& step : extension_.upgrade.steps) {
    if (applies(step.generations)) note_difference(step, other);
  }
}

// If another channel is read, the textures differ in any case.
void ObjectPlan::note_difference(const schema::UpgradeStep& step, json::NodeId other) {
  using Kind = schema::UpgradeStep::Kind;
  if (step.from.empty()) return;
  const bool copy = step.kind == Kind::copy;
  const json::NodeId from =
      copy ? context_.source_of(host_, step.from).value : document_.find(host_.object, step.from);
  const json::NodeId to = step.kind == Kind::place
                              ? find_path(document_, host_.node, split_path(step.to))
                              : document_.find(other, step.to);
  const bool both = from != json::kNoNode && to != json::kNoNode;
  if (both && !step.swizzle.empty()) return;
  const auto usual = [&](const schema::Extension& extension, const std::string& name) {
    const schema::ShapeId shape = extension.shape_on(host_.type);
    if (shape == schema::kNone) return std::string();
    const schema::Property* property =
        context_.set.find_property(context_.set.shape(shape).type, name);
    return property == nullptr ? std::string() : property->default_json;
  };
  std::string was = step.otherwise.empty()
                        ? usual(copy ? successor_ : extension_, copy ? step.to : step.from)
                        : step.otherwise;
  if (from != json::kNoNode) was = text_of(document_, from, step);
  const std::string is =
      to == json::kNoNode ? usual(successor_, step.to) : text_of(document_, to, step);
  if (is_same(was, is)) return;
  action_.notes.push_back(
      fmt::format("{} is {}, but {} is {}", step.from, shown(was), step.to, shown(is)));
}

}  // namespace gltfx::upgrade
