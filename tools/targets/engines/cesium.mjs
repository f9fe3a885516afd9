// SPDX-License-Identifier: Apache-2.0
// CesiumJS: a model alone in a scene, lit by a fixed light.
import { createRequire } from 'node:module';
import { mkdirSync, rmSync, symlinkSync } from 'node:fs';
import { basename } from 'node:path';
import { browser, pixels } from './chromium.mjs';

export { limit } from './chromium.mjs';

const page = `<!doctype html><meta charset="utf-8"><body style="margin:0"><div id="scene" style="width:96px;height:96px"></div>
<script>window.CESIUM_BASE_URL = '/package/bundle/';</script>
<script type="module">
${pixels}
import * as Cesium from '/package/bundle/cesium.js';
const widget = new Cesium.CesiumWidget('scene', { globe: false, skyBox: false, skyAtmosphere: false, baseLayer: false, imageryProvider: false, creditContainer: document.createElement('div'),
  useDefaultRenderLoop: false, contextOptions: { webgl: { preserveDrawingBuffer: true } }, msaaSamples: 1 });
const { scene } = widget;
scene.backgroundColor = Cesium.Color.GRAY;
scene.sun = scene.moon = undefined;
scene.light = new Cesium.DirectionalLight({ direction: new Cesium.Cartesian3(-0.6, -0.7, 0.4) });
scene.rethrowRenderErrors = true;
const place = Cesium.Transforms.eastNorthUpToFixedFrame(Cesium.Cartesian3.fromDegrees(0, 0, 0));
let model;
window.show = async address => {
  if (model) scene.primitives.remove(model);
  model = undefined;
  const options = { url: address, modelMatrix: place, incrementallyLoadTextures: false, asynchronous: false };
  model = scene.primitives.add(await within(Cesium.Model.fromGltfAsync(options), 30000));
  await within(new Promise((done, failed) => {
    let finished = false;
    model.errorEvent?.addEventListener(failed);
    model.readyEvent.addEventListener(() => { finished = true; });
    const step = () => {
      try { widget.resize(); scene.render(Cesium.JulianDate.fromIso8601('2025-06-21T12:00:00Z')); } catch (error) { failed(error); return; }
      if (finished) done(); else setTimeout(step, 5);
    };
    step();
  }), 30000);
  const center = Cesium.Cartesian3.fromDegrees(0, 0, 0);
  // The front of a model of glTF points to the east.
  scene.camera.lookAt(center, new Cesium.HeadingPitchRange(0.4 - Math.PI / 2, -0.35, 5));
  for (let i = 0; i < 3; ++i) scene.render(Cesium.JulianDate.fromIso8601('2025-06-21T12:00:00Z'));
  return pixels(widget.canvas.toDataURL('image/png'));
};
window.ready = true;
</script>`;

export async function open(packages, tools) {
  const { buildSync } = createRequire(`${tools}/`)('esbuild');
  const engine = `${packages}/node_modules/@cesium/engine`;
  rmSync(`${packages}/bundle`, { recursive: true, force: true });
  mkdirSync(`${packages}/bundle`);
  for (const part of ['Source/Assets', 'Source/ThirdParty', 'Build/Workers']) symlinkSync(`${engine}/${part}`, `${packages}/bundle/${basename(part)}`);
  buildSync({ entryPoints: [`${engine}/index.js`], bundle: true, format: 'esm', outfile: `${packages}/bundle/cesium.js`, external: ['fs', 'path', 'url', 'zlib', 'http', 'https'], logLevel: 'silent' });
  return browser({ page, tools, folder: packages });
}
