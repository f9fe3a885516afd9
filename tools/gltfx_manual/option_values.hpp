// SPDX-License-Identifier: Apache-2.0
/// What can be offered where the command line wants a value.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gltfx::tool {

/// Words to choose from. Long sets have a name, under which scripts keep them once.
struct WordSet {
  std::string name = {};  ///< "codes"; may be empty
  std::vector<std::string> words = {};
};

/// What fits one option, or the positional arguments of a verb.
struct Values {
  WordSet words = {};
  bool commas = false;       ///< several words with commas between
  WordSet behind = {};       ///< what may follow a word and "="
  bool file_behind = false;  ///< a file may do so
  bool files = false, folders = false;
  std::vector<std::string> endings = {};  ///< of files, without the dot; empty: all

  bool paths() const { return files || folders; }
};

/// For an option of a verb ("validate", "--lfs"), or its positional arguments (an empty option).
/// Empty for values of which nothing can be said, such as numbers.
Values values_of(std::string_view verb, std::string_view option);

/// All sets of words that have a name.
std::vector<WordSet> named_word_sets();

}  // namespace gltfx::tool
