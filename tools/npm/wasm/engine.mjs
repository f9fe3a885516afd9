// SPDX-License-Identifier: Apache-2.0
// gltfx in WebAssembly: validates bytes, and runs the command line on files in memory. No dependency on Node.js or a
// browser. createEngine() takes gltfx.wasm and the default export of gltfx-wasm.mjs.

const FORMATS = [undefined, "gltf", "glb"];
export const PROFILES = ["default", "khronos", "strict"];
const encoder = new TextEncoder();
const decoder = new TextDecoder();
const FOLDER = "/work";
const MOST_ARGUMENT_BYTES = 256 * 1024; // they are copied to the stack

/** Compiles the module once. `wasm`: bytes or a WebAssembly.Module. */
export async function createEngine(wasm, loader) {
  const compiled = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);
  const engine = new Engine(compiled, loader);
  await engine.start();
  return engine;
}

class Engine {
  #compiled;
  #loader;
  #module = null; // validates; null: not created yet, or it broke

  constructor(compiled, loader) {
    this.#compiled = compiled;
    this.#loader = loader;
  }

  /** Makes the engine ready. Another validation may break it before the caller continues: check isReady again. */
  async start() {
    this.#module ??= await this.#instance({});
    this.version ??= this.#module.UTF8ToString(this.#module._gltfx_version());
  }

  /** False before start(), and after a validation that broke the engine. */
  get isReady() {
    return this.#module !== null;
  }

  /** Whether there is a rule with that code. Precondition: isReady. */
  isCode(code) {
    return withText(this.#module, code, (at) => this.#module._gltfx_is_code(at)) !== 0;
  }

  /**
   * Validates an asset in memory. `report` is JSON text: the Khronos validator's report in the profile
   * "khronos", that of gltfx otherwise. `missing` lists the URIs, as reports print them, that are neither
   * in `options.resources` nor in the asset; with `options.paths`, decoded paths below the folder of the asset in
   * place of URIs. Precondition: isReady. Throws an Error that says why the engine broke.
   */
  validate(asset, options = {}) {
    const module = this.#module;
    const missing = new Set();
    module.readResource = (uri) => {
      const bytes = options.resources?.get(uri);
      if (bytes === undefined) missing.add(uri);
      return bytes ?? null;
    };
    try {
      return { report: validateOnce(module, asset, options), missing: [...missing] };
    } catch (error) {
      this.#module = null;
      throw brokenEngine(error);
    }
  }

  /**
   * Runs the command line in the folder `cwd`, in a file system that holds `files`, by absolute paths or paths
   * relative to `cwd`; one that ends in "/" is an empty folder. Returns the exit code, the output, and the files
   * that were written, relative to `cwd` if they are below it.
   */
  async run(args, files = new Map(), { cwd = FOLDER, stdin = new Uint8Array() } = {}) {
    let read = 0;
    const nextByte = () => (read < stdin.length ? stdin[read++] : null);
    const { module, ...done } = await this.#call(args, nextByte, ({ FS }) => writeFiles(FS, files, cwd));
    return { ...done, files: writtenFiles(module.FS, cwd) };
  }

  /**
   * Runs the command line in the folder `cwd` of the file system that `attach(module)` gives the module, which it
   * reads and writes. `nextByte()` gives standard input; null: its end.
   */
  async runOn(attach, args, { cwd, nextByte }) {
    const { code, stdout, stderr } = await this.#call(args, nextByte, (module) => {
      attach(module);
      module.FS.chdir(cwd);
    });
    return { code, stdout, stderr };
  }

  async #call(args, nextByte, prepare) {
    const bytes = args.reduce((sum, argument) => sum + argument.length * 3 + 8, 0);
    if (bytes > MOST_ARGUMENT_BYTES) throw new Error("gltfx: the arguments are too long");
    const printed = [new Printed(), new Printed()];
    const outputs = printed.map((to) => (byte) => to.add(byte));
    const module = await this.#instance({ preRun: [(starting) => starting.FS.init(nextByte, ...outputs)] });
    prepare(module);
    try {
      const code = module.callMain([...args]);
      return { module, code, stdout: printed[0].bytes(), stderr: decoder.decode(printed[1].bytes()) };
    } catch (error) {
      throw brokenEngine(error);
    }
  }

  #instance(settings) {
    return this.#loader({
      ...settings,
      print() {},
      printErr() {},
      instantiateWasm: (imports, done) => {
        WebAssembly.instantiate(this.#compiled, imports).then((instance) => done(instance));
        return {};
      },
    });
  }
}

