// SPDX-License-Identifier: Apache-2.0
// Loads assets in an engine without ending when the engine fails.

export const told = process.env.GLTFX_TARGETS_LOG ? (...text) => process.stderr.write(`${text.join(' ')}\n`) : () => {};

// attempt(files, main): { dump, facts } of an asset, or { error }. The engine prints nothing.
export async function openEngine(engine, packages, tools) {
  process.on('unhandledRejection', () => {});
  process.on('uncaughtException', () => {});
  for (const name of ['log', 'warn', 'error', 'info', 'debug']) console[name] = () => {};
  const adapter = await import(`./engines/${engine}.mjs`);
  const host = await adapter.open(packages, tools).catch(error => {
    process.stderr.write(`${engine} is not measured: ${error.stack}\n`);
    process.exit(1);
  });
  return async (files, main) => {
    let timer;
    const late = new Promise((_, failed) => { timer = setTimeout(() => failed(new Error('harness: no answer')), adapter.limit ?? 10000); });
    try {
      return await Promise.race([host.load(files, main), late]);
    } catch (error) {
      return { error: error ?? new Error('refused without a reason') };
    } finally {
      clearTimeout(timer);
    }
  };
}

// A failure of the harness is not one of the engine: parts of a browser that are missing, constants of WebGL, compilers
// of shaders, servers.
export const ofHarness = error => error instanceof ReferenceError
  || /harness:|is not defined|Illegal invocation|structuredClone|OffscreenCanvas|WebGL|shader failed to compile|reading '[A-Z0-9_]{4,}'|https:\/\//.test(`${error?.message ?? error}`);
