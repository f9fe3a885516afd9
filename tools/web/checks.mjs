// SPDX-License-Identifier: Apache-2.0
// The page's interface to the worker that checks files.

function policy() {
  const rules = { createScriptURL: (address) => address };
  return globalThis.trustedTypes ? globalThis.trustedTypes.createPolicy("gltfx", rules) : rules;
}

const workerAddress = policy().createScriptURL(
  URL.createObjectURL(new Blob([document.getElementById("worker").textContent], { type: "text/javascript" })),
);

async function unpackEngine() {
  const packed = atob(document.getElementById("engine").textContent);
  const bytes = new Uint8Array(packed.length);
  for (let at = 0; at < packed.length; ++at) bytes[at] = packed.charCodeAt(at);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

let unpacked = null;

/** One run over what was dropped. `tell` gets the messages of the worker, and {broken} if it ends unexpectedly. */
export class Checks {
  #worker = new Worker(workerAddress);
  #tell;

  constructor(dropped, tell) {
    this.#tell = tell;
    this.#worker.onmessage = ({ data }) => this.#tell(data);
    this.#worker.onerror = (event) => this.#tell({ broken: event.message || "the engine ended" });
    this.#start(dropped);
  }

  async #start(dropped) {
    try {
      unpacked ??= unpackEngine();
      this.#worker.postMessage({ open: dropped, wasm: await unpacked });
    } catch (error) {
      this.#tell({ broken: error.message });
    }
  }

  make(kind, title) {
    this.#worker.postMessage({ make: kind, title });
  }

  stop() {
    this.#tell = () => {};
    this.#worker.terminate();
  }
}
