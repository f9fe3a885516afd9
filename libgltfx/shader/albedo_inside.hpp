// SPDX-License-Identifier: Apache-2.0
/// Energy conservation of a dielectric's layer inside a volume.
///
/// The tables of albedo.hpp do not have the curve of total reflection. It is summed over visible
/// normals, which takes longer than everything else at a surface: sums are kept in a table.
#pragma once

#include "shader/fresnel.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// The transmittance of the layer over that of the sample implementation, which passes 1 - F on to
/// diffuse lobes. `layer_scale`: of the light of the layer, for what bounces between facets.
/// Precondition: `fresnel.eta` is below 1. The result depends on the arguments alone; its colours
/// differ below a film.
Rgb share_inside(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v,
                 const Rgb& layer_scale = Rgb(1));

/// The albedo of a refracting interface whose facets lose nothing, summed over facets; of a film,
/// that of the strongest colour. Exact to some 0.01.
double summed_albedo(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v);

}  // namespace gltfx::shader
