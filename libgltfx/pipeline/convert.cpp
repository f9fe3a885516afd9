// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/apply.hpp"
#include "change/chain.hpp"
#include "pipeline/change_check.hpp"
#include "pipeline/convert_form.hpp"
#include "pipeline/convert_places.hpp"
#include "pipeline/convert_savings.hpp"
#include "pipeline/convert_targets.hpp"
#include "pipeline/edit_bytes.hpp"
#include "pipeline/edit_files.hpp"
#include "pipeline/external_needs.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/picture_check.hpp"
#include "pipeline/run_within_bounds.hpp"
#include "prove/findings.hpp"
#include "prove/meaning.hpp"
#include "rules/validated_asset.hpp"
#include "schema/compile.hpp"
#include "steps/image_encodings.hpp"
#include "steps/layout.hpp"
#include "steps/stages.hpp"
#include "steps/step.hpp"
#include "steps/stored_size.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

using model::OpenedAsset;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;
using Reason = std::optional<std::string>;

std::string with_place(const ConvertNote& note) {
  return note.pointer.empty() ? note.reason : fmt::format("{}: {}", note.pointer, note.reason);
}

// In degrees: a direction whose length becomes 1 is rounded.
constexpr double kRoundedDirection = 1e-4;

/// Used by all assets of a run.
struct Shared {
  FolderIndex& folders;
  steps::ImageEncodings& encodings;
};

/// One asset on its way through the steps.
class ConvertRun {
 public:
  /// `pictures` may be null.
  ConvertRun(const OpenedAsset& before, const FileState& state, const ConvertOptions& options,
             const SchemaSet& schemas, const PictureCheck* pictures, const ConvertTargets& targets,
             const Shared& shared, ConvertReport& report)
      : before_(before),
        state_(state),
        options_(options),
        schemas_(schemas),
        pictures_(pictures),
        targets_(targets),
        shared_(shared),
        report_(report),
        stages_(before) {}

  std::optional<Draft> run() {
    if (auto why = find_edit_obstacle(before_)) return refuse(*std::move(why));
    if (changes_container_in_place()) return refuse("in place, an asset keeps its container");
    const std::vector<steps::StepDescription> list = steps::steps();
    for (const steps::StepDescription& step : list) {
      const bool is_last = &step == &list.back();
      if (is_last) {
        if (auto why = lay_out()) return refuse(*std::move(why));
      }
      if (!step.asked(options_) && !targets_.need(step)) continue;
      if (auto why = resolve()) return refuse(*std::move(why));
      if (auto why = take(step)) return refuse(*std::move(why));
    }
    change::NewText now = change::drop_unnamed_files(stages_.all(), *before_.container().json);
    const change::Change& change = stages_.all();
    report_.changes = !change.empty();
    if (asks_nothing(options_)) {
      find_savings(before_, *schemas_, options_, shared_.encodings, report_);
    }
    if (options_.diff) report_.diff = diff_of(before_, change.edits, !change.format);
    if (auto why = targets_.check(before_, change, report_)) return refuse(*std::move(why));
    if (!report_.changes) {
      copy_unchanged(before_, state_, options_, report_);
      return std::nullopt;
    }
    if (auto why = find_taken_name(before_, options_, stages_.all().files))
      return refuse(*std::move(why));
    if (auto why = find_other_reader(before_, options_, stages_.all().replaced, shared_.folders))
      return refuse(*std::move(why));
    for (const change::NewFile& file : change.files) report_.new_files.push_back(file.path);
    auto draft = carry_out(
        {before_, state_, options_, schemas_, shared_.folders, options_.jobs},
        std::move(stages_.all()), [this](const ValidatedAsset& after) { return find_error(after); },
        report_, std::move(now));
    if (!draft) forget_changes();
    return draft;
  }

 private:
  bool changes_container_in_place() const {
    const bool is_glb = before_.container().format == container::Format::glb;
    return options_.in_place && options_.to && (options_.to == StoredAs::glb) != is_glb;
  }

  // Of the new asset.
  std::string file_name() const {
    if (!options_.output.empty()) return fs::path(options_.output).filename().native();
    fs::path name = fs::path(before_.name()).filename();
    if (options_.to) name.replace_extension(options_.to == StoredAs::glb ? ".glb" : ".gltf");
    return name.native();
  }

  std::nullopt_t refuse(std::string why) {
    note_failure(report_, EditProblem::refused, std::move(why));
    forget_changes();
    return std::nullopt;
  }

  // Nothing came of the steps.
  void forget_changes() {
    for (ConvertStep& row : report_.steps) {
      row.changes = false;
      row.bytes_after = row.bytes_before;
    }
    report_.new_files.clear();
    report_.new_warnings.clear();
  }

