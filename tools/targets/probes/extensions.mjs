// SPDX-License-Identifier: Apache-2.0
// Probes of extensions. An entry of `plain` adds one extension to an object of a model; more complex probes are
// functions.
import { readFileSync } from 'node:fs';
import { backdrop, colors, model, primitive, place, square, texture, textured } from './models.mjs';
import { compressed, quantized } from './compression.mjs';
import { png, quadrants } from './png.mjs';

const picture = name => readFileSync(new URL(`images/${name}`, import.meta.url));

// The content of an extension, and a model that shows it.
const onMaterial = {
  '3DS_materials_translucency': { translucencyFactor: 0.8, translucencyColorFactor: [0.2, 0.9, 0.3] },
  ADOBE_materials_thin_transparency: { transmissionFactor: 0.9, ior: 1.6 },
  KHR_materials_anisotropy: { anisotropyStrength: 0.9, anisotropyRotation: 0.7 },
  KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatRoughnessFactor: 0.1 },
  KHR_materials_diffuse_roughness: { diffuseRoughnessFactor: 1 },
  KHR_materials_diffuse_transmission: { diffuseTransmissionFactor: 0.9, diffuseTransmissionColorFactor: [0.2, 0.9, 0.3] },
  KHR_materials_emissive_strength: { emissiveStrength: 5 },
  KHR_materials_ior: { ior: 2.2 },
  KHR_materials_iridescence: { iridescenceFactor: 1, iridescenceIor: 1.8, iridescenceThicknessMaximum: 500 },
  KHR_materials_sheen: { sheenColorFactor: [0.9, 0.2, 0.9], sheenRoughnessFactor: 0.4 },
  KHR_materials_specular: { specularFactor: 0.2, specularColorFactor: [0.1, 0.9, 0.4] },
  KHR_materials_subsurface: { scatterDistance: 1.0, scatterColor: [0.8, 0.2, 0.1] },
  KHR_materials_sss: { scatterDistance: 1.0, scatterColor: [0.8, 0.2, 0.1] },
  KHR_materials_translucency: { translucencyFactor: 0.8, translucencyColorFactor: [0.2, 0.9, 0.3] },
  KHR_materials_transmission: { transmissionFactor: 0.95 },
  KHR_materials_unlit: {},
};
const emissive = { KHR_materials_emissive_strength: { emissiveFactor: [0.4, 0.2, 0.1] } };
const seenThrough = ['3DS_materials_translucency', 'ADOBE_materials_thin_transparency', 'KHR_materials_translucency',
  'KHR_materials_diffuse_transmission', 'KHR_materials_transmission'];

const set = (object, name, value) => { object.extensions = { ...object.extensions, [name]: value }; };

// A model with an extension on its material. Companions are extensions that it needs to show.
function material(name, value, members = {}, companions = {}, behind = false) {
  const only = ['POSITION', 'NORMAL', 'TEXCOORD_0', ...(name === 'KHR_materials_anisotropy' ? ['TANGENT'] : [])];
  const asset = model({ material: members, only });
  for (const [other, content] of Object.entries(companions)) {
    set(asset.json.materials[0], other, content);
    asset.uses(other);
  }
  if (behind || seenThrough.includes(name)) backdrop(asset);
  const twin = asset.copy();
  set(asset.json.materials[0], name, value);
  return { asset, twin };
}

const glass = { KHR_materials_transmission: { transmissionFactor: 1 } };
const thick = { thicknessFactor: 1, attenuationDistance: 0.5, attenuationColor: [0.9, 0.3, 0.2] };
const inVolume = (name, value) => material(name, value, {}, { ...glass, KHR_materials_volume: thick }, true);

// A twin is the asset without the extension; added() gives both.
function added(asset, change) {
  const twin = asset.copy();
  change(asset);
  return { asset, twin };
}

function light(type, more = {}) {
  return added(model(), asset => {
    asset.json.extensions = { KHR_lights_punctual: { lights: [{ type, name: 'Lamp', intensity: 20, color: [1, 0.3, 0.2], ...more }] } };
    asset.json.scenes[0].nodes.push(asset.add('nodes', { name: 'Lamp', translation: [1, 2, 2], rotation: [-0.5, 0, 0, Math.sqrt(0.75)],
      extensions: { KHR_lights_punctual: { light: 0 } } }));
  });
}

