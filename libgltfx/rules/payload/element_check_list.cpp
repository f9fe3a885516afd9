// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "base/checked.hpp"
#include "model/animation.hpp"
#include "model/mesh.hpp"
#include "model/skin.hpp"
#include "rules/core/attribute_formats.hpp"
#include "rules/extension_walk.hpp"
#include "rules/payload/element_check.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

using model::Accessor;
using model::ComponentType;
using model::ElementType;
using model::SemanticKind;

constexpr model::Format kTimes{ElementType::scalar, ComponentType::float32, false};
constexpr model::Format kBindMatrix{ElementType::mat4, ComponentType::float32, false};

bool is_index_format(const model::Format& format) {
  return format.type == ElementType::scalar && !format.normalized &&
         model::can_index_elements(format.component);
}

std::vector<double> read_bounds(const json::Document& document, json::NodeId array, bool single) {
  std::vector<double> bounds;
  bounds.reserve(document.array_size(array));
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    const double value = at.number().value;
    bounds.push_back(single ? static_cast<double>(static_cast<float>(value)) : value);
  }
  return bounds;
}

class Scheduler {
 public:
  explicit Scheduler(const Context& context)
      : context_(context),
        model_(context.asset, context.schemas),
        formats_(context),
        positions_(context.views.accessors.size(), kNowhere) {}

  std::vector<Schedule> run() {
    const auto& accessors = context_.views.accessors;
    for (std::uint32_t i = 0; i < accessors.size(); ++i) add_accessor(i, accessors[i]);
    const auto& meshes = context_.views.meshes;
    for (std::uint32_t i = 0; i < meshes.size(); ++i) add_mesh(i, meshes[i]);
    const auto& skins = context_.asset.elements(model::RootArray::skins);
    for (std::uint32_t i = 0; i < skins.size(); ++i) add_skin(i, skins[i]);
    const auto& animations = context_.views.animations;
    for (std::uint32_t i = 0; i < animations.size(); ++i) add_animation(i, animations[i]);
    add_instances();
    return std::move(schedules_);
  }

 private:
  static constexpr std::size_t kNowhere = SIZE_MAX;
  static constexpr std::size_t kFew = 16;
  using Key = std::tuple<std::uint32_t, CheckKind, std::int64_t, bool, bool>;

  const Accessor& accessor(std::uint32_t index) const { return context_.views.accessors[index]; }

  Schedule& schedule(std::uint32_t index) {
    if (positions_[index] == kNowhere) {
      positions_[index] = schedules_.size();
      schedules_.push_back({index, {}});
    }
    return schedules_[positions_[index]];
  }

  void add(std::uint32_t index, Check check) {
    std::vector<Check>& checks = schedule(index).checks;
    check.same_as = first_same(index, checks, check);
    const bool again = check.same_as != checks.size();
    if (again && !context_.deviations.each_finding_is_listed) return;  // once is enough
    checks.push_back(std::move(check));
  }

  static Key key_of(std::uint32_t index, const Check& check) {
    return {index, check.kind, check.most, check.triangles, check.cubic};
  }

  // The position of the first equal check, or one past the last. Most accessors have a handful;
  // only those with very many uses are worth a table.
  std::size_t first_same(std::uint32_t index, const std::vector<Check>& checks,
                         const Check& check) {
    const Key key = key_of(index, check);
    if (checks.size() == kFew) {
      for (const Check& each : checks) seen_.try_emplace(key_of(index, each), each.same_as);
    }
    if (checks.size() >= kFew) return seen_.try_emplace(key, checks.size()).first->second;
    const auto same = std::find_if(checks.begin(), checks.end(),
                                   [&](const Check& each) { return key_of(index, each) == key; });
    return same == checks.end() ? checks.size() : same->same_as;
  }

