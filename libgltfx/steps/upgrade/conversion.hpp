// SPDX-License-Identifier: Apache-2.0
/// What the steps of a schema cannot say of an upgrade: arithmetic, other structures. Each is named
/// by the word `convert` of a schema and works on one legacy object.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "steps/upgrade/context.hpp"
#include "steps/upgrade/placements.hpp"

namespace gltfx::upgrade {

/// What a conversion works with. Keeps references.
struct ConversionContext {
  Context& run;
  const Host& host;
  const schema::Extension& extension;
  const schema::Extension& successor;
  Placements& placements;
  UpgradeAction& action;

  /// A member of the legacy object, or kNoNode.
  json::NodeId member(std::string_view name) const { return run.document.find(host.object, name); }
  /// Whether an animation or graph points to a member of the host's object, or below it.
  bool is_pointed_at(std::string_view path) const;
  /// As above, to a member of the legacy object.
  bool is_own_pointed_at(std::string_view member) const;
  /// Takes a member out of the legacy object. Only while the changes are made.
  void drop(std::string_view name) const;
};

class Conversion {
 public:
  using Problem = std::optional<std::string>;
  virtual ~Conversion() = default;
  /// Whether the object becomes part of the successor that stands beside it, which then keeps its
  /// name: prepare() and apply() put it there, and the object itself goes.
  virtual bool joins(const ConversionContext&) { return false; }
  /// Why the object has no effect and can go, if so; or what takes its place elsewhere, where its
  /// schema knows no successor. Then apply() makes that.
  virtual Problem reason_to_go(const ConversionContext&) { return std::nullopt; }
  /// Why it cannot be done, if so; otherwise fills placements and notes.
  virtual Problem prepare(const ConversionContext& context) = 0;
  /// Makes the changes inside the legacy object, whose name others change.
  virtual void apply(const ConversionContext& context) = 0;
};

/// Null for an empty name. Precondition: the schema vocabulary knows the name.
std::unique_ptr<Conversion> make_conversion(std::string_view name);

std::unique_ptr<Conversion> make_root_translation();
std::unique_ptr<Conversion> make_scattering();
std::unique_ptr<Conversion> make_specular_glossiness();
std::unique_ptr<Conversion> make_xmp();

}  // namespace gltfx::upgrade
