// SPDX-License-Identifier: Apache-2.0
/// The paths of the worker programs.
#pragma once

#include <string>

namespace gltfx::codec {

/// The path of the worker program `name`: in `folder` or, if that is empty, in the first folder
/// that has it: the one in GLTFX_CODEC_WORKERS or of set_codec_folder(), the folder of the running
/// program, the folder for worker programs relative to it (so that an installed tree can be moved),
/// the package that the program was built against, or the configured installation folder. If none
/// has it, the path of a missing file.
std::string program_path(const std::string& folder, const std::string& name);

/// Whether the path is an executable file.
bool is_program(const std::string& path);

}  // namespace gltfx::codec