  void add_accessor(std::uint32_t index, const Accessor& accessor) {
    const model::Format& format = accessor.format;
    if (!format.known() || !model::is_core_component(format.component)) return;
    const bool single = format.component == ComponentType::float32;
    Check check;
    check.place = {Place::Kind::accessor, index, 0, {}, accessor.node};
    if (single) {
      const bool bounds = accessor.min != json::kNoNode && accessor.max != json::kNoNode;
      if (bounds) schedule(index).checks.reserve(3);
      add(index, check);
    }
    const auto add_bound = [&](CheckKind kind, json::NodeId array) {
      if (array == json::kNoNode) return;
      if (!model::is_sound_bound(context_.document, format, array)) return;
      check.kind = kind;
      check.bounds = read_bounds(context_.document, array, single);
      check.place.node = array;
      add(index, check);
    };
    add_bound(CheckKind::minimum, accessor.min);
    add_bound(CheckKind::maximum, accessor.max);
  }

  void add_mesh(std::uint32_t index, const model::Mesh& mesh) {
    if (mesh.has_holes && context_.deviations.broken_values_are_absent) return;
    for (std::uint32_t i = 0; i < mesh.primitives.size(); ++i) {
      add_primitive(index, i, mesh.primitives[i]);
    }
  }

  void add_primitive(std::uint32_t mesh, std::uint32_t index, const model::Primitive& primitive) {
    std::int64_t vertices = -1;
    for (const model::Attribute& attribute : primitive.attributes) {
      if (!attribute.accessor) continue;
      const Accessor& used = accessor(*attribute.accessor);
      if (vertices < 0 && used.count) vertices = static_cast<std::int64_t>(*used.count);
      add_attribute(attribute, used,
                    {Place::Kind::attribute, mesh, index, attribute.name, attribute.value});
    }
    if (!primitive.indices || !is_index_format(accessor(*primitive.indices).format)) return;
    if (vertices < 0 && !context_.deviations.missing_integers_are_minus_one) return;
    Check check;
    check.kind = CheckKind::index;
    check.most = vertices < 0 ? -1 : vertices - 1;
    check.triangles = primitive.mode == model::Mode::triangles;
    check.place = {Place::Kind::indices, mesh, index, {}, primitive.indices_node};
    add(*primitive.indices, check);
  }

  void add_attribute(const model::Attribute& attribute, const Accessor& used, const Place& place) {
    const FormatList* formats = formats_.find(attribute, false);
    if (formats == nullptr || !allows(*formats, used.format)) return;
    Check check;
    check.place = place;
    if (attribute.semantic.kind == SemanticKind::normal) {
      check.kind = CheckKind::unit_vector;
    } else if (attribute.semantic.kind == SemanticKind::tangent) {
      check.kind = CheckKind::unit_tangent;
    } else if (attribute.semantic.kind == SemanticKind::color && attribute.semantic.set == 0 &&
               used.format.component == ComponentType::float32) {
      check.kind = CheckKind::clamped;
    } else if (const auto kind = vertex_value_check(attribute.name);
               kind && !context_.deviations.no_additional_rules) {
      check.kind = *kind;
      check.length_slack = length_of_steps(used.format.component, 4);
    } else {
      return;
    }
    add(*attribute.accessor, check);
  }

  void add_instances() {
    for (const schema::Extension* extension : instancing_extensions(context_)) {
      for_each_extension(
          context_, model::RootArray::nodes, extension->name,
          [&](const ExtensionPlace& place, const Path&) { add_instances(place, extension->name); });
    }
  }

  void add_instances(const ExtensionPlace& place, std::string_view extension) {
    const json::NodeId attributes =
        model::object_member(context_.document, place.object, "attributes");
    if (attributes == json::kNoNode) return;
    for (const auto& attribute : model::read_attributes(context_.asset, attributes)) {
      if (!attribute.accessor) continue;
      const model::Format& format = accessor(*attribute.accessor).format;
      const auto kind = instance_value_check(attribute.name, format);
      if (!kind) continue;
      Check check;
      check.kind = *kind;
      check.length_slack = length_of_steps(format.component, 4);
      check.place = {Place::Kind::instances,
                     static_cast<std::uint32_t>(place.index),
                     0,
                     attribute.name,
                     attribute.value,
                     extension};
      add(*attribute.accessor, check);
    }
  }