// A texture whose image only the extension names, or a fallback of other colors beside it. The twin has the fallback, or
// no texture.
export function imageBy(name, file, mimeType, fallback) {
  const size = [16, 16];
  const other = { image: png({ size, at: (x, y) => quadrants(size)(15 - x, 15 - y) }) };
  const [asset, twin] = [textured(other), textured(other)];
  if (!fallback) {
    for (const it of [asset, twin]) {
      delete it.json.images;
      it.files.clear();
    }
    delete asset.json.textures[0].source;
    delete twin.json.textures;
    delete twin.json.materials[0].pbrMetallicRoughness.baseColorTexture;
  }
  set(asset.json.textures[0], name, { source: asset.image(picture(file), file, { mimeType }) });
  return { asset, twin, ...(!fallback && { like: textured() }) };
}

const instances = () => added(model(), asset => {
  const offsets = [-2, 0, 0, 0, 1, 0, 2, 0, 0];
  set(asset.json.nodes[0], 'EXT_mesh_gpu_instancing', { attributes: { TRANSLATION: asset.accessor(offsets, { bounds: true }) } });
});

const variants = () => {
  const asset = model();
  asset.add('materials', { name: 'Other', pbrMetallicRoughness: { baseColorFactor: [0.1, 0.2, 0.9, 1] } });
  place(asset, [primitive(asset, square(0.2, 2), { material: 1 })]);
  return added(asset, it => {
    it.json.extensions = { KHR_materials_variants: { variants: [{ name: 'first' }, { name: 'second' }] } };
    set(it.json.meshes[0].primitives[0], 'KHR_materials_variants', { mappings: [{ material: 0, variants: [0] }, { material: 1, variants: [1] }] });
  });
};

const pointer = () => {
  const asset = model();
  const input = asset.accessor([0, 1], { type: 'SCALAR', bounds: true });
  const output = asset.accessor([0.7, 0.5, 0.3, 1, 0.1, 0.2, 0.9, 1], { type: 'VEC4' });
  const move = asset.accessor([0, 0, 0, 1, 0, 0], {});
  asset.add('animations', { name: 'Colors', samplers: [{ input, output: move }], channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }] });
  return added(asset, it => {
    it.json.animations[0].samplers.push({ input, output });
    it.json.animations[0].channels.push({ sampler: 1, target: { path: 'pointer', extensions: { KHR_animation_pointer: { pointer: '/materials/0/pbrMetallicRoughness/baseColorFactor' } } } });
  });
};

const splats = () => added(model({ shape: square() }), asset => {
  const count = 3;
  const each = (...values) => Array.from({ length: count }, () => values).flat();
  const attributes = {
    POSITION: asset.attribute([0, 0, 1.5, 1, 0, 1.5, 0, 1, 1.5], { bounds: true }),
    COLOR_0: asset.attribute(each(1, 0, 0, 1), { type: 'VEC4' }),
    'KHR_gaussian_splatting:ROTATION': asset.attribute(each(0, 0, 0, 1), { type: 'VEC4' }),
    'KHR_gaussian_splatting:SCALE': asset.attribute(each(0.2, 0.2, 0.2), {}),
    'KHR_gaussian_splatting:OPACITY': asset.attribute(each(0.9), { type: 'SCALAR' }),
    'KHR_gaussian_splatting:SH_DEGREE_0_COEF_0': asset.attribute(each(1, 0.2, 0.2), {}),
  };
  place(asset, [{ mode: 0, attributes, extensions: { KHR_gaussian_splatting: { kernel: 'ellipse', colorSpace: 'srgb_rec709_display' } } }]);
});

const onRoot = (name, root, on, value, of = model()) => added(of, asset => {
  asset.json.extensions = { [name]: root };
  if (on) set(on(asset.json), name, value);
});
const node = json => json.nodes[0];

const lod = () => {
  const asset = model();
  const coarse = asset.add('nodes', { name: 'Coarse', mesh: asset.add('meshes', { name: 'Coarse', primitives: [primitive(asset, square())] }) });
  return added(asset, it => set(it.json.nodes[0], 'MSFT_lod', { ids: [coarse] }));
};

