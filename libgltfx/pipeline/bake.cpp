// SPDX-License-Identifier: Apache-2.0
#include <gltfx/bake.hpp>
#include <gltfx/pipeline.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "codec/client.hpp"
#include "pipeline/bake_asset.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_scene.hpp"
#include "pipeline/cached_picture.hpp"
#include "pipeline/cached_verb.hpp"
#include "pipeline/edit_bytes.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/picture_file.hpp"
#include "pipeline/thumbnail.hpp"
#include "preview/lighting.hpp"
#include "preview/picture.hpp"

namespace gltfx {
namespace {

/// PNG files by what their names have before the ending.
using Pictures = std::map<std::string, std::string>;

/// One file on its way from scene to pictures.
class Baker {
 public:
  /// `kept` gets the pictures where it is not null, else the options say where they are written.
  Baker(BakeScene loaded, const BakeOptions& options, Pictures* kept = nullptr)
      : options_(options), loaded_(std::move(loaded)), report_(loaded_.report), kept_(kept) {}

  BakeReport run() {
    if (!loaded_.ready() || !check_output() || !choose_all_views()) return std::move(report_);
    for (std::size_t i = 0; i < options_.sizes.size(); ++i) {
      if (!draw_size(options_.sizes[i], views_[i])) return std::move(report_);
    }
    if (options_.embed) embed();
    return std::move(report_);
  }

 private:
  bool fail(BakeProblem problem, std::string error) {
    report_.problem = problem;
    report_.error = std::move(error);
    return false;
  }

  bool check_output() {
    if (options_.output.empty()) return true;
    const auto format = picture_format(options_.output);
    if (!format) return fail(BakeProblem::refused, format.error().message);
    format_ = *format;
    if (!is_transparent(options_) || holds_alpha(format_)) return true;
    return fail(BakeProblem::refused,
                "JPEG holds no transparent background; PNG, WebP and OpenEXR do");
  }

  bool choose_all_views() {
    for (const BakeSize& size : options_.sizes) {
      const double aspect = static_cast<double>(size.width) / size.height;
      auto views = choose_views(loaded_, options_, aspect);
      if (!views) return fail(BakeProblem::refused, views.error().message);
      pictures_ += views->size();
      views_.push_back(*std::move(views));
    }
    choose_backdrop(loaded_, views_.front().front(), options_);
    loaded_.forget_faces();
    return true;
  }

  bool draw_size(const BakeSize& size, const std::vector<render::View>& views) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      const render::Framebuffer drawn =
          draw_picture(loaded_, views[i], size, options_, layers_of(options_), part());
      ++done_;
      std::string suffix;
      if (options_.sizes.size() > 1) suffix = fmt::format("-{}x{}", size.width, size.height);
      if (options_.turntable > 0) suffix += fmt::format("-{:03}", i);
      if (!take(drawn, suffix)) return false;
    }
    return true;
  }

  // Progress of one picture among all of them.
  std::function<void(double)> part() const {
    if (!options_.progress) return {};
    return [this](double within) {
      options_.progress((static_cast<double>(done_) + within) / static_cast<double>(pictures_));
    };
  }

  bool take(const render::Framebuffer& drawn, const std::string& suffix) {
    if (report_.pixels.bytes.empty()) {
      preview::Picture shown = finish_picture(drawn, options_, preview::PixelType::bytes);
      report_.pixels = {shown.width, shown.height, shown.channels, std::move(shown.bytes)};
    }
    if (options_.output.empty() && kept_ == nullptr) return true;
    const auto numbers =
        holds_floats(format_) ? preview::PixelType::floats : preview::PixelType::bytes;
    const preview::Picture picture = finish_picture(drawn, options_, numbers);
    if (!put(picture, suffix)) return false;
    for (const BakeLayer layer : options_.layers) {
      const preview::Picture seen =
          preview::layer_picture(drawn, static_cast<preview::Layer>(layer), numbers);
      const std::string ending = fmt::format("{}-{}", suffix, bake_layer_name(layer));
      if (!put(seen, ending)) return false;
    }
    return true;
  }

  bool put(const preview::Picture& picture, const std::string& suffix) {
    if (kept_ != nullptr) {
      auto png = encode_png(picture);
      if (!png) return fail(BakeProblem::not_written, png.error().message);
      kept_->emplace(suffix, *std::move(png));
      return true;
    }
    const std::string path = with_suffix(options_.output, suffix);
    if (auto trouble = write_picture(picture, path)) {
      return fail(BakeProblem::not_written, std::move(trouble->message));
    }
    report_.written.push_back(path);
    return true;
  }

  void embed() {
    if (auto trouble = embed_thumbnail(report_.path, report_.pixels, options_)) {
      fail(BakeProblem::not_written, std::move(trouble->message));
      return;
    }
    report_.embedded = true;
  }

  const BakeOptions& options_;
  BakeScene loaded_;
  BakeReport report_;
  Pictures* const kept_;
  codec::EncodedFormat format_ = codec::EncodedFormat::png;
  std::vector<std::vector<render::View>> views_;  // by size
  std::size_t pictures_ = 0, done_ = 0;
};

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
    report = Baker(std::move(scene), drawn, &baked.pictures).run();
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
                 [&] { return Baker(load_bake_scene(std::move(asset), options), options).run(); });
}

BakeReport bake_with_key(const std::string& path, const BakeOptions& options, PictureKey& keys) {
  return guarded(path, [&] {
    const auto key = keys.of(options);
    if (!key) return Baker(load_bake_scene(path, options), options).run();
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
