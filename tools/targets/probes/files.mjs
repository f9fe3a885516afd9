// SPDX-License-Identifier: Apache-2.0
// Probes of containers, URIs, images and versions.
import { readFileSync } from 'node:fs';
import { colors, model, sharp, square, textured } from './models.mjs';
import { png, quadrants } from './png.mjs';
import { imageBy } from './extensions.mjs';

const picture = name => readFileSync(new URL(`images/${name}`, import.meta.url));
const like = (asset, twin, ...same) => ({ asset, twin, same });
const laid = (layout, of = model()) => Object.assign(of, { layout });

// The asset whose only difference from its twin is how its parts are stored.
const stored = (make, change, ...same) => {
  const [asset, twin] = [make(), make()];
  change(asset);
  return like(asset, twin, ...(same.length ? same : ['corners']));
};

const inBufferView = asset => {
  const [name] = asset.files.keys();
  asset.json.images[0] = { bufferView: asset.view(asset.files.get(name)), mimeType: 'image/png' };
  asset.files.delete(name);
};

const imageUri = uri => stored(textured, asset => {
  const bytes = asset.files.get('colors.png');
  asset.files.delete('colors.png');
  asset.files.set(decodeURIComponent(uri), bytes);
  asset.json.images[0].uri = uri;
}, 'images');

const dataImage = () => stored(textured, asset => {
  asset.json.images[0].uri = `data:image/png;base64,${asset.files.get('colors.png').toString('base64')}`;
  asset.files.delete('colors.png');
}, 'images');

// An asset with a picture of another encoding; its twin has the plain one.
const encoded = (image, uri = 'colors.png') => like(textured({ image, uri }), textured(), 'pixels');
const size = [16, 16];
const faded = [255, 90, 200, 0];
const translucent = options => {
  const blend = { material: { alphaMode: 'BLEND' } };
  const [image, plain] = [png({ size, at: quadrants(size, faded), ...options }), png({ size, at: quadrants(size, faded), kind: 'rgba' })];
  return like(textured({ image }, blend), textured({ image: plain }, blend), 'pixels');
};
const gray = options => like(textured({ image: png({ size, at: grays, ...options }) }), textured({ image: png({ size, at: grays }) }), 'pixels');
const grays = (x, y) => {
  const value = quadrants(size)(x, y)[0];
  return [value, value, value, 255];
};

const external = () => {
  const asset = model();
  const bytes = Buffer.concat(asset.bytes);
  asset.json.buffers = [];
  asset.layout = 'glb';
  asset.bytes = [];
  asset.length = 0;
  asset.files.set('data.bin', bytes);
  asset.json.buffers.push({ byteLength: bytes.length, uri: 'data.bin' });
  return like(asset, model(), 'corners');
};

const bare = () => {
  const asset = model({ shape: square(), indices: undefined });
  asset.json = { asset: asset.json.asset, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ name: 'Lone', translation: [1, 2, 3] }] };
  asset.bytes = [];
  asset.length = 0;
  return asset;
};

const versions = (asset, members) => {
  Object.assign(asset.json.asset, members);
  return asset;
};

const orientation = () => {
  const plain = picture('rgb.jpg');
  // A segment APP1 with the tag Orientation (274) of value 6 after the start of the image.
  const tiff = Buffer.from([0x4d, 0x4d, 0, 42, 0, 0, 0, 8, 0, 1, 1, 18, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0, 0, 0, 0, 0]);
  const body = Buffer.concat([Buffer.from('Exif\0\0', 'latin1'), tiff]);
  const head = Buffer.from([0xff, 0xe1, 0, body.length + 2]);
  const turned = Buffer.concat([plain.subarray(0, 2), head, body, plain.subarray(2)]);
  return { asset: textured({ image: turned, uri: 'colors.jpg' }), twin: textured({ image: plain, uri: 'colors.jpg' }), differs: ['pixels'] };
};

export const address = 'http://example.com/';

