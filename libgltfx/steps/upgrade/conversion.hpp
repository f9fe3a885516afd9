// SPDX-License-Identifier: Apache-2.0
/// Parts of an upgrade that the steps of a schema cannot describe: arithmetic, and changes of
/// structure. The word `convert` of a schema names the conversion, which handles one legacy object.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "steps/upgrade/context.hpp"
#include "steps/upgrade/placements.hpp"

namespace gltfx::upgrade {

/// Input of a conversion. Keeps references.
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
  /// The same for a member of the legacy object.
  bool is_own_pointed_at(std::string_view member) const;
  /// Removes a member of the legacy object. Only allowed in apply().
  void drop(std::string_view name) const;
};

class Conversion {
 public:
  using Problem = std::optional<std::string>;
  virtual ~Conversion() = default;
  /// Whether the object is merged into an existing successor, which then keeps its name: prepare()
  /// and apply() move the content there, and the object itself is removed.
  virtual bool joins(const ConversionContext&) { return false; }
  /// Why the object has no effect and can be removed, if so; or its replacement elsewhere, if its
  /// schema has no successor. Then apply() makes the replacement.
  virtual Problem reason_to_go(const ConversionContext&) { return std::nullopt; }
  /// Why it cannot be done, if so; otherwise adds placements and notes.
  virtual Problem prepare(const ConversionContext& context) = 0;
  /// Makes the changes inside the legacy object. Its name is changed by the caller.
  virtual void apply(const ConversionContext& context) = 0;
};

/// Null for an empty name. Precondition: the schema vocabulary defines the name.
std::unique_ptr<Conversion> make_conversion(std::string_view name);

std::unique_ptr<Conversion> make_root_translation();
std::unique_ptr<Conversion> make_scattering();
std::unique_ptr<Conversion> make_specular_glossiness();
std::unique_ptr<Conversion> make_xmp();

}  // namespace gltfx::upgrade
