// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/container.hpp"
#include "container/pieces.hpp"
#include "json/parse.hpp"
#include "pipeline/companions.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/new_findings.hpp"
#include "pipeline/patch_path.hpp"
#include "pipeline/resolver_for.hpp"
#include "pipeline/upgraded_asset.hpp"
#include "pipeline/write_upgrade.hpp"
#include "schema/compile.hpp"
#include "upgrade/ambiguity.hpp"
#include "upgrade/asset_pictures.hpp"
#include "upgrade/diff.hpp"
#include "upgrade/glb_rewrite.hpp"
#include "upgrade/old_format.hpp"
#include "upgrade/orphans.hpp"
#include "upgrade/plan.hpp"
#include "upgrade/prune.hpp"
#include "upgrade/references.hpp"
#include "upgrade/render.hpp"
#include "upgrade/settlement.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Pieces = std::vector<container::Bytes>;

/// One file on its way: read, planned, checked, written.
class Upgrade {
 public:
  Upgrade(const std::string& path, const UpgradeOptions& options)
      : path_(path),
        options_(options),
        schemas_(options.schemas ? options.schemas : schema::builtin_set()),
        resolver_(resolver_for(fs::path(path).parent_path(), options.root)) {
    report_.path = path;
  }

  UpgradeReport run() {
    if (read() && plan()) finish();
    return std::move(report_);
  }

  // The new bytes, checked as if they were to be written; nothing when there are none.
  std::optional<OpenedAsset> run_in_memory() {
    Pieces pieces;
    if (!read() || !plan() || !report_.changes || !rebuild(pieces)) return std::nullopt;
    OpenedAsset asset{
        container::open_bytes(joined(std::move(pieces)), path_), with_new_files(), {}};
    if (!is_no_worse(asset.container)) return std::nullopt;
    asset.parsed = json::parse(asset.container.json);
    return asset;
  }

 private:
  bool fail(UpgradeProblem problem, std::string error) {
    report_.problem = problem;
    report_.error = std::move(error);
    for (UpgradeAction& action : report_.actions) action.done = false;
    report_.changes = false;
    report_.new_files.clear();
    report_.new_warnings.clear();
    report_.diff.clear();
    report_.orphans.clear();
    return false;
  }

  // The state is taken before the bytes: a change between the two is seen when it is written.
  bool read() {
    const auto state = file_state(path_);
    auto opened = container::open_file(path_);
    if (!opened) return fail(UpgradeProblem::unreadable, opened.error().message);
    if (!state) return fail(UpgradeProblem::unreadable, state.error().message);
    state_ = *state;
    container_ = *std::move(opened);
    if (container_.glb_version == 1U) {
      report_.actions.push_back(upgrade::old_format(options_));
      return false;
    }
    if (const auto obstacle = find_text_obstacle(container_)) {
      return fail(UpgradeProblem::unreadable, obstacle->message);
    }
    drop_zero_padding();
    parsed_ = json::parse(container_.json);
    const auto obstacle = find_document_obstacle(parsed_);
    return !obstacle || fail(UpgradeProblem::unreadable, obstacle->message);
  }

  // Some writers fill the JSON chunk up with zeros; the new one gets blanks.
  void drop_zero_padding() {
    if (container_.format != container::Format::glb) return;
    const std::size_t end = container_.json->find_last_not_of('\0') + 1;
    if (end == container_.json->size()) return;
    container_.json = share_text(std::string(container_.json->substr(0, end)));
  }

  bool plan() {
    const model::Asset asset(parsed_.document);
    upgrade::AssetBytes bytes(asset, container_, resolver_);
    upgrade::AssetPictures pictures(bytes, upgrade::ImageCache::shared());
    upgrade::Plan plan =
        upgrade::make_plan(parsed_.document, *schemas_, options_, &pictures, &bytes);
    if (const std::string why = pictures.failure(); !why.empty()) {
      return fail(UpgradeProblem::unreadable, why);
    }
    const auto ambiguity = upgrade::find_ambiguity(parsed_, plan);
    report_.actions = std::move(plan.actions);
    edits_ = std::move(plan.edits);
    if (report_.due() == 0) return true;
    if (ambiguity) return fail(UpgradeProblem::refused, *ambiguity);
    if (const auto obstacle = upgrade::find_glb_obstacle(container_); obstacle && !edits_.empty()) {
      return fail(UpgradeProblem::refused, "it cannot be written anew: " + *obstacle);
    }
    report_.changes = !edits_.empty() || !plan.additions.empty();
    if (options_.strict && !is_lossless()) {
      return fail(UpgradeProblem::refused,
                  "not everything can be upgraded without loss (--strict)");
    }
    if (!plan.additions.empty() && !settle(plan.additions, bytes, pictures)) {
      return false;
    }
    if (report_.changes && asset.count(model::RootArray::textures) > 0)
      look_for_orphans(plan.released, bytes);
    if (options_.diff) report_.diff = diff_text();
    return true;
  }

