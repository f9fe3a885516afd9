// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "edit_run.hpp"
#include "schema/compile.hpp"
#include "schema_words.hpp"
#include "steps/upgrade/choice.hpp"
#include "upgrade_print.hpp"

namespace gltfx::tool {
namespace {

// An Error about the first unknown name.
std::optional<Error> unknown_name(std::string_view option, const std::vector<std::string>& wanted,
                                  const std::vector<std::string>& known) {
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    return Error{fmt::format("{}: {} is not one of {}.", option, gltfx::quoted(name),
                             fmt::join(known, ", "))};
  }
  return std::nullopt;
}

struct UpgradeVerb : EditVerb {
  using Request = UpgradeRequest;
  using Options = UpgradeOptions;
  using Report = UpgradeReport;
  using Summary = UpgradeSummary;
  static constexpr std::string_view external_assets = "external assets have legacy extensions, too";
  static constexpr auto run = upgrade_files;
  static constexpr auto text = upgrade_plan_text;
  static constexpr auto summary_text = upgrade_summary_text;
  static constexpr auto json = upgrade_json;
  static constexpr auto json_end = upgrade_json_end;

  static UpgradeOptions options_of(const UpgradeRequest& request) { return request.upgrade; }

  static std::optional<Error> check(UpgradeOptions& options) {
    if (!options.schemas) options.schemas = schema::builtin_set();
    const schema::Set& set = *options.schemas;
    for (auto problem : {unknown_name("--generation", {options.generation}, generation_names(set)),
                         unknown_name("--only", options.only, upgrade::legacy_names(set)),
                         unknown_name("--to", options.to, upgrade::successor_names(set))}) {
      if (problem) return problem;
    }
    return std::nullopt;
  }

  static void note_beside_diff(const UpgradeReport& report) {
    const std::string path = printable(report.path);
    for (const std::string& file : report.new_files) {
      complain(fmt::format("note: {}: the diff lacks the new file {}, which it refers to", path,
                           printable(file)));
    }
    for (const std::string& warning : report.new_warnings) {
      complain(fmt::format("note: {}: new warning: {}", path, printable(warning)));
    }
    if (!report.not_verified.empty()) {
      complain(fmt::format("note: {}: not verified: {}", path, printable(report.not_verified)));
    }
  }

  static bool is_finding(const UpgradeReport& report, const UpgradeRequest& request, bool writing) {
    return (writing && report.left() > 0) || (request.check && report.due() > 0);
  }
};

}  // namespace

ExitCode run(const UpgradeRequest& request) { return run_edit<UpgradeVerb>(request); }

}  // namespace gltfx::tool
