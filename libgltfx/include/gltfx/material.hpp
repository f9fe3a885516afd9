// SPDX-License-Identifier: Apache-2.0
/// @file
/// The material of glTF 2.0 and its extensions at one point of a surface, and its effect on light:
/// evaluate, sample and integrate (specification, Appendix B, and the texts of the material
/// extensions).
///
/// Directions are unit vectors that point away from the surface, in a frame with the shading
/// normal as +z, the tangent as +x and the bitangent as +y. +z is the outside of a closed mesh; a
/// direction with z < 0 is behind the surface, in the volume when the material bounds one.
/// Colours are linear Rec. 709. Functions are pure, never fail, and use doubles throughout.
///
/// A leaf in the sun, seen against it, and how much of all light it lets through:
///
///     gltfx::Material leaf;
///     leaf.metallic = 0;
///     leaf.base_color = {0.1, 0.3, 0.05};
///     leaf.diffuse_transmission = 0.6;
///     leaf.diffuse_transmission_color = {0.2, 0.6, 0.1};
///     const gltfx::Vec3d viewer{0, 0, 1}, sun{0, 0.6, -0.8};
///     const gltfx::Rgb seen = gltfx::evaluate(leaf, viewer, sun) * (100000 * 0.8);  // cd/m^2
///     const gltfx::Rgb through = gltfx::integrate(leaf, viewer).diffuse_transmit;
///     const auto next = gltfx::sample(leaf, viewer, {0.5, 0.3, 0.7});  // to where a path goes on
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <limits>
#include <optional>

namespace gltfx {

/// The extension that defines how light scatters in the volume.
enum class Scattering : std::uint8_t {
  none,
  distance,      ///< KHR_materials_sss and KHR_materials_subsurface: sigma_s = -log c / d
  multiscatter,  ///< KHR_materials_volume_scatter: albedo after many bounces
  unified,       ///< KHR_materials_scatter: the same with a strength, and a thin-walled form
};

/// The parameters of a material at a point: factor times texture (times vertex colour for the base
/// colour), each as its specification has it after the texture is read. Defaults are those of a
/// material without the property or its extension.
struct Material {
  Rgb base_color{1, 1, 1};       ///< 0 to 1
  double metallic = 1;           ///< 0 to 1
  double roughness = 1;          ///< 0 to 1; alpha is its square
  double diffuse_roughness = 0;  ///< 0 to 1; 0 is Lambertian
  Rgb emissive;                  ///< radiance: factor, texture and emissiveStrength multiplied

  double ior = 1.5;             ///< >= 1, or 0: infinite, for specular-glossiness
  double outside_ior = 1;       ///< of the medium around the surface, for nested volumes
  double specular = 1;          ///< 0 to 1
  Rgb specular_color{1, 1, 1};  ///< colour of F0; may be above 1

  double transmission = 0;                  ///< 0 to 1
  double diffuse_transmission = 0;          ///< 0 to 1
  Rgb diffuse_transmission_color{1, 1, 1};  ///< 0 to 1

  double thickness = 0;  ///< any unit; above 0 the surface bounds a volume, at 0 it is thin-walled
  double attenuation_distance = std::numeric_limits<double>::infinity();  ///< metres
  Rgb attenuation_color{1, 1, 1};                                         ///< 0 to 1
  Scattering scattering = Scattering::none;                               ///< in the volume
  double scatter_distance = std::numeric_limits<double>::infinity();  ///< metres; `distance` only
  Rgb scatter_color;              ///< `distance`: c of sigma_s; else the multi-scatter colour
  double scatter_strength = 1;    ///< 0 to 1; `unified` only
  double scatter_anisotropy = 0;  ///< -1 to 1; above 0 forwards
  double dispersion = 0;          ///< 20 / Abbe number

  Rgb sheen_color;                     ///< 0 to 1
  double sheen_roughness = 0;          ///< 0 to 1
  double clearcoat = 0;                ///< 0 to 1
  double clearcoat_roughness = 0;      ///< 0 to 1
  Vec3d clearcoat_normal{0, 0, 1};     ///< in the frame above
  double anisotropy = 0;               ///< 0 to 1
  double anisotropy_rotation = 0;      ///< radians, counter-clockwise from the tangent
  double iridescence = 0;              ///< 0 to 1
  double iridescence_ior = 1.3;        ///< at least 1
  double iridescence_thickness = 400;  ///< nanometres

  bool unlit = false;  ///< emits its base colour and does nothing else

  /// Whether the surface bounds a volume.
  bool volumetric() const { return thickness > 0; }
};

/// The material of KHR_materials_pbrSpecularGlossiness, converted as in the specification of
/// KHR_materials_specular: IOR 0.
Material specular_glossiness(const Rgb& diffuse, const Rgb& specular, double glossiness);

/// Adds the first generation of KHR_materials_translucency: the base colour tints transmitted
/// light. (Later generations have a colour of their own and need no conversion: their factor and
/// colour are diffuse_transmission and diffuse_transmission_color.)
void add_translucency(Material& material, double factor);

/// How literally the specifications are implemented.
enum class ShaderMode : std::uint8_t {
  spec,  ///< the literal sample implementations, which can reflect more than they receive
  /// Diffuse light below a layer is what the layer leaves over, and light that bounces between
  /// facets is added: the albedo of a white material is 1 to some 0.01.
  conserving,
};

/// How a material is evaluated.
struct ShaderOptions {
  ShaderMode mode = ShaderMode::conserving;  ///< how literally
  /// Colour channel of the path through a dispersive volume: 0, 1 or 2 for its own index of
  /// refraction, any other value for that of the green channel.
  int channel = -1;
};

/// Random numbers, each in [0, 1).
struct Random3 {
  double lobe = 0, u = 0, v = 0;  ///< which lobe, and where in it
};

/// A direction in which a path continues.
struct MaterialSample {
  Vec3d l;         ///< away from the surface
  Rgb weight;      ///< f |cos| / pdf
  double pdf = 0;  ///< per steradian; of a delta lobe: its probability
  /// True for a mirror or an ideal refraction, which evaluate() and pdf() leave out.
  bool delta = false;
};

/// f(v, l) without the cosine, delta lobes left out. Radiance towards v under a directional light
/// of E lux from l is f E |l.z|.
Rgb evaluate(const Material& material, const Vec3d& v, const Vec3d& l, const ShaderOptions& = {});

/// Density per steradian with which sample() takes l.
double pdf(const Material& material, const Vec3d& v, const Vec3d& l, const ShaderOptions& = {});

/// Nothing when the path ends: absorbed, or below the horizon.
std::optional<MaterialSample> sample(const Material& material, const Vec3d& v,
                                     const Random3& random, const ShaderOptions& = {});

/// Radiance towards v of the surface itself, or of an unlit material its colour.
Rgb emitted(const Material& material, const Vec3d& v);

/// The fraction of light that comes back from an environment of radiance 1 on all sides.
struct Albedo {
  Rgb diffuse_reflect, diffuse_transmit;    ///< to this side and to the other
  Rgb specular_reflect, specular_transmit;  ///< clearcoat and sheen count as specular
  Rgb total;                                ///< of all of them
};

/// Albedo towards v, by quadrature: `resolution` azimuths for each lobe, and some half of that
/// along each. At 64 it is exact to some 1e-5, except for layered lobes at grazing angles.
Albedo integrate(const Material& material, const Vec3d& v, const ShaderOptions& = {},
                 int resolution = 64);

}  // namespace gltfx