const outline = () => added(model({ shape: square() }), asset =>
  set(asset.json.meshes[0].primitives[0], 'CESIUM_primitive_outline', { indices: asset.indices([0, 1, 1, 2, 2, 3, 3, 0]) }));

const imageBased = () => added(model(), asset => {
  const faces = Array.from({ length: 6 }, (_, i) => asset.image(colors(), `face${i}.png`));
  asset.json.extensions = { EXT_lights_image_based: { lights: [{ intensity: 1, specularImageSize: 16, specularImages: [faces],
    irradianceCoefficients: Array.from({ length: 9 }, (_, i) => [i === 0 ? 1 : 0, 0.2, 0.1]) }] } };
  set(asset.json.scenes[0], 'EXT_lights_image_based', { light: 0 });
});

const transform = { offset: [0.25, 0.5], rotation: 0.5, scale: [2, 3] };
const glossy = { diffuseFactor: [0.1, 0.3, 0.9, 1], specularFactor: [0.6, 0.1, 0.1], glossinessFactor: 0.8 };
const packed = (name, slots) => added(model(), asset => {
  const index = texture(asset);
  set(asset.json.materials[0], name, Object.fromEntries(slots.map(slot => [slot, { index }])));
});

const mpegMedia = asset => {
  asset.json.extensions = { MPEG_media: { media: [{ name: 'film', autoplay: true, alternatives: [{ uri: 'film.mp4', mimeType: 'video/mp4', tracks: [{ track: '#track_ID=1', codecs: 'avc1.42E01E' }] }] }] } };
};

function withFile(name, text, { asset, twin }) {
  asset.files.set(name, Buffer.from(text));
  return { asset, twin };
}

