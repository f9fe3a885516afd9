// SPDX-License-Identifier: Apache-2.0
// Engines that draw, in a headless Chromium that draws with the processor. A page shows an asset and gives its picture.
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname } from 'node:path';

export const limit = 60000;
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm', '.png': 'image/png', '.jpg': 'image/jpeg', '.css': 'text/css', '.gltf': 'model/gltf+json', '.glb': 'model/gltf-binary' };

// page: the text of the page, whose window.show(address) gives the pixels of a picture (RGBA, in base64) or throws.
// folder: served below /package/. broken(error): whether the page is of no use after an error.
export async function browser({ page, folder, tools, broken = () => false }) {
  let files = new Map();
  let outside = null;  // an address outside of this server
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://example.com').pathname);
    const asset = path.match(/^\/asset\/\d+\/(.*)$/);
    const bytes = path === '/' ? Buffer.from(page) : asset ? files.get(asset[1]) : path.startsWith('/package/') && !path.includes('..') && existsSync(folder + path.slice(8)) ? readFileSync(folder + path.slice(8)) : undefined;
    if (!bytes && path.startsWith('/package/')) outside = path;
    response.writeHead(bytes ? 200 : 404, { 'content-type': path === '/' ? 'text/html' : types[extname(path)] ?? 'application/octet-stream', 'cache-control': asset ? 'no-store' : 'max-age=9999' });
    response.end(bytes);
  });
  await new Promise(done => server.listen(0, '127.0.0.1', done));
  const { address, port } = server.address();
  const origin = `http://${address}:${port}`;
  const { chromium } = createRequire(`${tools}/`)('playwright-core');
  const program = await chromium.launch({ executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--hide-scrollbars'] });
  const tab = await program.newPage({ viewport: { width: 200, height: 200 } });
  await tab.route(url => url.origin !== origin, route => {
    outside = route.request().url();
    return route.abort();
  });
  const start = async () => {
    await tab.goto(`${origin}/`, { waitUntil: 'domcontentloaded' });
    await tab.waitForFunction('window.ready', undefined, { timeout: 100000 });
  };
  await start();
  let count = 0;
  return { load: async (asset, main) => {
    files = asset;
    outside = null;
    const answer = await tab.evaluate(async address => {
      try { return { picture: await window.show(address) }; } catch (error) { return { error: String(error?.message ?? error) }; }
    }, `${origin}/asset/${++count}/${main}`).catch(error => { throw new Error(`harness: ${error.message}`); });
    if (outside) {  // the failure may be cached
      const address = outside;
      await start();
      throw new Error(`harness: ${address} is outside`);
    }
    if (answer.error && broken(answer.error)) await start();
    if (answer.error) throw new Error(answer.error);
    return { picture: Buffer.from(answer.picture, 'base64') };
  } };
}

// The pixels of a picture in a page, small: text of a function for pages.
export const pixels = `
window.pixels = async source => {
  const image = new Image();
  image.src = source;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0, 64, 64);
  return btoa(String.fromCharCode(...context.getImageData(0, 0, 64, 64).data));
};
window.within = (promise, time) => Promise.race([promise, new Promise((_, failed) => setTimeout(() => failed(new Error('harness: no answer of the page')), time))]);
`;
