// SPDX-License-Identifier: Apache-2.0
// Filament: an asset alone in a scene, lit by two point lights and a cube of colors. An asset may have a sun of its own.
import { browser, pixels } from './chromium.mjs';

export { limit } from './chromium.mjs';

const page = `<!doctype html><meta charset="utf-8"><body style="margin:0"><canvas id="picture" width="96" height="96"></canvas>
<script src="/package/filament.js"></script>
<script>
${pixels}
// A cube map whose six faces have colors of their own, striped where surfaces are smooth.
function surroundings(engine) {
  const size = 16;
  const texture = Filament.Texture.Builder().width(size).height(size).levels(5)
    .sampler(Filament.Texture$Sampler.SAMPLER_CUBEMAP).format(Filament.Texture$InternalFormat.RGBA8).build(engine);
  const faces = [[200, 120, 80], [80, 120, 200], [240, 240, 255], [40, 40, 30], [120, 160, 120], [160, 120, 160]];
  for (let level = 0; level < 5; ++level) {
    const side = size >> level;
    const bytes = new Uint8Array(6 * side * side * 4);
    for (let i = 0; i < bytes.length / 4; ++i) {
      const stripe = level < 2 && (i % side) * 4 % side < side / 8 ? 0.3 : 1;
      bytes.set([...faces[Math.floor(i / side / side)].map(v => v * stripe), 255], i * 4);
    }
    texture.setImageCube(engine, level, Filament.PixelBuffer(bytes, Filament.PixelDataFormat.RGBA, Filament.PixelDataType.UBYTE));
  }
  return Filament.IndirectLight.Builder().reflections(texture).irradianceSh(1, [0.5, 0.5, 0.5]).intensity(1.5).build(engine);
}

function lamp(engine, scene, position, color) {
  const entity = Filament.EntityManager.get().create();
  Filament.LightManager.Builder(Filament.LightManager$Type.POINT).position(position).color(color).intensity(150).falloff(20).build(engine, entity);
  scene.addEntity(entity);
}

Filament.init([], () => {
  const canvas = document.getElementById('picture');
  const engine = Filament.Engine.create(canvas);
  const scene = engine.createScene();
  const [swapChain, renderer, view] = [engine.createSwapChain(), engine.createRenderer(), engine.createView()];
  const camera = engine.createCamera(Filament.EntityManager.get().create());
  camera.setProjectionFov(40, 1, 0.1, 50, Filament.Camera$Fov.VERTICAL);
  camera.setExposureDirect(1);
  camera.lookAt([2, 1.7, 4.3], [0, 0, 0], [0, 1, 0]);
  view.setCamera(camera);
  view.setScene(scene);
  view.setPostProcessingEnabled(false);  // its dithering differs from frame to frame
  view.setViewport([0, 0, canvas.width, canvas.height]);
  renderer.setClearOptions({ clearColor: [0.5, 0.5, 0.5, 1], clear: true });
  scene.setIndirectLight(surroundings(engine));
  lamp(engine, scene, [-2, 3, 3], [1, 1, 0.9]);
  lamp(engine, scene, [3, -1, 2], [0.7, 0.8, 1]);
  const loader = engine.createAssetLoader();
  let asset;

  async function shown(address) {
    const answer = await fetch(address);
    asset = loader.createAsset(new Uint8Array(await answer.arrayBuffer()));
    if (!asset) throw new Error('createAsset gives nothing');
    // The loader does not wait for images that it fetches itself.
    for (const uri of asset.getResourceUris()) {
      const place = String(new URL(uri, address));
      const file = await fetch(place).catch(() => null);
      if (file?.ok) Filament.assets[place] = new Uint8Array(await file.arrayBuffer());
    }
    await within(new Promise((done, failed) => {
      window.onunhandledrejection = event => failed(new Error(String(event.reason?.message ?? event.reason)));
      window.onerror = message => failed(new Error(String(message)));
      asset.loadResources(done, null, address, 1);
    }), 30000);
    scene.addEntities(asset.getEntities());
    const animator = asset.getInstance().getAnimator();
    animator.updateBoneMatrices();
    // A renderer skips frames where the last ones took long.
    for (let drawn = 0; drawn < 3;) {
      await new Promise(requestAnimationFrame);
      const begun = renderer.beginFrame(swapChain);
      if (begun) {
        renderer.renderView(view);
        renderer.endFrame();
        drawn += 1;
      }
      engine.execute();
    }
    return canvas.toDataURL('image/png');
  }
  window.show = async address => {
    try {
      return await pixels(await shown(address));
    } finally {
      if (asset) {
        scene.removeEntities(asset.getEntities());
        loader.destroyAsset(asset);
      }
      asset = undefined;
      for (const place of Object.keys(Filament.assets)) delete Filament.assets[place];
    }
  };
  window.ready = true;
});
</script>`;

// A module in WebAssembly that aborts has no defined state.
export const open = (packages, tools) => browser({ page, tools, folder: `${packages}/node_modules/filament`, broken: error => /^Aborted|RuntimeError|null function|out of bounds|unreachable/.test(error) });
