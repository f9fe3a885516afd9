// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_materials.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "model/image_codec.hpp"
#include "pipeline/scene_detail.hpp"
#include "pipeline/scene_images.hpp"
#include "render/texture.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kMostSentences = 32;

// Images that run into a limit cost a second each: one asset gets no more than two of them.
constexpr int kMostCostly = 2;

// What a worker decodes in the time that another one takes to start.
constexpr std::uint64_t kWorkerPixels = std::uint64_t{1} << 23U;

constexpr std::uint64_t kLargeImage = std::uint64_t{1} << 20U;  // texels

render::Wrap wrap_of(model::Wrap wrap) {
  if (wrap == model::Wrap::clamp_to_edge) return render::Wrap::clamp_to_edge;
  return wrap == model::Wrap::repeat ? render::Wrap::repeat : render::Wrap::mirrored_repeat;
}

// Bytes of the decoded image, as its header has it.
Checked decoded_size(const image::Header& header) {
  const Checked texels = checked_mul(header.width, header.height);
  return texels ? checked_mul(*texels, header.bits > 8 ? 8 : 4) : std::nullopt;
}

using render::Slot;

// Puts the numbers of a parameter where they belong.
struct Assign {
  render::SceneMaterial& to;
  const std::array<float, 4>& from;

  void operator()(double Material::*member) const {
    to.factors.*member = static_cast<double>(from[0]);
  }
  void operator()(Rgb Material::*member) const {
    to.factors.*member = {static_cast<double>(from[0]), static_cast<double>(from[1]),
                          static_cast<double>(from[2])};
  }
  void operator()(float render::SceneMaterial::*member) const { to.*member = from[0]; }
  void operator()(Float3 render::SceneMaterial::*member) const {
    to.*member = {from[0], from[1], from[2]};
  }
};

/// One material on its way.
class Translation {
 public:
  Translation(const model::Material& from, const SceneSource& source, SceneTextures& textures)
      : from_(from), source_(source), textures_(textures) {}

  std::pair<render::SceneMaterial, MaterialNeeds> run() {
    find_sets();
    set_parameters();
    for (std::size_t i = 0; i < kMaterialSlots; ++i) use(static_cast<Slot>(i), from_.slots[i]);
    if (to_.tinted_by_base_color) to_.use(Slot::diffuse_transmission).channel = 0;
    choose_tangents();
    return {std::move(to_), std::move(needs_)};
  }

 private:
  void find_sets() {
    auto& sets = needs_.tex_coords;
    for (const model::TextureSlot& slot : from_.slots) {
      if (slot.texture) sets.push_back(slot.tex_coord);
    }
    // Tangents without a texture to go by are those of the first set.
    if (from_.of(MaterialParameter::anisotropy)[0] > 0) sets.push_back(0);
    std::sort(sets.begin(), sets.end());
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  }

  std::uint32_t position_of(std::uint32_t set) const {
    const auto& sets = needs_.tex_coords;
    return static_cast<std::uint32_t>(std::lower_bound(sets.begin(), sets.end(), set) -
                                      sets.begin());
  }

  void use(Slot slot, const model::TextureSlot& from) {
    if (!from.texture) return;
    render::TextureUse& to = to_.use(slot);
    to.texture = textures_.use(source_, *from.texture);
    to.uv_set = position_of(from.tex_coord);
    to.transform = render::texture_transform(from.offset, from.rotation, from.scale);
  }

  void set_parameters() {
    for (std::size_t i = 0; i < kMaterialParameters; ++i) {
      std::visit(Assign{to_, from_.values[i]}, render::kParameterMembers[i]);
    }
    Material& m = to_.factors;
    m.emissive *= static_cast<double>(to_.emissive_strength);
    m.unlit = from_.unlit;
    to_.toon = from_.toon;
    m.scattering = static_cast<Scattering>(from_.scattering);
    to_.name = from_.name;
    to_.alpha = from_.of(MaterialParameter::base_color)[3];
    to_.alpha_mode = static_cast<render::AlphaMode>(from_.alpha_mode);
    to_.double_sided = from_.double_sided;
    to_.specular_glossiness = from_.specular_glossiness;
    to_.tinted_by_base_color = from_.first_generation;
  }

