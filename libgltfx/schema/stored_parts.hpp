// SPDX-License-Identifier: Apache-2.0
/// The members of the parts of a Set, in the order in which they are stored: for writing and for
/// reading.
#pragma once

#include "schema/set.hpp"
#include "schema/walk_tables.hpp"

namespace gltfx::schema {

template <class Archive>
void exchange(Archive& archive, Slot& slot) {
  archive(slot.channels, slot.srgb, slot.scaled_by, slot.factors);
}

template <class Archive>
void exchange(Archive& archive, Target& target) {
  archive(target.base, target.enclosing, target.steps, target.text);
}

template <class Archive>
void exchange(Archive& archive, Literal& literal) {
  archive(literal.kind, literal.number, literal.string, literal.name);
}

template <class Archive>
void exchange(Archive& archive, Version& version) {
  archive(version.major, version.minor);
}

template <class Archive>
void exchange(Archive& archive, VersionText& text) {
  archive(text.version, text.status, text.revision, text.explained);
}

template <class Archive>
void exchange(Archive& archive, Advice& advice) {
  archive(advice.shape, advice.since, advice.because);
}

template <class Archive>
void exchange(Archive& archive, Property& property) {
  archive(property.name, property.shape, property.required, property.parameter,
          property.mutable_type, property.animated_minimum, property.aliases, property.default_json,
          property.deprecated, property.draft, property.since, property.without, property.should,
          property.added_late, property.unit, property.description);
}

template <class Archive>
void exchange(Archive& archive, Condition& condition) {
  archive(condition.if_shape, condition.then_shape, condition.else_shape);
}

template <class Archive>
void exchange(Archive& archive, Shape& shape) {
  archive(shape.label, shape.types, shape.never, shape.minimum, shape.maximum,
          shape.exclusive_minimum, shape.exclusive_maximum, shape.multiple_of, shape.min_length,
          shape.max_length, shape.min_items, shape.max_items, shape.min_properties,
          shape.max_properties, shape.unique_items, shape.pattern, shape.format, shape.literals,
          shape.open_since, shape.is_const, shape.items, shape.type, shape.values,
          shape.pattern_properties, shape.property_names, shape.all_of, shape.any_of, shape.one_of,
          shape.not_shape, shape.conditions, shape.dependent_required, shape.ref, shape.ref_has,
          shape.ref_holds, shape.ref_name, shape.unit_length, shape.should_match, shape.may_refer,
          shape.may_point, shape.essential, shape.by_position, shape.slot, shape.title,
          shape.description, shape.hint, shape.zero_hint);
}

template <class Archive>
void exchange(Archive& archive, ObjectType& type) {
  archive(type.name, type.shape, type.properties, type.open, type.strict, type.extension,
          type.origin);
}

template <class Archive>
void exchange(Archive& archive, Relation& relation) {
  archive(relation.extension, relation.because, relation.error);
}

template <class Archive>
void exchange(Archive& archive, AttributeFormat& format) {
  archive(format.semantic, format.types, format.components, format.required);
}

template <class Archive>
void exchange(Archive& archive, Generation& generation) {
  archive(generation.name, generation.description, generation.with, generation.without,
          generation.slots);
}

template <class Archive>
void exchange(Archive& archive, UpgradeStep& step) {
  archive(step.kind, step.from, step.to, step.otherwise, step.take, step.swizzle, step.accept_index,
          step.generations);
}

template <class Archive>
void exchange(Archive& archive, UpgradeStay& stay) {
  archive(stay.generations, stay.because);
}

template <class Archive>
void exchange(Archive& archive, UpgradeLoss& loss) {
  archive(loss.vertex_attribute, loss.generations, loss.because);
}

template <class Archive>
void exchange(Archive& archive, Upgrade& upgrade) {
  archive(upgrade.to, upgrade.alternatives, upgrade.opt_in, upgrade.together, upgrade.conversion,
          upgrade.blocked_by, upgrade.stays, upgrade.hidden_by, upgrade.steps, upgrade.losses);
}

template <class Archive>
void exchange(Archive& archive, Extension& extension) {
  archive(extension.name, extension.title, extension.description, extension.spec,
          extension.revision, extension.status, extension.attachment_points, extension.excludes,
          extension.requires_, extension.overridden_by, extension.strength, extension.standalone,
          extension.undrawn, extension.optional_with_fallback, extension.khronos_validator,
          extension.must_be_required, extension.fallback, extension.fallback_extensions,
          extension.image_mime_types, extension.vertex_attributes, extension.morph_attributes,
          extension.instance_attributes, extension.successor, extension.generations,
          extension.upgrade, extension.enum_additions, extension.from_user);
}

template <class Archive>
void exchange(Archive& archive, ShapePlan& plan) {
  archive(plan.plan, plan.combined, plan.members, plan.shallow, plan.slot, plan.every_value,
          plan.every_fraction, plan.every_negative_fraction, plan.of_extension, plan.target,
          plan.type, plan.items, plan.values, plan.low, plan.high);
}

template <class Archive>
void exchange(Archive& archive, PropertyPlan& plan) {
  archive(plan.shape, plan.required, plan.deprecated, plan.draft, plan.slot, plan.advised,
          plan.since);
}

template <class Archive>
void exchange(Archive& archive, DependencyPlan& plan) {
  archive(plan.name, plan.other, plan.property, plan.needed);
}

template <class Archive>
void exchange(Archive& archive, TypePlan::Entry& entry) {
  archive(entry.symbol, entry.property, entry.alias);
}

template <class Archive>
void exchange(Archive& archive, TypePlan& plan) {
  archive(plan.entries, plan.properties, plan.dependencies, plan.constraints_at, plan.extensions_at,
          plan.origin, plan.is_root, plan.declarations_at, plan.asset_at);
}

template <class Archive>
void exchange(Archive& archive, TargetPlan& plan) {
  archive(plan.target, plan.pointer, plan.steps_over);
}

template <class Archive>
void exchange(Archive& archive, TargetLookup& lookup) {
  archive(lookup.target, lookup.shared);
}

template <class Archive>
void exchange(Archive& archive, WalkPlans& plans) {
  archive(plans.names, plans.shapes, plans.types, plans.targets, plans.name_target_of,
          plans.lookups);
}

}  // namespace gltfx::schema
