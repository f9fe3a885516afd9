// SPDX-License-Identifier: Apache-2.0
// What the code of the auditor does counts where its README says otherwise: a limit that is left
// out is none.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "config_import.hpp"
#include "json/document.hpp"
#include "json/parse.hpp"

namespace gltfx::tool {
namespace {

using json::Document;
using json::kNoNode;
using json::NodeId;

constexpr double kBytesPerKiB = 1024;

/// Reads the file and collects limits by table.
class AuditorReader {
 public:
  AuditorReader(const Document& document, const std::string& name)
      : document_(document), name_(name) {}

  ImportedConfig read() {
    read_file_size();
    read_range("", "materials", at("materials"));
    const NodeId model = at("model");
    const NodeId counts = member(model, "objectCount");
    read_range("", "nodes", member(counts, "nodes"));
    read_range("", "meshes", member(counts, "meshes"));
    read_range("", "primitives", member(counts, "primitives"));
    read_triangles(member(model, "triangles"));
    read_flag("mesh", "hard-edges = 0", member(model, "requireBeveledEdges"));
    read_flag("scene", "root-transform = true", member(model, "requireCleanRootNodeTransform"));
    read_flag("mesh", "non-manifold-edges = 0", member(model, "requireManifoldEdges"));
    read_product(member(at("product"), "dimensions"));
    read_textures(at("textures"));
    read_uvs(at("uvs"));
    return finish();
  }

 private:
  NodeId at(std::string_view group) { return member(document_.root(), group); }
  NodeId member(NodeId object, std::string_view name) const {
    if (object == kNoNode || !document_.is_object(object)) return kNoNode;
    return document_.find(object, name);
  }

  // A number that is a limit: -1 is none.
  std::optional<double> number(NodeId object, std::string_view name) const {
    const NodeId value = member(object, name);
    if (value == kNoNode || !document_.is_number(value)) return std::nullopt;
    const double read = document_.number(value).value;
    return std::isfinite(read) && read >= 0 ? std::optional(read) : std::nullopt;
  }

  bool is_true(NodeId value) const {
    if (value == kNoNode) return false;
    const std::string_view raw = document_.raw(value);
    return raw == "true" || raw == "\"true\"";
  }

  void add(const std::string& table, std::string line) { lines_[table].push_back(std::move(line)); }
  void note(std::string_view text) {
    notes_.push_back(fmt::format("{}: {}", printable(name_), text));
  }

  void add_range(const std::string& table, std::string_view measure, std::optional<double> least,
                 std::optional<double> most, std::string_view remark = {}) {
    std::vector<std::string> ops;
    if (least) ops.push_back("min = " + number_text(*least));
    if (most) ops.push_back("max = " + number_text(*most));
    if (ops.empty()) return;
    add(table, fmt::format("{} = {{ {} }}{}{}", measure, fmt::join(ops, ", "),
                           remark.empty() ? "" : "  # ", remark));
  }
  void read_range(const std::string& table, std::string_view measure, NodeId object,
                  std::string_view remark = {}) {
    add_range(table, measure, number(object, "minimum"), number(object, "maximum"), remark);
  }
  void read_flag(const std::string& table, std::string line, NodeId value) {
    if (is_true(value)) add(table, std::move(line));
  }

  // The auditor compares with a maximum of size or triangles only above 0.
  std::optional<double> above_zero(std::optional<double> most, std::string_view what) {
    if (!most || *most > 0) return most;
    note(fmt::format("a maximum of 0 for {} is no limit, as in the auditor", what));
    return std::nullopt;
  }

  void read_file_size() {
    const NodeId group = at("fileSizeInKb");
    const auto bytes = [](std::optional<double> kib) {
      return kib ? std::optional(*kib * kBytesPerKiB) : std::nullopt;
    };
    const auto most = above_zero(number(group, "maximum"), "the size of the file");
    const auto least = number(group, "minimum");
    add_range("", "file-size", bytes(least), bytes(most),
              least || most ? "from KiB; the auditor rounds to whole ones" : "");
  }

  void read_triangles(NodeId group) {
    add_range("", "triangles", number(group, "minimum"),
              above_zero(number(group, "maximum"), "triangles"));
  }

