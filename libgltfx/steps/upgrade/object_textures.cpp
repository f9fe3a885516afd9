// SPDX-License-Identifier: Apache-2.0
// Textures of a legacy object whose data is needed in other channels.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "change/lost_content.hpp"
#include "json/document.hpp"
#include "model/asset.hpp"
#include "model/fields.hpp"
#include "steps/upgrade/object_plan.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::string_view kTransform = "KHR_texture_transform";

using Numbers = std::vector<double>;

/// The placement members of a texture info, with defaults.
struct Placement {
  std::uint64_t tex_coord = 0;
  Numbers offset{0, 0}, scale{1, 1};
  double rotation = 0;
  bool plain = true;  ///< no extensions except the transform
  bool operator==(const Placement&) const = default;
};

void read_pair(const json::Document& document, json::NodeId object, std::string_view name,
               Numbers& to) {
  const json::NodeId list = document.find(object, name);
  if (list == json::kNoNode || document.kind(list) != json::Kind::number_array) return;
  to.clear();
  for (json::NumberCursor at(document, list); at.valid(); at.advance()) {
    to.push_back(at.number().value);
  }
}

Placement placement_of(const json::Document& document, json::NodeId info) {
  Placement placement;
  if (!document.is_object(info)) return placement;
  placement.tex_coord = model::unsigned_member(document, info, "texCoord").value_or(0);
  const json::NodeId extensions = model::object_member(document, info, "extensions");
  if (extensions == json::kNoNode) return placement;
  for (const auto extension : document.members(extensions)) {
    placement.plain = placement.plain && document.key(extension.key_id) == kTransform;
  }
  const json::NodeId transform = model::extension_object(document, info, kTransform);
  if (transform == json::kNoNode) return placement;
  const auto instead = model::unsigned_member(document, transform, "texCoord");
  placement.tex_coord = instead.value_or(placement.tex_coord);
  placement.rotation = model::number_member(document, transform, "rotation").value_or(0);
  read_pair(document, transform, "offset", placement.offset);
  read_pair(document, transform, "scale", placement.scale);
  return placement;
}

/// wrapS, wrapT, minFilter, magFilter; 0 if a renderer may choose.
std::array<std::uint64_t, 4> settings_of(const model::Asset& asset,
                                         std::optional<std::uint64_t> index) {
  constexpr std::uint64_t kRepeat = 10497;
  std::array<std::uint64_t, 4> settings{kRepeat, kRepeat, 0, 0};
  const auto& samplers = asset.elements(model::RootArray::samplers);
  if (!index || *index >= samplers.size()) return settings;
  constexpr std::array<std::string_view, 4> kNames{"wrapS", "wrapT", "minFilter", "magFilter"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto value = model::unsigned_member(asset.document(), samplers[*index], kNames[i]);
    settings[i] = value.value_or(settings[i]);
  }
  return settings;
}

// Whether two texture infos (or bare indices) have the same placement: same set of texture
// coordinates and same transform, with defaults, and no other extension.
bool lie_alike(const json::Document& document, json::NodeId one, json::NodeId other) {
  const Placement placement = placement_of(document, one);
  return placement.plain && placement == placement_of(document, other);
}

// Whether two samplers (nothing: the default one) have the same wrapping and filters.
bool sample_alike(const model::Asset& asset, std::optional<std::uint64_t> one,
                  std::optional<std::uint64_t> other) {
  return settings_of(asset, one) == settings_of(asset, other);
}

// Why the colour of one image and a channel of another cannot be in one image: different sizes, or
// more than 8 bits of colour. Empty: they can.
std::string packing_obstacle(const Picture& colour, const Picture& factor) {
  if (colour.image.bits != 8) return "the color has more than 8 bits";
  if (colour.image.width == factor.image.width && colour.image.height == factor.image.height) {
    return {};
  }
  return fmt::format("the images have {}x{} and {}x{} texels", colour.image.width,
                     colour.image.height, factor.image.width, factor.image.height);
}

}  // namespace

// The index of the texture in a texture info, or a bare index.
json::NodeId ObjectPlan::texture_index(const Found& found) const {
  return document_.is_number(found.value) ? found.value : document_.find(found.value, "index");
}

// The member that multiplies the texels of a step; empty: none.
std::string ObjectPlan::factor_of(const schema::UpgradeStep& step) const {
  const schema::TypeId type = context_.set.shape(extension_.attachment_points.front().second).type;
  const schema::Property* property =
      type == schema::kNone ? nullptr : context_.set.find_property(type, step.from);
  if (property == nullptr || property->shape == schema::kNone) return {};
  const auto& slot = context_.set.shape(property->shape).slot;
  return slot ? slot->scaled_by : std::string();
}

ObjectPlan::Problem ObjectPlan::find_channel(const schema::UpgradeStep& step, Found& found) {
  const json::NodeId index = texture_index(found);
  if (index == json::kNoNode) return fmt::format("its {} does not reference a texture", step.from);
  if (Problem problem = check_texture(step.from, index)) return problem;
  const std::uint64_t texture = document_.unsigned_integer(index).value_or(0);
  const ChannelMove move =
      check_channel_move(context_.asset, texture, step.swizzle, context_.pictures);
  const std::string wanted = fmt::format("texture {} has its data in {}, but {} reads {}", texture,
                                         step.swizzle.front(), step.to, step.swizzle.back());
  if (move.kind == ChannelMove::Kind::impossible) {
    action_.outcome = UpgradeOutcome::needs_image;
    action_.notes.push_back(fmt::format("{}; {}", wanted, move.problem));
    return std::nullopt;
  }
  if (!move.note.empty()) {
    action_.notes.push_back(
        fmt::format("texture {} is read from its fallback ({})", texture, move.note));
  }
  weigh_evidence(step, move);
  if (move.constant && fold(step, *move.constant, found)) return std::nullopt;
  if (move.kind == ChannelMove::Kind::reuse) return std::nullopt;
  action_.notes.push_back(wanted + "; a new image is created");
  found.image = move.job;
  found.sampler = move.sampler;
  return std::nullopt;
}

