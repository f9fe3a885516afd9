// SPDX-License-Identifier: Apache-2.0
// Parts of a browser that loaders use, without pictures: an image is its size and the digest of its bytes. A message
// that begins with "harness:" is from these parts and says nothing about the engine.
import { hash } from './dump.mjs';

export const address = 'http://example.com/';
let files = new Map();
export const decoded = [];  // digests of the images that were decoded since the last asset

export function serve(asset) {
  files = asset;
  decoded.length = 0;
}

const bytesAt = url => {
  const text = String(url);
  if (!text.startsWith(address)) return null;
  const path = text.slice(address.length).split(/[?#]/)[0];
  let name;
  try { name = decodeURIComponent(path); } catch { name = path; }
  return files.get(name.split('/').filter(part => part !== '.').join('/')) ?? undefined;
};

const plainFetch = globalThis.fetch;
export async function get(url) {
  const bytes = bytesAt(url?.url ?? url);
  if (bytes === null) {
    if (!/^(data|blob):/.test(String(url?.url ?? url))) throw new Error(`harness: ${url} is outside`);
    return plainFetch(url);
  }
  if (bytes === undefined) return new Response('', { status: 404, statusText: 'Not Found' });
  return new Response(bytes, { status: 200 });
}

// Size of an image by its header: formats that browsers decode.
export function header(bytes) {
  const b = Buffer.from(bytes.buffer ?? bytes, bytes.byteOffset ?? 0, bytes.byteLength);
  if (b.length > 24 && b.readUInt32BE(0) === 0x89504e47) return [b.readUInt32BE(16), b.readUInt32BE(20)];
  if (b.length > 4 && b[0] === 0xff && b[1] === 0xd8)
    for (let at = 2; at + 9 < b.length; at += 2 + b.readUInt16BE(at + 2))
      if (b[at + 1] >= 0xc0 && b[at + 1] <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(b[at + 1])) return [b.readUInt16BE(at + 7), b.readUInt16BE(at + 5)];
  if (b.length > 30 && b.toString('latin1', 8, 12) === 'WEBP') return webp(b);
  const size = b.indexOf('ispe');  // a box of HEIF
  if (b.length > 12 && b.toString('latin1', 4, 12) === 'ftypavif' && size > 0) return [b.readUInt32BE(size + 8), b.readUInt32BE(size + 12)];
  return null;
}

function webp(b) {
  const kind = b.toString('latin1', 12, 16);
  if (kind === 'VP8X') return [1 + b.readUIntLE(24, 3), 1 + b.readUIntLE(27, 3)];
  if (kind === 'VP8L') return [1 + (b.readUInt32LE(21) & 0x3fff), 1 + ((b.readUInt32LE(21) >> 14) & 0x3fff)];
  return [b.readUInt16LE(26) & 0x3fff, b.readUInt16LE(28) & 0x3fff];
}

class Picture {
  constructor(bytes, size) {
    [this.width, this.height] = size;
    this.digest = hash(bytes);
  }
  close() {}
}
async function decode(bytes) {
  const size = header(bytes);
  if (!size) throw new Error('The source image could not be decoded.');
  const picture = new Picture(Buffer.from(bytes), size);
  decoded.push(picture.digest);
  return picture;
}

class Target {
  listeners = {};
  addEventListener(type, f) { (this.listeners[type] ??= []).push(f); }
  removeEventListener(type, f) { this.listeners[type] = (this.listeners[type] ?? []).filter(x => x !== f); }
  fire(type, event = {}) {
    const whole = { type, target: this, currentTarget: this, ...event };
    for (const f of this.listeners[type] ?? []) f.call(this, whole);
    this[`on${type}`]?.call(this, whole);
  }
}
const hidden = (object, key, value) => Object.defineProperty(object, key, { value, writable: true, enumerable: false });

class ImageElement extends Target {
  constructor() {
    super();
    for (const key of ['listeners', 'onload', 'onerror', 'source']) hidden(this, key, key === 'listeners' ? {} : null);
    this.width = this.height = 0;
  }
  set src(url) {
    hidden(this, 'source', url);
    get(url).then(async answer => {
      if (!answer.ok) throw new Error('404');
      const picture = await decode(new Uint8Array(await answer.arrayBuffer()));
      Object.assign(this, { width: picture.width, height: picture.height, naturalWidth: picture.width, naturalHeight: picture.height, digest: picture.digest, complete: true });
      this.fire('load');
    }).catch(error => this.fire('error', { message: String(error) }));
  }
  get src() { return this.source; }
  decode() { return new Promise((done, failed) => { this.addEventListener('load', done); this.addEventListener('error', failed); }); }
}

class Request extends Target {
  open(method, url) { this.url = url; }
  setRequestHeader() {}
  getResponseHeader() { return null; }
  getAllResponseHeaders() { return ''; }
  overrideMimeType() {}
  abort() {}
  send() {
    get(this.url).then(async answer => {
      const bytes = await answer.arrayBuffer();
      Object.assign(this, { status: answer.status, statusText: answer.statusText, readyState: 4, responseURL: String(this.url) });
      const text = () => new TextDecoder().decode(bytes);
      this.response = this.responseType === 'arraybuffer' ? bytes : this.responseType === 'blob' ? new Blob([bytes]) : this.responseType === 'json' ? JSON.parse(text()) : text();
      if (!this.responseType || this.responseType === 'text') this.responseText = this.response;
    }).then(() => { for (const type of ['readystatechange', 'load', 'loadend']) this.fire(type); }, error => {
      Object.assign(this, { status: 0, readyState: 4 });
      for (const type of ['readystatechange', 'error', 'loadend']) this.fire(type, { error });
    });
  }
}
Request.DONE = 4;

// A canvas whose context accepts every call and draws nothing.
const canvas = () => Object.assign(new Target(), {
  width: 1, height: 1, style: {},
  getContext: () => new Proxy({}, { get: (_, key) => (key === 'getImageData' ? (x, y, w, h) => ({ data: new Uint8ClampedArray(w * h * 4) }) : () => {}), set: () => true }),
  getBoundingClientRect: () => ({ left: 0, top: 0, width: 1, height: 1 }), toBlob: done => done(new Blob([])),
  toDataURL: type => `data:${['image/jpeg', 'image/webp'].includes(type) ? type : 'image/png'};base64,`,
});

export function install() {
  const element = name => (name === 'img' ? new ImageElement() : name === 'canvas' ? canvas() : Object.assign(new Target(), { style: {}, appendChild() {}, setAttribute() {} }));
  Object.assign(globalThis, {
    self: globalThis, window: globalThis, fetch: get, Image: ImageElement, HTMLImageElement: ImageElement, XMLHttpRequest: Request,
    HTMLCanvasElement: class {}, HTMLVideoElement: class {}, Element: class {}, HTMLElement: class {}, ImageBitmap: Picture, OffscreenCanvas: undefined,
    ProgressEvent: class { constructor(type, more) { Object.assign(this, { type, ...more }); } },
    createImageBitmap: async source => decode(new Uint8Array(await source.arrayBuffer())),
    document: { createElement: element, createElementNS: (_, name) => element(name), addEventListener() {}, removeEventListener() {}, head: element('head'), body: element('body'), baseURI: address, URL: address, location: { href: address } },
    location: { href: address, origin: address.slice(0, -1), protocol: 'http:', search: '' },
    requestAnimationFrame: f => setTimeout(f, 0), cancelAnimationFrame: clearTimeout,
    addEventListener() {}, removeEventListener() {}, screen: { width: 1, height: 1 }, devicePixelRatio: 1,
  });
  if (!globalThis.navigator?.userAgent) Object.defineProperty(globalThis, 'navigator', { value: { userAgent: 'Mozilla/5.0 Chrome/120.0', platform: 'Linux', hardwareConcurrency: 1, maxTouchPoints: 0 }, configurable: true, writable: true });
}
