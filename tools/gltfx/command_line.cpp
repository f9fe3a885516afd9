// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.hpp"
#include "command_line_parts.hpp"
#include "command_table.hpp"
#include "configuration.hpp"
#include "help_text.hpp"
#include "input_walk.hpp"
#include "option_check.hpp"
#include "raw_options.hpp"
#include "suggestion.hpp"
#include "version.hpp"

namespace gltfx::tool {

namespace {

// Everything CLI11 is told. Only verbs that are among the words get their options: to declare those
// of all verbs takes longer than the rest of a short run. Without words, all verbs get theirs.
class Declaration {
 public:
  explicit Declaration(std::span<const char* const> words) : words_(words) {
    app_.allow_extras();
    // With one verb at most, a path that is called like a verb stays a path.
    app_.require_subcommand(0, 1);
    app_.get_formatter()->column_width(28);
    app_.footer([] { return help_footer(""); });
    app_.add_flag("-V,--version", version_, "Print the versions of gltfx and its libraries");
    verb("validate", "Validate .gltf, .glb and .vrm files", declare_validate, validate_);
    verb("fix", "Fix what a program can fix with certainty", declare_fix, fix_);
    verb("upgrade", "Upgrade legacy extensions to their successors", declare_upgrade, upgrade_);
    verb("edit", "Delete objects and renumber what refers to others", declare_edit, edit_);
    // For the help: read() takes the word away, so that the verb behind it has its own options.
    verb("hook", "Run a command on the assets of a commit", describe_positional, "VERB",
         "Command to run, with its options");
    verb("bake", "Render previews of assets", declare_bake, bake_);
    verb("report", "Write an HTML page: findings, previews, sizes", declare_report, report_);
    verb("inspect", "Show the content of assets and its size", declare_inspect, inspect_);
    verb("merge", "Merge the reports of several runs", declare_merge, merge_);
    verb("explain", "Explain a rule, with a bad and a good example", declare_explain, explain_);
    verb("rules", "List all rules", declare_rules, rules_);
    verb("targets", "Show what engines do with features of glTF", declare_targets, targets_);
    verb("schema", "Show the schemas of extensions and core types", declare_schema, schema_);
    verb("config", "Show the configuration of a path and its source", declare_config, config_);
  }

  CommandLine read(int argc, const char* const* argv);
  const CLI::App& app() const { return app_; }

 private:
  template <class... Options>
  void verb(const char* name, const char* text, void (*declare)(CLI::App&, Options...),
            std::type_identity_t<Options>... options) {
    CLI::App& app = *app_.add_subcommand(name, text);
    app.allow_extras();
    app.footer([name] { return help_footer(name); });
    const bool among_words =
        std::find(words_.begin(), words_.end(), std::string_view(name)) != words_.end();
    if (among_words || words_.empty()) declare(app, options...);
  }
  std::string help() const;
  std::string take_positionals();
  std::vector<std::string>* positionals(std::string_view verb);
  std::string unknown_verb(const std::string& word) const;
  std::string verb_among(const std::vector<std::string>& words) const;
  CommandLine request(std::string_view verb) const;

