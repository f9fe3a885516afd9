// SPDX-License-Identifier: Apache-2.0
// Triangles wound against their normals, and closed surfaces that face inward.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/material.hpp"
#include "rules/finding.hpp"
#include "rules/shows/facing.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/turn_faces.hpp"

namespace gltfx::validate {
namespace {

using model::Primitive;
using model::RootArray;

/// A surface on the wrong side.
struct WrongSide {
  enum class Cause : std::uint8_t { triangles, normals, unknown };

  Code code = Code::NORMALS_AGAINST_WINDING;
  Cause cause = Cause::unknown;
  std::uint32_t mesh = 0;
  std::optional<std::uint32_t> primitive = std::nullopt;  ///< nothing: all of the mesh
  double against = 0, triangles = 0;
  bool hidden = false;  ///< by a double-sided material
};

struct SidePart {
  std::uint32_t primitive = 0;
  TriangleReader triangles;
  Facing facing = {};
};

class WrongSides {
 public:
  WrongSides(DataPhase& phase, PlacedScene& scene)
      : phase_(phase), context_(phase.context), scene_(scene) {}

  void run() {
    for (std::uint32_t i = 0; i < context_.views.meshes.size(); ++i) {
      if (scene_.draws(i) && found_.size() < kMostSurfaces) suspect(i);
    }
    // What is meant to face inward need not be looked at.
    std::vector<WrongSide> suspects;
    for (const WrongSide& each : found_) {
      if (each.code != Code::SURFACE_INSIDE_OUT || !is_meant(each)) suspects.push_back(each);
    }
    found_.clear();
    for (const WrongSide& each : suspects) {
      if (found_.size() < kMostSurfaces) examine(each.mesh);
    }
    if (found_.size() > kMostSurfaces) found_.resize(kMostSurfaces);
    std::vector<WrongSide> left;
    for (const WrongSide& each : found_) {
      if (!is_meant(each)) left.push_back(each);
    }
    report(left, Code::NORMALS_AGAINST_WINDING);
    report(left, Code::SURFACE_INSIDE_OUT);
  }

 private:
  // Of an asset that are judged: each is compared with all that the scene draws.
  static constexpr std::size_t kMostSurfaces = 256;
  // Triangles of a primitive that are looked at first; then one of so many, at least and at most.
  static constexpr std::uint64_t kFirst = 8, kOneOf = 32, kLeast = 64, kMost = 4096;

  std::vector<SidePart> parts_of(std::uint32_t mesh) const {
    std::vector<SidePart> parts;
    const auto& primitives = context_.views.meshes[mesh].primitives;
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
      auto triangles = TriangleReader::open(phase_, primitives[i]);
      if (triangles) parts.push_back({i, *std::move(triangles)});
    }
    return parts;
  }

  Vec3d middle_of_mesh(std::uint32_t mesh) {
    const BoundsBox box = phase_.box_of_mesh(mesh);
    return {(box.least[0] + box.most[0]) / 2, (box.least[1] + box.most[1]) / 2,
            (box.least[2] + box.most[2]) / 2};
  }

  // Notes a mesh that may be on the wrong side.
  void suspect(std::uint32_t mesh) {
    const auto parts = parts_of(mesh);
    if (parts.empty() || !is_sound(phase_.box_of_mesh(mesh))) return;
    const Vec3d origin = middle_of_mesh(mesh);
    constexpr double kAtFirst = 0.5, kThen = 0.1, kOpen = 0.4;
    const auto few = [](std::uint64_t) { return kFirst; };
    Sample sample = sampled(parts, origin, 1, few);
    if (!sample.turned && sample.whole.surely_outward(kAtFirst)) return;
    const auto many = [](std::uint64_t count) { return std::clamp(count / kOneOf, kLeast, kMost); };
    sample = sampled(parts, origin, 3, many);
    if (sample.turned) {
      found_.push_back({.mesh = mesh});
    } else if (!sample.whole.surely_outward(kThen) && !sample.whole.surely_open(kOpen) &&
               !scene_.skins(mesh)) {
      found_.push_back({Code::SURFACE_INSIDE_OUT, WrongSide::Cause::triangles, mesh});
    }
  }

  struct Sample {
    Facing whole;
    bool turned = false;  ///< half of the triangles of a primitive, or more
  };

  template <typename Number>
  static Sample sampled(const std::vector<SidePart>& parts, const Vec3d& origin,
                        std::size_t normals, Number number) {
    Sample sample;
    for (const SidePart& part : parts) {
      const std::uint64_t count = part.triangles.count();
      if (count == 0) continue;
      const std::uint64_t most = std::min(count, number(count));
      const Facing facing = sum_some(part.triangles, most, normals, origin);
      sample.turned = sample.turned || (facing.judged > 0 && 2 * facing.against >= facing.judged);
      sample.whole.add(facing, static_cast<double>(count) / static_cast<double>(most));
    }
    return sample;
  }

