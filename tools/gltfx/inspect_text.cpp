// SPDX-License-Identifier: Apache-2.0
#include "inspect_text.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"

namespace gltfx::tool {
namespace {

constexpr std::size_t kLongest = 40;       // code points of a name in a table
constexpr std::size_t kLongestLine = 300;  // of a text on a separate line

std::string cell(std::string_view text) { return report::safe_cut(text, kLongest); }

/// The parts of one asset, one after the other.
class Page {
 public:
  Page(std::size_t most, const Style& style) : most_(most), style_(style) {}

  std::string write(const InspectReport& report) {
    text_ = style_.bold(report::safe(report.path)) + "\n";
    if (report.facts) write(*report.facts);
    write_shown(report);
    write_upgrade(report);
    if (report.facts) write_problems(report.facts->problems);
    return std::move(text_);
  }

 private:
  void line(std::string_view name, std::string_view value) {
    if (value.empty()) return;
    const std::string whole = wrapped(report::safe_cut(value, kLongestLine), 14);
    text_ += fmt::format("  {}{}", padded(name, 12), std::string_view(whole).substr(14));
  }

  void write(const AssetFacts& facts) {
    write_head(facts);
    write_bytes(facts);
    write_extensions(facts.extensions);
    write_list("Files it refers to", facts.referred_files, referred_table(), add_referred);
    write_external_assets(facts.external_assets);
    write_list("Meshes", facts.meshes, mesh_table(), add_mesh);
    write_list("Images", facts.images, image_table(), add_image);
    write_list("Materials", facts.materials, material_table(), add_material);
    write_list("Animations", facts.animations, animation_table(), add_animation);
    write_list("Skins", facts.skins, {"rlrr", {"#", "name", "joints", "bytes"}}, add_skin);
    write_list("Cameras", facts.cameras, {"rll", {"#", "name", "type"}}, add_named);
    write_list("Lights", facts.lights, {"rll", {"#", "name", "type"}}, add_named);
    write_list("Metadata classes", facts.metadata_classes, {"rlr", {"#", "class", "properties"}},
               add_class);
    write_list("Property tables", facts.property_tables, property_table(), add_property_table);
  }

  void write_head(const AssetFacts& facts) {
    line("format", fmt::format("{}, glTF {}", facts.mime_type,
                               facts.version.empty() ? "of no version" : facts.version));
    line("generator", facts.generator);
    line("copyright", facts.copyright);
    line("contents", contents(facts));
    if (facts.bounds) line("extent", extent(*facts.bounds));
    const std::uint64_t total = facts.total_bytes();
    const std::string exact = total < 1000 ? "" : fmt::format(" ({} bytes)", grouped(total));
    line("size", fmt::format("{}{} in {}", size_text(total), exact,
                             report::counted(facts.files.size(), "file")));
    line("GPU memory",
         fmt::format("about {}: images {}, meshes {}",
                     size_text(facts.image_gpu_bytes() + facts.mesh_gpu_bytes()),
                     size_text(facts.image_gpu_bytes()), size_text(facts.mesh_gpu_bytes())));
  }

  static std::string contents(const AssetFacts& facts) {
    std::vector<std::string> parts;
    const auto add = [&parts](std::uint64_t count, std::string_view one, std::string_view several) {
      if (count > 0)
        parts.push_back(fmt::format("{} {}", grouped(count), count == 1 ? one : several));
    };
    add(facts.scenes, "scene", "scenes");
    add(facts.nodes, "node", "nodes");
    add(facts.meshes.size(), "mesh", "meshes");
    add(facts.primitives, "primitive", "primitives");
    add(facts.triangles, "triangle", "triangles");
    if (facts.drawn_triangles != facts.triangles) {
      if (facts.triangles == 0) parts.emplace_back("no triangle");
      parts.back() += fmt::format(" ({} drawn by the scene)", grouped(facts.drawn_triangles));
    }
    add(facts.vertices, "vertex", "vertices");
    add(facts.materials.size(), "material", "materials");
    add(facts.textures, "texture", "textures");
    add(facts.images.size(), "image", "images");
    add(facts.animations.size(), "animation", "animations");
    add(facts.skins.size(), "skin", "skins");
    add(facts.cameras.size(), "camera", "cameras");
    add(facts.lights.size(), "light", "lights");
    add(facts.shapes, "shape", "shapes");
    add(facts.bounding_volumes, "bounding volume", "bounding volumes");
    return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, ", "));
  }

