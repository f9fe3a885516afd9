// SPDX-License-Identifier: Apache-2.0
#include "option_rows.hpp"

#include <algorithm>

namespace gltfx::tool {

void Options::add(std::string_view names, std::string_view type, std::string_view text,
                  Binding binding, ConfigKey key) {
  Option& row = rows_.emplace_back();
  const std::size_t comma = names.find(',');
  if (comma != std::string_view::npos) row.short_name = names.substr(0, comma);
  row.name = names.substr(comma + 1);
  row.type = type;
  row.text = text;
  row.repeatable = binding.repeatable;
  row.values = std::move(binding.values);
  row.key = key;
  row.read = std::move(binding.read);
  row.file_only = file_only_;
}

void Options::positional(std::string_view name, std::string_view text, Binding binding) {
  arguments_.name = name;
  arguments_.text = text;
  arguments_.values = std::move(binding.values);
  arguments_.read = std::move(binding.read);
}

const Option* Options::find(std::string_view name) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const Option& row) { return row.name == name; });
  return found == rows_.end() ? nullptr : &*found;
}

const Words& Options::words(std::string_view name) const {
  const Option* const row = find(name);
  return row == nullptr ? none_ : row->words;
}

std::string_view Options::word(std::string_view name) const {
  const Words& all = words(name);
  return all.empty() ? std::string_view() : all.back();
}

bool Options::given(std::string_view name) const {
  const Option* const row = find(name);
  return row != nullptr && row->given;
}

bool Options::has_keys() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [](const Option& row) { return !row.key.name.empty(); });
}

bool Options::runs_without_configuration() const {
  return std::any_of(without_configuration.begin(), without_configuration.end(),
                     [this](std::string_view name) { return given(name); });
}

std::optional<Error> Options::read() const {
  if (!arguments_.words.empty()) arguments_.read(arguments_.name, arguments_.words);
  for (const Option& row : rows_) {
    if (row.words.empty() || !row.read) continue;
    if (auto mistake = row.read(row.name, row.words)) return mistake;
  }
  return {};
}

void Options::read_by_path() const {
  for (const Option& row : rows_) {
    if (row.key.by_path && !row.words.empty()) row.read(row.name, row.words);
  }
}

Binding text(std::string& member, std::function<Values()> values) {
  return parsed(
      member, [](std::string_view, const std::string& word) { return Result<std::string>(word); },
      std::move(values));
}

Binding list(Words& member, std::function<Values()> values) {
  return parsed_list(
      member, [](std::string_view, const Words& words) { return Result<Words>(words); },
      std::move(values));
}

Binding flag(bool& member) {
  return parsed(member, [](std::string_view, const std::string& word) {
    return Result<bool>(word != "false");
  });
}

Binding decimal(double& member, double least, double greatest) {
  return parsed(member, [least, greatest](std::string_view option, std::string_view word) {
    return parse_decimal(option, word, least, greatest);
  });
}

}  // namespace gltfx::tool
