// SPDX-License-Identifier: Apache-2.0
/// Where the worker programs are.
#pragma once

#include <string>

namespace gltfx::codec {

/// The path of the worker program `name`: in `folder` or, when that is empty, in the folder that
/// GLTFX_CODEC_WORKERS or set_codec_folder() names, beside the running program, from there in the
/// folder for such programs (so that an installed tree can be moved), in the package that the
/// program was built against, or in the folder that gltfx was configured to be installed to. If
/// there is none, the path of a missing file.
std::string program_path(const std::string& folder, const std::string& name);

/// Whether the path is an executable file.
bool is_program(const std::string& path);

}  // namespace gltfx::codec
