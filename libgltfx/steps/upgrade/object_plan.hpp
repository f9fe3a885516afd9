// SPDX-License-Identifier: Apache-2.0
/// The outcome of one legacy object: first prepared, then changed only if the action is done.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steps/upgrade/animated_copy.hpp"
#include "steps/upgrade/context.hpp"
#include "steps/upgrade/conversion.hpp"
#include "steps/upgrade/placements.hpp"
#include "steps/upgrade/texture_source.hpp"

namespace gltfx::upgrade {

class ObjectPlan {
 public:
  /// Keeps references to its arguments. `action` is the result for the object. If the extension has
  /// no successor, `successor` is the extension itself.
  ObjectPlan(Context& context, const schema::Extension& extension,
             const schema::Extension& successor, const Host& host, UpgradeAction& action);
  ObjectPlan(const ObjectPlan&) = delete;
  ObjectPlan& operator=(const ObjectPlan&) = delete;

  /// Fills the action: the result for the object, and its reason.
  void prepare();
  /// Adds the changes to the context's editor. Precondition: prepare() found no obstacle.
  void apply();
  /// New extensions of the host in addition to the successor.
  std::vector<std::string> further_extensions() const { return placements_.extensions(); }

 private:
  /// A step and its value in the document.
  struct Found {
    Found(const schema::UpgradeStep* taken, json::NodeId found) : step(taken), value(found) {}
    const schema::UpgradeStep* step;
    json::NodeId value;
    std::string json;   ///< new text of the value; empty: unchanged
    bool gone = false;  ///< it is removed
    /// The new texture; nothing: unchanged.
    std::optional<ImageJob> image;
    std::optional<std::uint64_t> sampler;  ///< sampler of that texture
    bool shared = false;                   ///< a copy whose original also gets that texture
  };
  using Problem = std::optional<std::string>;

  bool is_pointed_at(std::initializer_list<std::string_view> steps) const;
  bool is_own_pointed_at() const;
  bool has_beside(const std::string& extension) const;
  ConversionContext context() {
    return {context_, host_, extension_, successor_, placements_, action_};
  }
  bool joins() { return conversion_ != nullptr && conversion_->joins(context()); }
  bool is_blocked_by(const std::string& extension) const;
  const schema::Extension* replacement();
  void check_duplicate(const schema::Extension& other);
  void check_removal(const std::string& why);
  Problem reason_to_go();
  Problem hidden();
  void place_what_is_missing();
  Problem conflict() const;
  schema::TypeId own_type() const;
  std::vector<std::string> foreign() const;
  void note_lost_members();
  void note_differences(json::NodeId other);
  void note_difference(const schema::UpgradeStep& step, json::NodeId other);
  void refuse(std::string why);
  Problem check_neighbours();
  Problem check_steps();
  Problem find(const schema::UpgradeStep& step);
  Problem find_moved(const schema::UpgradeStep& step);
  Problem find_channel(const schema::UpgradeStep& step, Found& found);
  bool fold(const schema::UpgradeStep& step, double constant, Found& found);
  void weigh_evidence(const schema::UpgradeStep& step, const ChannelMove& move);
  std::string factor_of(const schema::UpgradeStep& step) const;
  json::NodeId texture_index(const Found& found) const;
  void pack();
  std::string pack(Found& factor, Found& colour);
  void release(const Found& found);
  std::string new_texture(const Found& found);
  void show(const Found& found);
  void show_copy(const Found& found);
  Problem find_placed(const schema::UpgradeStep& step);
  void note_overwritten();
  Problem find_copied(const schema::UpgradeStep& step);
  Problem fill_copy(Found& found, const std::vector<std::string>& path);
  Problem check_value(const std::string& name, json::NodeId value);
  Problem check_texture(const std::string& name, json::NodeId index);
  void follow_animation(const schema::UpgradeStep& step, const std::vector<std::string>& path);
  void note_losses();
  void note_lost_attribute(const schema::UpgradeLoss& loss);
  Problem check_tint();
  Problem fold_tint(const schema::UpgradeStep& step, const Tint& tint);
  bool applies(const std::vector<std::string>& generations) const;
  bool is_default(const std::string& property, const std::vector<json::Number>& numbers) const;
  void lose(std::string note);
  void take_out(json::NodeId value);
  void take_out_members();
  void apply(const Found& found);

  Context& context_;
  const json::Document& document_;
  const schema::Extension& extension_;
  const schema::Extension& successor_;
  const Host& host_;
  Placements placements_;
  std::unique_ptr<Conversion> conversion_;
  std::vector<Found> found_;
  std::vector<Follower> followers_;
  Rgb tint_{1, 1, 1};                  ///< factor of the copy relative to its original
  std::vector<MaterialSplit> splits_;  ///< if it is not the same everywhere
  UpgradeAction& action_;
};

/// The elements of an array of numbers; none for anything else.
std::vector<json::Number> numbers_of(const json::Document& document, json::NodeId list);

}  // namespace gltfx::upgrade
