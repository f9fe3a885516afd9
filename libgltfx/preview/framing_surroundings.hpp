// SPDX-License-Identifier: Apache-2.0
/// Skies and seas: what surrounds the subject of a picture.
#pragma once

#include "preview/framing.hpp"

namespace gltfx::preview {

/// Removes triangles of bodies that are many times larger than all others together: level sheets,
/// such as a sea, that the others rise from; and domes and boxes around the others that show them
/// their fronts, such as a sky. They stay in the picture, as far as they are behind the others.
void drop_surroundings(Subject& subject);

}  // namespace gltfx::preview
