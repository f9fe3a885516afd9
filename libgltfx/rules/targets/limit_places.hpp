// SPDX-License-Identifier: Apache-2.0
/// Where the elements of measures are in an asset.
#pragma once

#include <gltfx/limit.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "rules/context.hpp"
#include "rules/targets/limit_words.hpp"

namespace gltfx::validate {

/// Keeps references, which must outlive it.
class LimitPlaces {
 public:
  LimitPlaces(const Context& context, const Measurements& taken,
              std::optional<std::uint32_t> default_scene)
      : context_(context), taken_(taken), default_scene_(default_scene) {}

  /// What an element is called.
  Measured measured(MeasureScope on, std::size_t element) const;
  /// Its pointer, and its name or that of the mesh of a primitive; both may be empty.
  std::string pointer(MeasureScope on, std::size_t element) const;
  std::string name(MeasureScope on, std::size_t element) const;

  /// Reports a finding at the element; for the asset at the array or scene that its value is made
  /// of.
  void report(const Limit& limit, std::size_t element, Finding finding, Sink& sink) const;

 private:
  bool is_plain(MeasureScope on, std::size_t element) const;
  json::NodeId object(MeasureScope on, std::size_t element) const;
  void report_asset(const MeasureDescription& measure, Finding finding, Sink& sink) const;

  const Context& context_;
  const Measurements& taken_;
  std::optional<std::uint32_t> default_scene_;
};

}  // namespace gltfx::validate
