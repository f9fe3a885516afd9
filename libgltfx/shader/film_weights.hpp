// SPDX-License-Identifier: Apache-2.0
/// How much of an even light comes from facets that are seen under each cosine.
#pragma once

#include <array>
#include <memory>

#include "shader/film_layer.hpp"

namespace gltfx::shader {

/// By cosine of the view and cosine of the facet.
using FilmWeightRows = std::array<FilmCurve, kFilmColumns>;
/// Also by azimuth_of() the view.
using AnisotropicFilmWeights = std::array<FilmWeightRows, kAzimuthRows>;

/// Of an isotropic lobe, from a table.
FilmWeightRows film_weights(double roughness);

/// Of an anisotropic lobe, between lobes that are summed at first use: a table of all would take
/// megabytes.
std::shared_ptr<const AnisotropicFilmWeights> anisotropic_film_weights(const Microfacets& facets);

}  // namespace gltfx::shader