  // Runs a step on what the steps before made; why all is refused, or nothing.
  Reason take(const steps::StepDescription& step) {
    ConvertStep& row = report_.steps.emplace_back();
    row.step = step.name;
    const bool first = report_.steps.size() == 1;
    const std::uint64_t bytes =
        first ? steps::stored_size(before_) : report_.steps[report_.steps.size() - 2].bytes_after;
    row.bytes_before = row.bytes_after = bytes;
    std::vector<ConvertNote> unread;
    const bool is_bounded = step.is_bounded != nullptr && step.is_bounded(options_);
    if (is_bounded) {
      if (auto why = prove_so_far()) return why;
    }
    auto outcome = is_bounded ? run_within_bounds(step, input(unread)) : step.run(input(unread));
    if (!outcome) {
      row.refused.push_back({{}, outcome.error().message});
      return outcome.error().message;
    }
    row = std::move(outcome->row);
    row.step = step.name;
    std::move(unread.begin(), unread.end(), std::back_inserter(row.refused));
    row.changes = !outcome->change.empty();
    row.bytes_before = row.bytes_after = bytes;
    if (!row.refused.empty() && !options_.partial) {
      return fmt::format("{} (--partial writes the rest)", with_place(row.refused.front()));
    }
    if (!row.changes) return std::nullopt;
    if (outcome->freedom.moves_base()) return move_base(std::move(*outcome));
    base_.freedom |= outcome->freedom;
    if (auto why = add(std::move(outcome->change))) return why;
    return is_bounded ? set_proven() : std::nullopt;
  }

  // A step changes the meaning. It is proven alone.
  Reason move_base(steps::StepOutcome outcome) {
    if (auto why = prove_so_far()) return why;
    if (auto why = add(std::move(outcome.change))) return why;
    if (auto why = resolve()) return why;
    if (!outcome.freedom.new_objects && !outcome.freedom.own_proof) {
      if (auto why = find_difference(proven(), stages_.asset(), outcome.freedom)) return why;
    }
    return set_proven();
  }

  // The next steps are compared with what this one made.
  Reason set_proven() {
    if (auto why = resolve()) return why;
    const bool plain_elements = base_.freedom.plain_elements;
    base_.freedom = {};
    base_.freedom.plain_elements = plain_elements;
    base_.asset = stages_.share();
    return std::nullopt;
  }

  const OpenedAsset& proven() const { return base_.asset ? *base_.asset : before_; }

  Reason prove_so_far() {
    if (stages_.share() == base_.asset) return std::nullopt;
    if (auto why = find_difference(proven(), stages_.asset(), {})) return why;
    return set_proven();
  }

  Reason add(change::Change change) {
    auto trouble = stages_.add(std::move(change));
    return trouble ? Reason(std::move(trouble->message)) : std::nullopt;
  }
  Reason apply() {
    auto trouble = stages_.apply();
    return trouble ? Reason(std::move(trouble->message)) : std::nullopt;
  }

  // Makes what the last step changes: the next one works on that.
  Reason resolve() {
    if (!stages_.is_open()) return std::nullopt;
    if (auto why = apply()) return why;
    report_.steps.back().bytes_after =
        laid_out_ ? steps::stored_size(stages_.asset())
                  : steps::laid_out_size(used_before(), stages_.asset(), *schemas_);
    return std::nullopt;
  }

  // Moves the bytes that steps made to where the asset has its own.
  Reason lay_out() {
    if (stages_.all().empty()) return std::nullopt;
    if (auto why = apply()) return why;
    std::vector<ConvertNote> unread;  // already refused by earlier steps
    auto change = steps::lay_out(used_before(), input(unread));
    if (!change) return change.error().message;
    laid_out_ = true;
    if (!change->empty()) {
      if (auto why = add(*std::move(change))) return why;
      if (auto why = apply()) return why;
    }
    set_last_size(steps::stored_size(stages_.asset()));
    return std::nullopt;
  }

  // After the last step with changes.
  void set_last_size(std::uint64_t bytes) {
    for (auto row = report_.steps.rbegin(); row != report_.steps.rend(); ++row) {
      row->bytes_after = bytes;
      if (row->changes) return;
      row->bytes_before = bytes;
    }
  }

  steps::StepInput input(std::vector<ConvertNote>& unread) const {
    return {stages_.asset(), *schemas_,         options_,          file_name(),
            unread,          shared_.encodings, targets_.repairs()};
  }
  const steps::UsedBytes& used_before() {
    if (!used_before_) used_before_.emplace(before_, *schemas_);
    return *used_before_;
  }

  Reason find_error(const ValidatedAsset& after) {
    set_last_size(steps::stored_size(after.asset()));
    prove::NewFindings found = prove::new_findings(
        before_, after, schemas_,
        base_.freedom.plain_elements ? prove::Louder::is_known : prove::Louder::is_new);
    report_.new_warnings = std::move(found.warnings);
    if (!found.error.empty()) {
      return fmt::format("the new file would have the new error {}", found.error);
    }
    if (laid_out_ || pictures_ != nullptr) {
      if (auto why = find_difference(proven(), after.asset(), {})) return why;
    }
    if (pictures_ == nullptr) return std::nullopt;
    ChangeCheck check = check_changes(before_, after.asset(), *schemas_,
                                      changes_of_conversion(options_), options_.jobs);
    if (!check.difference.empty()) return check.difference + " (--verify)";
    report_.not_verified = pictures_->obstacle();
    if (report_.not_verified.empty()) report_.not_verified = std::move(check.unproven);
    if (!report_.not_verified.empty()) return std::nullopt;
    std::string difference = pictures_->find_difference(after);
    report_.verified = difference.empty();
    return report_.verified ? std::nullopt : Reason(difference + " (--verify)");
  }

