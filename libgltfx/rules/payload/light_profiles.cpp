// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "rules/extension_walk.hpp"
#include "rules/payload/phases.hpp"
#include "rules/resource_fetch.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kLightProfilesExtension = "EXT_lights_ies";
constexpr std::string_view kSpace = " \t\r\n,";

// The first lines of the versions named by the extension; 1995 and 2002 are versions of the IESNA.
constexpr std::array<std::string_view, 3> kVersions{"IESNA:LM-63-1995", "IESNA:LM-63-2002",
                                                    "IES:LM-63-2019"};

std::string_view first_line(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t last = line.find_last_not_of(" \t\r");
  return line.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

// Removes the next number from the front of `text`.
std::optional<double> take_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto read = read_double(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return value;
}

// TILT=INCLUDE: a geometry, a count, and that number of angles and factors.
bool skip_tilt(std::string_view& text) {
  const auto geometry = take_number(text);
  const auto count = take_number(text);
  if (!geometry || !count || !(*count >= 0)) return false;
  for (double left = *count * 2; left >= 1; --left) {
    if (!take_number(text)) return false;
  }
  return true;
}

// The problem of a profile, as one sentence; empty: no problem in its head.
std::string error_of(std::string_view text) {
  const std::string_view version = first_line(text);
  if (std::find(kVersions.begin(), kVersions.end(), version) == kVersions.end()) {
    return "The profile does not start with the header of LM-63-1995, LM-63-2002 or LM-63-2019.";
  }
  const std::size_t tilt = text.find("\nTILT=");
  if (tilt == std::string_view::npos) return "The profile has no TILT= line.";
  text.remove_prefix(tilt + 1);
  const bool included = first_line(text) == "TILT=INCLUDE";
  text.remove_prefix(std::min(text.find('\n'), text.size()));
  if (included && !skip_tilt(text)) return "The tilt data of the profile is incomplete.";
  // Lamps, lumens, a factor and two counts of angles come before the kind of photometry.
  std::optional<double> kind;
  for (int i = 0; i < 6; ++i) {
    kind = take_number(text);
    if (!kind) return "The data after TILT= is incomplete.";
  }
  const bool known = *kind == 1 || *kind == 2 || *kind == 3;
  return known ? std::string()
               : "The photometric type of the profile is not 1 (C), 2 (B) or 3 (A).";
}

}  // namespace

void check_light_profiles(DataPhase& phase) {
  const json::NodeId object = root_extension(phase.context, kLightProfilesExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kLightProfilesExtension);
  const Path list(extension, "lights");
  const auto lights = object_list(phase.context.document, object, "lights");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i] == json::kNoNode) continue;
    const Path path(list, i);
    ResourceInfo info;
    const Resource resource{phase.context, phase.sink, phase.report, path, lights[i], info};
    check_resource_uri(resource);
    const auto bytes = fetch_uri_or_view(resource, phase.resources);
    if (!bytes) continue;
    const std::span<const std::byte> view = bytes->view();
    std::string error = error_of({reinterpret_cast<const char*>(view.data()), view.size()});
    if (!error.empty()) resource.find(Code::IES_PROFILE_INVALID, "", std::move(error));
  }
}

}  // namespace gltfx::validate
