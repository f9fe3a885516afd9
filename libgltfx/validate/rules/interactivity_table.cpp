// SPDX-License-Identifier: Apache-2.0
// Examples of an extension name it, as those of any extension do.
#include "validate/rules/interactivity_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float2"}],
  "variables": [{"type": 0, "value": [0.5, 0.5]}]}]}}})";

constexpr std::string_view kGoodNodes =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float"}],
  "variables": [{"type": 0, "value": [1]}],
  "declarations": [{"op": "math/add"}, {"op": "variable/get"}],
  "nodes": [{"declaration": 1, "configuration": {"variable": {"value": [0]}}},
   {"declaration": 0, "values": {"a": {"node": 0}, "b": {"type": 0, "value": [2]}}}]}]}}})";

constexpr RuleDescription kRules[] = {
    {"INTERACTIVITY_EARLIER_DRAFT", Severity::info,
     "The behaviour graphs follow an earlier draft of the extension",
     "The drafts differ in the form of nodes, sockets and variables; programs that follow the "
     "released text reject such graphs.",
     "Export the asset again with a program that follows the released text.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float"}],
  "variables": [{"id": "speed", "type": 0, "value": [1]}],
  "declarations": [{"op": "event/onStart"}],
  "nodes": [{"declaration": 0, "configuration": {}, "values": {}, "flows": {}}]}]}}})",
     kGoodNodes, Fix::none, false},
    {"INTERACTIVITY_EVENT_REPEATED", Severity::error, "Two events of a graph have one id",
     "The application knows events by their id: graphs with two of a kind are rejected.",
     "Give each event its own id, or merge the two.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float2"}],
  "variables": [{"type": 0, "value": [0.5, 0.5]}],
  "events": [{"id": "open"}, {"id": "open"}]}]}}})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float2"}],
  "variables": [{"type": 0, "value": [0.5, 0.5]}],
  "events": [{"id": "open"}, {"id": "close"}]}]}}})",
     Fix::none, false},
    {"INTERACTIVITY_INDEX_UNRESOLVED", Severity::error,
     "A configuration names a variable or event that does not exist",
     "The node has no meaning, and the whole graph is rejected.",
     "Correct the index, or add what it names.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float"}],
  "variables": [{"type": 0, "value": [1]}],
  "declarations": [{"op": "math/add"}, {"op": "variable/get"}],
  "nodes": [{"declaration": 1, "configuration": {"variable": {"value": [3]}}},
   {"declaration": 0, "values": {"a": {"node": 0}, "b": {"type": 0, "value": [2]}}}]}]}}})",
     kGoodNodes, Fix::none, false},
    {"INTERACTIVITY_NODE_ORDER", Severity::error, "A behaviour graph leads back",
     "Values come from nodes before and flows go to nodes behind, so that no graph runs in "
     "circles; others are rejected.",
     "Sort the nodes so that each comes behind those it takes values from.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float"}],
  "variables": [{"type": 0, "value": [1]}],
  "declarations": [{"op": "math/add"}, {"op": "variable/get"}],
  "nodes": [{"declaration": 0, "values": {"a": {"node": 1}, "b": {"type": 0, "value": [2]}}},
   {"declaration": 1, "configuration": {"variable": {"value": [0]}}}]}]}}})",
     kGoodNodes, Fix::none, false},
    {"INTERACTIVITY_TYPE_REPEATED", Severity::error, "Two types of a graph have one signature",
     "Types are compared by index: graphs with a type twice are rejected.",
     "Keep the first, and let everything refer to it.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float2"}, {"signature": "float2"}],
  "variables": [{"type": 0, "value": [0.5, 0.5]}]}]}}})",
     kGood, Fix::none, false},
    {"INTERACTIVITY_VALUE_KIND", Severity::error, "A value of a behaviour graph is not of its type",
     "A bool is true or false, an int a whole number of 32 bits, a ref a JSON pointer; graphs with "
     "others are rejected.",
     "Write the value as its type asks, or change the type.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "bool"}],
  "variables": [{"type": 0, "value": [1]}]}]}}})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "bool"}],
  "variables": [{"type": 0, "value": [true]}]}]}}})",
     Fix::none, false},
    {"INTERACTIVITY_VALUE_LENGTH", Severity::error,
     "A value of a behaviour graph has more or fewer elements than its type",
     "Values are written as one element a component; graphs with others are rejected.",
     "Write as many elements as the type has components.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_interactivity"],
 "extensions": {"KHR_interactivity": {"graph": 0, "graphs": [{"types": [{"signature": "float2"}],
  "variables": [{"type": 0, "value": [0.5]}]}]}}})",
     kGood, Fix::none, false},
};

}  // namespace

std::span<const RuleDescription> interactivity_rules() { return kRules; }

}  // namespace gltfx::validate