function brokenEngine(error) {
  const why = error instanceof Error ? error.message : String(error?.message ?? error);
  return new Error(`gltfx: the module ended early: ${why}`);
}

/** Returns the result of `use` for a text in the module's memory. */
function withText(module, string, use) {
  const at = allocated(module, encoder.encode(`${string}\0`));
  const made = use(at);
  module._free(at);
  return made;
}

function validateOnce(module, asset, options) {
  const request = module._gltfx_request(asset.length);
  if (request === 0) throw new Error("out of memory");
  module.HEAPU8.set(asset, module._gltfx_request_bytes(request));
  const text = (string, use) => withText(module, string, use);
  if (options.uri) text(options.uri, (at) => module._gltfx_request_name(request, at));
  module._gltfx_request_kind(request, position(FORMATS, options.format),
    position(PROFILES, options.profile ?? "default"));
  if (options.paths) module._gltfx_request_paths(request);
  module._gltfx_request_limit(request, options.maxIssues ?? 0);
  for (const code of options.ignoredIssues ?? []) text(code, (at) => module._gltfx_request_ignore(request, at));
  for (const code of options.onlyIssues ?? []) text(code, (at) => module._gltfx_request_select(request, at));
  for (const [code, severity] of Object.entries(options.severityOverrides ?? {})) {
    text(code, (at) => module._gltfx_request_severity(request, at, severity));
  }
  const begin = module._gltfx_validate(request);
  const report = decoder.decode(module.HEAPU8.subarray(begin, begin + module._gltfx_report_size(request)));
  module._gltfx_release(request);
  return report;
}

function position(names, name) {
  const found = names.indexOf(name);
  if (found < 0) throw new Error(`gltfx: '${name}' is not one of ${names.filter(Boolean).join(", ")}`);
  return found;
}

function allocated(module, bytes) {
  const at = module._malloc(bytes.length || 1);
  if (at === 0) throw new Error("out of memory");
  module.HEAPU8.set(bytes, at);
  return at;
}

class Printed {
  #chunk = new Uint8Array(1 << 12);
  #used = 0;

  add(byte) {
    if (byte === null) return;
    if (this.#used === this.#chunk.length) {
      const larger = new Uint8Array(this.#chunk.length * 2);
      larger.set(this.#chunk);
      this.#chunk = larger;
    }
    this.#chunk[this.#used++] = byte;
  }

  bytes() {
    return this.#chunk.slice(0, this.#used);
  }
}

function writeFiles(fs, files, cwd) {
  fs.mkdirTree(cwd);
  fs.chdir(cwd);
  for (const [name, bytes] of files) {
    const path = name.startsWith("/") ? name : `${cwd}/${name}`;
    fs.mkdirTree(path.slice(0, path.lastIndexOf("/")) || "/");
    if (path.endsWith("/")) continue;
    fs.writeFile(path, bytes);
    fs.utime(path, 0, 0); // files that are written later are newer
  }
}

function writtenFiles(fs, cwd) {
  const written = new Map();
  const visit = (folder) => {
    for (const name of fs.readdir(folder || "/")) {
      const path = `${folder}/${name}`;
      if (name === "." || name === ".." || path === "/dev" || path === "/proc") continue;
      const { mode, mtime } = fs.stat(path);
      if (fs.isDir(mode)) visit(path);
      else if (mtime.getTime() > 0) written.set(fromFolder(path, cwd), fs.readFile(path));
    }
  };
  visit("");
  return written;
}

function fromFolder(path, folder) {
  return path.startsWith(`${folder}/`) ? path.slice(folder.length + 1) : path;
}
