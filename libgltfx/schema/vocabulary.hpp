// SPDX-License-Identifier: Apache-2.0
/// The words of schema files and the form each value takes. `schema/meta/vocabulary.schema.json`
/// has the same for editors and other validators; a test compares the two.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gltfx::schema {

/// Keywords of a schema object, for a switch. `none`: not one.
enum class Keyword : std::uint8_t {
  none,
  schema,
  id,
  ref,
  defs,
  comment,
  title,
  description,
  default_value,
  deprecated,
  examples,
  type,
  enumeration,
  constant,
  minimum,
  maximum,
  exclusive_minimum,
  exclusive_maximum,
  multiple_of,
  min_length,
  max_length,
  pattern,
  format,
  properties,
  required,
  additional_properties,
  pattern_properties,
  property_names,
  min_properties,
  max_properties,
  dependent_required,
  items,
  min_items,
  max_items,
  unique_items,
  all_of,
  any_of,
  one_of,
  not_,
  if_,
  then_,
  else_,
  x_gltfx,
};

/// The form a word's value must have.
enum class Form : std::uint8_t {
  any,
  text,
  nonempty_text,
  flag,
  number,
  positive,
  count,
  list,
  names,
  type,
  literals,
  literal,
  pattern,
  version,
  versions,
  advice,
  schema,
  schemas,
  schema_map,
  pattern_map,
  names_map,
  reference,
  dialect,
  file_id,
  annotation,  // annotation: x-gltfx
  target,
  name_target,
  member_path,
  slot,
  slot_map,
  channel_factors,
  mutable_type,
  enum_names,
  channels,
  color_space,
  extension_name,
  attachment_points,
  status,
  url,
  revision,
  relations,
  companions,
  severity,
  requirement,
  media_types,
  semantics,
  element_types,
  component_types,
  generations,
  enum_additions,
  upgrade,
  upgrade_steps,
  upgrade_losses,
  upgrade_stays,
  step_kind,
  accepted_form,
  conversion,
  swizzle,
};

struct Word {
  std::string_view name;
  Form form = Form::any;
  Keyword keyword = Keyword::none;
  bool required = false;
};

/// The kinds of object a schema file is made of.
enum class Context : std::uint8_t {
  file,
  schema,
  word,
  version,
  advice,
  extension,
  slot,
  relation,
  companion,
  attribute,
  generation,
  upgrade,
  upgrade_step,
  upgrade_loss,
  upgrade_stay
};

/// The words an object of that kind may have.
std::span<const Word> words(Context context);
/// The name of the kind in an error: "a schema keyword", "a word of x-gltfx".
std::string_view context_name(Context context);
/// The keyword of that name.
Keyword keyword_of(std::string_view name);

/// Values that a word's list of names may hold; empty when it is not such a list.
std::span<const std::string_view> listed_values(Form form);

}  // namespace gltfx::schema