  // Where an asset means something else than the one before, beyond what the steps say. `more`: of
  // a step that moves the base.
  Reason find_difference(const OpenedAsset& before, const OpenedAsset& after,
                         const steps::Freedom& more) const {
    prove::MeaningRequest request;
    if (more.unit_vectors) request.tolerance.direction = kRoundedDirection;
    if (base_.freedom.vertex_order) request.order = prove::VertexOrder::free;
    if (base_.freedom.keyframes) request.animations = prove::AnimationComparison::curves;
    request.images =
        base_.freedom.texels ? prove::ImageComparison::none : prove::ImageComparison::texels;
    request.unused_may_go = base_.freedom.unused;
    request.image_names_may_go = base_.freedom.image_names;
    request.older_version = base_.freedom.version;
    request.jobs = options_.jobs;
    request.most = 1;
    const prove::Meaning meaning = prove::compare_meaning(before, after, *schemas_, request);
    if (meaning.same()) return std::nullopt;
    const prove::Difference& first = meaning.differences.front();
    return fmt::format("the new file would not mean the same: {}: {}", first.pointer, first.what);
  }

  const OpenedAsset& before_;
  const FileState& state_;
  const ConvertOptions& options_;
  const SchemaSet& schemas_;
  const PictureCheck* pictures_;  ///< of the old asset; null: none are compared
  const ConvertTargets& targets_;
  const Shared& shared_;
  ConvertReport& report_;
  steps::Stages stages_;
  std::optional<steps::UsedBytes> used_before_;
  bool laid_out_ = false;  ///< steps before the last changed something
  struct {
    std::shared_ptr<const OpenedAsset> asset;  ///< null: the old one
    steps::Freedom freedom;                    ///< of all steps since
  } base_;                                     ///< what the next steps are compared with
};

std::optional<Draft> convert(EditedAsset opened, ConvertOptions options, const Shared& shared,
                             ConvertReport& report) {
  if (const auto obstacle = find_obstacle(opened.asset)) {
    note_failure(report, EditProblem::unreadable, obstacle->message);
    return std::nullopt;
  }
  options.to = form_of(opened.asset, options);
  options.later.glb_version = glb_version_of(opened.asset, options);
  if (!options.later.flatten) {
    report.external_assets = external_assets_where(opened.asset, [](const auto&) { return true; });
  }
  const SchemaSet schemas = options.schemas ? options.schemas : schema::builtin_set();
  const ConvertTargets targets(opened.asset, schemas, options);
  if (!options.verify) {
    return ConvertRun(opened.asset, opened.state, options, schemas, nullptr, targets, shared,
                      report)
        .run();
  }
  const ValidatedAsset before(std::move(opened.asset), validate::default_validation(schemas));
  const PictureCheck pictures(before, options.root, schemas, options.jobs);
  return ConvertRun(before.asset(), opened.state, options, schemas, &pictures, targets, shared,
                    report)
      .run();
}

ConvertReport convert_path(const std::string& path, const ConvertOptions& options,
                           const Shared& shared) {
  return edit_file<ConvertReport>(path, options, "convert",
                                  [&](EditedAsset opened, ConvertReport& report) {
                                    convert(std::move(opened), options, shared, report);
                                  });
}

}  // namespace

std::uint64_t ConvertReport::refused() const {
  std::uint64_t count = 0;
  for (const ConvertStep& step : steps) count += step.refused.size();
  for (const ConvertRemainder& each : remaining) count += each.refused ? 1U : 0U;
  return count;
}

ConvertReport convert_file(const std::string& path, const ConvertOptions& options) {
  FolderIndex folders;
  steps::ImageEncodings encodings;
  return convert_path(path, options, {folders, encodings});
}

EditedBytes<ConvertReport> convert_bytes(MemoryAsset asset, const ConvertOptions& options) {
  return edit_bytes<ConvertReport>(
      std::move(asset), options, [&](EditedAsset opened, ConvertReport& report) {
        FolderIndex folders;
        steps::ImageEncodings encodings;
        return convert(std::move(opened), options, {folders, encodings}, report);
      });
}

void convert_files(const std::vector<EditInput>& inputs, const ConvertOptions& options,
                   unsigned jobs, const std::function<void(ConvertReport&&)>& consume) {
  steps::ImageEncodings encodings;
  edit_files(
      inputs, options, jobs,
      [&](const std::string& path, const ConvertOptions& each, FolderIndex& folders) {
        return convert_path(path, each, {folders, encodings});
      },
      consume);
}

}  // namespace gltfx