  void examine(std::uint32_t mesh) {
    auto parts = parts_of(mesh);
    const Vec3d origin = middle_of_mesh(mesh);
    Facing whole;
    for (SidePart& part : parts) {
      if (!phase_.budget.take(part.triangles.count(), 9) ||
          !phase_.budget.take(part.triangles.vertex_count(), 5)) {
        return;
      }
      part.facing = sum_all(part.triangles, origin);
      whole.add(part.facing, 1);
    }
    judge(mesh, parts, whole);
  }

  // Normals that are on the other side say more than a volume, and explain it.
  void judge(std::uint32_t mesh, const std::vector<SidePart>& parts, const Facing& whole) {
    bool turned = false;
    bool all_closed = true;
    for (const SidePart& part : parts) {
      all_closed = all_closed && part.facing.closed();
      if (!part.facing.turned()) continue;
      turned = true;
      WrongSide wrong{.mesh = mesh, .primitive = part.primitive};
      const Facing* surface = part.facing.closed() ? &part.facing : nullptr;
      if (surface == nullptr && whole.closed()) surface = &whole;
      if (surface != nullptr && surface->inward()) wrong.cause = WrongSide::Cause::triangles;
      if (surface != nullptr && surface->outward()) wrong.cause = WrongSide::Cause::normals;
      add(wrong, part.facing);
    }
    if (turned || scene_.skins(mesh)) return;
    const WrongSide inside{Code::SURFACE_INSIDE_OUT, WrongSide::Cause::triangles, mesh};
    if (!all_closed || parts.size() == 1) {
      if (whole.closed() && whole.inward()) add(inside, whole);
      return;
    }
    for (const SidePart& part : parts) {
      if (!part.facing.inward()) continue;
      WrongSide wrong = inside;
      wrong.primitive = part.primitive;
      add(wrong, part.facing);
    }
  }

  void add(WrongSide wrong, const Facing& facing) {
    wrong.against = facing.against;
    wrong.triangles = facing.looked;
    wrong.hidden = all_materials(wrong, [&](std::uint32_t material) {
      return model::true_member(context_.document,
                                context_.asset.elements(RootArray::materials)[material],
                                "doubleSided");
    });
    found_.push_back(wrong);
  }

  // Whether the surface has materials that all answer yes.
  template <typename Ask>
  bool all_materials(const WrongSide& wrong, Ask ask) const {
    const auto& primitives = context_.views.meshes[wrong.mesh].primitives;
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
      if (wrong.primitive.value_or(i) != i) continue;
      if (!primitives[i].material || !ask(*primitives[i].material)) return false;
    }
    return true;
  }

  // Hulls that draw an outline, rooms and skies face inward.
  bool is_meant(const WrongSide& wrong) {
    if (wrong.code == Code::NORMALS_AGAINST_WINDING) {
      return wrong.cause == WrongSide::Cause::triangles && encloses(wrong, kNearlyAll);
    }
    const auto is_unlit = [&](std::uint32_t material) {
      return model::read_material(context_.asset, material).unlit;
    };
    return is_named_so(wrong) || all_materials(wrong, is_unlit) || encloses(wrong, 0);
  }

  bool is_named_so(const WrongSide& wrong) const {
    constexpr std::array<std::string_view, 7> kWords = {
        "sky", "dome", "room", "outline", "interior", "backdrop", "environment"};
    const auto fits = [&](json::NodeId object) {
      constexpr std::size_t kLongestName = 256;
      const std::string name = lower_case(
          model::string_member(context_.document, object, "name").substr(0, kLongestName));
      return std::any_of(kWords.begin(), kWords.end(), [&](std::string_view word) {
        return name.find(word) != std::string::npos;
      });
    };
    if (fits(context_.views.meshes[wrong.mesh].node)) return true;
    const auto placed = first_place(wrong);
    if (placed && fits(context_.views.nodes[placed->node].object)) return true;
    return all_materials(wrong, [&](std::uint32_t material) {
      return fits(context_.asset.elements(RootArray::materials)[material]);
    });
  }

  // Where a node draws the surface.
  std::optional<Placed> first_place(const WrongSide& wrong) const {
    std::optional<Placed> found;
    for (const Placed& each : scene_.parts()) {
      if (each.mesh != wrong.mesh || wrong.primitive.value_or(each.primitive) != each.primitive) {
        continue;
      }
      if (!found) {
        found = each;
      } else if (found->node == each.node) {
        found->box.include(each.box);
      }
    }
    return found;
  }

  static constexpr double kNearlyAll = 0.7;

