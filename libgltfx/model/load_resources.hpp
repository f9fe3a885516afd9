// SPDX-License-Identifier: Apache-2.0
/// The bytes of an asset that is known to be valid, or that is taken as it is: what cannot be had
/// is left out and named.
#pragma once

#include <string>
#include <vector>

#include "container/container.hpp"
#include "container/resolver.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

struct LoadedResources {
  ResourceData data;
  std::vector<std::string> notes;  ///< what is missing and why, a sentence each
};

/// Opens or decodes all buffers and images, maps files, reads headers of images, and decodes buffer
/// views that come as streams of meshoptimizer, on up to `jobs` threads. Nothing outside of the
/// resolver's root is opened.
LoadedResources load_resources(const container::Container& container,
                               const container::Resolver& resolver, const Asset& asset,
                               const Views& views, unsigned jobs);

}  // namespace gltfx::model
