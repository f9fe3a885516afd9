// SPDX-License-Identifier: Apache-2.0
#include <gltfx/bake.hpp>
#include <gltfx/pipeline.hpp>

#include <optional>
#include <string>
#include <utility>

#include "codec/client.hpp"
#include "pipeline/bake_asset.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_run.hpp"
#include "pipeline/bake_scene.hpp"
#include "pipeline/cached_picture.hpp"
#include "pipeline/cached_verb.hpp"
#include "pipeline/edit_bytes.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/picture_file.hpp"
#include "pipeline/thumbnail.hpp"

namespace gltfx {
namespace {

void embed_in(EditedAsset asset, const BakeOptions& options, BakedBytes& baked) {
  EditOptions edit;
  edit.schemas = options.schemas;
  const auto draft = embed_thumbnail(std::move(asset), baked.report.pixels, edit);
  auto bytes = draft ? bytes_of(*draft) : draft.error();
  if (!bytes) {
    baked.report.problem = BakeProblem::refused;
    baked.report.error = bytes.error().message;
    return;
  }
  baked.report.embedded = true;
  baked.bytes = *std::move(bytes);
  baked.files = files_of(*draft);
}

void bake_in_memory(Result<model::OpenedAsset> opened, const BakeOptions& options,
                    BakedBytes& baked) {
  BakeReport& report = baked.report;
  report.problem = BakeProblem::refused;
  if (!opened) {
    report.error = opened.error().message;
  } else if (!options.output.empty() || options.cache) {
    report.error = "an asset in memory is not drawn to files: output and cache are for files";
  } else if (auto obstacle = find_obstacle(*opened)) {
    report = unreadable(opened->name(), std::move(obstacle->message));
  } else {
    codec::Client::shared().prepare_images();
    BakeOptions drawn = options;
    drawn.embed = false;
    EditedAsset asset = to_edit(*opened);
    auto scene = load_bake_scene(validate_to_bake(*std::move(opened), options), options);
    report = run_bake(std::move(scene), drawn, &baked.pictures);
    if (options.embed && report.problem == BakeProblem::none) {
      embed_in(std::move(asset), options, baked);
    }
  }
}

/// Baking of one file, for cached().
struct BakeVerb {
  using Report = BakeReport;
  const std::string& path;
  const BakeOptions& options;

  Result<model::OpenedAsset> open() const { return open_document(path, AssetBounds::of(options)); }
  BakeReport refuse(const std::string& why) const { return unreadable(path, why); }
  BakeReport run(model::OpenedAsset asset) const {
    return bake_asset(validate_to_bake(std::move(asset), options), options);
  }
  std::optional<std::string> pack(const BakeReport& report) const {
    return pack_pictures(report, options);
  }
  std::optional<BakeReport> unpack(const std::string& kept, const model::OpenedAsset*) const {
    return recall_pictures(kept, path, options);
  }
};

}  // namespace

bool can_bake() { return true; }

std::string check_picture_name(const std::string& path) {
  const auto format = picture_format(path);
  return format ? std::string() : format.error().message;
}

BakeReport bake_asset(validate::ValidatedAsset asset, const BakeOptions& options) {
  const std::string path = asset.asset().name();
  return guarded(path,
                 [&] { return run_bake(load_bake_scene(std::move(asset), options), options); });
}

BakeReport bake_with_key(const std::string& path, const BakeOptions& options, PictureKey& keys) {
  return guarded(path, [&] {
    const auto key = keys.of(options);
    if (!key) return run_bake(load_bake_scene(path, options), options);
    codec::Client::shared().prepare_images();
    return cached(path, AssetBounds::of(options), *options.cache, *key, BakeVerb{path, options});
  });
}

BakedBytes bake_bytes(MemoryAsset asset, const BakeOptions& options) {
  BakedBytes baked;
  const std::string name = asset.name;
  baked.report = guarded(name, [&] {
    baked.report.path = name;
    bake_in_memory(open_memory(std::move(asset), options.root), options, baked);
    return std::move(baked.report);
  });
  if (baked.report.problem != BakeProblem::none) baked.pictures.clear();
  return baked;
}

BakeReport bake_file(const std::string& path, const BakeOptions& options) {
  PictureKey keys;
  return bake_with_key(path, options, keys);
}

}  // namespace gltfx
