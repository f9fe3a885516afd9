// SPDX-License-Identifier: Apache-2.0
#include "config_keys.hpp"

#include <array>

namespace gltfx::tool {
namespace {

using Form = ConfigForm;
using Words = RawValidateOptions;
constexpr ConfigMerge kLast = ConfigMerge::last;
constexpr ConfigMerge kAll = ConfigMerge::all;

constexpr std::array<ConfigKey, 24> kKeys{{
    {"profile", Form::word, kLast, false, "default", &Words::profile},
    {"pixels", Form::word, kLast, false, "headers; needed in the strict profile", &Words::pixels},
    {"fail-on", Form::word, kLast, false, "error", &Words::fail_on},
    {"select", Form::codes, kLast, true, "all", nullptr, &Words::select},
    {"ignore", Form::codes, kAll, true, "none", nullptr, &Words::ignore},
    {"severity", Form::levels, kAll, true, "as 'gltfx rules' says", nullptr, &Words::severities},
    {"max-issues", Form::number, kLast, false, "0, no limit", &Words::max_issues},
    {"lfs", Form::word, kLast, true, "skip", &Words::lfs},
    {"inline-suppressions", Form::flag, kLast, true, "false", &Words::inline_suppressions},
    {"targets", Form::names, kLast, true, "none", nullptr, &Words::targets},
    {"root", Form::path, kLast, false, "the asset's folder", &Words::root},
    {"exclude", Form::paths, kAll, false, "nothing"},
    {"schemas", Form::paths, kAll, false, "the built-in ones", nullptr, &Words::schema_files},
    {"baseline", Form::path, kLast, false, "none", &Words::baseline},
    {"environment", Form::path, kLast, false, "a studio"},
    {"quality", Form::word, kLast, false, "standard"},
    {"projection", Form::word, kLast, false, "perspective"},
    {"frame", Form::word, kLast, false, "everything"},
    {"interior", Form::word, kLast, false, "auto"},
    {"budgets.texture-size", Form::number, kLast, true, "0, no limit", &Words::max_texture_size},
    {"budgets.total-pixels", Form::number, kLast, true, "0, no limit", &Words::max_total_pixels},
    {"budgets.triangles", Form::number, kLast, true, "0, no limit", &Words::max_triangles},
    {"budgets.draw-calls", Form::number, kLast, true, "0, no limit", &Words::max_draw_calls},
    {"budgets.file-size", Form::number, kLast, true, "0, no limit", &Words::max_file_size},
}};

}  // namespace

std::span<const ConfigKey> config_keys() { return kKeys; }

const ConfigKey* find_config_key(std::string_view name) {
  for (const ConfigKey& key : kKeys) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

}  // namespace gltfx::tool
