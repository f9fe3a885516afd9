// SPDX-License-Identifier: Apache-2.0
// Stores images in another format or size (glTF 2.0 section 3.8; EXT_texture_webp).
#include "steps/images.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "codec/client.hpp"
#include "image/features.hpp"
#include "image/gpu_memory.hpp"
#include "report/wording.hpp"
#include "steps/image_attempts.hpp"
#include "steps/image_encodings.hpp"
#include "steps/image_plan.hpp"
#include "steps/image_sources.hpp"
#include "steps/image_store.hpp"
#include "steps/image_use.hpp"
#include "steps/json_edits.hpp"

namespace gltfx::steps {
namespace {

using target::Repair;

/// One kind of loss, over all images.
struct Loss {
  std::uint64_t images = 0;
  double bound = 0;                ///< as bound_of()
  double greatest = 0;             ///< the greatest error of a value
  std::optional<double> decibels;  ///< the lowest; infinite: there is no error
  std::optional<double> angle;     ///< the greatest, degrees
};

class ImageStep {
 public:
  /// `only`: images, by index; null: all.
  ImageStep(const StepInput& input, const std::set<std::uint32_t>* only)
      : input_(input),
        only_(only),
        elements_(input.asset.document()),
        bytes_(elements_, input.asset.container(), input.asset.resolver()),
        graph_(input.asset.document(), input.schemas, true),
        others_(other_users(elements_, graph_)),
        sources_(elements_, graph_, others_),
        editor_(input.asset.document()),
        store_(input, elements_, graph_, editor_) {}

  Result<StepOutcome> run() {
    std::vector<Job> jobs = plan();
    parallel_ordered(
        jobs.size(), input_.options.jobs, [&](std::size_t i) { encode(jobs[i], input_.encodings); },
        [](std::size_t) {});
    for (Job& job : jobs) finish(job);
    replace_unused();
    sources_.edit(editor_);
    outcome_.change.edits = editor_.take();
    store_.add_to(outcome_.change);
    describe();
    return std::move(outcome_);
  }

 private:
  std::vector<Job> plan() {
    std::vector<ImageGroup> groups = group_images(elements_, bytes_);
    std::vector<std::size_t> group_of(elements_.count(model::RootArray::images));
    for (std::size_t i = 0; i < groups.size(); ++i) {
      for (const std::uint32_t image : groups[i].images) group_of[image] = i;
    }
    const std::vector<ImageUse> uses =
        image_uses(elements_, graph_, others_, group_of, groups.size());
    std::vector<Job> jobs(groups.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      jobs[i].group = std::move(groups[i]);
      plan(jobs[i], uses[i]);
    }
    return jobs;
  }

  bool is_chosen(const ImageGroup& group) const {
    return only_ == nullptr ||
           std::any_of(group.images.begin(), group.images.end(),
                       [this](std::uint32_t image) { return only_->contains(image); });
  }

  void plan(Job& job, const ImageUse& use) {
    if (job.group.storage == model::Storage::nowhere) return;
    const bool repairs = input_.repairs.has_any({Repair::core_images, Repair::rgb_images});
    if (!repairs && !is_requested(input_.options, use)) return;
    if (!is_chosen(job.group)) return;
    auto bytes = bytes_.image(job.group.images.front());
    if (!bytes) {
      for (const std::uint32_t image : job.group.images) {
        input_.unread.push_back(
            {fmt::format("/images/{}", image), half_sentence(bytes.error().message)});
      }
      return;
    }
    job.file = read_image_file(*std::move(bytes));
    ImageContext context{input_.options, use, true, bytes_.origin()};
    for (const std::uint32_t image : job.group.images) {
      context.allowed = context.allowed && sources_.allow(image, job.file.media_type);
    }
    if (repairs) context.repair = find_repair(job);
    job.plan = plan_image(job.file, context, [&](std::string_view media_type) {
      std::string why;
      for (const std::uint32_t image : job.group.images) {
        if (why.empty()) why = sources_.find_obstacle(image, media_type);
      }
      return why;
    });
    if (job.plan.attempts.empty()) return;
    const std::string why = store_.find_obstacle(job.group);
    if (why.empty()) return;
    job.plan.attempts.clear();
    job.plan.left.push_back(why);
  }

  ImageRepair find_repair(const Job& job) {
    for (const auto& [name, only_required] : input_.repairs.features(Repair::core_images)) {
      if (!sources_.is_format_of(name, job.file.media_type)) continue;
      sources_.unrequire(name);
      const auto& images = job.group.images;
      const bool plain = std::all_of(images.begin(), images.end(), [&](std::uint32_t image) {
        return sources_.has_fallbacks(image);
      });
      if (plain && only_required) continue;
      for (const std::uint32_t image : images) sources_.unlink(image);
      if (!plain) return ImageRepair::core;
    }
    if (!job.file.header) return ImageRepair::none;
    const auto& wanted = input_.repairs.features(Repair::rgb_images);
    for (const std::string_view name : image::features_of(*job.file.header)) {
      if (wanted.contains(name)) return ImageRepair::rgb;
    }
    return ImageRepair::none;
  }

  // An image without users becomes a copy of the one that textures use in its place.
  void replace_unused() {
    const json::Document& document = input_.asset.document();
    const auto& images = elements_.elements(model::RootArray::images);
    const auto stand_ins = sources_.stand_ins();
    for (const auto& [image, other] : stand_ins) {
      for (const std::string_view name : {"uri", "bufferView", "mimeType"}) {
        const json::NodeId value = document.find(images[other], name);
        remove_member(document, editor_, images[image], name);
        if (value == json::kNoNode) continue;
        editor_.append_member(images[image], name, document.raw(value));
      }
    }
    if (stand_ins.empty()) return;
    done_["replaced by the fallback"] += stand_ins.size();
    outcome_.freedom.texels = true;
  }