  // Whether a surface has another one or a camera in it, which is at least so wide in parts of its
  // own width.
  bool encloses(const WrongSide& wrong, double least_width) {
    const auto own = first_place(wrong);
    if (!own) return false;
    const auto holds = [&](const BoundsBox& box) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double width = own->box.most[k] - own->box.least[k];
        const double slack = 1e-3 * width;
        if (box.least[k] < own->box.least[k] - slack || box.most[k] > own->box.most[k] + slack) {
          return false;
        }
        if (box.most[k] - box.least[k] < least_width * width) return false;
      }
      return true;
    };
    // Whoever has very many wrong surfaces gets a finding for none of them.
    if (!phase_.budget.take(scene_.parts().size() + context_.views.nodes.size(), 2)) return true;
    for (const Placed& each : scene_.parts()) {
      const bool same =
          each.mesh == wrong.mesh && wrong.primitive.value_or(each.primitive) == each.primitive;
      if (!same && !is_wrong_as(wrong, each) && holds(each.box)) return true;
    }
    if (least_width > 0) return false;
    for (std::size_t i = 0; i < context_.views.nodes.size(); ++i) {
      if (!context_.views.nodes[i].camera || scene_.pose().in_scene[i] == 0) continue;
      const model::Vector3& eye = scene_.pose().world[i].columns[3];
      if (holds({eye, eye})) return true;
    }
    return false;
  }

  bool is_wrong_as(const WrongSide& wrong, const Placed& placed) const {
    // In the order of meshes and primitives; a mesh has either one entry, or some of primitives.
    const auto before = [](const WrongSide& each, const Placed& other) {
      return std::pair(each.mesh, each.primitive.value_or(other.primitive)) <
             std::pair(other.mesh, other.primitive);
    };
    const auto at = std::lower_bound(found_.begin(), found_.end(), placed, before);
    return at != found_.end() && at->mesh == placed.mesh &&
           at->primitive.value_or(placed.primitive) == placed.primitive && at->code == wrong.code &&
           at->cause == wrong.cause;
  }

  // One finding a file and code: the first of those that no material hides, and the number of the
  // others.
  void report(const std::vector<WrongSide>& all, Code code) {
    const WrongSide* first = nullptr;
    std::size_t count = 0;
    for (const WrongSide& each : all) {
      if (each.code != code) continue;
      ++count;
      if (first == nullptr || (first->hidden && !each.hidden)) first = &each;
    }
    if (first == nullptr) return;
    std::string message =
        code == Code::SURFACE_INSIDE_OUT ? inside_text(*first) : against_text(*first);
    if (count > 1) {
      message += fmt::format("; {}{} other {} the same fault",
                             found_.size() == kMostSurfaces ? "at least " : "", count - 1,
                             count == 2 ? "surface has" : "surfaces have");
    }
    const std::string pointer = fmt::format("/meshes/{}", first->mesh);
    const model::Mesh& mesh = context_.views.meshes[first->mesh];
    Finding finding = finding_on(context_, mesh.node, code, message + ".");
    std::string member;
    if (first->primitive) {
      const Primitive& primitive = mesh.primitives[*first->primitive];
      member = fmt::format("/primitives/{}", *first->primitive);
      json::NodeId place = primitive.node;
      if (first->cause == WrongSide::Cause::unknown) {
        place = primitive.attributes_node;
        member += "/attributes";
      } else if (first->cause == WrongSide::Cause::normals) {
        place = primitive.find(model::SemanticKind::normal)->value;
        member += "/attributes/NORMAL";
      }
      finding = finding_on(context_, place, code, message + ".");
    }
    if (first->hidden) finding.severity = Severity::info;
    report_at(phase_.sink, pointer + member, std::move(finding));
  }

  std::string against_text(const WrongSide& wrong) const {
    const std::string count = wrong.against < wrong.triangles
                                  ? fmt::format("{} of {}", wrong.against, wrong.triangles)
                                  : fmt::format("All {}", wrong.triangles);
    std::string text = fmt::format("{} triangles of {} are wound against their normals", count,
                                   object_label(context_, RootArray::meshes, wrong.mesh));
    switch (wrong.cause) {
      case WrongSide::Cause::triangles:
        return text + ": the surface is closed, and its triangles face inward";
      case WrongSide::Cause::normals:
        return text + ": the surface is closed, and its normals point inward";
      case WrongSide::Cause::unknown:
        break;
    }
    return text + ": either its triangles or its normals are reversed";
  }

  std::string inside_text(const WrongSide& wrong) const {
    return fmt::format(
        "{} is inside out: its surface is closed, and its {} triangles face inward, {}",
        object_label(context_, RootArray::meshes, wrong.mesh), wrong.triangles,
        wrong.hidden ? "which is hidden only because the material is double-sided"
                     : "so viewers leave out its front and show the inside of the far side");
  }

  DataPhase& phase_;
  const Context& context_;
  PlacedScene& scene_;
  std::vector<WrongSide> found_;  ///< in the order of meshes
};

}  // namespace

void check_wrong_sides(DataPhase& phase, PlacedScene& scene) { WrongSides(phase, scene).run(); }

const RuleGroup& wrong_side_rules() {
  static constexpr FixEntry kFixes[] = {{Code::NORMALS_AGAINST_WINDING, turn_wrong_one},
                                        {Code::SURFACE_INSIDE_OUT, turn_inside_out}};
  static constexpr RuleGroup group{.fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
