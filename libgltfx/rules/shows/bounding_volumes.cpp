// SPDX-License-Identifier: Apache-2.0
// Bounding volumes (glTF 2.1) that do not enclose the geometry of their nodes.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "codec/client.hpp"
#include "measure/source.hpp"
#include "model/volume_contents.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"
#include "rules/shows/child_points.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::BoundingVolume;
using model::NodeIndex;
using model::RootArray;
using model::Vector3;
using model::VolumeMiss;

// "0.25 (3.6 % of its diagonal)".
std::string amount_of(const BoundingVolume& volume, const VolumeMiss& miss) {
  if (!(volume.size() > 0)) return fmt::format("{:.6g}", miss.distance);
  return fmt::format("{:.6g} ({:.3g} % of its {})", miss.distance,
                     100 * miss.distance / volume.size(), volume.is_box ? "diagonal" : "diameter");
}

std::string animation_of(const Context& context, const VolumeMiss& miss) {
  if (miss.external == nullptr) {
    return object_label(context, RootArray::animations, *miss.animation);
  }
  const model::Asset& asset = miss.external->source->asset;
  const std::string name = asset.name(asset.elements(RootArray::animations)[*miss.animation]);
  return fmt::format("animation {}{} of {}", *miss.animation,
                     name.empty() ? name : fmt::format(" ({})", gltfx::quoted(name)),
                     gltfx::quoted(miss.external->name));
}

std::string moment_of(const Context& context, const VolumeMiss& miss) {
  if (!miss.animation) return "at rest";
  return fmt::format("at {:.4g} s of {}", miss.time, animation_of(context, miss));
}

// A node draws a mesh, or another asset.
std::string vertex_of(const Context& context, const VolumeMiss& miss) {
  const std::string node = object_label(context, RootArray::nodes, miss.node);
  if (!context.views.nodes[miss.node].mesh) return "a vertex of the external asset of " + node;
  return fmt::format("vertex {} of primitive {} of {}", miss.vertex.vertex, miss.vertex.primitive,
                     node);
}

void report_volume(DataPhase& phase, const BoundingVolume& volume,
                   const model::VolumeVerdict& verdict) {
  const Context& context = phase.context;
  const VolumeMiss& miss = verdict.greatest;
  if (!(miss.distance > model::tolerance_of(volume, miss))) return;
  const bool at_rest = verdict.at_rest.distance > model::tolerance_of(volume, verdict.at_rest);
  report_at(
      phase.sink, fmt::format("/nodes/{}/boundingVolume", verdict.node),
      finding_on(context, volume.object,
                 at_rest ? Code::BOUNDING_VOLUME_TOO_SMALL : Code::BOUNDING_VOLUME_MISSES_POSES,
                 fmt::format("The bounding volume of {} does not enclose {}, which lies {} "
                             "outside {}.",
                             object_label(context, RootArray::nodes, verdict.node),
                             vertex_of(context, miss), amount_of(volume, miss),
                             moment_of(context, miss))));
}

// --- Fixes ---

/// Volumes of the asset that is fixed, and how many nodes use each shape.
class FixedVolumes {
 public:
  explicit FixedVolumes(Fixing& fixing)
      : source_{fixing.elements(), fixing.views(), fixing.resources(), decoded(fixing)},
        children_(fixing.opened()),
        contents_(source_, fixing.schemas(), &children_) {}

  model::VolumeContents& contents() { return contents_; }
  // The index of a shape that is appended.
  std::size_t add_shape(std::size_t stored) { return stored + added_++; }

 private:
  const model::DracoMeshes& decoded(Fixing& fixing) {
    draco_.add_all(fixing.elements(), fixing.views(), fixing.resources());
    draco_.decode(codec::Client::shared(), 1);
    return draco_;
  }

  model::DracoMeshes draco_;
  const model::GeometrySource source_;
  ChildPoints children_;
  model::VolumeContents contents_;
  std::size_t added_ = 0;
};

double number_in(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// The least number of seven digits that is not below another one: readers may have single
// precision.
double rounded_up(double value) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 6);
  const double near = std::round(value / unit) * unit;
  return number_in(fmt::format("{:.7g}", near >= value * (1 - 1e-12) ? near : near + unit));
}

double rounded(double value) { return number_in(fmt::format("{:.7g}", value)) + 0.0; }

std::string list_of_three(const Vector3& values) {
  return fmt::format("[{}, {}, {}]", values[0], values[1], values[2]);
}

// The form of a shape around a fitted volume, and the rounded center.
struct WrittenVolume {
  Vector3 center{};
  std::string form;  ///< the object of the type
};