  void choose_tangents() {
    for (const Slot slot : {Slot::normal, Slot::clearcoat_normal, Slot::anisotropy}) {
      const render::TextureUse& use = std::as_const(to_).use(slot);
      if (use.texture == render::kNone || needs_.tangents) continue;
      needs_.tangents = use;
    }
    if (!needs_.tangents && to_.factors.anisotropy > 0) needs_.tangents = render::TextureUse();
  }

  const model::Material& from_;
  const SceneSource& source_;
  SceneTextures& textures_;
  render::SceneMaterial to_;
  MaterialNeeds needs_;
};

// Why an image is not even tried, or empty.
std::string obstacle_of(const model::ImageData& data) {
  if (!data.bytes) return "has a missing image";
  if (!data.format) return "has an image in an unknown format";
  if (!data.header) return "has an image with an invalid header";
  return model::is_decodable(data)
             ? std::string()
             : "has a KTX2 image whose texels are neither ETC1S with BasisLZ nor UASTC";
}

}  // namespace

void SceneNotes::add(std::string sentence) {
  if (sentences_.size() < kMostSentences) {
    sentences_.push_back(std::move(sentence));
  } else {
    ++more_;
  }
}

void SceneNotes::add(const std::string& place, const std::string& outcome) {
  Kind& kind = kinds_[outcome];
  if (kind.count++ == 0) kind.first = place;
}

void SceneNotes::leave_out(const std::string& place, const std::string& outcome) {
  add(place, outcome);
  kinds_[outcome].left_out = true;
  complete_ = false;
}

void SceneNotes::add_all(SceneNotes& others, const std::string& name) {
  for (const std::string& sentence : others.sentences_) add(fmt::format("{}: {}", name, sentence));
  more_ += others.more_;
  for (const auto& [outcome, theirs] : others.kinds_) {
    Kind& kind = kinds_[outcome];
    if (kind.count == 0) kind.first = fmt::format("{} of {}", theirs.first, name);
    kind.count += theirs.count;
    kind.left_out = kind.left_out || theirs.left_out;
  }
  complete_ = complete_ && others.complete_;
}

std::vector<std::string> SceneNotes::take() {
  std::vector<std::string> before = std::exchange(sentences_, {});
  for (const bool left_out : {true, false}) {
    for (const auto& [outcome, kind] : kinds_) {
      if (kind.left_out != left_out) continue;
      if (kind.count == 1) {
        add(fmt::format("{} {}.", kind.first, outcome));
      } else {
        add(fmt::format("{} {}, and {} more like it.", kind.first, outcome, kind.count - 1));
      }
    }
    for (std::string& sentence : before) add(std::move(sentence));
    before.clear();
  }
  if (more_ > 0) sentences_.push_back(fmt::format("{} more notes were left out.", more_));
  return std::move(sentences_);
}

std::uint32_t SceneTextures::use(const SceneSource& source, std::uint32_t texture) {
  const Place place{&source, texture};
  const auto [known, fresh] = known_.try_emplace(place, static_cast<std::uint32_t>(used_.size()));
  if (!fresh) return known->second;
  used_.push_back(
      {place, model::read_texture(source.asset,
                                  source.asset.elements(model::RootArray::textures)[texture])});
  const model::Sampler& sampler = used_.back().texture.sampler;
  render::Texture to;
  to.wrap_s = wrap_of(sampler.wrap_s);
  to.wrap_t = wrap_of(sampler.wrap_t);
  to.filter =
      sampler.magnify == model::Filter::nearest ? render::Filter::nearest : render::Filter::linear;
  to.missing = true;
  scene_.textures.push_back(std::move(to));
  return known->second;
}

// What memory there may be is settled here, image by image, whatever the number of threads.
void SceneTextures::plan(model::MemoryBudget& budget) {
  for (const Used& used : used_) {
    const SceneSource* const source = used.place.first;
    for (const std::uint32_t image : used.texture.images) {
      const model::ImageData& data = source->resources.images[image];
      if (!obstacle_of(data).empty() || job_of_.count({source, image}) > 0) continue;
      Job job{{source, image},
              0,
              codec::DecodeError{codec::ErrorKind::too_large, "its pixels need too much memory"}};
      if (budget.take(decoded_size(*data.header))) job.result = codec::Image();
      pixels_ = saturating_add(pixels_, texels_of(*data.header));
      job_of_.emplace(job.place, jobs_.size());
      jobs_.push_back(std::move(job));
      break;
    }
  }
}

