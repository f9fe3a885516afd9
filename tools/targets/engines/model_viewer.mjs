// SPDX-License-Identifier: Apache-2.0
// The element model-viewer with a camera at a fixed place.
import { browser, pixels } from './chromium.mjs';

export { limit } from './chromium.mjs';

const page = `<!doctype html><meta charset="utf-8"><body style="margin:0">
<script type="module">
${pixels}
import '/package/model-viewer.min.js';
await customElements.whenDefined('model-viewer');
const View = customElements.get('model-viewer');
View.minimumRenderScale = 1;
let element;
function fresh() {
  element?.remove();
  element = document.createElement('model-viewer');
  Object.assign(element.style, { width: '96px', height: '96px' });
  for (const [name, value] of Object.entries({ loading: 'eager', reveal: 'auto', 'camera-orbit': '25deg 70deg 5m', 'camera-target': '0m 0m 0m', 'field-of-view': '40deg', 'min-camera-orbit': 'auto auto 1m',
    'max-camera-orbit': 'auto auto 50m', 'interpolation-decay': '1', 'interaction-prompt': 'none', 'shadow-intensity': '0' })) element.setAttribute(name, value);
  document.body.append(element);
}
fresh();
window.show = async address => {
  const events = new AbortController();
  try {
    const loaded = new Promise((done, failed) => {
      element.addEventListener('load', done, { signal: events.signal });
      element.addEventListener('error', event => failed(event.detail?.sourceError ?? new Error('an error event')), { signal: events.signal });
    });
    element.src = address;
    await within(loaded, 30000);
  } catch (error) {
    fresh();
    throw error;
  } finally {
    events.abort();
  }
  element.jumpCameraToGoal();
  for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame);
  return pixels(element.toDataURL('image/png'));
};
window.ready = true;
</script>`;

export const open = (packages, tools) => browser({ page, tools, folder: `${packages}/node_modules/@google/model-viewer/dist` });