  void finish(Job& job) {
    std::string why = job.plan.refused;
    if (outcome_.trouble.empty()) outcome_.trouble = job.trouble;
    if (job.encoded.attempt != nullptr) {
      if (auto trouble = take(job)) why = trouble->message;
    }
    for (const std::uint32_t image : job.group.images) {
      const std::string pointer = fmt::format("/images/{}", image);
      for (const std::string& reason : job.plan.left)
        outcome_.row.left.push_back({pointer, reason});
      if (!why.empty()) outcome_.row.refused.push_back({pointer, why});
    }
  }

  std::optional<Error> take(Job& job) {
    const image::Format format = job.encoded.attempt->format;
    const std::string_view type = image::media_type(format);
    const bool same = job.file.format == format;
    if (auto trouble = store_.store(job.group, {std::move(job.encoded.bytes), type, same})) {
      return trouble;
    }
    if (!same) {
      for (const std::uint32_t image : job.group.images) sources_.set_type(image, type);
    }
    note(job);
    return std::nullopt;
  }

  void note(const Job& job) {
    const Encoded& encoded = job.encoded;
    const ImageAttempt& attempt = *encoded.attempt;
    const std::uint64_t count = job.group.images.size();
    const bool same = job.file.format == attempt.format && !job.file.cmyk;
    const bool resized = encoded.source.width != encoded.raster.width ||
                         encoded.source.height != encoded.raster.height;
    const std::string_view name = format_name(attempt.format);
    std::string done = job.file.name;
    if (!same) done += fmt::format(" -> {}", name);
    if (!same && !attempt.lossy && !job.file.cmyk) done += " exact";
    if (resized) done += " resized";
    if (same && !resized) done += attempt.rgb ? " as RGB" : " recompressed";
    done_[done] += count;
    if (job.file.cmyk) losses_["CMYK as RGB"].images += count;
    if (attempt.request.image.resize.needed(encoded.source.width, encoded.source.height)) {
      losses_[describe_size()].images += count;
    } else if (resized) {
      losses_["sides rounded to multiples of 4 texels"].images += count;
    }
    if (encoded.source.bits > encoded.raster.bits) {
      losses_["8 of 16 bits per channel"].images += count;
    }
    outcome_.row.gpu_bytes_before += image::gpu_bytes(job.file.bytes.view()) * count;
    outcome_.row.gpu_bytes_after += encoded.gpu_bytes * count;
    if (attempt.lossy) add_distance(encoded, count);
    outcome_.freedom.texels |=
        resized || attempt.lossy || encoded.source.bits > encoded.raster.bits;
  }

  std::string describe_size() const {
    return fmt::format("resolution above {} texels per side", *input_.options.texture_size);
  }

  void add_distance(const Encoded& encoded, std::uint64_t count) {
    const double bound = bound_of(*encoded.attempt, encoded.source);
    Loss& loss = losses_[describe_encoding(*encoded.attempt, bound)];
    loss.images += count;
    loss.bound = std::max(loss.bound, bound);
    loss.greatest = std::max(loss.greatest, encoded.distance->greatest);
    const double decibels = encoded.distance->decibels();
    loss.decibels = std::min(loss.decibels.value_or(decibels), decibels);
    if (const auto angle = encoded.distance->angle) {
      loss.angle = std::max(loss.angle.value_or(*angle), *angle);
    }
  }

  static std::string describe_encoding(const ImageAttempt& attempt, double bound) {
    const std::string_view name = format_name(attempt.format);
    if (bound > 0) return fmt::format("{} values", name);
    if (attempt.request.quality > 0) {
      return fmt::format("{} of quality {}", name, attempt.request.quality);
    }
    switch (attempt.request.image.resize.kind) {
      case codec::TexelKind::color:
        return fmt::format("{} of colors", name);
      case codec::TexelKind::normal:
        return fmt::format("{} of normals", name);
      case codec::TexelKind::data:
        break;
    }
    return fmt::format("{} of data", name);
  }

  void describe() {
    for (const auto& [done, count] : done_) {
      if (!outcome_.row.what.empty()) outcome_.row.what += ", ";
      outcome_.row.what += fmt::format("{} {}", count, done);
    }
    for (const auto& [name, loss] : losses_) {
      std::string quantity = fmt::format("{} ({}", name, report::counted(loss.images, "image"));
      if (loss.decibels && loss.bound == 0) {
        quantity += std::isfinite(*loss.decibels) ? fmt::format(", {:.1f} dB", *loss.decibels)
                                                  : std::string(", exact");
      }
      if (loss.angle && loss.bound == 0) {
        quantity += fmt::format(", 99 % of the normals within {:.2g} deg", *loss.angle);
      }
      outcome_.row.losses.push_back({quantity + ")", loss.bound, loss.greatest, "/255"});
    }
  }

  const StepInput& input_;
  const std::set<std::uint32_t>* only_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  const graph::Graph graph_;
  const OtherUsers others_;
  ImageSources sources_;
  json::Editor editor_;
  ImageStore store_;
  StepOutcome outcome_;
  std::map<std::string, std::uint64_t> done_;  ///< images by what was done
  std::map<std::string, Loss> losses_;
};

}  // namespace

Result<StepOutcome> convert_images(const StepInput& input, const std::set<std::uint32_t>* only) {
  return ImageStep(input, only).run();
}

}  // namespace gltfx::steps
