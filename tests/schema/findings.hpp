// SPDX-License-Identifier: Apache-2.0
/// The findings of the schema walk on the text of a document.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/check.hpp"
#include "schema/compile.hpp"

namespace gltfx::test {

/// One finding, with the text it marks.
struct Found {
  std::string code, pointer, message, help, marked;
  bool is_reference = false;
  bool is_error = false;  ///< its own severity says so, or it has none
};

/// All findings in the order of report: those of the schema sink and of the reference sink mixed.
std::vector<Found> find(std::string_view json, schema::Deviations deviations = {},
                        const schema::Set& set = *schema::builtin_set());

/// "CODE /pointer" of each.
std::vector<std::string> verdict(std::string_view json, schema::Deviations deviations = {},
                                 const schema::Set& set = *schema::builtin_set());

/// The only finding; fails the test when there is another number of them.
Found only(std::string_view json, const schema::Set& set = *schema::builtin_set());

/// Other results of the walk.
schema::CheckResult result_of(std::string_view json, schema::Deviations deviations = {},
                              const schema::Set& set = *schema::builtin_set());

/// A whole asset around one member of the root: `"nodes": [{}]`.
std::string asset(std::string_view members);
/// The same with extensions declared: "A", or "A,B".
std::string asset_using(std::string_view extensions, std::string_view members);
/// An asset with one material.
std::string material(std::string_view members);

}  // namespace gltfx::test