// If the new channel of a map also has data, the object may be of a generation that reads this
// channel.
void ObjectPlan::weigh_evidence(const schema::UpgradeStep& step, const ChannelMove& move) {
  const bool told = context_.options.generation != "auto" || extension_.generations.size() < 2;
  if (told || !move.target_varies || move.kind == ChannelMove::Kind::reuse) return;
  lose(
      fmt::format("the image of {} also has data in {}, which another draft uses; set --generation",
                  step.from, step.swizzle.back()));
}

// A texture that is the same everywhere is multiplied into the factor as a number.
bool ObjectPlan::fold(const schema::UpgradeStep& step, double constant, Found& texture) {
  const std::string factor = factor_of(step);
  const auto factors = std::find_if(found_.begin(), found_.end(), [&](const Found& each) {
    return each.step->kind == schema::UpgradeStep::Kind::move && each.step->from == factor;
  });
  if (factors == found_.end() || is_pointed_at({"extensions", extension_.name, factor}) ||
      is_pointed_at({"extensions", extension_.name, step.from}) ||
      !change::foreign_below(document_, context_.set, texture.value).empty()) {
    return false;
  }
  texture.gone = true;
  texture.json.clear();
  action_.notes.push_back(constant == 1
                              ? fmt::format("{} is 1 in all texels and is removed", step.from)
                              : fmt::format("{} is {} in all texels and is multiplied into {}",
                                            step.from, number_text(constant), factor));
  if (constant == 1) return true;
  const double product = document_.number(factors->value).value * constant;
  factors->json = number_text(product);
  action_.removed =
      product == 0 && factor == extension_.strength && !is_own_pointed_at() && foreign().empty();
  return true;
}

// Packs the new image of a factor and a copied colour into RGB and A of one image.
void ObjectPlan::pack() {
  const auto factor = std::find_if(found_.begin(), found_.end(), [](const Found& each) {
    return each.image && each.step->kind == schema::UpgradeStep::Kind::move &&
           each.step->swizzle.back() == 'a';
  });
  const auto colour = std::find_if(found_.begin(), found_.end(), [&](const Found& each) {
    return each.step->kind == schema::UpgradeStep::Kind::copy && each.step->take == 0 &&
           document_.find(each.value, "index") != json::kNoNode;
  });
  if (factor == found_.end() || colour == found_.end()) return;
  const std::string obstacle = pack(*factor, *colour);
  if (!obstacle.empty()) action_.notes.push_back("not packed with the color: " + obstacle);
}

std::string ObjectPlan::pack(Found& factor, Found& colour) {
  if (!lie_alike(document_, factor.value, colour.value)) {
    return "the textures have different coordinates or transforms";
  }
  if (context_.find_taken_over(host_, colour.step->from)) {
    return "the color comes from another upgraded extension";
  }
  if (context_.is_pointed_at(host_, split_path(colour.step->from)) ||
      is_pointed_at({"extensions", extension_.name, factor.step->from})) {
    return "one of the textures is animated";
  }
  const std::uint64_t texture =
      document_.unsigned_integer(document_.find(colour.value, "index")).value_or(0);
  const TextureSource source = texture_source(context_.asset, texture, *context_.pictures);
  if (!source.problem.empty()) return source.problem;
  if (!sample_alike(context_.asset, factor.sampler, source.sampler)) {
    return "the textures are sampled differently";
  }
  constexpr std::uint8_t kAlpha = 3;
  const std::uint64_t map = factor.image->channels[kAlpha].image.value_or(0);
  const std::string obstacle =
      packing_obstacle(context_.pictures->picture(source.image), context_.pictures->picture(map));
  if (!obstacle.empty()) return obstacle;
  for (std::uint8_t i = 0; i < kAlpha; ++i) {
    factor.image->channels[i] = ChannelSource::of(source.image, i);
  }
  colour.image = factor.image;
  colour.sampler = factor.sampler;
  const json::NodeId mode = document_.find(host_.node, "alphaMode");
  colour.shared = mode == json::kNoNode || document_.raw(mode) == R"("OPAQUE")";
  action_.notes.push_back(fmt::format("{} and {} share the image{}", factor.step->to,
                                      colour.step->to,
                                      colour.shared ? " with " + colour.step->from : ""));
  return {};
}

void ObjectPlan::release(const Found& found) {
  const auto index = document_.unsigned_integer(texture_index(found));
  if (index) context_.plan.released.push_back(*index);
}

std::string ObjectPlan::new_texture(const Found& found) {
  return std::to_string(context_.add_texture(*found.image, found.sampler));
}

void ObjectPlan::show_copy(const Found& found) {
  const std::string texture = new_texture(found);
  const json::NodeId index = texture_index(found);
  const std::uint32_t begin = document_.span(found.value).begin;
  const Span place{document_.span(index).begin - begin, document_.span(index).end - begin};
  std::string info(document_.raw(found.value));
  info.replace(place.begin, place.size(), texture);
  context_.editor.append_member(host_.object, found.step->to, info);
  if (found.shared) context_.editor.replace_scalar(index, texture);
}

void ObjectPlan::show(const Found& found) {
  const std::string texture = new_texture(found);
  if (found.json.empty()) return context_.editor.replace_scalar(texture_index(found), texture);
  context_.editor.replace(host_.object, found.value, fmt::format(R"({{"index":{}}})", texture));
}

}  // namespace gltfx::upgrade