  bool is_lossless() const {
    for (const UpgradeAction& action : report_.actions) {
      if (action.is_due() && (action.fate != UpgradeFate::safe || action.lossy)) return false;
    }
    return true;
  }

  // No patch changes the JSON inside a binary file: there the diff is a comment of one.
  std::string diff_text() const {
    const bool is_text = container_.format == container::Format::gltf;
    return upgrade::unified_diff(*container_.json, edits_, patch_path(path_), is_text ? "" : "# ");
  }

  bool settle(const upgrade::Additions& additions, const upgrade::AssetBytes& bytes,
              upgrade::Pictures& pictures) {
    std::vector<std::shared_ptr<const std::string>> images;
    for (const upgrade::ImageJob& job : additions.images()) {
      auto file = upgrade::render(job, pictures, upgrade::ImageCache::shared(), bytes.origin());
      if (!file) return fail(UpgradeProblem::refused, file.error().message);
      images.push_back(*std::move(file));
    }
    auto settled = upgrade::settle(additions, images, container_, bytes,
                                   [this](const std::string& path, std::string_view content) {
                                     return is_free(path, content);
                                   });
    if (!settled) return fail(UpgradeProblem::refused, settled.error().message);
    edits_ = json::merge_edits(std::move(edits_), std::move(settled->edits));
    bin_.more = std::move(settled->bin);
    files_ = std::move(settled->files);
    for (const upgrade::NewFile& file : files_) report_.new_files.push_back(file.path);
    return true;
  }

  // What additions refer to is not missed: they stand behind everything that was there before.
  void look_for_orphans(const std::vector<std::uint64_t>& released, upgrade::AssetBytes& bytes) {
    const std::string text = json::apply_edits(*container_.json, edits_);
    const json::Parsed now = json::parse(std::string_view(text));
    const upgrade::References before(parsed_.document, *schemas_);
    const upgrade::References after(now.document, *schemas_);
    const upgrade::Orphans orphans =
        upgrade::find_orphans(parsed_.document, before, released, now.document, after);
    for (const auto& [array, indices] : orphans) {
      for (const std::uint64_t index : indices) {
        UpgradeOrphan orphan{fmt::format("/{}/{}", array, index), 0, false};
        if (array == "images") orphan.bytes = size_of_image(bytes, index);
        report_.orphans.push_back(std::move(orphan));
      }
    }
    if (options_.prune && !report_.orphans.empty()) prune(now.document, after, orphans, bytes);
  }

  static std::uint64_t size_of_image(upgrade::AssetBytes& bytes, std::uint64_t index) {
    const auto content = bytes.image(index);
    return content ? content->size() : 0;
  }

  void prune(const json::Document& now, const upgrade::References& references,
             const upgrade::Orphans& orphans, const upgrade::AssetBytes& bytes) {
    std::optional<std::uint64_t> bin_size;
    if (bytes.buffer_storage(0) == upgrade::Storage::bin_chunk) bin_size = container_.bin->length;
    auto pruned = upgrade::prune(now, references, orphans, bin_size);
    if (!pruned) {
      report_.orphans_kept = pruned.error().message;
      return;
    }
    edits_ = json::chain_edits(*container_.json, edits_, pruned->edits);
    bin_.cut = std::move(pruned->cut);
    for (UpgradeOrphan& orphan : report_.orphans) orphan.removed = true;
    report_.names_removed = std::move(pruned->names);
  }

  // A new name is one that is free, or taken by the same bytes, where the asset is and where it
  // goes.
  bool is_free(const std::string& path, std::string_view content) const {
    const container::Resolved here = resolver_.open(path);
    if (here.fault == container::ResolveFault::none
            ? here.bytes.text() != content
            : here.fault != container::ResolveFault::not_found) {
      return false;
    }
    const fs::path there = target_folder(path_, options_) / path;
    std::error_code fault;
    return !fs::exists(fs::symlink_status(there, fault)) ||
           has_bytes(there, {std::as_bytes(std::span(content)), nullptr});
  }

