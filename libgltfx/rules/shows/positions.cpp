// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/elements.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;
using model::SemanticKind;
using model::Vector3;

const model::Attribute* positions_of(const model::Primitive& primitive) {
  const model::Attribute* found = primitive.find(SemanticKind::position);
  return found != nullptr && found->accessor ? found : nullptr;
}

void report_positions(DataPhase& phase, std::size_t mesh, std::size_t primitive,
                      const model::Attribute& attribute, Code code, std::string message) {
  report_at(phase.sink,
            fmt::format("/meshes/{}/primitives/{}/attributes/POSITION", mesh, primitive),
            finding_on(phase.context, attribute.value, code, std::move(message)));
}

// The distance of single precision numbers at a value.
double float_step(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(std::nextafter(rounded, std::numeric_limits<float>::infinity())) -
         static_cast<double>(rounded);
}

// --- Vertices far from all others ---

struct Stray {
  std::uint64_t vertex = 0;
  std::uint64_t count = 0;  ///< of vertices that are as far away
  double times = 0;         ///< distance, in widths of all others
  std::array<float, 3> place{};
};

constexpr double kFarAway = 100;  // in widths of the other vertices

// Whether half of a sample of vertices, at least, is in a small part of the bounds.
bool is_crowded(const AccessorData& data, double width) {
  constexpr std::size_t kSample = 13;
  const bool floats = data.format().component == model::ComponentType::float32;
  const std::uint64_t step = std::max<std::uint64_t>(1, data.count() / kSample);
  const auto count =
      static_cast<std::size_t>(std::min<std::uint64_t>(kSample, (data.count() - 1) / step + 1));
  std::array<std::array<float, kSample>, 3> axes{};
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 3> place{};
    if (floats) {
      data.read_one(reinterpret_cast<std::byte*>(place.data()), i * step);
    } else {
      const std::vector<float> element = model::element_at(data, i * step);
      std::copy_n(element.begin(), place.size(), place.begin());
    }
    if (!is_finite(place)) return false;
    for (std::size_t k = 0; k < 3; ++k) axes[k][i] = place[k];
  }
  const std::size_t quarter = count / 4;
  return std::all_of(axes.begin(), axes.end(), [&](std::array<float, kSample>& values) {
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(values.begin(), end);
    const double core =
        static_cast<double>(values[count - 1 - quarter]) - static_cast<double>(values[quarter]);
    return core * kFarAway / 2 < width;
  });
}

double distance_to(const std::array<float, 3>& a, const Vector3& b) {
  double distance = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    distance = std::max(distance, std::abs(static_cast<double>(a[k]) - b[k]));
  }
  return distance;
}

Vector3 median_of(const model::Vectors<3>& places) {
  Vector3 middle{};
  std::vector<float> values(places.size());
  for (std::size_t k = 0; k < 3; ++k) {
    std::transform(places.begin(), places.end(), values.begin(),
                   [k](const auto& each) { return each[k]; });
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[k] = static_cast<double>(*half);
  }
  return middle;
}

// Up to a quarter of the vertices, at up to three places: the corners of faces are separate
// vertices.
std::optional<Stray> find_stray(const model::Vectors<3>& places) {
  constexpr std::size_t kMostPlaces = 3;
  constexpr std::size_t kMostVertices = 64;
  const Vector3 middle = median_of(places);
  std::vector<std::pair<double, std::uint32_t>> far;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    far.emplace_back(distance_to(places[i], middle), i);
  }
  const std::size_t most = std::min(kMostVertices, places.size() / 4);
  std::partial_sort(far.begin(), far.begin() + static_cast<std::ptrdiff_t>(most + 1), far.end(),
                    std::greater<>());
  std::set<std::array<float, 3>> distinct;
  for (std::size_t i = 0; i < most; ++i) {
    distinct.insert(places[far[i].second]);
    if (distinct.size() > kMostPlaces) return std::nullopt;
    const double rest = 2 * far[i + 1].first;
    if (rest > 0 && far[i].first > kFarAway * rest) {
      return Stray{far[0].second, i + 1, far[0].first / rest, places[far[0].second]};
    }
  }
  return std::nullopt;
}

std::optional<Stray> find_stray(DataPhase& phase, std::uint32_t accessor) {
  constexpr std::uint64_t kFewest = 8;
  const model::Accessor& described = phase.context.views.accessors[accessor];
  const BoundsBox& box = phase.box_of(accessor);
  if (box.empty() || !described.count || *described.count < kFewest) return std::nullopt;
  const auto data = phase.open(accessor);
  if (!data || data->implied() || data->components() != 3) return std::nullopt;
  if (!is_crowded(*data, box.width())) return std::nullopt;
  if (data->count() > UINT32_MAX || !phase.budget.take(data->count(), 3)) return std::nullopt;
  model::Vectors<3> places(static_cast<std::size_t>(data->count()));
  model::read_elements(*data, places);
  if (!std::all_of(places.begin(), places.end(), is_finite)) return std::nullopt;
  return find_stray(places);
}

}  // namespace

void check_far_positions(DataPhase& phase) {
  constexpr double kCoarse = 1e-3;       // of the mesh
  constexpr double kCoarseInAll = 1e-6;  // of all meshes: small parts of a large asset are fine
  const auto& meshes = phase.context.views.meshes;
  BoundsBox all;
  std::vector<BoundsBox> boxes(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (const model::Primitive& primitive : meshes[i].primitives) {
      const model::Attribute* positions = positions_of(primitive);
      if (positions == nullptr) continue;
      const model::Accessor& accessor = phase.context.views.accessors[*positions->accessor];
      if (accessor.format.component != model::ComponentType::float32) continue;
      const BoundsBox& box = phase.box_of(*positions->accessor);
      boxes[i].include(box);
      all.include(box);
    }
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const double step = float_step(boxes[i].reach());
    const double width = boxes[i].width();
    if (!(width > 0) || step <= width * kCoarse || step <= all.width() * kCoarseInAll) continue;
    const auto& primitives = meshes[i].primitives;
    const auto first = std::find_if(primitives.begin(), primitives.end(), positions_of);
    report_positions(
        phase, i, static_cast<std::size_t>(first - primitives.begin()), *positions_of(*first),
        Code::POSITIONS_FAR_FROM_ORIGIN,
        fmt::format(
            "The mesh is {:.3g} wide and {:.3g} from its origin, where positions are rounded "
            "to steps of {:.2g}, 1/{:.0f} of its width.",
            width, boxes[i].reach(), step, std::max(1.0, std::floor(width / step))));
  }
}

void check_stray_vertices(DataPhase& phase) {
  const auto& meshes = phase.context.views.meshes;
  std::vector<std::uint8_t> seen(phase.context.views.accessors.size(), 0);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (std::size_t k = 0; k < meshes[i].primitives.size(); ++k) {
      const model::Attribute* positions = positions_of(meshes[i].primitives[k]);
      if (positions == nullptr || seen[*positions->accessor] != 0) continue;
      seen[*positions->accessor] = 1;
      const auto stray = find_stray(phase, *positions->accessor);
      if (!stray) continue;
      report_positions(
          phase, i, k, *positions, Code::STRAY_VERTEX,
          fmt::format("Vertex {}{} is at ({:.6g}, {:.6g}, {:.6g}), {:.0f} times as far away as all "
                      "other vertices are wide: a view of the whole mesh shows only a dot.",
                      stray->vertex,
                      stray->count > 1 ? fmt::format(", the farthest of {},", stray->count) : "",
                      stray->place[0], stray->place[1], stray->place[2], stray->times));
    }
  }
}

}  // namespace gltfx::validate
