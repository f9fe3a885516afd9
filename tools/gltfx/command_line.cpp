// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.hpp"
#include "command_table.hpp"
#include "configuration.hpp"
#include "folder_walk.hpp"
#include "help_text.hpp"
#include "input_walk.hpp"
#include "option_check.hpp"
#include "option_values.hpp"
#include "suggestion.hpp"
#include "verb_options.hpp"
#include "version.hpp"

namespace gltfx::tool {

namespace {

Answer usage_error(std::string_view verb, std::string_view problem) {
  const std::string command = verb.empty() ? "gltfx" : fmt::format("gltfx {}", verb);
  return {{}, fmt::format("gltfx: {}\nSee '{} --help'.\n", problem, command), ExitCode::usage};
}

// Without allow_extra_args(false), a repeatable option would take all positionals after its value.
void tell_cli(CLI::App& app, Option& row) {
  std::string names(row.short_name);
  if (!names.empty()) names += ',';
  names += row.name;
  const std::string text(row.text), type(row.type);
  const auto take = [&row](const Words& words) {
    row.words = words;
    row.given = true;
  };
  if (!row.takes_value()) {
    app.add_flag_callback(
        names, [take] { take({"true"}); }, text);
  } else if (row.repeatable) {
    app.add_option_function<Words>(names, take, text)->type_name(type)->allow_extra_args(false);
  } else {
    const auto take_one = [take](const std::string& word) { take({word}); };
    app.add_option_function<std::string>(names, take_one, text)->type_name(type)->take_last();
  }
}

// CLI11 gets positionals for the help only: it parses "[a].gltf" as a list, so they are declared
// without values and taken from the remaining words.
void tell_cli(CLI::App& app, Options& options) {
  const Option& arguments = options.arguments();
  if (!arguments.name.empty()) {
    app.add_option(std::string(arguments.name))
        ->description(std::string(arguments.text))
        ->type_name("...")
        ->expected(0);
  }
  for (Option& row : options.rows()) {
    if (!row.file_only) tell_cli(app, row);
  }
}

struct Verb {
  const char* name;
  const char* text;
  Options options = {};
  std::function<CommandLine()> request = {};
};

// All verbs, and the options of those in the words: declaring the options of all verbs takes longer
// than the rest of a short run. Without words, each verb has its options.
class Declaration {
 public:
  explicit Declaration(std::span<const char* const> words) : words_(words) {
    app_.allow_extras();
    // With at most one verb, a path with the name of a verb stays a path.
    app_.require_subcommand(0, 1);
    app_.get_formatter()->column_width(28);
    app_.footer([] { return help_footer(""); });
    program_.add("-V,--version", "", "Print the versions of gltfx and its libraries", {});
    tell_cli(app_, program_);
    verb("validate", "Validate .gltf, .glb and .vrm files", declare_validate, read_validate);
    verb("fix", "Fix what a program can fix with certainty", declare_fix, read_fix);
    verb("upgrade", "Upgrade legacy extensions to their successors", declare_upgrade, read_upgrade);
    verb("edit", "Delete objects and renumber what refers to others", declare_edit, read_edit);
    verb("convert", "Store assets as GLB, with files or with data URIs", declare_convert,
         read_convert);
    verb("compare", "Tell what changed between two assets", declare_compare, read_compare);
    add_hook();
    verb("bake", "Render previews of assets", declare_bake, read_bake);
    verb("report", "Write an HTML page: findings, previews, sizes", declare_report, read_report);
    verb("inspect", "Show the content of assets and its size", declare_inspect, read_inspect);
    verb("merge", "Merge the reports of several runs", declare_merge, read_merge);
    verb("explain", "Explain a rule, with a bad and a good example", declare_explain, read_explain);
    verb("rules", "List all rules", declare_rules, read_rules);
    verb<TargetsRequest>("targets", "Show what engines do with features of glTF", declare_targets,
                         read_targets);
    verb("schema", "Show the schemas of extensions and core types", declare_schema, read_schema);
    verb("measures", "List what can be measured and limited", declare_measures, read_measures);
    verb("presets", "List published limits with source and date", declare_presets, read_presets);
    verb("config", "Show the configuration of a path and its source", declare_config, read_config);
  }

  CommandLine read(int argc, const char* const* argv);
  std::vector<CommandEntry> table() const;

