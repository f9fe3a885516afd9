// SPDX-License-Identifier: Apache-2.0
// The options of `gltfx compare`.
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/loss_bounds.hpp"
#include "base/text.hpp"
#include "configuration.hpp"
#include "option_parts.hpp"
#include "option_values.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {
namespace {

// "position=0.1%,normal=2deg". The others keep their defaults; "off": only equal values.
Result<CompareBounds> parse_compare_bounds(std::string_view option, std::string_view text) {
  const CompareBounds usual;
  if (text == kNoValue) return usual;
  LossBounds loss{usual.position, usual.normal, usual.texcoord,
                  usual.color,    usual.weight, usual.animation};
  std::optional<double> factor = usual.factor, image = usual.image;
  std::vector<NamedBound> bounds = named_bounds(loss);
  bounds.push_back({"factor", "", 1, "0.5/255", &factor});
  bounds.push_back({"image", "", 1, "1/255", &image});
  if (const auto mistake = read_bounds(text, bounds)) return mistake_in(option, *mistake);
  return CompareBounds{loss.position.value_or(0), loss.normal.value_or(0),
                       loss.texcoord.value_or(0), loss.color.value_or(0),
                       loss.weight.value_or(0),   loss.animation.value_or(0),
                       factor.value_or(0),        image.value_or(0)};
}

using Kinds = std::set<std::string, std::less<>>;

Result<Kinds> parse_kinds(std::string_view option, const Words& words) {
  Kinds kinds;
  for (const std::string& word : words) {
    if (find_change_kind(word) == nullptr) {
      std::vector<std::string_view> names;
      for (const ChangeKind& kind : change_kinds()) names.push_back(kind.name);
      return unknown_word(option, word, names);
    }
    kinds.insert(word);
  }
  return kinds;
}

Values kind_values() {
  Values values;
  for (const ChangeKind& kind : change_kinds()) values.words.words.emplace_back(kind.name);
  values.words.name = "kinds";
  return values;
}

// Git gives seven arguments, nine for a rename, and one for a file of an unfinished merge; its
// difftool gives three.
bool is_driver_call(std::size_t words) {
  return words == 7 || words == 9 || words == 1 || words == 3;
}

}  // namespace

void declare_compare(Options& options, CompareRequest& request) {
  CompareOptions& compare = request.compare;
  options.positional("OLD NEW", "Two files, or two folders, paired by path",
                     list(request.paths, values::assets));
  options.add("--allow", "LEVEL", "Exit 0 up to identical, storage, bounds or differs",
              one_of(request.allow, {{"identical", CompareLevel::identical},
                                     {"storage", CompareLevel::storage},
                                     {"bounds", CompareLevel::bounds},
                                     {"differs", CompareLevel::differs}}));
  options.add("--bounds", "[LIST]", "Allow bounds; change some: position=0.1%,normal=2deg",
              parsed(compare.bounds, parse_compare_bounds));
  options.add("--drawn", "", "Count only what is drawn: no names, no extras", flag(compare.drawn));
  options.add("--ignore", "KIND", "Do not count this kind of change (repeatable)",
              parsed_list(compare.ignore, parse_kinds, kind_values));
  options.add("--count", "KIND", "Count this kind, such as generator (repeatable)",
              parsed_list(compare.count, parse_kinds, kind_values));
  options.add("--format", "NAME", "text (default), json, markdown",
              one_of(request.format, {{"text", CompareFormat::text},
                                      {"json", CompareFormat::json},
                                      {"markdown", CompareFormat::markdown}}));
  options.add("-o,--output", "FILE", "Output file: .html is a page with pictures",
              text(request.output, [] { return values::files({"html"}); }));
  options.add("--pictures", "DIR", "Write pictures of both assets and of what differs",
              text(request.pictures, values::folder));
  options.add("--picture-url", "PREFIX", "Prefix of links to pictures in Markdown",
              text(request.picture_url));
  options.add("--size", "N", "Pixels along the sides of pictures (256)",
              number(compare.picture_size, 32, kMostComparePicture));
  options.add("--all", "", "List all changes, not only the first 40", flag(request.all));
  options.add("--git", "RANGE", "Changed assets: since BASE, or of A..B, A...B", text(request.git));
  options.add("--git-driver", "", "Print one file for 'git diff'; arguments follow",
              flag(request.git_driver));
  options.add("--setup-git", "", "Let 'git diff' compare assets in this repository",
              flag(request.setup_git));
  options.add("--global", "", "With --setup-git: in all repositories of the user",
              flag(request.global));
  add_root(options, compare.root);
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_configuration(options);
  add_decoders(options, request.common);
  add_common(options, request.common);
}

void read_compare(Reading& reading, CompareRequest& request) {
  const Options& options = reading.options();
  const std::size_t words = options.arguments().words.size();
  const bool git = options.given("--git");
  const bool driver = options.given("--git-driver");
  const bool setup = options.given("--setup-git");
  reading.require(git + driver + setup <= 1,
                  "--git, --git-driver and --setup-git are mutually exclusive.");
  reading.require(setup || !options.given("--global"), "--global goes with --setup-git.");
  reading.require(!(git || driver) || !options.given("--root"),
                  "--root goes with files; the assets of a repository are inside of it.");
  if (driver) {
    reading.require(is_driver_call(words),
                    "--git-driver: git gives 7 or 9 arguments, or 3 for a difftool.");
  } else if (setup) {
    reading.require(words == 0, "--setup-git takes no paths.");
  } else if (!git) {
    reading.require(words == 2, "compare: name two assets, or two folders: OLD NEW.");
  }
  reading.require_files("compare");
  const auto given = [&](std::string_view name) { return reading.options().given(name); };
  reading.require(given("--pictures") || !given("--picture-url"),
                  "compare: --picture-url is for the files of --pictures DIR.");
  reading.read();
  const bool page = ending_of(request.output) == ".html";
  reading.require(given("--pictures") || page || !given("--size"),
                  "compare: --size is for --pictures DIR, or a page: --output FILE.html.");
  if (request.output == "-") request.output.clear();
  const bool draws = !request.pictures.empty() || page;
  if (draws && request.compare.picture_size == 0) request.compare.picture_size = 256;
  request.has_bounds = reading.options().given("--bounds");
}

}  // namespace gltfx::tool
