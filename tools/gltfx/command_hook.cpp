// SPDX-License-Identifier: Apache-2.0
/// `gltfx hook VERB`: runs a verb on the assets of a commit, and checks that the commit is
/// complete.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "container/container.hpp"
#include "json/parse.hpp"
#include "read_input.hpp"
#include "report/wording.hpp"
#include "schema/compile.hpp"
#include "staged_assets.hpp"
#include "steps/upgrade/plan.hpp"

namespace gltfx::tool {
namespace {

class Hook {
 public:
  Hook(HookRequest request, GitIndex index)
      : request_(std::move(request)), index_(std::move(index)), assets_(index_) {}

  ExitCode execute() {
    auto trouble = choose();
    if (!trouble && assets_.found().empty()) return code_;
    if (!trouble) trouble = run_verb();
    if (!trouble) trouble = check();
    if (!trouble) return code_;
    complain("hook: " + trouble->message);
    return worse(code_, ExitCode::unreadable);
  }

 private:
  bool quiet() const {
    return std::visit([](const auto& verb) { return verb.quiet; }, request_.verb);
  }
  bool fixes() const {
    const auto* upgrade = std::get_if<UpgradeRequest>(&request_.verb);
    const auto* fix = std::get_if<FixRequest>(&request_.verb);
    return (upgrade != nullptr && upgrade->upgrade.in_place) ||
           (fix != nullptr && fix->fix.in_place);
  }
  void say(const std::string& text) { code_ = worse(code_, print(text)); }
  void fail(const std::string& text) {
    say(text);
    code_ = worse(code_, ExitCode::findings);
  }
  std::string shown(const RepositoryName& name) const { return quoted(index_.path_of(name), 200); }

  NamedPaths& paths() {
    return std::visit([](auto& verb) -> NamedPaths& { return verb.paths; }, request_.verb);
  }

  std::optional<Error> choose() {
    auto staged = index_.staged();
    if (!staged) return staged.error();
    staged_ = *std::move(staged);
    std::set<RepositoryName> names;
    for (const auto& [name, letter] : staged_) names.insert(name);
    for (const std::string& path : paths().words) {
      auto name = index_.name_of(path);
      if (!name) return Error{quoted(path, 200) + " is outside the working tree"};
      names.insert(*std::move(name));
    }
    return assets_.find(names);
  }

  std::optional<Error> run_verb() {
    const auto before = index_.unstaged();
    if (!before) return before.error();
    paths() = {{}, true};
    std::vector<RepositoryName> half_staged;
    for (const RepositoryName& asset : assets_.found()) {
      paths().words.push_back(index_.path_of(asset));
      if (before->count(asset) == 0) continue;
      half_staged.push_back(asset);
      if (quiet()) continue;
      complain(
          fmt::format("note: {} differs from its staged version; the file in the folder is checked",
                      shown(asset)));
    }
    code_ = std::visit([](const auto& verb) { return run(verb); }, request_.verb);
    if (!fixes()) return std::nullopt;
    assets_.look_at_files(*before);
    const auto after = index_.unstaged();
    if (!after) return after.error();
    for (const RepositoryName& asset : assets_.found()) {
      if (after->count(asset) > before->count(asset)) to_stage_.push_back(asset);
    }
    return check_half_staged(half_staged);
  }

  // A user who stages a part of a file decides which other parts belong to the commit.
  std::optional<Error> check_half_staged(const std::vector<RepositoryName>& assets) {
    const auto* upgrade = std::get_if<UpgradeRequest>(&request_.verb);
    if (assets.empty() || upgrade == nullptr) return std::nullopt;
    const UpgradeRequest& request = *upgrade;
    auto schemas = load_schemas(request.schema_files, request.schema_folders);
    if (!schemas) return schemas.error();
    const auto set = *schemas ? *std::move(schemas) : schema::builtin_set();
    return index_.read(assets, [&](const RepositoryName& asset, std::string&& bytes) {
      const auto staged =
          container::open_bytes(container::Bytes::from_string(std::move(bytes)), asset);
      if (!staged.json) return;
      const json::Parsed parsed = json::parse(staged.json);
      if (parsed.document.empty()) return;
      UpgradeReport report;
      report.actions = upgrade::make_plan(parsed.document, *set, request.upgrade).actions;
      if (report.due() == 0) return;
      fail(
          fmt::format("{} is staged with legacy objects, and not all of its changes are staged: "
                      "stage what belongs to the commit ('git add -p')\n",
                      shown(asset)));
    });
  }

  std::optional<Error> check() {
    const auto found = check_commit(index_, assets_, staged_);
    if (!found) return found.error();
    for (const auto& [name, asset] : found->missing) {
      fail(fmt::format("{} refers to {}, which is neither in the repository nor in its folder\n",
                       shown(asset), shown(name)));
    }
    to_stage_.insert(to_stage_.end(), found->to_stage.begin(), found->to_stage.end());
    if (!quiet()) warn(*found);
    if (!to_stage_.empty()) name_what_is_to_be_staged();
    return std::nullopt;
  }

  void warn(const CommitCheck& found) {
    for (const auto& [name, asset] : found.ignored) {
      say(fmt::format("note: {} refers to {}, which .gitignore leaves out\n", shown(asset),
                      shown(name)));
    }
    for (const auto& [name, other] : found.not_lfs) {
      const std::size_t dot = name.rfind('.');
      const std::string pattern =
          dot == std::string::npos ? name : fmt::format("*{}", name.substr(dot));
      say(
          fmt::format("warning: {} would not be kept by Git LFS, as {} is; to change that:\n"
                      "  git lfs track {}\n",
                      shown(name), shown(other), shell_word(pattern)));
    }
  }

  void name_what_is_to_be_staged() {
    std::string line = "  git add --";
    for (const RepositoryName& name : to_stage_) {
      const std::string path = index_.path_of(name);
      const bool special = path.starts_with(':') || path.starts_with('-');  // to git, or to people
      line.append(1, ' ').append(shell_word(fmt::format("{}{}", special ? "./" : "", path)));
    }
    fail(fmt::format(
        "{} to be staged, without which the commit would be broken or out of date:\n"
        "{}\n",
        report::counted(to_stage_.size(), "file") + (to_stage_.size() == 1 ? " has" : " have"),
        line));
  }

  HookRequest request_;
  const GitIndex index_;
  StagedAssets assets_;
  std::map<RepositoryName, char> staged_;
  std::vector<RepositoryName> to_stage_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const HookRequest& request) {
  auto index = GitIndex::open();
  if (index) return Hook(request, *std::move(index)).execute();
  complain("hook: " + index.error().message);
  return ExitCode::unreadable;
}

}  // namespace gltfx::tool
