// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_primitive_edge_visibility codes edges in bits and lines of bytes, so this file names it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/element_kernels.hpp"
#include "rules/payload/topology.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kEdgeVisibilityExtension = "EXT_mesh_primitive_edge_visibility";

// An edge with its value in one of its triangles.
struct CodedEdge {
  std::uint64_t edge = 0;
  std::uint32_t value = 0;  ///< 0 hidden, 1 silhouette, 2 hard, 3 hard and coded before
};

// The number of occurrences of each value for one edge.
struct Tally {
  std::array<std::uint64_t, 4> of{};
  // One 2 and otherwise 3; or one 1 and otherwise 0; or only 0.
  bool sound() const {
    const bool hard = of[2] + of[3] != 0;
    return hard ? of[2] == 1 && of[0] + of[1] == 0 : of[1] <= 1;
  }
};

std::string edge_text(std::uint64_t edge) {
  return fmt::format("between vertices {} and {}", edge >> 32U, edge & UINT32_MAX);
}

std::string first_of(std::string sentence, std::uint64_t count) {
  return count > 1 ? fmt::format("{} This is the first of {}.", sentence, count) : sentence;
}

class VisibilityCheck {
 public:
  VisibilityCheck(DataPhase& phase, const ExtensionPlace& place, const Path& path)
      : phase_(phase),
        context_(phase.context),
        object_(place.object),
        path_(path),
        primitive_(model::read_primitive(context_.asset, place.host)) {}

  void run() {
    const auto mode = primitive_.mode;
    if (mode && *mode < model::Mode::triangles) {
      phase_.sink.report(path_,
                         finding_on(context_, object_, Code::EDGE_VISIBILITY_INVALID_MODE,
                                    fmt::format("The mode of the primitive is {}; it must be "
                                                "TRIANGLES, TRIANGLE_STRIP or TRIANGLE_FAN.",
                                                model::mode_name(*mode))));
      return;
    }
    const auto triangles = read_triangles(phase_, primitive_);
    if (!triangles) return;
    edges_ = edges_of(*triangles);
    read_visibility(*triangles);
    check_lines();
  }

 private:
  std::optional<std::uint32_t> accessor(std::string_view member) const {
    return context_.asset.index(object_, member, model::RootArray::accessors);
  }

  void report(std::string_view member, Code code, std::string message) const {
    report_member(phase_.sink, context_, path_, object_, member, code, std::move(message));
  }

  // --- visibility: two bits per edge, three edges per triangle ---

  void read_visibility(const std::vector<Triangle>& triangles) {
    const auto index = accessor("visibility");
    if (!index) return;
    const auto& format = context_.views.accessors[*index].format;
    const auto bytes = format.component == model::ComponentType::uint8
                           ? read_indices(phase_, *index)
                           : std::nullopt;
    const std::size_t bits = triangles.size() * 6;
    if (!bytes || bytes->size() != (bits + 7) / 8) return;  // reported for the accessor
    std::vector<CodedEdge> coded;
    coded.reserve(triangles.size() * 3);
    std::size_t bit = 0;
    for (const Triangle& each : triangles) {
      for (std::size_t i = 0; i < 3; ++i, bit += 2) {
        const std::uint32_t value = (*bytes)[bit / 8] >> (bit % 8) & 3U;
        coded.push_back({edge_of(each[i], each[(i + 1) % 3]), value});
      }
    }
    if (bits % 8 != 0 && (bytes->back() >> (bits % 8)) != 0) {
      report("visibility", Code::EDGE_VISIBILITY_PADDING,
             fmt::format("The padding bits after the {} edges of {} triangles are not zero.",
                         coded.size(), triangles.size()));
    }
    check_codes(coded);
  }

  void check_codes(std::vector<CodedEdge>& coded) {
    const auto silhouettes = static_cast<std::uint64_t>(std::count_if(
        coded.begin(), coded.end(), [](const CodedEdge& each) { return each.value == 1; }));
    const bool visible = std::any_of(coded.begin(), coded.end(),
                                     [](const CodedEdge& each) { return each.value != 0; });
    if (!visible && !coded.empty()) {
      report("visibility", Code::EDGE_VISIBILITY_EMPTY, "All edges are hidden.");
    }
    check_normals(silhouettes);
    std::sort(coded.begin(), coded.end(),
              [](const CodedEdge& a, const CodedEdge& b) { return a.edge < b.edge; });
    std::uint64_t errors = 0;
    std::string first;
    for (std::size_t i = 0; i < coded.size();) {
      const std::uint64_t edge = coded[i].edge;
      Tally tally;
      for (; i < coded.size() && coded[i].edge == edge; ++i) ++tally.of[coded[i].value];
      if (tally.of[2] + tally.of[3] != 0) hard_.push_back(edge);
      if (tally.sound() || errors++ != 0) continue;
      first = fmt::format(
          "The edge {} is encoded {} times as 0, {} times as 1, {} times as 2 and {} times as 3.",
          edge_text(edge), tally.of[0], tally.of[1], tally.of[2], tally.of[3]);
    }
    if (errors != 0) {
      report("visibility", Code::EDGE_VISIBILITY_REPEATED, first_of(std::move(first), errors));
    }
  }

  // --- silhouetteNormals: normals of the two faces at each edge of value 1 ---

