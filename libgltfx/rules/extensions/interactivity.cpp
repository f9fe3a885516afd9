// SPDX-License-Identifier: Apache-2.0
// KHR_interactivity: the order of a graph's nodes, lengths and kinds of values, indices inside
// configurations. This file is about that one extension and names it.
#include <array>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/json_pointer.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/extensions/interactivity_draft.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kInteractivityExtension = "KHR_interactivity";

struct Signature {
  std::string_view name;
  std::uint64_t length;
};
constexpr std::array<Signature, 10> kSignatures{{{"bool", 1},
                                                 {"float", 1},
                                                 {"float2", 2},
                                                 {"float3", 3},
                                                 {"float4", 4},
                                                 {"float2x2", 4},
                                                 {"float3x3", 9},
                                                 {"float4x4", 16},
                                                 {"int", 1},
                                                 {"ref", 1}}};

const Signature* find_signature(std::string_view name) {
  const auto* const found = std::find_if(kSignatures.begin(), kSignatures.end(),
                                         [&](const Signature& each) { return each.name == name; });
  return found == kSignatures.end() ? nullptr : found;
}

// Settings of operations without a default: indices of a list of the graph, or a text, or a
// boolean.
struct NeededSetting {
  std::string_view operation, setting, list;
  bool text = false;
};
constexpr NeededSetting kNeededSettings[] = {
    {"variable/get", "variable", "variables"},
    {"variable/set", "variables", "variables"},
    {"variable/interpolate", "variable", "variables"},
    {"variable/interpolate", "useSlerp", ""},
    {"event/send", "event", "events"},
    {"event/receive", "event", "events"},
    {"pointer/get", "pointer", "", true},
    {"pointer/get", "type", "types"},
    {"pointer/set", "pointer", "", true},
    {"pointer/set", "type", "types"},
    {"pointer/interpolate", "pointer", "", true},
    {"pointer/interpolate", "type", "types"},
};

class GraphCheck {
 public:
  GraphCheck(const Context& context, json::NodeId graph, const Path& path)
      : context_(context), document_(context.document), graph_(graph), path_(path) {}