  void add_skin(std::uint32_t index, json::NodeId object) {
    const auto matrices =
        context_.asset.index(object, "inverseBindMatrices", model::RootArray::accessors);
    if (!matrices || accessor(*matrices).format != kBindMatrix) return;
    Check check;
    check.kind = CheckKind::bind_matrix;
    check.place = {
        Place::Kind::matrices, index, 0, {}, context_.document.find(object, "inverseBindMatrices")};
    add(*matrices, check);
  }

  void add_animation(std::uint32_t index, const model::Animation& animation) {
    for (std::uint32_t i = 0; i < animation.samplers.size(); ++i) {
      const auto& input = animation.samplers[i].input;
      if (!input || accessor(*input).format != kTimes) continue;
      Check check;
      check.kind = CheckKind::times;
      check.place = {Place::Kind::times,
                     index,
                     i,
                     {},
                     context_.document.find(animation.samplers[i].object, "input")};
      add(*input, check);
    }
    for (std::uint32_t i = 0; i < animation.channels.size(); ++i) {
      const model::AnimationChannel& channel = animation.channels[i];
      if (channel.sampler) {
        add_channel({index, i}, channel, animation.samplers[*channel.sampler]);
      }
    }
  }

  struct ChannelIndex {
    std::uint32_t animation, channel;
  };

  void add_channel(ChannelIndex index, const model::AnimationChannel& channel,
                   const model::AnimationSampler& sampler) {
    if (!sampler.output) return;
    const model::Format& format = accessor(*sampler.output).format;
    if (channel.path != model::AnimationPath::rotation) {
      return add_pointed(index, channel, sampler, format);
    }
    const bool vector = format.type == ElementType::vec4;
    const bool four = model::component_count(format.type) == 4;
    if (!vector && !(four && context_.deviations.formats_count_by_components)) return;
    Check check;
    check.kind = CheckKind::quaternion;
    check.cubic = sampler.interpolation == model::Interpolation::cubic_spline;
    check.place = {Place::Kind::channel,
                   index.animation,
                   index.channel,
                   {},
                   context_.document.find(channel.object, "sampler")};
    add(*sampler.output, check);
  }

  void add_pointed(ChannelIndex index, const model::AnimationChannel& channel,
                   const model::AnimationSampler& sampler, const model::Format& format) {
    auto check = pointer_value_check(context_, model_, channel);
    if (!check || (check->kind == CheckKind::quaternion && format.type != ElementType::vec4))
      return;
    check->cubic = sampler.interpolation == model::Interpolation::cubic_spline;
    check->group = model::component_count(format.type);
    check->place = {Place::Kind::channel,
                    index.animation,
                    index.channel,
                    {},
                    context_.document.find(channel.object, "sampler")};
    add(*sampler.output, *std::move(check));
  }

  const Context& context_;
  model::ObjectModel model_;
  AttributeFormats formats_;
  std::vector<Schedule> schedules_;
  std::vector<std::size_t> positions_;  // positions in schedules_, by accessor
  std::map<Key, std::size_t> seen_;     // first checks of accessors that have more than a few
};

// Half a second for zeros, or for the same bytes in a few accessors each.
constexpr std::uint64_t kFreeNumbers = std::uint64_t{1} << 29U;
constexpr std::uint64_t kNumbersPerByte = 16;
// Some megabytes of report; the limit also grows with the number of floats in buffers.
constexpr std::uint64_t kFreeErrors = 65536;
constexpr std::uint64_t kBytesPerError = 4;

}  // namespace

std::vector<Schedule> schedule_checks(const Context& context) { return Scheduler(context).run(); }

Budget::Budget(const model::ResourceData& resources)
    : left_(kFreeNumbers), listed_left_(kFreeErrors) {
  for (const auto& buffer : resources.buffers) {
    if (!buffer) continue;
    left_ += buffer->size() * kNumbersPerByte;
    listed_left_ += buffer->size() / kBytesPerError;
  }
}

bool Budget::list(std::uint64_t errors) {
  if (errors > listed_left_) return false;
  listed_left_ -= errors;
  return true;
}

bool Budget::take(std::uint64_t count, std::uint64_t each) {
  const Checked cost = checked_mul(count, each);
  if (!cost || *cost > left_) return false;
  left_ -= *cost;
  return true;
}

}  // namespace gltfx::validate
