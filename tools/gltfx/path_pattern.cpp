// SPDX-License-Identifier: Apache-2.0
#include "path_pattern.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fnmatch.h>

namespace gltfx::tool {
namespace {

using Names = std::vector<std::string>;

Names split(std::string_view path) {
  Names names;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    if (end > 0) names.emplace_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return names;
}

bool fits_name(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

Names steps_of(std::string_view pattern) {
  Names steps = split(pattern);
  const bool folder = pattern.ends_with('/');
  const std::string_view body = pattern.substr(0, pattern.size() - (folder ? 1 : 0));
  if (body.find('/') == std::string_view::npos) steps.insert(steps.begin(), "**");
  if (folder) steps.insert(steps.end(), {"**", "*"});
  return steps;
}

}  // namespace

// Row by row: fits[i] says whether the steps so far fit the first i names. Linear in both.
bool fits_pattern(std::string_view pattern, std::string_view path) {
  const Names names = split(path);
  std::vector<bool> fits(names.size() + 1, false);
  fits[0] = true;
  for (const std::string& step : steps_of(pattern)) {
    std::vector<bool> next(names.size() + 1, false);
    if (step == "**") {
      const auto first = std::find(fits.begin(), fits.end(), true);
      std::fill(next.begin() + (first - fits.begin()), next.end(), true);
    } else {
      for (std::size_t i = 0; i < names.size(); ++i)
        next[i + 1] = fits[i] && fits_name(step, names[i]);
    }
    fits = std::move(next);
  }
  return fits.back();
}

}  // namespace gltfx::tool