  void read_product(NodeId dimensions) {
    constexpr std::pair<std::string_view, char> kAxes[]{
        {"length", 'x'}, {"height", 'y'}, {"width", 'z'}};
    for (const auto& [name, axis] : kAxes) {
      const NodeId group = member(dimensions, name);
      read_range("", fmt::format("size-{}", axis), group, name);
      const auto tolerance = number(group, "percentTolerance");
      if (!tolerance) continue;
      add("", fmt::format("product-deviation-{} = {}  # %, of the product", axis,
                          number_text(*tolerance)));
    }
  }

  void read_textures(NodeId group) {
    read_range("image", "height-pixels", member(group, "height"));
    read_range("image", "width-pixels", member(group, "width"));
    const NodeId colors = member(group, "pbrColorRange");
    constexpr std::string_view kWhich = "of all images; the auditor reads base colors";
    add_range("image", "value-min", number(colors, "minimum"), {}, kWhich);
    add_range("image", "value-max", {}, number(colors, "maximum"), kWhich);
    read_flag("image", "power-of-two = true", member(group, "requireDimensionsBePowersOfTwo"));
    read_flag("image", "aspect = 1", member(group, "requireDimensionsBeQuadratic"));
  }

  void read_uvs(NodeId group) {
    read_density(member(group, "pixelsPerMeter"));
    read_flag("material", "uv-inverted = 0", member(group, "requireNotInverted"));
    read_flag("material", "uv-overlap = 0", member(group, "requireNotOverlapping"));
    read_flag("material", "uv-outside = 0", member(group, "requireRangeZeroToOne"));
    const NodeId gutter = member(group, "gutterWidth");
    if (gutter == kNoNode || !document_.is_object(gutter)) return;
    std::vector<std::string> tiers;
    for (const auto each : document_.members(gutter)) {
      constexpr std::string_view kPrefix = "resolution";
      const std::string_view key = document_.key(each.key_id);
      const auto texels = number(gutter, key);
      const bool known = key.starts_with(kPrefix) && key.size() > kPrefix.size() &&
                         key.find_first_not_of("0123456789", kPrefix.size()) == key.npos;
      if (!texels || !known || tiers.size() == 16) continue;
      tiers.push_back(
          fmt::format("{{ min = {}, at = {} }}", number_text(*texels), key.substr(kPrefix.size())));
    }
    if (!tiers.empty()) add("material", fmt::format("uv-gutter = [{}]", fmt::join(tiers, ", ")));
  }

  void read_density(NodeId group) {
    constexpr std::string_view kWhy = "the square root: the auditor has px2/m2";
    const auto most = number(group, "maximum"), least = number(group, "minimum");
    const auto root = [](std::optional<double> square) {
      return square ? std::optional(std::sqrt(*square)) : std::nullopt;
    };
    add_range("material", "texel-density-min", root(least), {}, kWhy);
    add_range("material", "texel-density-max", {}, root(most), kWhy);
  }

  ImportedConfig finish() {
    ImportedConfig config;
    config.toml = fmt::format("# Made of {} by 'gltfx config import'.\n", printable(name_));
    for (const auto& [table, lines] : lines_) {
      config.toml += table.empty() ? "\n[budgets]\n" : fmt::format("\n[budgets.{}]\n", table);
      for (const std::string& line : lines) config.toml += line + '\n';
    }
    if (lines_.empty()) note("no limit is set");
    config.notes = std::move(notes_);
    return config;
  }

  const Document& document_;
  const std::string& name_;
  std::map<std::string, std::vector<std::string>> lines_;  // by scope; empty: the asset
  std::vector<std::string> notes_;
};

constexpr std::string_view kGroups[]{"fileSizeInKb", "materials", "model",
                                     "product",      "textures",  "uvs"};

}  // namespace

bool looks_like_json(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

Result<ImportedConfig> auditor_config_as_toml(std::string_view text, const std::string& name) {
  const json::Parsed parsed = json::parse(text);
  const Document& document = parsed.document;
  if (!parsed.ok() || !document.is_object(document.root())) {
    return Error{fmt::format("{}: this is not JSON", printable(name))};
  }
  const bool known = document.holds(document.root(), "version") &&
                     std::any_of(std::begin(kGroups), std::end(kGroups), [&](auto group) {
                       return document.holds(document.root(), group);
                     });
  if (!known) {
    return Error{fmt::format("{}: a file of the asset auditor has 'version' and one of {}",
                             printable(name), fmt::join(kGroups, ", "))};
  }
  return AuditorReader(document, name).read();
}

}  // namespace gltfx::tool