WrittenVolume write_volume(const BoundingVolume& volume, const model::FittedVolume& fitted) {
  constexpr double kThin = 1e-6;  // of the longest side: shapes are not flat
  WrittenVolume written;
  double off = 0;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    written.center[k] = rounded(fitted.center[k]);
    off = std::hypot(off, written.center[k] - fitted.center[k]);
    longest = std::max(longest, fitted.half[k]);
  }
  Vector3 size{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double half = fitted.half[k] + off;
    size[k] = rounded_up(2 * std::max({half, kThin * longest, 1e-9}));
  }
  written.form = volume.is_box
                     ? fmt::format("{{\"size\": {}}}", list_of_three(size))
                     : fmt::format("{{\"radius\": {}}}", rounded_up(fitted.half[0] + off));
  return written;
}

bool set_member(Fixing& fixing, json::NodeId object, std::string_view name,
                const std::string& text) {
  const json::NodeId old = fixing.document().find(object, name);
  return old == json::kNoNode ? fixing.append_member(object, name, text)
                              : fixing.replace(old, text);
}

// Gives the volume its own shape, or changes the shape that it alone uses.
bool write_shape(Fixing& fixing, const BoundingVolume& volume, const WrittenVolume& written) {
  const json::Document& document = fixing.document();
  const model::ShapeObject shape = model::read_shapes(fixing.elements())[volume.shape];
  const std::string type = volume.is_box ? "box" : "sphere";
  const bool alone = fixing.graph().users(shape.object).size() == 1 &&
                     fixing.graph().unknown_extensions().empty() &&
                     !fixing.is_claimed(shape.object);
  if (alone) {
    const std::string_view member = volume.is_box ? "size" : "radius";
    if (shape.form == json::kNoNode) return set_member(fixing, shape.object, type, written.form);
    const std::size_t begin = written.form.find(": ") + 2;
    return set_member(fixing, shape.form, member,
                      written.form.substr(begin, written.form.size() - begin - 1));
  }
  const json::NodeId shapes = document.find(document.root(), "shapes");
  const std::size_t index =
      fixing.table<FixedVolumes>().add_shape(static_cast<std::size_t>(document.array_size(shapes)));
  fixing.editor().append_element(
      shapes, fmt::format("{{\"type\": \"{}\", \"{}\": {}}}", type, type, written.form));
  return fixing.replace_scalar(document.find(volume.object, "shape"), fmt::format("{}", index));
}

bool enclose(Fixing& fixing, const Subject& subject, bool poses) {
  const json::Document& document = fixing.document();
  const auto node = fixing.index(RootArray::nodes, subject.owner);
  if (!node || fixing.is_claimed(subject.owner)) return false;
  model::VolumeContents& contents = fixing.table<FixedVolumes>().contents();
  const auto& volume = contents.volumes()[*node];
  if (!volume) return false;
  const auto fitted = contents.fit(*node, poses);
  if (!fitted || !fixing.claim(subject.owner)) return false;
  const WrittenVolume written = write_volume(*volume, *fitted);
  if (!write_shape(fixing, *volume, written)) return false;
  const json::NodeId scale = document.find(volume->object, "scale");
  if (scale != json::kNoNode) fixing.remove_member(scale);
  const json::NodeId moved = document.find(volume->object, "translation");
  const bool centered = written.center == Vector3{};
  if (!centered)
    return set_member(fixing, volume->object, "translation", list_of_three(written.center));
  if (moved != json::kNoNode) fixing.remove_member(moved);
  return true;
}

bool enclose_rest(Fixing& fixing, const Subject& subject) {
  return enclose(fixing, subject, false);
}
bool enclose_poses(Fixing& fixing, const Subject& subject) {
  return enclose(fixing, subject, true);
}

}  // namespace

void check_bounding_volumes(DataPhase& phase) {
  const Context& context = phase.context;
  if (context.version <= schema::kVersion2 || model::read_shapes(context.asset).empty()) return;
  if (!is_enabled(context.options, Code::BOUNDING_VOLUME_TOO_SMALL) &&
      !is_enabled(context.options, Code::BOUNDING_VOLUME_MISSES_POSES)) {
    return;
  }
  const auto volumes = model::read_bounding_volumes(context.asset, context.views.nodes);
  if (std::none_of(volumes.begin(), volumes.end(), [](const auto& each) { return each; })) return;
  ChildPoints children(*context.opened);
  model::VolumeContents contents(phase.measured.geometry(), context.schemas, &children);
  for (const model::VolumeVerdict& verdict : contents.judge()) {
    report_volume(phase, *contents.volumes()[verdict.node], verdict);
  }
}

const RuleGroup& bounding_volume_rules() {
  static constexpr FixEntry kFixes[] = {
      {Code::BOUNDING_VOLUME_TOO_SMALL, enclose_rest, FixStage::document, enclose_poses},
      {Code::BOUNDING_VOLUME_MISSES_POSES, enclose_poses}};
  static constexpr RuleGroup group{.fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
