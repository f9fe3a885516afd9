// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_names.hpp"

#include <gltfx/bake.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

// What there is, for a user who named something else.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    text += text.empty() ? "" : ", ";
    text += names[i].empty() ? std::to_string(i) : quoted(names[i], 40);
  }
  if (names.size() > kMost) text += ", ...";
  return text;
}

std::string like(const std::string& word, const std::vector<std::string>& names) {
  const std::vector<std::string_view> all(names.begin(), names.end());
  const std::string_view near = nearest(word, all);
  return near.empty() ? std::string() : fmt::format(". Did you mean {}?", quoted(near, 60));
}

std::from_chars_result parse(const char* first, const char* last, double& number) {
  return read_double(first, last, number);
}
std::from_chars_result parse(const char* first, const char* last, std::uint32_t& number) {
  return std::from_chars(first, last, number);
}

template <class Number>
bool parse_all(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = parse(text.data(), end, number);
  return error == std::errc() && stop == end;
}

}  // namespace

Result<std::optional<std::uint32_t>> find_named(std::string_view kind, const std::string& word,
                                                const std::vector<std::string>& names) {
  using Found = std::optional<std::uint32_t>;
  if (word.empty()) return Found();
  const auto name = std::find(names.begin(), names.end(), word);
  if (name != names.end()) return Found(static_cast<std::uint32_t>(name - names.begin()));
  std::uint32_t index = 0;
  if (parse_all(word, index) && index < names.size()) return Found(index);
  if (names.empty()) return Error{fmt::format("it has no {}", kind)};
  return Error{fmt::format("it has no {} {}; there is {}{}", kind, quoted(word, 60), listed(names),
                           like(word, names))};
}

Result<std::optional<std::uint32_t>> find_node(const std::string& word,
                                               const std::vector<std::string>& names) {
  constexpr std::string_view kNodes = "/nodes/";
  std::uint32_t index = 0;
  if (word.starts_with(kNodes) && parse_all(std::string_view(word).substr(kNodes.size()), index) &&
      index < names.size()) {
    return std::optional(index);
  }
  return find_named("node", word, names);
}

Result<std::optional<std::uint32_t>> find_part(std::string_view kind, const std::string& word,
                                               const std::vector<std::string>& names,
                                               const Presence& presence) {
  auto found = find_named(kind, word, names);
  if (found || !presence.optional) return found;
  if (!names.empty()) presence.notes.push_back(found.error().message);
  return std::optional<std::uint32_t>();
}

std::vector<std::string> names_in(const model::Asset& asset, model::RootArray array) {
  std::vector<std::string> names;
  for (const json::NodeId element : asset.elements(array)) names.push_back(asset.name(element));
  return names;
}

std::optional<std::pair<double, double>> parse_angles(const std::string& word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string::npos) return std::nullopt;
  std::pair<double, double> angles;
  const std::string_view text(word);
  if (!parse_all(text.substr(0, comma), angles.first)) return std::nullopt;
  if (!parse_all(text.substr(comma + 1), angles.second)) return std::nullopt;
  if (!std::isfinite(angles.first) || !std::isfinite(angles.second)) return std::nullopt;
  return angles;
}

std::optional<std::pair<double, double>> find_preset(std::string_view word) {
  struct Preset {
    std::string_view name;
    double azimuth, elevation;
  };
  // The front of an asset faces +z, so its left is +x (specification section 3.4).
  static constexpr Preset kPresets[] = {
      {"front", 0, 0}, {"back", 180, 0},   {"left", 90, 0},        {"right", -90, 0},
      {"top", 0, 90},  {"bottom", 0, -90}, {"iso", 45, 35.264389},  // equal angles to all axes
  };
  for (const Preset& each : kPresets) {
    if (each.name == word) return std::pair(each.azimuth, each.elevation);
  }
  return std::nullopt;
}

bool is_for_any_asset(const std::string& camera) {
  return parse_angles(camera) || find_preset(camera);
}

std::vector<std::string> camera_file_parts(const std::vector<std::string>& cameras) {
  std::vector<std::string> parts;
  for (std::string part : cameras) {
    for (char& c : part) {
      const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      if (!letter && !(c >= '0' && c <= '9') && c != '-' && c != ',') c = '_';
    }
    while (std::find(parts.begin(), parts.end(), part) != parts.end()) part += '_';
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string_view bake_layer_name(BakeLayer layer) {
  switch (layer) {
    case BakeLayer::albedo:
      return "albedo";
    case BakeLayer::normal:
      return "normal";
    case BakeLayer::depth:
      return "depth";
    case BakeLayer::material:
      break;
  }
  return "material";
}

}  // namespace gltfx
