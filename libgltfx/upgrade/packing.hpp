// SPDX-License-Identifier: Apache-2.0
/// Whether two textures may become one image: channels of either show the same as before.
#pragma once

#include <cstdint>
#include <string>

#include "json/document.hpp"
#include "model/asset.hpp"
#include "upgrade/texture_source.hpp"

namespace gltfx::upgrade {

/// Two texture infos (or bare indices) are at the same place of the surface: same set of texture
/// coordinates and same transform, defaults filled in, and nothing else that would have a say.
bool lie_alike(const json::Document& document, json::NodeId one, json::NodeId other);

/// Two samplers (nothing: the default one) wrap and filter alike.
bool sample_alike(const model::Asset& asset, std::optional<std::uint64_t> one,
                  std::optional<std::uint64_t> other);

/// Why the colour of one image and a channel of another do not go into one: of another size, or
/// more than 8 bits of colour. Empty when they do.
std::string packing_obstacle(const Picture& colour, const Picture& factor);

}  // namespace gltfx::upgrade
