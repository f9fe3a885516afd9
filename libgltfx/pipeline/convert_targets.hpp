// SPDX-License-Identifier: Apache-2.0
/// What the targets of a conversion need, and what they lack afterwards.
#pragma once

#include <gltfx/convert.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "rules/shortfall.hpp"
#include "schema/set.hpp"
#include "steps/step.hpp"
#include "target/repair.hpp"

namespace gltfx {

/// Without targets in the options it does nothing.
class ConvertTargets {
 public:
  /// Validates the asset. Adds to `options` what all targets read: a container, and with `shrink`
  /// the smallest encoding. Keeps a reference to `options`.
  ConvertTargets(model::OpenedAsset& before, std::shared_ptr<const schema::Set> schemas,
                 ConvertOptions& options);

  const target::Repairs& repairs() const { return repairs_; }
  /// Whether a step makes one of the repairs.
  bool need(const steps::StepDescription& step) const;

  /// Adds to `report` what the targets still lack for the asset after a change. Returns why the
  /// result is refused, half a sentence: a target refuses it, or ignores something new.
  /// Precondition: the change is placed.
  std::optional<std::string> check(const model::OpenedAsset& before, const change::Change& change,
                                   ConvertReport& report) const;

 private:
  void add_zeros();
  void choose_container(const model::OpenedAsset& before, ConvertOptions& options) const;
  void choose_encoding(ConvertOptions& options) const;
  bool all_read(std::string_view extension) const;
  bool is_new(const validate::Shortfall& found) const;

  const ConvertOptions& options_;
  const std::shared_ptr<const schema::Set> schemas_;
  std::vector<validate::Shortfall> before_;
  target::Repairs repairs_;
};

}  // namespace gltfx
