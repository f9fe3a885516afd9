// SPDX-License-Identifier: Apache-2.0
// The verbs that show assets, rules, engines, schemas and the configuration.
#include <utility>

#include "configuration.hpp"
#include "option_parts.hpp"
#include "option_values.hpp"
#include "schema_tests.hpp"
#include "target_choice.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {

void declare_inspect(Options& options, InspectRequest& request) {
  add_asset_arguments(options, request.paths);
  options.add("-f,--format", "NAME", "Output format: text (default), json, outline",
              one_of(request.format, {{"text", InspectFormat::text},
                                      {"json", InspectFormat::json},
                                      {"outline", InspectFormat::outline}}));
  options.add("--top", "N", "Rows per table, largest first (default: 10, 0: all)",
              number(request.most));
  options.add("--pixels", "LEVEL", "Decode images (json): headers (none), needed",
              one_of(request.inspect.pixels, {{"headers", false}, {"needed", true}}));
  add_search(options, request.paths);
  add_root(options, request.inspect.root);
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_quiet(options, request.quiet, "Print no notes");
  add_configuration(options);
  add_common(options, request.common);
}

void read_inspect(Reading& reading, InspectRequest&) {
  reading.require_inputs("inspect");
  reading.require_files("inspect");
  reading.read();
}

void declare_explain(Options& options, ExplainRequest& request) {
  options.positional("CODE", "Codes of rules, in any case",
                     list(request.codes, values::code_choice));
  add_own_rules(options, request.own_rules);
  add_configuration(options);
  add_color(options, request.common);
}

void read_explain(Reading& reading, ExplainRequest& request) {
  reading.require(!reading.options().arguments().words.empty(),
                  "explain: name a code; 'gltfx rules' lists them all.");
  reading.read();
  request.own_rules = reading.options().own_rules();
}

void declare_rules(Options& options, RulesRequest& request) {
  add_table_format(options, request.format);
  add_own_rules(options, request.own_rules);
  options.add("--test", "PATH", "Validate the examples of own rules (repeatable)",
              list(request.tests, values::pages));
  options.add("--new", "CODE", "Write a page of a rule to start with: CODE.md",
              text(request.new_page));
  options.add("--on", "KIND", "Kind of object of the new rule (default: node)",
              text(request.new_on, [] {
                const auto scopes = own_rule_scopes();
                return values::choice({scopes.begin(), scopes.end()});
              }));
  add_configuration(options);
  // A page is written before the configuration names it, and tested while others have mistakes.
  options.without_configuration = {"--new", "--test"};
  add_color(options, request.common);
}

void read_rules(Reading& reading, RulesRequest& request) {
  const Options& options = reading.options();
  reading.require(!options.given("--test") || !options.given("--new"),
                  "--test and --new are mutually exclusive.");
  reading.require(!options.given("--on") || options.given("--new"), "--on needs --new.");
  reading.read();
  request.own_rules = options.own_rules();
}

void declare_targets(Options& options, TargetsRequest& request) {
  options.positional("NAME[@VERSION]", "Engines and versions (default: the newest of each)",
                     list(request.names, values::target_choice));
  options.add("-f,--format", "NAME", "Output format: text (default), json or markdown",
              one_of(request.format, {{"text", MatrixFormat::text},
                                      {"json", MatrixFormat::json},
                                      {"markdown", MatrixFormat::markdown}}));
  options.add("--target", "NAME[@VERSION]", "An engine, as without the option",
              {.values = values::target_list, .repeatable = true});
  add_target_files(options);
  add_color(options, request.common);
}

void read_targets(Reading& reading, TargetsRequest& request) {
  reading.read();
  const Options& options = reading.options();
  const Words& files = options.words("--target-file");
  Words& names = request.names;
  names.insert(names.end(), options.words("--target").begin(), options.words("--target").end());
  if (names.empty()) names = target_names(files);
  auto choices = read_targets(names, files);
  reading.require(static_cast<bool>(choices), choices ? std::string() : choices.error().message);
  if (choices) request.choices = *std::move(choices);
}

void declare_schema(Options& options, SchemaRequest& request) {
  options.positional("NAME", "Extension or core type (default: list them)",
                     text(request.name, values::schema_choice));
  add_table_format(options, request.format);
  options.add("--status", "NAME", "Extensions of this status only (repeatable)",
              each_of(request.statuses, {{"ratified", schema::Status::ratified},
                                         {"release-candidate", schema::Status::release_candidate},
                                         {"draft", schema::Status::draft},
                                         {"legacy", schema::Status::legacy},
                                         {"archived", schema::Status::archived},
                                         {"registered-vendor", schema::Status::registered_vendor},
                                         {"vendor", schema::Status::vendor}}));
  options.add("--new", "NAME", "Print a schema to start with", text(request.new_name));
  options.add("--check", "FILE", "Check a schema file (repeatable)", list(request.check_files));
  options.add("--test", "FILE", "Run the tests of a schema file (repeatable)",
              list(request.test_files));
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_configuration(options);
  add_color(options, request.common);
}

void read_schema(Reading& reading, SchemaRequest& request) {
  const Options& options = reading.options();
  const std::size_t names = options.arguments().words.size();
  reading.require(names <= 1, "schema: name one extension or core type at a time.");
  const bool writes = options.given("--new");
  const bool checks = options.given("--check") || options.given("--test");
  reading.require(names + (writes ? 1U : 0U) + (checks ? 1U : 0U) <= 1,
                  "schema: use a name, --new, or --check and --test.");
  reading.read();
  reading.require(request.statuses.empty() || (names == 0 && !writes && !checks),
                  "--status: it chooses from the list of extensions.");
  reading.require(!writes || is_extension_name(request.new_name),
                  "--new: an extension is named PREFIX_name, such as ACME_leaf.");
}

void declare_measures(Options& options, MeasuresRequest& request) {
  options.positional("NAME", "Name of a measure (default: list them)",
                     text(request.name, values::measure_name));
  add_table_format(options, request.format);
  add_color(options, request.common);
}

void read_measures(Reading& reading, MeasuresRequest&) {
  reading.require(reading.options().arguments().words.size() <= 1,
                  "measures: name one measure at a time.");
  reading.read();
}

void declare_presets(Options& options, PresetsRequest& request) {
  options.positional("ID", "Identifier of a preset (default: list them)",
                     text(request.id, values::preset_choice));
  add_table_format(options, request.format);
  add_color(options, request.common);
}

void read_presets(Reading& reading, PresetsRequest&) {
  reading.require(reading.options().arguments().words.size() <= 1,
                  "presets: name one preset at a time.");
  reading.read();
}

void declare_config(Options& options, ConfigRequest& request) {
  options.positional("PATH", "Path, or import FILE of a Khronos tool", text(request.path, [] {
                       Values values = values::choice({"import"});
                       values.files = values.folders = true;
                       return values;
                     }));
  add_configuration(options);
  add_color(options, request.common);
}

void read_config(Reading& reading, ConfigRequest& request) {
  const Words& words = reading.options().arguments().words;
  const bool import = !words.empty() && words.front() == "import";
  reading.require(!import || words.size() == 2, "config: import takes one file.");
  reading.require(import || words.size() <= 1, "config: name one path at a time.");
  reading.read();
  if (import) request.import_file = std::exchange(request.path, {});
  request.choice = config_choice(reading.options());
}

}  // namespace gltfx::tool
