# SPDX-License-Identifier: Apache-2.0
"""Runs in Blender: draws assets with Cycles, as a file of JSON says.

  blender --background --factory-startup --python draw_in_blender.py -- JOBS.json

Cycles has no denoiser, clamp or blur here; pictures are OpenEXR files of linear light. What the
glTF importer of Blender 3.4 reads differently from the specification and can be set right without
doubt is set right in adapt(); see "Agreement with Cycles" in HACKING.md.
"""
import json
import math
import sys

import bpy


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        jobs = json.load(file)
    for job in jobs:
        print("drawing", job["asset"], file=sys.stderr, flush=True)
        draw(job)


def draw(job):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # Unitless: 1 lux is 1 W/m2, and not 1/683 of that. Smooth: normals of the asset are kept; by
    # default, the importer needs a version of NumPy before 1.24.
    bpy.ops.import_scene.gltf(filepath=job["asset"], convert_lighting_mode="COMPAT",
                              import_shading="SMOOTH")
    scene = bpy.context.scene
    scene.camera = next(o for o in scene.objects if o.type == "CAMERA")
    adapt()
    light_with(scene, job["sky"])
    render(scene, job)


def light_with(scene, sky):
    """The environment as gltfx places it: its middle column is glTF's -z, and not +x."""
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    place = tree.nodes.new("ShaderNodeTexCoord")
    turn = tree.nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value[2] = -math.pi / 2
    image = tree.nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(sky)
    tree.links.new(place.outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs["Vector"], image.inputs["Vector"])
    tree.links.new(image.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def render(scene, job):
    cycles, output = scene.cycles, scene.render
    output.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.samples, cycles.seed = job["samples"], job["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    for kind in ("", "diffuse_", "glossy_", "transmission_", "volume_"):
        setattr(cycles, kind + "bounces" if kind else "max_bounces", job["bounces"])
    cycles.transparent_max_bounces = 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = 1.47  # as wide, by standard deviation, as the tent filter of gltfx
    output.threads_mode, output.threads = "FIXED", job["threads"]
    output.resolution_x = output.resolution_y = job["size"]
    output.resolution_percentage = 100
    output.film_transparent = False
    scene.view_settings.view_transform = "Raw"
    settings = output.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "NONE"
    output.filepath = job["picture"]
    bpy.ops.render.render(write_still=True)


def adapt():
    for light in bpy.data.lights:
        light.shadow_soft_size = 0
        if light.type == "SUN":
            light.angle = 0
    for material in bpy.data.materials:
        change = ADAPTATIONS.get(material.get("nodes"))
        if change:
            tree = material.node_tree
            change(tree, next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), material)


def take_input(tree, node, name, target):
    """Gives `target` what an input has: its link or its value."""
    source = node.inputs[name]
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def replace(tree, node, output):
    for link in list(node.outputs[0].links):
        tree.links.new(output, link.to_socket)


def lambert(tree, principled, _material):
    """The diffuse BRDF of the specification, not that of Disney."""
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    take_input(tree, principled, "Base Color", diffuse.inputs["Color"])
    take_input(tree, principled, "Normal", diffuse.inputs["Normal"])
    clear = tree.nodes.new("ShaderNodeBsdfTransparent")
    covered = mix(tree, None, clear.outputs[0], diffuse.outputs[0])
    take_input(tree, principled, "Alpha", covered.node.inputs["Fac"])
    replace(tree, principled, covered)


def cosine_of_view(tree):
    """An output: of the angle between normal and view."""
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    cosine = tree.nodes.new("ShaderNodeVectorMath")
    cosine.operation = "DOT_PRODUCT"
    tree.links.new(geometry.outputs["Normal"], cosine.inputs[0])
    tree.links.new(geometry.outputs["Incoming"], cosine.inputs[1])
    return cosine.outputs["Value"]


def schlick(tree, f0, weight=1.0):
    """An output: `weight` times Schlick's term, of the angle between normal and view."""
    def math_node(operation, *values):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        for value, target in zip(values, node.inputs):
            if isinstance(value, float):
                target.default_value = value
            else:
                tree.links.new(value, target)
        return node.outputs[0]

    rest = math_node("SUBTRACT", 1.0, math_node("ABSOLUTE", cosine_of_view(tree)))
    fifth = math_node("POWER", rest, 5.0)
    return math_node("MULTIPLY_ADD", fifth, weight * (1 - f0), weight * f0)


def mix(tree, factor, one, other):
    node = tree.nodes.new("ShaderNodeMixShader")
    for source, target in zip((factor, one, other), node.inputs):
        if source:
            tree.links.new(source, target)
    return node.outputs[0]


def by_angle(tree, values):
    """An output: colors by the cosine of the angle between normal and view, from 0 to 1."""
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    stops = ramp.color_ramp.elements
    while len(stops) < len(values):
        stops.new(1)
    for i, (stop, value) in enumerate(zip(stops, values)):
        stop.position = i / (len(values) - 1)
        stop.color = (*value, 1)
    tree.links.new(cosine_of_view(tree), ramp.inputs["Fac"])
    return ramp.outputs["Color"]


def layered(tree, principled, base, factor, roughness, rest=None):
    """Puts a layer of IOR 1.5 over `base`: what it reflects, the base does not get. `roughness`
    names the input that has its roughness. `rest`: an output, the part that the base gets; by
    default what a smooth layer leaves."""
    layer = tree.nodes.new("ShaderNodeBsdfPrincipled")
    layer.inputs["Base Color"].default_value = (0, 0, 0, 1)
    take_input(tree, principled, roughness, layer.inputs["Roughness"])
    weight = tree.nodes.new("ShaderNodeValue")
    weight.outputs[0].default_value = factor
    black = tree.nodes.new("ShaderNodeBsdfDiffuse")
    black.inputs["Color"].default_value = (0, 0, 0, 1)
    added = tree.nodes.new("ShaderNodeAddShader")
    links = [link.to_socket for link in principled.outputs[0].links]
    held = (mix(tree, rest, black.outputs[0], base) if rest else
            mix(tree, schlick(tree, 0.04, factor), base, black.outputs[0]))
    for source, target in zip((held,
                               mix(tree, weight.outputs[0], black.outputs[0], layer.outputs[0])),
                              added.inputs):
        tree.links.new(source, target)
    for target in links:
        tree.links.new(added.outputs[0], target)


def coat(tree, principled, _material):
    """KHR_materials_clearcoat, which Principled has at a quarter of its strength and with another
    distribution of normals."""
    factor = principled.inputs["Clearcoat"].default_value
    principled.inputs["Clearcoat"].default_value = 0
    layered(tree, principled, principled.outputs[0], factor, "Clearcoat Roughness")


def plastic(tree, principled, material):
    """A dielectric whose base is that of the specification. Its property `rest` has what a rough
    layer leaves over by the angle to the view."""
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    take_input(tree, principled, "Base Color", diffuse.inputs["Color"])
    rest = by_angle(tree, [[part] * 3 for part in material["rest"]]) if "rest" in material else None
    layered(tree, principled, diffuse.outputs[0], 1.0, "Roughness", rest)


def thin(tree, principled, _material):
    """A smooth thin wall, which does not refract."""
    clear = tree.nodes.new("ShaderNodeBsdfTransparent")
    take_input(tree, principled, "Base Color", clear.inputs["Color"])
    gloss = tree.nodes.new("ShaderNodeBsdfGlossy")
    gloss.inputs["Color"].default_value = (1, 1, 1, 1)
    gloss.inputs["Roughness"].default_value = 0
    replace(tree, principled, mix(tree, schlick(tree, 0.04), clear.outputs[0], gloss.outputs[0]))


def many_bounces(_, principled, _material):
    """Light that bounces between facets more than once."""
    principled.distribution = "MULTI_GGX"


def film(tree, principled, material):
    """A thin film, which Blender 3.4 does not have, on a mirror or on smooth plastic: the color by
    the angle to the view is a property of the material."""
    colors = list(material["film"])
    colors = [colors[i:i + 3] for i in range(0, len(colors), 3)]
    gloss = tree.nodes.new("ShaderNodeBsdfGlossy")
    gloss.inputs["Roughness"].default_value = 0
    tree.links.new(by_angle(tree, colors), gloss.inputs["Color"])
    result = gloss.outputs[0]
    if principled.inputs["Metallic"].default_value == 0:
        base = principled.inputs["Base Color"].default_value[:3]
        diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
        tree.links.new(by_angle(tree, [[(1 - f) * c for f, c in zip(color, base)] for color in colors]),
                       diffuse.inputs["Color"])
        added = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(result, added.inputs[0])
        tree.links.new(diffuse.outputs[0], added.inputs[1])
        result = added.outputs[0]
    replace(tree, principled, result)


def volume(tree, _, _material):
    """Absorption by attenuationColor over attenuationDistance: -ln(color) / distance, and not
    (1 - color) / distance."""
    for node in [n for n in tree.nodes if n.type == "VOLUME_ABSORPTION"]:
        color, density = node.inputs["Color"], node.inputs["Density"]
        absorbed = [-math.log(c) * density.default_value for c in color.default_value[:3]]
        most = max(absorbed)
        if most > 0:
            density.default_value = most
            color.default_value = [1 - a / most for a in absorbed] + [1]


ADAPTATIONS = {"lambert": lambert, "plastic": plastic, "coat": coat, "thin": thin,
               "volume": volume, "many bounces": many_bounces, "film": film}


if __name__ == "__main__":
    main()
