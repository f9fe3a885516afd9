// SPDX-License-Identifier: Apache-2.0
/// Files that a reference to a missing file may mean.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "container/resolver.hpp"

namespace gltfx::container {

/// How the path of a file differs from the path of the missing file, the smallest difference first.
enum class Nearness : std::uint8_t {
  letter_case,
  folder,    ///< the same name elsewhere in the folder of the asset
  ending,    ///< "a.jpg" and "a.png"
  spelling,  ///< up to two edits in words; a number after the name, "a.001.png"
};

struct NearFile {
  std::string path;  ///< below the folder of the asset, '/' separated
  Nearness nearness = Nearness::letter_case;
};

/// The nearest first, files of the same nearness by name. Lists few folders, follows no symbolic
/// links, and opens no file. `path` is a Uri::path; it may lead out of the folder.
std::vector<NearFile> find_near_files(const Resolver& resolver, std::string_view path);

/// A relative URI for a path: characters that a URI cannot hold are escaped, letters of all
/// languages stay.
std::string uri_of_path(std::string_view path);

}  // namespace gltfx::container