export const files = {
  'container.glb': () => like(laid('glb'), model(), 'corners'),
  'container.glb-no-bin': () => like(laid('glb', bare()), bare(), 'nodes'),
  'container.glb-extra-chunk': () => ({ asset: Object.assign(laid('glb'), { chunks: [['PRBE', Buffer.from('abcd')]] }), twin: laid('glb') }),
  'container.glb-external-buffer': external,
  'uri.data-buffer': () => like(laid('embedded'), model(), 'corners'),
  'uri.data-gltf-buffer': () => like(Object.assign(laid('embedded'), { bufferType: 'application/gltf-buffer' }), model(), 'corners'),
  'uri.data-image': dataImage,
  'uri.percent-encoded': () => stored(model, asset => { asset.bufferUri = 'data%20of%20it.bin'; }),
  'uri.percent-encoded-image': () => imageUri('colors%20of%20it.png'),
  'uri.space': () => stored(model, asset => { asset.bufferUri = 'data of it.bin'; }),
  'uri.non-ascii': () => imageUri('färben.png'),
  // The address that the harness serves each asset at.
  'uri.absolute': () => stored(model, asset => { asset.bufferUri = `${address}data.bin`; }),
  'uri.dot-segment': () => stored(model, asset => { asset.bufferUri = './data.bin'; }),
  'uri.subfolder': () => stored(model, asset => { asset.bufferUri = 'folder/data.bin'; }),
  'image.png-16-bit': () => encoded(png({ size, at: quadrants(size), bits: 16 })),
  'image.png-palette': () => encoded(png({ size, at: quadrants(size), palette: true })),
  'image.png-palette-transparent': () => translucent({ palette: true, transparent: true }),
  'image.png-grayscale': () => gray({ kind: 'gray' }),
  'image.png-grayscale-alpha': () => gray({ kind: 'grayAlpha' }),
  'image.png-interlaced': () => encoded(png({ size, at: quadrants(size), interlaced: true })),
  'image.png-gamma': () => ({ asset: textured({ image: png({ size, at: quadrants(size), gamma: 100000 }) }), twin: textured(), differs: ['pixels'] }),
  'image.jpeg-progressive': () => like(textured({ image: picture('progressive.jpg'), uri: 'colors.jpg' }), textured({ image: picture('rgb.jpg'), uri: 'colors.jpg' }), 'pixels'),
  'image.jpeg-grayscale': () => like(textured({ image: picture('gray.jpg'), uri: 'colors.jpg' }), textured({ image: png({ size, at: (x) => (x < 8 ? [60, 60, 60, 255] : [200, 200, 200, 255]) }) }), 'pixels'),
  'image.jpeg-cmyk': () => like(textured({ image: picture('cmyk.jpg'), uri: 'colors.jpg' }), textured({ image: picture('rgb.jpg'), uri: 'colors.jpg' }), 'pixels'),
  'image.jpeg-orientation': orientation,
  'image.ktx2-etc1s': () => besideFallback('etc1s.ktx2'),
  'image.ktx2-uastc': () => besideFallback('uastc.ktx2'),
  'image.webp-no-mime-type': () => untyped('EXT_texture_webp', 'rgb.webp', 'image/webp'),
  'image.avif-no-mime-type': () => untyped('EXT_texture_avif', 'rgb.avif', 'image/avif'),
  'image.ktx2-no-mime-type': () => untyped('KHR_texture_basisu', 'etc1s.ktx2', 'image/ktx2'),
  'image.buffer-view': () => stored(textured, inBufferView, 'images'),
  'image.non-power-of-two': () => like(textured({ image: colors([48, 40]), sampler: sharp }), textured({ sampler: sharp }), 'pixels'),
  'asset.version-2.1': () => ({ asset: versions(model(), { version: '2.1' }), twin: model(), same: ['corners'] }),
  'asset.min-version-2.0': () => ({ asset: versions(model(), { minVersion: '2.0' }), twin: model(), same: ['corners'] }),
  'asset.min-version-2.1': () => ({ asset: versions(model(), { version: '2.1', minVersion: '2.1' }), twin: model(), same: ['corners'] }),
};

// Not required, so that only the image decides; the fallback has other colors.
function besideFallback(file) {
  const { asset, twin } = imageBy('KHR_texture_basisu', file, 'image/ktx2', true);
  return { asset: asset.uses('KHR_texture_basisu'), twin, differs: ['pixels'] };
}

// An image in a file, whose format only its name and bytes give.
function untyped(name, file, mimeType) {
  const [it, other] = [0, 1].map(() => imageBy(name, file, mimeType, false));
  const [asset, twin] = [it, other].map(made => made.asset.uses(name, true));
  delete asset.json.images[0].mimeType;
  return { ...like(asset, twin, 'images'), of: name, like: it.like };
}
