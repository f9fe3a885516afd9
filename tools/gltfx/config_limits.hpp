// SPDX-License-Identifier: Apache-2.0
/// Tables of limits in TOML: [budgets], [budgets.SCOPE].
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "measure/limit.hpp"
#include "toml.hpp"

namespace gltfx::tool {

class LimitTables {
 public:
  /// Takes a mistake with its line; false: no further ones are wanted.
  using Complain = std::function<bool(std::uint32_t line, const std::string& text)>;

  /// Limit::from of a line.
  using From = std::function<std::string(std::uint32_t line)>;

  LimitTables(From from, Complain complain)
      : from_(std::move(from)), complain_(std::move(complain)) {}

  /// Reads the value of `budgets`. The bounds are those of all tables together.
  void read(const toml::node& node, std::vector<measure::LimitChange>& changes);

 private:
  struct Table;
  struct Place;

  void read_scope(const toml::table& table, MeasureScope on);
  bool read_parameters(const toml::table& table, Table& to);
  void read_measure(const toml::key& key, const toml::node& node, const Table& table);
  bool read_value(const Place& place, const toml::node& node, std::vector<Limit>& limits);
  bool read_ops(const Place& place, const toml::table& table, std::vector<Limit>& limits);
  bool add(const Place& place, const toml::node& node, Limit limit, std::vector<Limit>& limits);
  void keep(const Place& place, const toml::node& node, std::vector<Limit> limits);
  bool complain(const toml::node& node, const std::string& text);

  From from_;
  Complain complain_;
  std::vector<measure::LimitChange>* changes_ = nullptr;
  std::vector<MeasureParameters> parameters_;  // that limits have
  std::size_t count_ = 0;                      // changes of all tables
  bool stopped_ = false;
};

}  // namespace gltfx::tool
