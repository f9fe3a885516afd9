// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_run.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "codec/client.hpp"
#include "pipeline/bake_clip.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_strip.hpp"
#include "pipeline/bake_views.hpp"
#include "pipeline/picture_file.hpp"
#include "pipeline/picture_names.hpp"
#include "pipeline/thumbnail.hpp"
#include "preview/picture.hpp"

namespace gltfx {
namespace {

/// The pictures of one camera in one size.
struct Shot {
  BakeSize size;
  std::string suffix;  ///< of the names of its files
  std::vector<render::View> views;
  bool dim_backdrop = false;                 ///< as the first view of the camera asks for
  std::map<std::string, FrameStrip> strips;  ///< by suffix, of pictures that become one file
};

/// One file on its way from scene to pictures.
class Baker {
 public:
  Baker(BakeScene loaded, const BakeOptions& options, Pictures* kept)
      : options_(options), loaded_(std::move(loaded)), report_(loaded_.report), kept_(kept) {}

  BakeReport run() {
    if (loaded_.ready() && check_output() && choose_shots() && check_layout() && check_names() &&
        draw_all() && options_.embed) {
      embed();
    }
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
    const auto format = output_format(options_);
    if (!format) return fail(BakeProblem::refused, format.error().message);
    format_ = *format;
    if (!is_transparent(options_) || holds_alpha(format_)) return true;
    return fail(BakeProblem::refused,
                "JPEG cannot have a transparent background; PNG, WebP and OpenEXR can");
  }

  bool choose_shots() {
    const std::vector<NamedCamera> cameras = named_cameras(loaded_, options_, report_.notes);
    for (const BakeSize& size : options_.sizes) {
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        const auto& [camera, part] = cameras[i];
        const double aspect = static_cast<double>(size.width) / size.height;
        auto views = choose_views(loaded_, options_, aspect, camera);
        if (!views) return fail(BakeProblem::refused, views.error().message);
        // All sizes of a picture have the backdrop of the first.
        const bool dim = shots_.size() < cameras.size()
                             ? needs_dim_backdrop(loaded_, views->front(), options_)
                             : shots_[i].dim_backdrop;
        shots_.push_back({size, shot_suffix(options_, part, size), *std::move(views), dim, {}});
      }
    }
    loaded_.forget_faces();
    return true;
  }

  std::uint32_t clip_frames() const { return loaded_.clip ? loaded_.clip->frames() : 1; }
  bool has_frames() const { return options_.turntable > 0 || loaded_.clip; }

  bool check_layout() {
    layout_ = layout_of(options_, has_frames(), format_ == codec::EncodedFormat::webp);
    if (layout_ == BakeLayout::files) return true;
    if (!has_frames()) {
      return fail(BakeProblem::refused, "a layout needs the frames of a turntable or clip");
    }
    if (layout_ == BakeLayout::animation && format_ != codec::EncodedFormat::webp) {
      return fail(BakeProblem::refused, "only WebP files can be animations");
    }
    return check_strips();
  }

  // Frames of one file are in memory until it is written, those of a clip until all files are.
  bool check_strips() {
    constexpr std::uint32_t kMostSide = 16383;
    constexpr std::uint64_t kMostInAll = 8192ULL * 16384;
    const std::uint64_t each = (1 + options_.layers.size()) * (holds_floats(format_) ? 4 : 1);
    std::uint64_t held = 0;  // pixels of 8 bits a channel
    for (const Shot& shot : shots_) {
      const auto frames = static_cast<std::uint32_t>(shot.views.size()) * clip_frames();
      const FrameGrid grid = layout_ == BakeLayout::sprites ? grid_of(frames) : FrameGrid();
      const std::uint64_t width = std::uint64_t{shot.size.width} * grid.columns;
      const std::uint64_t height = std::uint64_t{shot.size.height} * grid.rows;
      const std::uint64_t all = std::uint64_t{shot.size.width} * shot.size.height * frames;
      held = loaded_.clip ? held + all * each : std::max(held, all * each);
      if (std::max(width, height) <= kMostSide && all <= kMostInAll) continue;
      return fail(BakeProblem::refused,
                  fmt::format("{} frames of {}x{} pixels are too many for one file: a side has at "
                              "most {} pixels, all frames together {}",
                              frames, shot.size.width, shot.size.height, kMostSide, kMostInAll));
    }
    if (held <= kMostInAll) return true;
    return fail(BakeProblem::refused,
                fmt::format("frames of {} pixels would be in memory at the same time, but at most "
                            "{} may be (in OpenEXR a quarter); draw cameras, sizes or layers one "
                            "by one",
                            held, kMostInAll));
  }

