// SPDX-License-Identifier: Apache-2.0
#include "base/json_pointer.hpp"

#include <algorithm>

namespace gltfx {

std::string Path::pointer() const {
  std::vector<const Path*> steps;
  for (const Path* step = this; step->parent_ != nullptr; step = step->parent_) {
    steps.push_back(step);
  }
  std::string text;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if ((*step)->is_index_) {
      text += '/';
      text += std::to_string((*step)->index_);
    } else {
      append_pointer_step(text, (*step)->key_);
    }
  }
  return text;
}

void append_pointer_step(std::string& pointer, std::string_view key) {
  pointer += '/';
  for (const char c : key) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else {
      pointer += c;
    }
  }
}

namespace {

// One step without its '/', unescaped; nothing when a '~' is not followed by 0 or 1.
std::optional<std::string> unescape_step(std::string_view step) {
  std::string text;
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (step[i] != '~') {
      text += step[i];
      continue;
    }
    if (i + 1 == step.size() || (step[i + 1] != '0' && step[i + 1] != '1')) return std::nullopt;
    text += step[++i] == '0' ? '~' : '/';
  }
  return text;
}

bool is_array_index(std::string_view step) {
  return !step.empty() &&
         std::all_of(step.begin(), step.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::optional<std::vector<std::string>> split_pointer(std::string_view pointer) {
  std::vector<std::string> steps;
  if (!pointer.empty() && pointer.front() != '/') return std::nullopt;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const std::size_t end = std::min(pointer.find('/'), pointer.size());
    auto step = unescape_step(pointer.substr(0, end));
    if (!step) return std::nullopt;
    steps.push_back(std::move(*step));
    pointer.remove_prefix(end);
  }
  return steps;
}

std::string pointer_pattern(std::string_view pointer) {
  std::string pattern;
  while (!pointer.empty()) {
    pattern += pointer.front();
    pointer.remove_prefix(1);
    const std::size_t end = std::min(pointer.find('/'), pointer.size());
    const std::string_view step = pointer.substr(0, end);
    pattern += is_array_index(step) ? std::string_view("*") : step;
    pointer.remove_prefix(end);
  }
  return pattern;
}

}  // namespace gltfx
