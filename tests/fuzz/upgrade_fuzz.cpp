// SPDX-License-Identifier: Apache-2.0
// Any document through the upgrade: the result is JSON, keeps what lies between the edits, and is
// settled after one run.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "change/diff.hpp"
#include "json/parse.hpp"
#include "schema/compile.hpp"
#include "steps/upgrade/choice.hpp"
#include "steps/upgrade/plan.hpp"

namespace {

using namespace gltfx;

void require(bool promise) {
  if (!promise) std::abort();
}

void check_edits(std::string_view text, const std::vector<json::Edit>& edits) {
  std::size_t at = 0;
  for (const json::Edit& edit : edits) {
    require(at <= edit.span.begin && edit.span.begin <= edit.span.end);
    at = edit.span.end;
  }
  require(at <= text.size());
}

std::ptrdiff_t count_left(const upgrade::Plan& plan) {
  return std::count_if(plan.actions.begin(), plan.actions.end(),
                       [](const UpgradeAction& action) { return !action.done; });
}

void check(std::string_view text, const UpgradeOptions& options) {
  const json::Parsed old = json::parse(text);
  if (!old.ok()) return;
  const schema::Set& set = *schema::builtin_set();
  const upgrade::Plan plan = upgrade::make_plan(old.document, set, options);
  check_edits(text, plan.change.edits);
  require(plan.change.edits.empty() == change::unified_diff(text, plan.change.edits, "x").empty());
  const std::string fresh = json::apply_edits(text, plan.change.edits);
  const json::Parsed parsed = json::parse(std::string_view(fresh));
  require(parsed.ok());
  const upgrade::Plan again = upgrade::make_plan(parsed.document, set, options);
  require(again.change.edits.empty());
  require(static_cast<std::ptrdiff_t>(again.actions.size()) == count_left(plan));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  UpgradeOptions options;
  check(text, options);
  options.unsafe = true;
  check(text, options);
  options.generation = "v2";
  check(text, options);
  options.only = upgrade::legacy_names(*schema::builtin_set());
  check(text, options);
  return 0;
}
