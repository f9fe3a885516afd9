// SPDX-License-Identifier: Apache-2.0
// A baseline is edited and merged by people, so what is wrong with it is said with its place.
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/baseline.hpp"

namespace gltfx::report {
namespace {

const nlohmann::json* member(const nlohmann::json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found != object.end() ? &*found : nullptr;
}

const std::string* text_member(const nlohmann::json& object, const char* name) {
  const nlohmann::json* value = member(object, name);
  return value != nullptr ? value->get_ptr<const std::string*>() : nullptr;
}

std::optional<std::uint64_t> count_member(const nlohmann::json& object) {
  const nlohmann::json* value = member(object, "count");
  const auto* count = value != nullptr ? value->get_ptr<const std::uint64_t*>() : nullptr;
  if (count == nullptr || *count == 0) return std::nullopt;
  return *count;
}

Error wrong_entry(std::size_t index) {
  return {fmt::format(
      "findings[{}] of the baseline is not a finding: 'path', 'code' and 'pointer' must be strings "
      "and 'count' a whole number above 0.",
      index)};
}

void add(FindingCounts& counts, FindingKey key, std::uint64_t count) {
  std::uint64_t& sum = counts[std::move(key)];
  const std::uint64_t room = std::numeric_limits<std::uint64_t>::max() - sum;
  sum += count < room ? count : room;
}

}  // namespace

Result<Baseline> Baseline::parse(std::string_view text) {
  const nlohmann::json root = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (root.is_discarded()) {
    return Error{"The baseline is not valid JSON; write it anew with --write-baseline."};
  }
  const nlohmann::json* format = member(root, "gltfx-baseline");
  if (format == nullptr) return Error{"The file has no 'gltfx-baseline': it is not a baseline."};
  if (*format != 1) {
    return Error{"The baseline is in a format that this version of gltfx does not know."};
  }
  const nlohmann::json* findings = member(root, "findings");
  if (findings == nullptr || !findings->is_array()) {
    return Error{"The baseline has no list 'findings'."};
  }
  Baseline baseline;
  for (std::size_t i = 0; i < findings->size(); ++i) {
    const nlohmann::json& entry = (*findings)[i];
    const std::string* path = text_member(entry, "path");
    const std::string* code = text_member(entry, "code");
    const std::string* pointer = text_member(entry, "pointer");
    const std::optional<std::uint64_t> count = count_member(entry);
    if (path == nullptr || code == nullptr || pointer == nullptr || !count) return wrong_entry(i);
    add(baseline.known_, {*path, *code, *pointer}, *count);
  }
  return baseline;
}

}  // namespace gltfx::report
