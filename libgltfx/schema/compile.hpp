// SPDX-License-Identifier: Apache-2.0
/// Compiles schema files to a Set. Used at build time (a mistake fails the build), at start for the
/// embedded files and at run time for a user's own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// Maximum size of a user's schema file in bytes, many times the longest of ours.
inline constexpr std::size_t kLongestFile = 256U << 10U;

struct SourceFile {
  std::string name;  ///< shown in errors
  std::string text;
  bool from_user = false;
};

/// A mistake in a schema file.
struct SchemaError {
  std::string file;
  std::uint32_t line = 0;    ///< 1-based
  std::uint32_t column = 0;  ///< 1-based, in code points
  std::string pointer;       ///< JSON pointer to the key in the file
  std::string message;       ///< with a suggestion if a key is misspelt

  /// "file:line:column: /pointer: message"
  std::string text() const;
};

struct Compiled {
  std::shared_ptr<const Set> set;  ///< null when there are errors
  std::vector<SchemaError> errors;
};

/// Compiles all files together. A later file with the same `$id` replaces an earlier one.
Compiled compile(const std::vector<SourceFile>& files);

/// The set built into the library; compiled at first use, once.
const std::shared_ptr<const Set>& builtin_set();
/// The texts it was compiled from, `name` relative to schema/.
const std::vector<SourceFile>& builtin_files();

/// The built-in files with a user's own, which are added or replace built-in ones.
Compiled compile_with(const std::vector<SourceFile>& extra);

}  // namespace gltfx::schema
