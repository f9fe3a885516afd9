// SPDX-License-Identifier: Apache-2.0
/// Which fields of a Set's parts are in an image, for writing and reading alike.
#pragma once

#include "schema/set.hpp"

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
void exchange(Archive& archive, Property& property) {
  archive(property.name, property.shape, property.required, property.parameter,
          property.mutable_type, property.animated_minimum, property.aliases, property.default_json,
          property.deprecated, property.draft, property.added_late, property.unit,
          property.description);
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
          shape.is_const, shape.items, shape.type, shape.values, shape.pattern_properties,
          shape.property_names, shape.all_of, shape.any_of, shape.one_of, shape.not_shape,
          shape.conditions, shape.dependent_required, shape.ref, shape.ref_name, shape.slot,
          shape.title, shape.description, shape.hint);
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
  archive(extension.name, extension.title, extension.description, extension.spec, extension.status,
          extension.attachment_points, extension.excludes, extension.requires_,
          extension.overridden_by, extension.strength, extension.standalone,
          extension.optional_with_fallback, extension.khronos_validator, extension.must_be_required,
          extension.fallback, extension.image_mime_types, extension.vertex_attributes,
          extension.morph_attributes, extension.instance_attributes, extension.successor,
          extension.generations, extension.upgrade, extension.enum_additions, extension.from_user);
}

}  // namespace gltfx::schema