  static std::string extent(const SceneBounds& bounds) {
    const auto& a = bounds.least;
    const auto& b = bounds.greatest;
    return fmt::format(
        "{:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
        b[0] - a[0], b[1] - a[1], b[2] - a[2], a[0], a[1], a[2], b[0], b[1], b[2]);
  }

  void title(std::string_view words) { text_ += fmt::format("\n  {}\n", style_.bold(words)); }

  void write_bytes(const AssetFacts& facts) {
    const std::uint64_t total = facts.total_bytes();
    if (total == 0) return;
    title("Where the bytes go");
    TextTable table("lrr", {"for", "bytes", "share"});
    std::vector<std::size_t> order(kByteUseCount);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return facts.bytes[a] > facts.bytes[b]; });
    for (const std::size_t i : order) {
      if (facts.bytes[i] == 0) continue;
      const double share = 100.0 * static_cast<double>(facts.bytes[i]) / static_cast<double>(total);
      table.add({std::string(byte_use_name(static_cast<ByteUse>(i))), grouped(facts.bytes[i]),
                 fmt::format("{:.1f} %", share)});
    }
    text_ += table.text(4, style_);
    if (facts.files.size() < 2) return;
    TextTable files("rlr", {"#", "file", "bytes"});
    for (std::size_t i = 1; i < facts.files.size() && (most_ == 0 || i <= most_); ++i) {
      files.add({std::to_string(i), cell(facts.files[i].uri), grouped(facts.files[i].bytes)});
    }
    title("Files beside it");
    text_ += files.text(4, style_);
  }

  static std::string extension_note(const ExtensionFacts& extension) {
    if (extension.accessors == 0U) return "no accessor has its formats";
    if (extension.accessors == 1U) return "1 accessor has its formats";
    if (extension.accessors) {
      return fmt::format("{} accessors have its formats", grouped(*extension.accessors));
    }
    if (!extension.seen && extension.has_objects) return "no object has it";
    return extension.successor.empty() ? "" : "successor: " + extension.successor;
  }

  void write_extensions(const std::vector<ExtensionFacts>& extensions) {
    if (extensions.empty()) return;
    title("Extensions");
    TextTable table("llll", {"name", "status", "declared", ""});
    for (const ExtensionFacts& each : extensions) {
      table.add({cell(each.name), each.status,
                 each.required ? "required"
                 : each.used   ? "used"
                               : "not declared",
                 extension_note(each)});
    }
    text_ += table.text(4, style_);
  }

  template <class Facts>
  void write_list(std::string_view name, const std::vector<Facts>& list, TextTable table,
                  void (*add)(TextTable&, std::size_t, const Facts&)) {
    if (list.empty()) return;
    const std::vector<std::size_t> order = rows_of(list);
    if (order.size() < list.size()) {
      title(fmt::format("{}, {} of {}", name, order.size(), grouped(list.size())));
    } else {
      title(name);
    }
    for (const std::size_t i : order) add(table, i, list[i]);
    text_ += table.text(4, style_);
  }

  template <class Facts>
  std::vector<std::size_t> rows_of(const std::vector<Facts>& list) const {
    std::vector<std::size_t> order(list.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (most_ == 0 || order.size() <= most_) return order;
    if constexpr (requires(const Facts& facts) { facts.bytes; }) {
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return list[a].bytes > list[b].bytes; });
    }
    order.resize(most_);
    return order;
  }

  static TextTable referred_table() {
    return {"rlllrll", {"#", "name", "file", "type", "bytes", "aliases", ""}};
  }
  static void add_referred(TextTable& table, std::size_t index, const ReferredFileFacts& file) {
    table.add({std::to_string(index), cell(file.name),
               cell(file.uri.empty() ? "in a buffer view" : file.uri), cell(file.mime_type),
               file.bytes ? grouped(*file.bytes) : "",
               cell(fmt::format("{}", fmt::join(file.aliases, ", "))), note(file.problem)});
  }

  // Each below its parent; a part from the top where there are too many.
  void write_external_assets(const std::vector<ExternalAssetFacts>& list) {
    if (list.empty()) return;
    title("External assets");
    TextTable table("rllrrrrrl",
                    {"#", "asset", "type", "nodes", "meshes", "triangles", "bytes", "placed", ""});
    const std::size_t count = most_ == 0 ? list.size() : std::min(list.size(), most_);
    for (std::size_t i = 0; i < count; ++i) add_external_asset(table, list[i]);
    text_ += table.text(4, style_);
    if (count < list.size()) text_ += fmt::format("    and {} more\n", list.size() - count);
  }
  static void add_external_asset(TextTable& table, const ExternalAssetFacts& asset) {
    const bool read = asset.state == ExternalAssetState::read;
    const auto number = [read](std::uint64_t count) { return read ? grouped(count) : ""; };
    constexpr std::size_t kDeepestIndent = 20;
    const std::string indent(2 * std::min<std::size_t>(asset.depth, kDeepestIndent), ' ');
    table.add({std::to_string(asset.index), indent + cell(asset.path), cell(asset.mime_type),
               number(asset.nodes), number(asset.meshes), number(asset.triangles),
               number(asset.bytes), fmt::format("{}x", asset.placed), state_note(asset)});
  }
  static std::string state_note(const ExternalAssetFacts& asset) {
    if (asset.state == ExternalAssetState::repeated) return "see above";
    if (asset.state == ExternalAssetState::cycle) return "left out: it is above itself";
    return note(asset.problem);
  }
  static std::string note(std::string_view problem) {
    return problem.empty() ? "" : report::safe_cut(fmt::format("not read: {}", problem), 160);
  }

  static TextTable mesh_table() {
    return {"rlrrrrr", {"#", "name", "primitives", "triangles", "vertices", "bytes", "GPU"}};
  }
  static void add_mesh(TextTable& table, std::size_t index, const MeshFacts& mesh) {
    table.add({std::to_string(index), cell(mesh.name), grouped(mesh.primitives),
               grouped(mesh.triangles), grouped(mesh.vertices), grouped(mesh.bytes),
               size_text(mesh.gpu_bytes)});
  }

  static TextTable image_table() {
    return {"rllrllrr", {"#", "name", "format", "pixels", "color space", "slots", "bytes", "GPU"}};
  }
  static void add_image(TextTable& table, std::size_t index, const ImageFacts& image) {
    std::string format =
        image.format.substr(std::min(image.format.find('/') + 1, image.format.size()));
    if (!image.encoding.empty()) format += " " + image.encoding;
    if (!image.channels.empty()) format += " " + image.channels;
    const std::string pixels =
        image.width == 0 ? "" : fmt::format("{} x {}", image.width, image.height);
    table.add({std::to_string(index), cell(image.name.empty() ? image.uri : image.name),
               format.empty() ? "not read" : format, pixels, image.color_space,
               cell(fmt::format("{}", fmt::join(image.slots, ", "))), grouped(image.bytes),
               size_text(image.gpu_bytes)});
  }

  static TextTable material_table() {
    return {"rlllrl", {"#", "name", "alpha", "sides", "textures", "extensions"}};
  }
  static void add_material(TextTable& table, std::size_t index, const MaterialFacts& material) {
    table.add({std::to_string(index), cell(material.name), cell(material.alpha_mode),
               material.double_sided ? "both" : "front", grouped(material.textures),
               report::safe_cut(fmt::format("{}", fmt::join(material.extensions, ", ")), 160)});
  }

  static TextTable animation_table() {
    return {"rlrrrr", {"#", "name", "seconds", "channels", "keyframes", "bytes"}};
  }
  static void add_animation(TextTable& table, std::size_t index, const AnimationFacts& animation) {
    table.add({std::to_string(index), cell(animation.name),
               fmt::format("{:.3g}", animation.duration), grouped(animation.channels),
               grouped(animation.keyframes), grouped(animation.bytes)});
  }

  static void add_skin(TextTable& table, std::size_t index, const SkinFacts& skin) {
    table.add({std::to_string(index), cell(skin.name), grouped(skin.joints), grouped(skin.bytes)});
  }

  static void add_named(TextTable& table, std::size_t index, const NamedFacts& each) {
    table.add({std::to_string(index), cell(each.name), cell(each.type)});
  }

  static void add_class(TextTable& table, std::size_t index, const MetadataClassFacts& each) {
    table.add({std::to_string(index), cell(each.name), grouped(each.properties)});
  }

  static TextTable property_table() {
    return {"rllrrr", {"#", "name", "class", "rows", "columns", "bytes"}};
  }
  static void add_property_table(TextTable& table, std::size_t index,
                                 const PropertyTableFacts& each) {
    table.add({std::to_string(index), cell(each.name), cell(each.class_id), grouped(each.rows),
               grouped(each.columns), grouped(each.bytes)});
  }

  void write_shown(const InspectReport& report) {
    if (report.shown.empty() && report.shown_problem.empty()) return;
    title("What it shows");
    for (std::size_t i = 0; i < report.shown.size() && (most_ == 0 || i < most_); ++i) {
      const ShownFact& fact = report.shown[i];
      text_ += wrapped(
          report::safe(fmt::format("{}[{}] {}{}", fact.severity, fact.code, fact.message,
                                   fact.pointer.empty() ? "" : fmt::format(" ({})", fact.pointer))),
          4);
    }
    if (most_ > 0 && report.shown.size() > most_) {
      text_ += fmt::format("    and {} more\n", report.shown.size() - most_);
    }
    if (!report.shown_problem.empty()) text_ += wrapped(report::safe(report.shown_problem), 4);
  }

  void write_upgrade(const InspectReport& report) {
    if (report.upgrade.empty()) return;
    title("What 'gltfx upgrade' changes");
    TextTable table("llll", {"object", "from", "to", "outcome"});
    for (const UpgradeFact& fact : report.upgrade) {
      if (most_ > 0 && &fact >= report.upgrade.data() + most_) break;
      table.add({report::safe_cut(fact.pointer, 60), cell(fact.from), cell(fact.to),
                 fact.done ? fact.outcome : fmt::format("left alone: {}", fact.outcome)});
    }
    text_ += table.text(4, style_);
    if (!report.upgrade_problem.empty()) {
      text_ += wrapped(report::safe("Nothing is done: " + report.upgrade_problem), 4);
    }
  }

  void write_problems(const std::vector<std::string>& problems) {
    if (problems.empty()) return;
    title("Not read");
    for (std::size_t i = 0; i < problems.size() && (most_ == 0 || i < most_); ++i) {
      text_ += wrapped(report::safe(problems[i]), 4);
    }
    if (most_ > 0 && problems.size() > most_) {
      text_ += fmt::format("    and {} more\n", problems.size() - most_);
    }
  }

  std::size_t most_;
  const Style& style_;
  std::string text_;
};

}  // namespace

std::string inspect_text(const InspectReport& report, std::size_t most, const Style& style) {
  return Page(most, style).write(report);
}

}  // namespace gltfx::tool