  bool wants_to_write() const {
    return !options_.output.empty() || (options_.in_place && report_.changes);
  }

  void finish() {
    if (wants_to_write()) return write();
    if (report_.changes) try_out();
  }

  void write() {
    Pieces pieces{container_.bytes};
    if (report_.changes && !rebuild(pieces)) return;
    const UpgradeSource source{path_, state_, container_, parsed_.document, resolver_};
    const auto check = [this](const container::Container& written) { return new_fault(written); };
    const auto failure = write_upgrade(source, options_, files_, pieces,
                                       report_.changes ? UpgradeCheck(check) : nullptr);
    if (failure) {
      fail(failure->problem, failure->error);
      return;
    }
    report_.written = true;
    report_.written_to = options_.in_place ? path_ : options_.output;
  }

  static container::Bytes joined(Pieces pieces) {
    if (pieces.size() == 1) return std::move(pieces.front());
    return container::Bytes::from_string(container::join(pieces));
  }

  // A plan is judged as what is written is. Where the BIN chunk stays, it need not be copied.
  void try_out() {
    container::Container changed = container_;
    if (container_.format == container::Format::glb && !bin_.empty()) {
      Pieces pieces;
      if (!rebuild(pieces)) return;
      changed = container::open_bytes(joined(std::move(pieces)), path_);
    } else {
      changed.json = share_text(json::apply_edits(*container_.json, edits_));
    }
    is_no_worse(changed);
  }

  bool rebuild(Pieces& pieces) {
    std::string json = json::apply_edits(*container_.json, edits_);
    if (container_.format == container::Format::gltf) {
      pieces = {container::Bytes::from_string(std::move(json))};
      return true;
    }
    auto glb = upgrade::rewrite_glb(container_, json, bin_);
    if (!glb) return fail(UpgradeProblem::refused, glb.error().message);
    pieces = *std::move(glb);
    return true;
  }

  container::Resolver with_new_files() const {
    container::Resolver resolver = resolver_;
    for (const upgrade::NewFile& file : files_) {
      resolver.add(file.path, content_of(file));
    }
    return resolver;
  }

  // The new bytes may have no error that the old ones had not.
  std::optional<std::string> new_fault(const container::Container& changed) {
    const container::Resolver with_files = with_new_files();
    NewFindings found =
        new_findings({container_, resolver_}, {changed, with_files}, path_, schemas_);
    report_.new_warnings = std::move(found.warnings);
    if (found.error.empty()) return std::nullopt;
    return fmt::format(
        "the new file would have the new error {}; fix the findings of 'gltfx validate' first",
        found.error);
  }

  bool is_no_worse(const container::Container& changed) {
    const auto fault = new_fault(changed);
    return !fault || fail(UpgradeProblem::refused, *fault);
  }

  const std::string& path_;
  const UpgradeOptions& options_;
  const std::shared_ptr<const schema::Set> schemas_;
  const container::Resolver resolver_;
  FileState state_;
  container::Container container_;
  json::Parsed parsed_;
  std::vector<json::Edit> edits_;
  upgrade::BinChange bin_;
  std::vector<upgrade::NewFile> files_;  ///< that the new document refers to
  UpgradeReport report_;
};

UpgradeReport unreadable(const std::string& path, std::string why) {
  UpgradeReport report;
  report.path = path;
  report.problem = UpgradeProblem::unreadable;
  report.error = std::move(why);
  return report;
}

// The library does not throw.
template <class Work>
UpgradeReport guarded(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return unreadable(path, "there is not enough memory to upgrade this file");
  } catch (const fs::filesystem_error&) {
    return unreadable(path, "the path cannot be looked up");
  }
}

}  // namespace

UpgradeReport upgrade_file(const std::string& path, const UpgradeOptions& options) {
  return guarded(path, [&] { return Upgrade(path, options).run(); });
}

std::optional<OpenedAsset> upgraded_asset(const std::string& path, const UpgradeOptions& options) {
  return Upgrade(path, options).run_in_memory();
}

void upgrade_files(const std::vector<UpgradeInput>& inputs, const UpgradeOptions& options,
                   unsigned jobs, const std::function<void(UpgradeReport&&)>& consume) {
  report_in_order<UpgradeReport>(
      inputs.size(), jobs,
      [&](std::size_t i) {
        return guarded(inputs[i].path, [&] {
          UpgradeOptions each = options;
          each.output = inputs[i].output;
          return upgrade_file(inputs[i].path, each);
        });
      },
      consume);
}

}  // namespace gltfx