  void run() {
    read_types();
    read_operations();
    check_values_of("variables");
    check_events();
    const Path list(path_, "nodes");
    const auto nodes = object_list(document_, graph_, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i] != json::kNoNode) check_node(nodes[i], i, Path(list, i));
    }
  }

 private:
  void read_types() {
    const Path list(path_, "types");
    std::unordered_map<std::string_view, std::size_t> known;
    for (const json::NodeId type : object_list(document_, graph_, "types")) {
      const std::string name = model::string_member(document_, type, "signature");
      const Signature* signature = find_signature(name);
      types_.push_back(signature);
      if (signature == nullptr) continue;
      const auto [first, fresh] = known.try_emplace(signature->name, types_.size() - 1);
      if (fresh) continue;
      const Path at(list, types_.size() - 1);
      report_link(
          context_, Path(at, "signature"), document_.find(type, "signature"),
          Code::INTERACTIVITY_TYPE_REPEATED,
          fmt::format("Type {} already has the signature {}.", first->second, quoted(name)));
    }
  }

  void read_operations() {
    const Path list(path_, "declarations");
    std::unordered_map<std::string, std::size_t> known;
    for (const json::NodeId each : object_list(document_, graph_, "declarations")) {
      operations_.push_back(model::string_member(document_, each, "op"));
      if (operations_.back().empty()) continue;
      const auto [first, fresh] = known.try_emplace(identity(each), operations_.size() - 1);
      if (fresh) continue;
      report_link(context_, Path(list, operations_.size() - 1), each,
                  Code::INTERACTIVITY_DECLARATION_REPEATED,
                  fmt::format("Declaration {} already declares {}.", first->second,
                              quoted(operations_.back())));
    }
  }

  // The properties that make declarations equal: the operation, its extension, names and types of
  // its inputs.
  std::string identity(json::NodeId declaration) const {
    std::string identity =
        operations_.back() + '\n' + model::string_member(document_, declaration, "extension");
    const json::NodeId sockets = model::object_member(document_, declaration, "inputValueSockets");
    if (sockets == json::kNoNode) return identity;
    std::map<std::string_view, std::uint64_t> inputs;
    for (const auto socket : document_.members(sockets)) {
      if (!document_.is_object(socket.value)) continue;
      const auto type = model::unsigned_member(document_, socket.value, "type");
      inputs.emplace(document_.key(socket.key_id), type.value_or(UINT64_MAX));
    }
    for (const auto& [name, type] : inputs) identity += fmt::format("\n{}\n{}", name, type);
    return identity;
  }

  void check_values_of(std::string_view member) {
    const Path list(path_, member);
    const auto objects = object_list(document_, graph_, member);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] != json::kNoNode) check_value(objects[i], Path(list, i));
    }
  }

  void check_events() {
    const Path list(path_, "events");
    std::unordered_map<std::string, std::size_t> known;
    const auto events = object_list(document_, graph_, "events");
    for (std::size_t i = 0; i < events.size(); ++i) {
      const Path at(list, i);
      check_map(events[i], "values", at);
      const json::NodeId id = document_.find(events[i], "id");
      if (id == json::kNoNode || !document_.is_string(id)) continue;
      const auto [first, fresh] = known.try_emplace(document_.string(id), i);
      if (fresh) continue;
      report_link(
          context_, Path(at, "id"), id, Code::INTERACTIVITY_EVENT_REPEATED,
          fmt::format("Event {} already has the id {}.", first->second, quoted(first->first)));
    }
  }

  // Each value of a map from socket names.
  void check_map(json::NodeId object, std::string_view member, const Path& path) {
    const json::NodeId map = model::object_member(document_, object, member);
    if (map == json::kNoNode) return;
    const Path at(path, member);
    for (const auto each : document_.members(map)) {
      if (!document_.is_object(each.value)) continue;
      check_value(each.value, Path(at, document_.key(each.key_id)));
    }
  }

  void check_value(json::NodeId object, const Path& path) {
    const json::NodeId value = document_.find(object, "value");
    const auto type = model::unsigned_member(document_, object, "type");
    if (value == json::kNoNode || !document_.is_array(value) || !type || *type >= types_.size()) {
      return;
    }
    const Signature* signature = types_[*type];
    if (signature == nullptr) return;
    const std::size_t length = document_.array_size(value);
    const Path at(path, "value");
    if (length != signature->length) {
      report_link(context_, at, value, Code::INTERACTIVITY_VALUE_LENGTH,
                  fmt::format("The value has {} element{}; for {} it must have {}.", length,
                              length == 1 ? "" : "s", signature->name, signature->length));
    } else if (!has_kind(*signature, value)) {
      report_link(context_, at, value, Code::INTERACTIVITY_VALUE_KIND,
                  fmt::format("The value is not of type {}.", signature->name));
    }
  }

  bool has_kind(const Signature& signature, json::NodeId array) const {
    const bool numbers = document_.kind(array) == json::Kind::number_array;
    if (signature.name.starts_with("float")) return numbers;
    if (signature.name == "int") {
      if (!numbers) return false;
      const json::Number number = json::NumberCursor(document_, array).number();
      return number.is_integer() && number.value >= INT32_MIN && number.value <= INT32_MAX;
    }
    if (numbers) return false;
    const json::NodeId element = *document_.elements(array).begin();
    if (signature.name == "bool") return document_.is_boolean(element);
    return document_.is_string(element) && split_pointer(document_.string(element)).has_value();
  }

  void check_node(json::NodeId node, std::size_t index, const Path& path) {
    check_map(node, "values", path);
    check_order(node, "values", index, path);
    check_order(node, "flows", index, path);
    const auto operation = model::unsigned_member(document_, node, "declaration");
    if (!operation || *operation >= operations_.size()) return;
    for (const NeededSetting& setting : kNeededSettings) {
      if (setting.operation == operations_[*operation]) check_setting(node, setting, path);
    }
  }

  // Values come from earlier nodes, flows go to later nodes: so a graph has no cycles.
  void check_order(json::NodeId node, std::string_view member, std::size_t index,
                   const Path& path) {
    const json::NodeId map = model::object_member(document_, node, member);
    if (map == json::kNoNode) return;
    const bool flows = member == "flows";
    const Path at(path, member);
    for (const auto each : document_.members(map)) {
      if (!document_.is_object(each.value)) continue;
      const auto other = model::unsigned_member(document_, each.value, "node");
      if (!other || (flows ? *other > index : *other < index)) continue;
      const Path socket(at, document_.key(each.key_id));
      report_link(
          context_, Path(socket, "node"), document_.find(each.value, "node"),
          Code::INTERACTIVITY_NODE_ORDER,
          flows ? fmt::format("A flow of node {} leads to node {}; it must lead to a later node.",
                              index, *other)
                : fmt::format(
                      "Node {} takes a value from node {}; it must take it from an earlier node.",
                      index, *other));
    }
  }

  bool has_kind(const NeededSetting& setting, json::NodeId value) const {
    if (value == json::kNoNode || !document_.is_array(value)) return false;
    const bool numbers = document_.kind(value) == json::Kind::number_array;
    if (numbers || !setting.list.empty()) return numbers && !setting.list.empty();
    if (document_.array_size(value) != 1) return false;
    const json::NodeId element = *document_.elements(value).begin();
    return setting.text ? document_.is_string(element) : document_.is_boolean(element);
  }

  void check_setting(json::NodeId node, const NeededSetting& setting, const Path& path) {
    const json::NodeId map = model::object_member(document_, node, "configuration");
    const json::NodeId object = model::object_member(document_, map, setting.setting);
    const json::NodeId value = document_.find(object, "value");
    if (!has_kind(setting, value)) {
      report_link(context_, path, node, Code::INTERACTIVITY_SETTING_MISSING,
                  fmt::format("{} requires the configuration {} with {}.",
                              quoted(setting.operation), quoted(setting.setting),
                              setting.text           ? "a string"
                              : setting.list.empty() ? "a boolean"
                                                     : "an index"));
      return;
    }
    if (setting.list.empty()) return;
    const std::size_t count = list_size(setting.list);
    const Path configuration(path, "configuration");
    const Path name(configuration, setting.setting);
    const Path list(name, "value");
    std::uint64_t position = 0;
    for (json::NumberCursor at(document_, value); at.valid(); at.advance(), ++position) {
      const json::Number& number = at.number();
      if (number.is_integer() && number.value >= 0 && number.value < static_cast<double>(count)) {
        continue;
      }
      report_link(
          context_, Path(list, position), number.span, Code::INTERACTIVITY_INDEX_UNRESOLVED,
          fmt::format("{} refers to {}[{}], but the length of {} is {}.", quoted(setting.operation),
                      setting.list, number_text(number.value), setting.list, count));
    }
  }

  std::size_t list_size(std::string_view member) {
    const auto [known, fresh] = sizes_.try_emplace(member, 0);
    if (fresh) known->second = object_list(document_, graph_, member).size();
    return known->second;
  }

  static std::string quoted(std::string_view text) { return gltfx::quoted(text); }

  const Context& context_;
  const json::Document& document_;
  json::NodeId graph_;
  const Path& path_;
  std::vector<const Signature*> types_;  ///< null: custom, or unknown
  std::vector<std::string> operations_;  ///< by declaration
  std::unordered_map<std::string_view, std::size_t> sizes_;
};

void check_graphs(const Context& context) {
  const json::NodeId object = root_extension(context, kInteractivityExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kInteractivityExtension);
  const std::string_view earlier = earlier_interactivity(context.document);
  if (!earlier.empty()) {
    report_link(
        context, extension, object, kEarlierInteractivity,
        fmt::format("The behavior graphs follow an earlier draft of {} ({}); they are not checked.",
                    kInteractivityExtension, earlier));
    return;
  }
  const Path list(extension, "graphs");
  const auto graphs = object_list(context.document, object, "graphs");
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    if (graphs[i] == json::kNoNode) continue;
    const Path path(list, i);
    GraphCheck(context, graphs[i], path).run();
  }
}

}  // namespace

const RuleGroup& interactivity_rules() {
  static constexpr LinkRule kLinkRules[] = {check_graphs};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
