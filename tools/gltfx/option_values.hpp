// SPDX-License-Identifier: Apache-2.0
/// Completion of values of options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command_table.hpp"

namespace gltfx::tool {
namespace values {

// Sets from the tables of gltfx, made on demand.
Values code_choice();
Values code_list();
Values code_levels();
Values report_format_choice();
Values schema_choice();
Values target_choice();
Values measure_choice();
Values measure_name();
Values preset_choice();
Values target_list();
Values legacy_choice();
Values successor_choice();
Values generation_choice();

/// Words to choose from.
Values choice(std::vector<std::string> words);
/// Files with one of the endings, or all.
Values files(std::vector<std::string> endings);
Values any_file();
Values json_file();
Values folder();
/// Files and folders of assets.
Values assets();
/// Files and folders of pages of rules.
Values pages();
/// Files of pictures.
Values pictures();
Values pictures_or_folder();

}  // namespace values

/// All sets of words that have a name.
std::vector<WordSet> named_word_sets();

}  // namespace gltfx::tool
