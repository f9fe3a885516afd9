// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "pipeline/bake_asset.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_scene.hpp"
#include "pipeline/bake_views.hpp"
#include "pipeline/cached_picture.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/picture_file.hpp"
#include "preview/contact_sheet.hpp"
#include "prove/picture.hpp"

namespace gltfx {
namespace {

// Of one file of a run. Many files keep all threads busy by themselves, and each reports its end.
BakeOptions options_of(const BakeOptions& options, const BakeInput& input, std::size_t count) {
  BakeOptions each = options;
  each.output = input.output;
  if (count > 1) {
    each.jobs = 1;
    each.progress = {};
  }
  return each;
}

/// Two files, drawn alike. Precondition: the output, if there is one, has a format for bytes.
class Comparison {
 public:
  Comparison(const std::string& first, const std::string& second, const BakeOptions& options)
      : options_(options),
        first_(load_bake_scene(first, options)),
        second_(load_bake_scene(second, options)) {}

  BakeComparison run() {
    if (first_.ready() && second_.ready()) compare();
    return {std::move(first_.report), std::move(second_.report), psnr_, ssim_, std::move(error_)};
  }

 private:
  void compare() {
    const BakeSize size = options_.sizes.front();
    const double aspect = static_cast<double>(size.width) / size.height;
    const auto cameras = named_cameras(first_, options_, first_.report.notes);
    const auto views = choose_views(first_, options_, aspect, cameras.front().word);
    if (!views) {
      first_.report.problem = BakeProblem::refused;
      first_.report.error = views.error().message;
      return;
    }
    first_.dim_backdrop = needs_dim_backdrop(first_, views->front(), options_);
    const render::Framebuffer a = draw(first_, views->front(), 0);
    first_.forget_faces();
    second_.follow(*first_.subject, first_.origin);
    second_.dim_backdrop = first_.dim_backdrop;
    const render::View same = moved(views->front(), first_.origin, second_.origin);
    const render::Framebuffer b = draw(second_, same, 0.5);
    const preview::Picture left = to_picture(a, first_.report);
    const preview::Picture right = to_picture(b, second_.report);
    const double difference = prove::mean_square_difference(left, right, a, b);
    psnr_ = difference > 0 ? 10 * std::log10(255.0 * 255.0 / difference)
                           : std::numeric_limits<double>::infinity();
    ssim_ = prove::structural_similarity(left, right, a, b);
    if (options_.output.empty()) return;
    const auto format = output_format_of_bytes(options_);
    const auto image = encode_picture(prove::difference(left, right), *format);
    const auto trouble = image ? write_image(*image, options_.output) : image.error();
    if (trouble) error_ = trouble->message;
  }

  render::Framebuffer draw(const BakeScene& loaded, const render::View& view, double before) const {
    std::function<void(double)> progress;
    if (options_.progress) {
      progress = [this, before](double part) { options_.progress(before + part / 2); };
    }
    return draw_picture(loaded, view, options_.sizes.front(), options_, {.alpha = true}, progress);
  }

  preview::Picture to_picture(const render::Framebuffer& drawn, BakeReport& report) const {
    preview::Picture picture = finish_picture(drawn, options_, preview::PixelType::bytes);
    report.pixels = {picture.width, picture.height, picture.channels, picture.bytes};
    return picture;
  }

  const BakeOptions& options_;
  BakeScene first_, second_;
  double psnr_ = 0, ssim_ = 0;
  std::string error_;
};

/// The picture of all pictures, if there is to be one and memory for it.
class SheetOfAll {
 public:
  SheetOfAll(const std::vector<BakeInput>& inputs, const BakeOptions& options)
      : wanted_(!inputs.empty()) {
    if (!wanted_) return;
    attempt([&] {
      sheet_.emplace(inputs.size(), options.sizes.front());
      std::vector<std::string> paths;
      for (const BakeInput& input : inputs) paths.push_back(input.path);
      labels_ = preview::sheet_labels(paths);
    });
  }
  void add(std::size_t position, const BakeReport& report) {
    const bool unseen = report.problem == BakeProblem::nothing_to_see;
    const std::string_view instead = unseen ? "nothing visible" : "no picture";
    if (sheet_) attempt([&] { sheet_->add(report.pixels, labels_[position], instead); });
  }
  /// What went wrong, or an empty text.
  std::string write(const std::string& path) {
    std::optional<Error> trouble;
    if (sheet_) attempt([&] { trouble = write_picture(sheet_->take(), path); });
    if (wanted_ && !sheet_) return "there is not enough memory for the picture of all pictures";
    return trouble ? std::move(trouble->message) : std::string();
  }

 private:
  template <class Work>
  void attempt(const Work& work) {
    try {
      work();
    } catch (const std::bad_alloc&) {
      sheet_.reset();
    }
  }

  bool wanted_;
  std::optional<preview::ContactSheet> sheet_;
  std::vector<std::string> labels_;
};

}  // namespace

std::string bake_files(const std::vector<BakeInput>& inputs, const BakeOptions& options,
                       const std::string& sheet, const std::function<void(BakeReport&&)>& consume) {
  SheetOfAll pictures(sheet.empty() ? std::vector<BakeInput>() : inputs, options);
  PictureKey keys;
  std::size_t done = 0;
  report_in_order<BakeReport>(
      inputs.size(), inputs.size() > 1 ? options.jobs : 1,
      [&](std::size_t i) {
        return guarded(inputs[i].path, [&] {
          return bake_with_key(inputs[i].path, options_of(options, inputs[i], inputs.size()), keys);
        });
      },
      [&](BakeReport&& report) {
        pictures.add(done++, report);
        if (options.progress && inputs.size() > 1) {
          options.progress(static_cast<double>(done) / static_cast<double>(inputs.size()));
        }
        consume(std::move(report));
      });
  return pictures.write(sheet);
}

BakeComparison bake_comparison(const std::string& first, const std::string& second,
                               const BakeOptions& options) {
  const auto failed = [&](BakeProblem problem, std::string error) {
    BakeComparison none;
    none.first.path = first;
    none.second.path = second;
    none.first.problem = problem;
    none.first.error = std::move(error);
    return none;
  };
  if (!options.output.empty()) {
    const auto format = output_format_of_bytes(options);
    if (!format) return failed(BakeProblem::refused, format.error().message);
  }
  try {
    return Comparison(first, second, options).run();
  } catch (const std::bad_alloc&) {
    return failed(BakeProblem::unreadable, "there is not enough memory to draw the files");
  }
}

}  // namespace gltfx