  // A layer of one camera may be called like another camera.
  bool check_names() {
    std::set<std::string> names;
    const auto add = [&](const std::string& suffix) {
      if (names.insert(suffix).second) return true;
      const std::string name =
          options_.output.empty() ? suffix : with_suffix(options_.output, suffix);
      return fail(BakeProblem::refused,
                  fmt::format("two pictures would have the name {}", quoted(name, 200)));
    };
    for (const Shot& shot : shots_) {
      const std::size_t files =
          layout_ == BakeLayout::files ? shot.views.size() * clip_frames() : 1;
      for (std::size_t i = 0; i < files; ++i) {
        const std::string name = picture_suffix(shot, i);
        const auto taken = [&](BakeLayer layer) { return !add(name + layer_suffix(layer)); };
        if (!add(name) || std::any_of(options_.layers.begin(), options_.layers.end(), taken)) {
          return false;
        }
      }
    }
    return true;
  }

  // Of a picture among those of a shot.
  std::string picture_suffix(const Shot& shot, std::size_t number) const {
    const bool numbered = has_frames() && layout_ == BakeLayout::files;
    return numbered ? shot.suffix + frame_suffix(number) : shot.suffix;
  }

  bool draw_all() {
    for (const Shot& shot : shots_) pictures_ += shot.views.size() * clip_frames();
    for (std::uint32_t moment = 0; moment < clip_frames(); ++moment) {
      if (moment > 0 && !move_on(moment)) return false;
      for (Shot& shot : shots_) {
        if (!draw(shot, moment)) return false;
        if (!loaded_.clip && !finish(shot)) return false;
      }
    }
    return !loaded_.clip ||
           std::all_of(shots_.begin(), shots_.end(), [this](Shot& shot) { return finish(shot); });
  }

  // To a later frame of the clip.
  bool move_on(std::uint32_t moment) {
    const auto textures = loaded_.scene->textures;  // their pixels are those of the next one
    loaded_.bvh = std::nullopt;                     // before its scene
    loaded_.scene.reset();
    BakeScene next = loaded_.clip->scene_of(moment, *loaded_.subject);
    if (!next.ready()) return fail(next.report.problem, std::move(next.report.error));
    loaded_.scene = std::move(next.scene);
    loaded_.bvh = std::move(next.bvh);
    return true;
  }

  bool draw(Shot& shot, std::uint32_t moment) {
    loaded_.dim_backdrop = shot.dim_backdrop;
    for (std::size_t i = 0; i < shot.views.size(); ++i) {
      const render::Framebuffer drawn =
          draw_picture(loaded_, shot.views[i], shot.size, options_, layers_of(options_), part());
      ++done_;
      if (!take(drawn, shot, picture_suffix(shot, i + moment))) return false;
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

  bool take(const render::Framebuffer& drawn, Shot& shot, const std::string& suffix) {
    if (report_.pixels.bytes.empty()) {
      preview::Picture shown = finish_picture(drawn, options_, preview::PixelType::bytes);
      report_.pixels = {shown.width, shown.height, shown.channels, std::move(shown.bytes)};
    }
    if (options_.output.empty() && kept_ == nullptr) return true;
    const auto numbers =
        holds_floats(format_) ? preview::PixelType::floats : preview::PixelType::bytes;
    if (!put(finish_picture(drawn, options_, numbers), shot, suffix)) return false;
    for (const BakeLayer layer : options_.layers) {
      preview::Picture seen =
          preview::layer_picture(drawn, static_cast<preview::Layer>(layer), numbers);
      if (!put(std::move(seen), shot, suffix + layer_suffix(layer))) return false;
    }
    return true;
  }

  bool put(preview::Picture picture, Shot& shot, const std::string& suffix) {
    if (layout_ == BakeLayout::files) return write(encode_picture(picture, format_), suffix);
    shot.strips[suffix].add(std::move(picture));
    return true;
  }

  // Writes what one file holds of all frames.
  bool finish(Shot& shot) {
    for (const auto& [suffix, strip] : shot.strips) {
      const auto encoded =
          layout_ == BakeLayout::sprites
              ? encode_picture(strip.grid(), format_)
              : encode_animation(strip.column(), strip.frames(), frame_rate(options_));
      if (!write(encoded, suffix)) return false;
    }
    shot.strips.clear();
    return true;
  }

  bool write(const Result<codec::EncodedImage>& image, const std::string& suffix) {
    if (!image) return fail(BakeProblem::not_written, image.error().message);
    if (kept_ != nullptr) {
      const auto* text = reinterpret_cast<const char*>(image->bytes.data());
      kept_->emplace(suffix, std::string(text, image->bytes.size()));
      return true;
    }
    const std::string path = with_suffix(options_.output, suffix);
    if (auto trouble = write_image(*image, path)) {
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
  BakeLayout layout_ = BakeLayout::files;
  std::vector<Shot> shots_;
  std::size_t pictures_ = 0, done_ = 0;
};

}  // namespace

BakeReport run_bake(BakeScene loaded, const BakeOptions& options, Pictures* kept) {
  return Baker(std::move(loaded), options, kept).run();
}

}  // namespace gltfx