  std::span<const char* const> words_;
  CLI::App app_{
      "Validates and fixes glTF 2.0 assets, upgrades legacy extensions and renders previews.",
      "gltfx"};
  std::vector<std::string> after_mark_;  ///< what follows "--": never options
  bool version_ = false;
  RawValidateOptions validate_;
  RawMergeOptions merge_;
  RawFixOptions fix_;
  RawUpgradeOptions upgrade_;
  RawDeleteOptions edit_;
  RawBakeOptions bake_;
  RawInspectOptions inspect_;
  RawPageOptions report_;
  RawExplainOptions explain_;
  RawRulesOptions rules_;
  RawTargetsOptions targets_;
  RawSchemaOptions schema_;
  RawConfigOptions config_;
};

std::string unknown_option(const CLI::App& app, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& long_name : option->get_lnames()) names.push_back("--" + long_name);
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const std::string hint = is_asset_name(word)
                               ? fmt::format(" Write './{}' for a file.", printable(word))
                               : suggestion(name, candidates);
  return fmt::format("unknown option {}.{}", gltfx::quoted(name), hint);
}

std::string Declaration::unknown_verb(const std::string& word) const {
  std::vector<std::string> names;
  for (const CLI::App* verb : app_.get_subcommands(nullptr)) names.push_back(verb->get_name());
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  std::string hint = suggestion(word, candidates);
  const bool path = is_asset_name(word) || word.ends_with("/");
  if (path) hint = fmt::format(" Did you mean 'gltfx validate {}'?", printable(word));
  return fmt::format("unknown verb {}.{}", gltfx::quoted(word), hint);
}

// The help of the verb if there is one, ending in one line break.
std::string Declaration::help() const {
  std::string text = app_.help();
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

// Distributes what CLI11 put aside: positionals to their verb, the rest to a complaint (or empty).
std::string Declaration::take_positionals() {
  if (const auto left = app_.remaining(); !left.empty()) {
    return is_option(left.front()) ? unknown_option(app_, left.front())
                                   : unknown_verb(left.front());
  }
  if (app_.get_subcommands().empty()) return {};
  const CLI::App& verb = *app_.get_subcommands().front();
  std::vector<std::string>* words = positionals(verb.get_name());
  std::vector<std::string> taken = verb.remaining();
  for (const std::string& word : taken) {
    if (is_option(word)) return unknown_option(verb, word);
  }
  taken.insert(taken.end(), after_mark_.begin(), after_mark_.end());
  if (std::find(taken.begin(), taken.end(), "") != taken.end()) return empty_argument();
  if (words == nullptr && !taken.empty()) {
    return fmt::format("{}: unexpected argument {}.", verb.get_name(),
                       gltfx::quoted(taken.front()));
  }
  if (words != nullptr) *words = std::move(taken);
  return {};
}

std::vector<std::string>* Declaration::positionals(std::string_view verb) {
  if (verb == "validate") return &validate_.inputs.paths;
  if (verb == "fix") return &fix_.inputs.paths;
  if (verb == "upgrade") return &upgrade_.inputs.paths;
  if (verb == "edit") return &edit_.inputs.paths;
  if (verb == "bake") return &bake_.inputs.paths;
  if (verb == "merge") return &merge_.files;
  if (verb == "inspect") return &inspect_.paths;
  if (verb == "report") return &report_.validate.inputs.paths;
  if (verb == "explain") return &explain_.codes;
  if (verb == "targets") return &targets_.names;
  if (verb == "config") return &config_.words;
  return verb == "schema" ? &schema_.names : nullptr;
}

Answer usage_error(std::string_view verb, std::string_view problem) {
  const std::string command = verb.empty() ? "gltfx" : fmt::format("gltfx {}", verb);
  return {{}, fmt::format("gltfx: {}\nSee '{} --help'.\n", problem, command), ExitCode::usage};
}

// Built in place: g++ 12 warns of a moved temporary that it takes for uninitialised.
template <class Wanted>
CommandLine command_of(std::string_view verb, Result<Wanted> wanted) {
  if (!wanted) return usage_error(verb, wanted.error().message);
  return CommandLine(std::in_place_type<Request>, std::in_place_type<Wanted>, *std::move(wanted));
}

CommandLine hooked(CommandLine line) {
  auto* wanted = std::get_if<Request>(&line);
  if (wanted == nullptr) return line;
  if (auto* validate = std::get_if<ValidateRequest>(wanted)) {
    return Request(HookRequest{std::move(*validate)});
  }
  if (auto* fix = std::get_if<FixRequest>(wanted)) {
    return Request(HookRequest{std::move(*fix)});
  }
  if (auto* upgrade = std::get_if<UpgradeRequest>(wanted)) {
    return Request(HookRequest{std::move(*upgrade)});
  }
  return usage_error("hook", "hook: only validate, fix and upgrade go with it.");
}

CommandLine Declaration::request(std::string_view verb) const {
  if (verb == "hook") {
    return usage_error(verb,
                       "hook: name the verb to run: validate, fix or upgrade, with its options.");
  }
  if (verb == "validate") return command_of(verb, configured(validate_));
  if (verb == "fix") return command_of(verb, configured(fix_));
  if (verb == "upgrade") return command_of(verb, configured(upgrade_));
  if (verb == "edit") return command_of(verb, configured(edit_));
  if (verb == "bake") return command_of(verb, configured(bake_));
  if (verb == "report") return command_of(verb, configured(report_));
  if (verb == "inspect") return command_of(verb, configured(inspect_));
  if (verb == "merge") return command_of(verb, request_of(merge_));
  if (verb == "explain") return command_of(verb, request_of(explain_));
  if (verb == "rules") return command_of(verb, request_of(rules_));
  if (verb == "targets") return command_of(verb, request_of(targets_));
  if (verb == "config") return command_of(verb, request_of(config_));
  return command_of(verb, configured(schema_));
}

// The verb that the words name, or an empty text.
std::string Declaration::verb_among(const std::vector<std::string>& words) const {
  for (const std::string& word : words) {
    for (const CLI::App* verb : app_.get_subcommands(nullptr)) {
      if (verb->get_name() == word) return word;
    }
  }
  return {};
}

CommandLine Declaration::read(int argc, const char* const* argv) {
  if (argc > 1 && argv[1] == std::string_view("help")) {
    const std::vector<const char*> words{argv[0], argc > 2 ? argv[2] : "--help", "--help"};
    return read(static_cast<int>(words.size()), words.data());
  }
  const bool hook = argc > 2 && argv[1] == std::string_view("hook") && argv[2][0] != '-';
  if (hook) {
    --argc;
    ++argv;
    validate_.hook = fix_.hook = upgrade_.hook = true;
  }
  const char* const* mark =
      std::find(argv + std::min(argc, 1), argv + argc, std::string_view("--"));
  if (mark != argv + argc) after_mark_.assign(mark + 1, argv + argc);
  argc = static_cast<int>(mark - argv);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (const std::string problem = option_mistake(table_of(app_), words); !problem.empty()) {
    return usage_error(verb_among(words), problem);
  }
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Answer{help(), {}, ExitCode::ok};
  } catch (const CLI::ParseError&) {
    // Nothing that option_mistake() lets pass is known to come here; the words of CLI11 are not for
    // users.
    return usage_error(verb_among(words), "the arguments cannot be understood.");
  }
  const auto verbs = app_.get_subcommands();
  const std::string verb = verbs.empty() ? std::string() : verbs.front()->get_name();
  if (const std::string problem = take_positionals(); !problem.empty()) {
    return usage_error(verb, problem);
  }
  if (version_) return Answer{version_text(), {}, ExitCode::ok};
  if (verbs.empty()) return Answer{{}, help(), ExitCode::usage};
  return hook ? hooked(request(verb)) : request(verb);
}

}  // namespace

std::vector<CommandEntry> command_table() { return table_of(Declaration({}).app()); }

CommandLine read_command_line(int argc, const char* const* argv) {
  try {
    return Declaration({argv, static_cast<std::size_t>(argc)}).read(argc, argv);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return Answer{{}, fmt::format("gltfx: {}\n", printable(error.what())), ExitCode::internal};
  }
}

}  // namespace gltfx::tool