function tetrahedron() {
  const [a, b, c, d] = [[1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1]];
  const all = [a, b, c, d].flat();
  return { POSITION: all, NORMAL: all.map(v => v / Math.sqrt(3)), TEXCOORD_0: [0, 0, 1, 0, 0, 1, 1, 1], indices: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
}

// Two triangle strips of a mesh, which the extension joins.
function restart() {
  const asset = model({ shape: square() });
  const { indices, ...rest } = asset.json.meshes[0].primitives[0];
  const strip = [0, 1, 3, 2];
  asset.json.accessors.splice(indices, 1);
  asset.json.meshes[0].primitives = [0, 1].map(() => ({ ...rest, mode: 5, indices: asset.indices(strip) }));
  return added(asset, it => set(it.json.meshes[0], 'EXT_mesh_primitive_restart', { primitiveGroups: [{ primitives: [0, 1], indices: it.indices([...strip, 65535, ...strip]) }] }));
}

const vertexShader = 'attribute vec3 position; uniform mat4 matrix; void main() { gl_Position = matrix * vec4(position, 1); }';
const fragmentShader = 'precision mediump float; void main() { gl_FragColor = vec4(0.1, 0.2, 0.9, 1); }';
const inlined = text => ({ uri: `data:text/plain;base64,${Buffer.from(text).toString('base64')}` });

// A material drawn by a program. store(asset, text) gives the members of a shader that say where its text is.
export function technique(store = (asset, text) => ({ bufferView: asset.view(Buffer.from(text)) })) {
  const asset = model();
  const shader = (type, text) => ({ type, ...store(asset, text) });
  const shaders = [shader(35632, fragmentShader), shader(35633, vertexShader)];
  const techniques = [{ program: 0, attributes: { position: { semantic: 'POSITION' } }, uniforms: { matrix: { semantic: 'MODELVIEWPROJECTION', type: 35676 } } }];
  return onRoot('KHR_techniques_webgl', { programs: [{ fragmentShader: 0, vertexShader: 1 }], shaders, techniques }, json => json.materials[0], { technique: 0 }, asset);
}
export const inlinedTechnique = () => technique((asset, text) => inlined(text));

// A table of two rows for the two halves of a model, with one property. bytes: the column, and the starts of its
// elements.
export function metadata(property = { type: 'SCALAR', componentType: 'FLOAT32' }, bytes = { values: Float32Array.of(1.5, 2.5) }, more = {}) {
  const asset = model();
  const column = Object.fromEntries(Object.entries(bytes).map(([name, list]) => [name, asset.view(Buffer.from(list.buffer, list.byteOffset, list.byteLength))]));
  return onRoot('EXT_structural_metadata', {
    schema: { id: 'probe', classes: { part: { properties: { value: property } } }, ...more },
    propertyTables: [{ class: 'part', count: 2, properties: { value: column } }],
  }, undefined, undefined, asset);
}
const featureIds = { featureIds: [{ featureCount: 117, nullFeatureId: 0 }] };
const instanceFeatures = () => {
  const { asset } = instances();
  asset.uses('EXT_mesh_gpu_instancing');
  return added(asset, it => set(it.json.nodes[0], 'EXT_instance_features', { featureIds: [{ featureCount: 3 }] }));
};

// Name of an extension: { used, required, requiredWithFallback }, functions that give { asset, twin }. A single
// function is for both used and required.
export const extensions = {
  ...Object.fromEntries(Object.entries(onMaterial).map(([name, value]) => [name, () => material(name, value, emissive[name])])),
  ADOBE_materials_clearcoat_specular: () => material('ADOBE_materials_clearcoat_specular', { clearcoatIor: 2, clearcoatSpecularFactor: 0.3 }, {}, { KHR_materials_clearcoat: { clearcoatFactor: 1 } }),
  ADOBE_materials_clearcoat_tint: () => material('ADOBE_materials_clearcoat_tint', { clearcoatTintFactor: [0.9, 0.2, 0.2] }, {}, { KHR_materials_clearcoat: { clearcoatFactor: 1 } }),
  AGI_articulations: () => onRoot('AGI_articulations', { articulations: [{ name: 'Arm', stages: [{ name: 'Turn', type: 'xRotate', minimumValue: -90, maximumValue: 90, initialValue: 10 }] }] }, node, { articulationName: 'Arm' }),
  AGI_stk_metadata: () => onRoot('AGI_stk_metadata', { solarPanelGroups: [{ name: 'Panels', efficiency: 20 }] }, node, { solarPanelGroupName: 'Panels' }),
  CESIUM_primitive_outline: outline,
  EXT_instance_features: instanceFeatures,
  EXT_lights_image_based: imageBased,
  EXT_mesh_features: () => added(model(), asset => set(asset.json.meshes[0].primitives[0], 'EXT_mesh_features', featureIds)),
  EXT_mesh_gpu_instancing: instances,
  EXT_lights_ies: () => withFile('lamp.ies', 'IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 0\n', onRoot('EXT_lights_ies', { lights: [{ uri: 'lamp.ies', name: 'Lamp' }] }, node, { light: 0, multiplier: 5 })),
  EXT_mesh_manifold: () => added(model({ shape: tetrahedron() }), asset => set(asset.json.meshes[0], 'EXT_mesh_manifold', { manifoldPrimitive: { attributes: { POSITION: asset.json.meshes[0].primitives[0].attributes.POSITION }, indices: asset.json.meshes[0].primitives[0].indices } })),
  EXT_mesh_primitive_edge_visibility: () => added(model({ shape: square() }), asset => set(asset.json.meshes[0].primitives[0], 'EXT_mesh_primitive_edge_visibility', { visibility: asset.accessor([0b1010, 0b1010], { type: 'SCALAR', componentType: 5121 }) })),
  EXT_mesh_primitive_restart: restart,
  EXT_structural_metadata: () => metadata(),
  EXT_texture_avif: byImage('EXT_texture_avif', 'rgb.avif', 'image/avif'),
  EXT_texture_webp: byImage('EXT_texture_webp', 'rgb.webp', 'image/webp'),
  FB_geometry_metadata: () => added(model(), asset => set(asset.json.scenes[0], 'FB_geometry_metadata', { vertexCount: 117, primitiveCount: 168, sceneBounds: { min: [-1, -1, -1], max: [1, 1, 1] } })),
  GODOT_single_root: () => added(model(), () => {}),
  GRIFFEL_bim_data: () => onRoot('GRIFFEL_bim_data', { propertyNames: ['Storey'], propertyValues: ['Ground'], properties: [{ name: 0, value: 0 }] }, node, { properties: [0] }),
  KHR_XMP: () => added(model(), asset => { asset.json.asset.extensions = { KHR_XMP: { '@context': { dc: 'http://purl.org/dc/elements/1.1/' }, 'dc:title': 'Ball' } }; }),
  KHR_animation_pointer: pointer,
  KHR_draco_mesh_compression: compressed.draco,
  EXT_meshopt_compression: compressed.meshopt('EXT_meshopt_compression'),
  KHR_meshopt_compression: compressed.meshopt('KHR_meshopt_compression'),
  KHR_gaussian_splatting: splats,
  KHR_interactivity: () => onRoot('KHR_interactivity', { graphs: [{ declarations: [{ op: 'event/onStart' }], nodes: [{ declaration: 0 }] }], graph: 0 }),
  KHR_lights_punctual: () => light('point', { range: 20 }),
  KHR_materials_dispersion: () => inVolume('KHR_materials_dispersion', { dispersion: 5 }),
  KHR_materials_pbrSpecularGlossiness: {
    used: () => material('KHR_materials_pbrSpecularGlossiness', glossy),
    required: () => without(material('KHR_materials_pbrSpecularGlossiness', glossy), json => delete json.materials[0].pbrMetallicRoughness),
    requiredWithFallback: () => material('KHR_materials_pbrSpecularGlossiness', glossy),
  },
  KHR_materials_scatter: () => inVolume('KHR_materials_scatter', { scatterStrengthFactor: 0.8, multiscatterColorFactor: [0.8, 0.3, 0.2] }),
  KHR_materials_variants: variants,
  KHR_materials_volume: () => material('KHR_materials_volume', thick, {}, glass, true),
  KHR_materials_volume_scatter: () => inVolume('KHR_materials_volume_scatter', { multiscatterColorFactor: [0.8, 0.3, 0.2], scatterAnisotropy: 0.2 }),
  KHR_mesh_quantization: { required: quantized },
  KHR_node_hoverability: () => added(model(), asset => set(node(asset.json), 'KHR_node_hoverability', { hoverable: false })),
  KHR_node_selectability: () => added(model(), asset => set(node(asset.json), 'KHR_node_selectability', { selectable: false })),
  KHR_node_visibility: () => added(twoNodes(), asset => set(node(asset.json), 'KHR_node_visibility', { visible: false })),
  KHR_techniques_webgl: () => technique(),
  KHR_texture_basisu: byImage('KHR_texture_basisu', 'etc1s.ktx2', 'image/ktx2'),
  KHR_texture_transform: () => added(textured(), asset => set(asset.json.materials[0].pbrMetallicRoughness.baseColorTexture, 'KHR_texture_transform', transform)),
  KHR_xmp: () => onRoot('KHR_xmp', { '@context': { dc: 'http://purl.org/dc/elements/1.1/' }, packets: [{ 'dc:title': 'Ball' }] }, json => json.asset, { packet: 0 }),
  KHR_xmp_json_ld: () => onRoot('KHR_xmp_json_ld', { packets: [{ '@context': { dc: 'http://purl.org/dc/elements/1.1/' }, '@id': '', 'dc:title': 'Ball' }] }, json => json.asset, { packet: 0 }),
  MPEG_media: () => added(model(), mpegMedia),
  MSFT_lod: lod,
  MSFT_packing_normalRoughnessMetallic: () => packed('MSFT_packing_normalRoughnessMetallic', ['normalRoughnessMetallicTexture']),
  MSFT_packing_occlusionRoughnessMetallic: () => packed('MSFT_packing_occlusionRoughnessMetallic', ['occlusionRoughnessMetallicTexture', 'normalTexture']),
  NV_materials_mdl: () => onRoot('NV_materials_mdl', { modules: [{ uri: 'surface.mdl' }], functionCalls: [{ module: 0, functionName: 'surface', type: { typeName: 'material' } }] }, json => json.materials[0], { functionCall: 0 }),
};

function byImage(name, file, mimeType) {
  return {
    used: () => imageBy(name, file, mimeType, true),
    required: () => imageBy(name, file, mimeType, false),
    requiredWithFallback: () => imageBy(name, file, mimeType, true),
  };
}

function without({ asset, twin }, change) {
  change(asset.json);
  change(twin.json);
  return { asset, twin };
}

function twoNodes() {
  const asset = model();
  place(asset, [primitive(asset, square(0.5, 2))]);
  return asset;
}

export const lights = { directional: () => light('directional'), point: () => light('point'), spot: () => light('spot', { spot: { innerConeAngle: 0.1, outerConeAngle: 0.4 } }) };
