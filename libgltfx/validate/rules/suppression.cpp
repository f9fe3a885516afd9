// SPDX-License-Identifier: Apache-2.0
// What can be said about the wishes in extras.gltfx; suppressions.cpp says it, at the very end.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "materials": [{"name": "spare", "extras": {"gltfx": {"ignore": [
 {"code": "UNUSED_OBJECT", "reason": "The program picks it by its name."}]}}}]})";

constexpr RuleDescription kRules[] = {
    {"SUPPRESSION_INVALID", Severity::warning, "A wish to leave out a finding is not understood",
     "The finding is reported all the same, or the author believes that another one is left out.",
     "Give 'gltfx' in extras a list 'ignore' of objects with a 'code' and a 'reason'.",
     R"({"asset": {"version": "2.0"}, "nodes": [{"camera": 0, "extras": {"gltfx": {"ignore": [
 {"code": "UNUSED_OBJEKT", "reason": "The program picks it by its name."}]}}}], "scene": 0, "scenes": [{"nodes": [0]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     kGood, Fix::none, false},
    {"SUPPRESSION_UNUSED", Severity::info, "A wish to leave out a finding leaves nothing out",
     "What it was for is mended; left in place, it hides the next mistake of that kind.",
     "Remove the entry.",
     R"({"asset": {"version": "2.0", "extras": {"gltfx": {"ignore": [
 {"code": "EMPTY_ENTITY", "reason": "The exporter writes empty lists."}]}}}})",
     kGood, Fix::none, false},
    {"SUPPRESSION_WITHOUT_REASON", Severity::info, "A finding is left out without a reason",
     "Nobody can tell later whether it may be reported again.", "Say why in 'reason'.",
     R"({"asset": {"version": "2.0"}, "materials": [{"name": "spare", "extras": {"gltfx": {"ignore": [
 {"code": "UNUSED_OBJECT"}]}}}]})",
     kGood, Fix::none, false},
};

}  // namespace

const Family& suppression_family() {
  static const Family family{"suppression", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