  void check_normals(std::uint64_t silhouettes) {
    const auto index = accessor("silhouetteNormals");
    const bool given = context_.document.find(object_, "silhouetteNormals") != json::kNoNode;
    if (!given && silhouettes == 0) return;
    const Code code = Code::EDGE_SILHOUETTE_NORMALS_MISMATCH;
    if (!given || silhouettes == 0) {
      report("silhouetteNormals", code,
             given
                 ? std::string("There are silhouette normals, but no silhouette edges.")
                 : fmt::format(
                       "The number of silhouette edges is {}, but there are no silhouette normals.",
                       silhouettes));
      return;
    }
    if (!index) return;
    const auto count = context_.views.accessors[*index].count;
    if (count && *count != silhouettes * 2) {
      report("silhouetteNormals", code,
             fmt::format("The number of silhouette normals is {}; for {} silhouette edges it must "
                         "be two per edge.",
                         *count, silhouettes));
    }
    check_lengths(*index);
  }

  void check_lengths(std::uint32_t index) {
    const auto data = phase_.open(index);
    if (!data || data->format().type != model::ElementType::vec3) return;
    if (!phase_.budget.take(data->count(), 3)) return;
    std::uint64_t errors = 0;
    std::string first;
    const auto note = [&](std::uint64_t element, double length) {
      if (errors++ == 0) {
        first = fmt::format("The normal in element {} has length {:.4g}; it must be 1.", element,
                            length);
      }
    };
    model::with_component_type(data->format().component, [&](auto type) {
      using T = decltype(type);
      data->visit<T>([&](const T* values, std::size_t elements, std::uint64_t begin) {
        for (std::size_t i = 0; i < elements; ++i) {
          const double length = length_of(values + i * 3);
          if (std::abs(length - 1) > tolerance<T>()) note(begin + i, length);
        }
      });
    });
    if (errors != 0) {
      report("silhouetteNormals", Code::ACCESSOR_VECTOR3_NON_UNIT,
             first_of(std::move(first), errors));
    }
  }

  // Integers are fractions of their greatest value.
  template <typename T>
  static double length_of(const T* vector) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      double value = static_cast<double>(vector[i]);
      if constexpr (std::is_integral_v<T>) value = model::normalize(vector[i]);
      sum += value * value;
    }
    return std::sqrt(sum);
  }

  template <typename T>
  static double tolerance() {
    if constexpr (std::is_integral_v<T>) {
      return std::sqrt(3) / static_cast<double>(std::numeric_limits<T>::max());
    }
    return kernels::kVectorTolerance;
  }

  // --- lineStrings: consecutive vertices, lines separated by a restart value ---

  void check_lines() {
    const Path list(path_, "lineStrings");
    const auto lines = object_list(context_.document, object_, "lineStrings");
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto index = context_.asset.index(lines[i], "indices", model::RootArray::accessors);
      if (!index) continue;
      const auto indices = read_indices(phase_, *index);
      if (indices) check_line(lines[i], *index, *indices, Path(list, i));
    }
  }

  void check_line(json::NodeId line, std::uint32_t accessor, const Indices& indices,
                  const Path& path) {
    const auto restart = static_cast<std::uint32_t>(
        model::value_range(context_.views.accessors[accessor].format.component).most);
    std::string error;
    std::string repeat;
    std::size_t run = 0;  // number of vertices of the line so far
    const auto end_run = [&](std::size_t at) {
      if (run < 2 && error.empty()) {
        error = fmt::format(
            "The line string that ends before element {} has {} vertices; it must have at least 2.",
            at, run);
      }
      run = 0;
    };
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] == restart) {
        end_run(i);
        continue;
      }
      if (run++ == 0) continue;
      note_edge(edge_of(indices[i - 1], indices[i]), error, repeat);
    }
    end_run(indices.size());
    if (!error.empty()) {
      report_member(phase_.sink, context_, path, line, "indices", Code::EDGE_LINE_STRING_INVALID,
                    std::move(error));
    }
    if (!repeat.empty()) {
      report_member(phase_.sink, context_, path, line, "indices", Code::EDGE_LINE_STRING_REPEATED,
                    std::move(repeat));
    }
  }

  void note_edge(std::uint64_t edge, std::string& error, std::string& repeat) {
    if (!std::binary_search(edges_.begin(), edges_.end(), edge)) {
      if (error.empty())
        error = fmt::format("The segment {} is not a triangle edge.", edge_text(edge));
      return;
    }
    const bool coded = std::binary_search(hard_.begin(), hard_.end(), edge);
    if (!drawn_.insert(edge).second || coded) {
      if (!repeat.empty()) return;
      repeat = fmt::format("The edge {} is already {}.", edge_text(edge),
                           coded ? "marked in visibility" : "in a line string");
    }
  }

  DataPhase& phase_;
  const Context& context_;
  json::NodeId object_;
  const Path& path_;
  model::Primitive primitive_;
  std::vector<std::uint64_t> edges_;         ///< edges of the primitive, sorted
  std::vector<std::uint64_t> hard_;          ///< edges that are hard by visibility, sorted
  std::unordered_set<std::uint64_t> drawn_;  ///< edges drawn by lines
};

}  // namespace

void check_edge_visibility(DataPhase& phase) {
  for_each_primitive_extension(phase.context, kEdgeVisibilityExtension,
                               [&](const ExtensionPlace& place, const Path& path) {
                                 VisibilityCheck(phase, place, path).run();
                               });
}

}  // namespace gltfx::validate