 private:
  template <class Wanted>
  void verb(const char* name, const char* text, void (*declare)(Options&, Wanted&),
            void (*finish)(Reading&, Wanted&));
  void add_hook();
  CLI::App& add_app(const Verb& verb);
  bool is_wanted(std::string_view verb) const {
    return words_.empty() || std::find(words_.begin(), words_.end(), verb) != words_.end();
  }
  std::vector<std::string> with_values(const std::vector<std::string>& words) const;
  std::string help() const;
  std::string take_positionals();
  Verb* find_verb(std::string_view name);
  std::string unknown_verb(const std::string& word) const;
  std::string verb_among(const std::vector<std::string>& words) const;

  std::span<const char* const> words_;
  CLI::App app_{
      "Validates and fixes glTF 2.0 assets, upgrades legacy extensions and renders previews.",
      "gltfx"};
  std::vector<std::string> after_mark_;  ///< words after "--": never options
  Options program_;
  std::deque<Verb> verbs_;
};

CLI::App& Declaration::add_app(const Verb& verb) {
  CLI::App& app = *app_.add_subcommand(verb.name, verb.text);
  app.allow_extras();
  app.footer([name = verb.name] { return help_footer(name); });
  return app;
}

// Built in place: g++ 12 warns of a moved temporary that it takes for uninitialised.
template <class Wanted>
CommandLine read_request(const Verb& verb, Options& options, Wanted& wanted,
                         void (*read)(Reading&, Wanted&)) {
  if (const auto mistake = configure(options)) return usage_error(verb.name, mistake->message);
  Reading reading(options);
  read(reading, wanted);
  if (!reading.problem().empty()) return usage_error(verb.name, reading.problem());
  return CommandLine(std::in_place_type<Request>, std::in_place_type<Wanted>, std::move(wanted));
}

template <class Wanted>
void Declaration::verb(const char* name, const char* text, void (*declare)(Options&, Wanted&),
                       void (*finish)(Reading&, Wanted&)) {
  Verb& verb = verbs_.emplace_back();
  verb.name = name;
  verb.text = text;
  CLI::App& app = add_app(verb);
  if (!is_wanted(name)) return;
  const auto wanted = std::make_shared<Wanted>();
  declare(verb.options, *wanted);
  tell_cli(app, verb.options);
  verb.request = [&verb, wanted, finish] {
    return read_request(verb, verb.options, *wanted, finish);
  };
}

// For the help: read() removes the word, so that the verb after it has its own options.
void Declaration::add_hook() {
  Verb& verb = verbs_.emplace_back();
  verb.name = "hook";
  verb.text = "Run a command on the assets of a commit";
  CLI::App& app = add_app(verb);
  if (!is_wanted(verb.name)) return;
  verb.options.positional("VERB", "Command to run, with its options", {.values = [] {
                            return values::choice({"validate", "fix", "upgrade"});
                          }});
  tell_cli(app, verb.options);
  verb.request = [] {
    return usage_error("hook",
                       "hook: name the verb to run: validate, fix or upgrade, with its options.");
  };
}

CommandEntry entry_of(std::string name, std::string text, const Options& options) {
  OptionEntry help;
  help.short_name = "-h";
  help.name = "--help";
  help.text = "Print this help message and exit";
  CommandEntry entry{std::move(name), std::move(text), options.arguments(), {std::move(help)}};
  for (const Option& row : options.rows()) {
    if (!row.file_only) entry.options.push_back(row);
  }
  return entry;
}

std::vector<CommandEntry> Declaration::table() const {
  std::vector<CommandEntry> table{entry_of({}, app_.get_description(), program_)};
  for (const Verb& verb : verbs_) table.push_back(entry_of(verb.name, verb.text, verb.options));
  return table;
}

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
  std::vector<std::string_view> names;
  for (const Verb& verb : verbs_) names.emplace_back(verb.name);
  std::string hint = suggestion(word, names);
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

// Distributes the remaining words of CLI11: positionals to their verb, others to an error message.
// Returns the message, or an empty text.
std::string Declaration::take_positionals() {
  if (const auto left = app_.remaining(); !left.empty()) {
    return is_option(left.front()) ? unknown_option(app_, left.front())
                                   : unknown_verb(left.front());
  }
  if (app_.get_subcommands().empty()) return {};
  const CLI::App& verb = *app_.get_subcommands().front();
  Option& arguments = find_verb(verb.get_name())->options.arguments();
  std::vector<std::string> taken = verb.remaining();
  for (const std::string& word : taken) {
    if (is_option(word)) return unknown_option(verb, word);
  }
  taken.insert(taken.end(), after_mark_.begin(), after_mark_.end());
  if (std::find(taken.begin(), taken.end(), "") != taken.end()) return empty_argument();
  if (!arguments.read && !taken.empty()) {
    return fmt::format("{}: unexpected argument {}.", verb.get_name(),
                       gltfx::quoted(taken.front()));
  }
  arguments.words = std::move(taken);
  return {};
}

Verb* Declaration::find_verb(std::string_view name) {
  const auto found = std::find_if(verbs_.begin(), verbs_.end(),
                                  [&](const Verb& verb) { return verb.name == name; });
  return found == verbs_.end() ? nullptr : &*found;
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

// The verb that the words name, or an empty text.
std::string Declaration::verb_among(const std::vector<std::string>& words) const {
  for (const std::string& word : words) {
    for (const Verb& verb : verbs_) {
      if (verb.name == word) return word;
    }
  }
  return {};
}

// The words with the values of options that may do without one, each in the word of its option.
std::vector<std::string> Declaration::with_values(const std::vector<std::string>& words) const {
  const auto is_optional = [this](const std::string& word) {
    return std::any_of(verbs_.begin(), verbs_.end(), [&](const Verb& verb) {
      const auto& rows = verb.options.rows();
      return std::any_of(rows.begin(), rows.end(), [&](const Option& row) {
        return row.name == word && row.is_value_optional();
      });
    });
  };
  const auto is_value = [](const std::string& word) {
    return word.find('=') != std::string::npos && word.front() != '-' &&
           word.find('/') > word.find('=') && !is_asset_name(word);
  };
  std::vector<std::string> all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    all.push_back(words[i]);
    if (!is_optional(words[i])) continue;
    const bool follows = i + 1 < words.size() && is_value(words[i + 1]);
    all.back().append("=").append(follows ? words[++i] : kNoValue);
  }
  return all;
}

// Git appends names of files to its commands, which may look like options. Where they begin, or the
// end.
const char* const* words_of_git(const char* const* begin, const char* const* end) {
  for (const char* const* word = begin; word != end; ++word) {
    const auto rest = end - word - 1;
    const bool one = rest == 1 && is_asset_name(word[1]);
    const bool driver =
        *word == std::string_view("--git-driver") && (one || rest == 7 || rest == 9);
    if (driver || (one && *word == std::string_view("outline"))) return word + 1;
  }
  return end;
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
    for (Verb& verb : verbs_) verb.options.hook = true;
  }
  const char* const* mark =
      std::find(argv + std::min(argc, 1), argv + argc, std::string_view("--"));
  if (mark != argv + argc) {
    after_mark_.assign(mark + 1, argv + argc);
  } else {
    mark = words_of_git(argv + std::min(argc, 1), mark);
    after_mark_.assign(mark, argv + argc);
  }
  argc = static_cast<int>(mark - argv);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (const std::string problem = option_mistake(table(), words); !problem.empty()) {
    return usage_error(verb_among(words), problem);
  }
  const std::vector<std::string> complete = with_values(words);
  std::vector<const char*> parsed{argc > 0 ? argv[0] : "gltfx"};
  for (const std::string& word : complete) parsed.push_back(word.c_str());
  try {
    app_.parse(static_cast<int>(parsed.size()), parsed.data());
  } catch (const CLI::CallForHelp&) {
    return Answer{help(), {}, ExitCode::ok};
  } catch (const CLI::ParseError&) {
    // No input that option_mistake() accepts is known to reach this; the messages of CLI11 are not
    // for users.
    return usage_error(verb_among(words), "the arguments cannot be understood.");
  }
  const auto verbs = app_.get_subcommands();
  const std::string verb = verbs.empty() ? std::string() : verbs.front()->get_name();
  if (const std::string problem = take_positionals(); !problem.empty()) {
    return usage_error(verb, problem);
  }
  if (program_.given("--version")) return Answer{version_text(), {}, ExitCode::ok};
  if (verbs.empty()) return Answer{{}, help(), ExitCode::usage};
  CommandLine line = find_verb(verb)->request();
  return hook ? hooked(std::move(line)) : line;
}

}  // namespace

std::vector<CommandEntry> command_table() { return Declaration({}).table(); }

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