// An image has the detail that its textures need, where it is worth a look at them.
void SceneTextures::choose_detail(double pixel) {
  std::vector<ImageSize> sizes(used_.size());
  std::vector<Job*> jobs(used_.size());
  bool any = false;
  for (std::size_t i = 0; pixel > 0 && i < used_.size(); ++i) {
    const SceneSource* const source = used_[i].place.first;
    for (const std::uint32_t image : used_[i].texture.images) {
      const auto job = job_of_.find({source, image});
      if (job == job_of_.end()) continue;
      const image::Header& header = *source->resources.images[image].header;
      if (header.format != image::Format::jpeg || texels_of(header) < kLargeImage) continue;
      jobs[i] = &jobs_[job->second];
      jobs[i]->halvings = std::numeric_limits<std::uint32_t>::max();
      sizes[i] = {header.width, header.height};
      any = true;
    }
  }
  if (!any) return;
  const std::vector<std::uint32_t> halvings = find_halvings(scene_, sizes, pixel);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i] != nullptr) jobs[i]->halvings = std::min(jobs[i]->halvings, halvings[i]);
  }
}

void SceneTextures::decode(codec::Client& client, unsigned jobs, model::MemoryBudget& budget,
                           double pixel) {
  plan(budget);
  choose_detail(pixel);
  const auto worth = static_cast<unsigned>(std::min<std::uint64_t>(pixels_ / kWorkerPixels, 64));
  std::atomic<bool> stopped = false;
  int costly = 0;
  parallel_ordered(
      jobs_.size(), std::min(jobs == 0 ? default_jobs() : jobs, 1 + worth),
      [&](std::size_t i) {
        Job& job = jobs_[i];
        if (stopped || std::holds_alternative<codec::DecodeError>(job.result)) return;
        codec::ImageRequest request =
            model::image_request(job.place.first->resources, job.place.second);
        request.pixels = true;
        request.halvings = job.halvings;
        job.result = SceneImages::shared().decode(client, request);
      },
      [&](std::size_t i) {
        codec::ImageResult& result = jobs_[i].result;
        if (stopped)
          result = codec::DecodeError{codec::ErrorKind::timed_out, "others took too long"};
        const auto* error = std::get_if<codec::DecodeError>(&result);
        if (error != nullptr && codec::is_costly(*error) && ++costly == kMostCostly) stopped = true;
      });
  for (std::uint32_t i = 0; i < used_.size(); ++i) finish(i);
}

void SceneTextures::finish(std::uint32_t index) {
  std::string why = "has no image";
  const Used& used = used_[index];
  const SceneSource& source = *used.place.first;
  for (const std::uint32_t image : used.texture.images) {
    const auto job = job_of_.find({&source, image});
    if (job == job_of_.end()) {
      why = obstacle_of(source.resources.images[image]);
      continue;
    }
    const codec::ImageResult& result = jobs_[job->second].result;
    if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
      why = fmt::format("has an image that cannot be decoded ({})", printable(error->message));
      continue;
    }
    const auto& decoded = std::get<codec::Image>(result);
    render::Texture& to = scene_.textures[index];
    to.width = decoded.width;
    to.height = decoded.height;
    to.channels = decoded.channels;
    to.bits = decoded.bits;
    to.pixels = decoded.pixels;
    to.owner = decoded.owner;
    to.missing = decoded.pixels.empty();
    if (!to.missing) return;
  }
  source.notes.add(fmt::format("Texture {}", used.place.second),
                   fmt::format("{}; a checkerboard is shown instead", why));
}

const MaterialNeeds& SceneMaterials::use(const std::optional<std::uint32_t>& material) {
  if (!material) return default_;
  const auto known = known_.find(*material);
  if (known != known_.end()) return known->second;
  const model::Material read = model::read_material(source_.asset, *material, &source_.animated);
  if (read.toon) {
    source_.notes.add(
        fmt::format("Material {}", *material),
        "is drawn matte, in a color between its own and its shade; steps of toon shading, "
        "outlines and rim light are not drawn");
  }
  MaterialNeeds needs = translate(read);
  if (uvs_ && needs.tex_coords.empty()) needs.tex_coords = {0};
  return known_.emplace(*material, std::move(needs)).first->second;
}

MaterialNeeds SceneMaterials::translate(const model::Material& material) {
  auto [translated, needs] = Translation(material, source_, textures_).run();
  needs.material = static_cast<std::uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(translated));
  return std::move(needs);
}

}  // namespace gltfx
