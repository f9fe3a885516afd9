// SPDX-License-Identifier: Apache-2.0
// The files of this machine in the file system of the engine. Each lookup, read and write of the engine is one of
// node:fs, and links, pipes and devices are passed through, so that the engine decides what it opens as the native
// program does. Only regular files are opened.
import * as fs from "node:fs";
import { hostPath, virtualPath } from "./paths.mjs";

// The errno values of C programs in WebAssembly for errors of node:fs.
const ERRORS = {
  EACCES: 2,
  EBUSY: 10,
  EEXIST: 20,
  EINVAL: 28,
  EIO: 29,
  EISDIR: 31,
  ELOOP: 32,
  EMFILE: 33,
  ENAMETOOLONG: 37,
  ENOENT: 44,
  ENOMEM: 48,
  ENOSPC: 51,
  ENOTDIR: 54,
  ENOTEMPTY: 55,
  ENXIO: 60,
  EPERM: 63,
  EROFS: 69,
  EXDEV: 75,
};
const { O_APPEND, O_NOFOLLOW = 0, O_NONBLOCK = 0, O_RDONLY, O_RDWR, O_WRONLY } = fs.constants;
const ACCESS = [O_RDONLY, O_WRONLY, O_RDWR]; // by the lowest bits of the engine's flags
const APPENDS = 1024; // a bit of the engine's flags
const FROM_END = 2; // a kind of seek
const LARGEST = 2 ** 31 - 1; // maximum size of a file: half of the engine's memory
const ZEROS = 64; // bytes after a mapped file, as the system has there
const OWN_FOLDERS = ["/dev/shm/tmp", "/dev/shm", "/home/web_user", "/home", "/tmp"]; // empty ones of the engine

function mayWrite(path) {
  try {
    fs.accessSync(path, fs.constants.W_OK);
    return true;
  } catch {
    return false;
  }
}

class HostFiles {
  #engine; // the module
  #operations;

  constructor(engine) {
    this.#engine = engine;
    this.#operations = { node_ops: this.#safe(this.#ofNodes()), stream_ops: this.#safe(this.#ofStreams()) };
  }

  attach() {
    const { FS } = this.#engine;
    for (const folder of OWN_FOLDERS) FS.rmdir(folder);
    for (const folder of ["/", "/dev"]) {
      const { node } = FS.lookupPath(folder);
      const { lookup, readdir } = this.#operations.node_ops;
      const own = node.node_ops;
      const all = (one) => [...new Set([...own.readdir(one), ...readdir(one)])];
      node.node_ops = { ...own, lookup, readdir: folder === "/" ? all : own.readdir };
    }
  }

  #failure(name) {
    return new this.#engine.FS.ErrnoError(ERRORS[name] ?? ERRORS.EIO);
  }

  /** The same functions, with errors of the engine. */
  #safe(functions) {
    const safe = (run) => (...args) => {
      try {
        return run(...args);
      } catch (error) {
        throw error.code === undefined ? error : this.#failure(error.code);
      }
    };
    return Object.fromEntries(Object.entries(functions).map(([name, run]) => [name, safe(run)]));
  }

  #path(node, name) {
    const folder = this.#engine.FS.getPath(node);
    const path = hostPath(name === undefined ? folder : `${folder}/${name}`.replace(/^\/\//, "/"));
    if (path === null) throw this.#failure("ENOENT");
    return path;
  }

  // The engine checks the mode of a node for any user. So a node has all rights, and the system refuses; but access()
  // checks only the node for write permission.
  #found(parent, name) {
    const path = this.#path(parent, name);
    const status = fs.lstatSync(path);
    const rights = status.isFile() && !mayWrite(path) ? 0o555 : 0o777;
    const mode = (status.mode & ~0o7777) | rights;
    return Object.assign(this.#engine.FS.createNode(parent, name, mode, status.rdev), this.#operations);
  }

  #forget(parent, name) {
    const { FS } = this.#engine;
    try {
      FS.destroyNode(FS.lookupNode(parent, name));
    } catch {
      // unknown
    }
  }

  #ofNodes() {
    const { FS } = this.#engine;
    return {
      lookup: (parent, name) => this.#found(parent, name),
      getattr: (node) => fs.lstatSync(this.#path(node)),
      setattr: (node, { mode, size }) => {
        if (mode !== undefined) fs.chmodSync(this.#path(node), mode & 0o7777);
        if (size !== undefined) fs.truncateSync(this.#path(node), size);
      },
      mknod: (parent, name, mode) => {
        const path = this.#path(parent, name);
        if (FS.isDir(mode)) fs.mkdirSync(path, mode & 0o7777);
        else fs.closeSync(fs.openSync(path, "wx", mode & 0o7777));
        return this.#found(parent, name);
      },
      rename: (node, folder, name) => {
        this.#forget(folder, name);
        fs.renameSync(this.#path(node), this.#path(folder, name));
        Object.assign(node, { parent: folder, name });
      },
      unlink: (parent, name) => fs.unlinkSync(this.#path(parent, name)),
      rmdir: (parent, name) => fs.rmdirSync(this.#path(parent, name)),
      readlink: (node) => virtualPath(fs.readlinkSync(this.#path(node))),
      // Names that are not UTF-8 cannot be looked up.
      readdir: (node) => {
        const folder = this.#path(node);
        const isKnown = (name) => !name.includes("\ufffd") || fs.existsSync(`${folder}/${name}`);
        return fs.readdirSync(folder).filter(isKnown);
      },
    };
  }

  #ofStreams() {
    return {
      open: (stream) => this.#open(stream),
      close: ({ file }) => file !== undefined && fs.closeSync(file),
      fsync: ({ file }) => (file === undefined ? undefined : fs.fsyncSync(file)),
      read: ({ file }, to, offset, length, position) =>
        file === undefined ? 0 : fs.readSync(file, to, offset, length, position),
      write: ({ file }, from, offset, length, position) => {
        if (file === undefined) throw this.#failure("ENXIO");
        return fs.writeSync(file, from, offset, length, position);
      },
      llseek: ({ file, position }, offset, whence) => {
        const from = [0, position, whence === FROM_END && file !== undefined ? fs.fstatSync(file).size : 0][whence];
        if (from === undefined || from + offset < 0) throw this.#failure("EINVAL");
        return from + offset;
      },
      mmap: (stream, _address, length, position) => this.#map(stream, length, position),
    };
  }

  // A file that became a pipe meanwhile neither blocks nor is read.
  #open(stream) {
    if (!this.#engine.FS.isFile(stream.node.mode)) return;
    const flags = ACCESS[stream.flags & 3] | (stream.flags & APPENDS ? O_APPEND : 0);
    const file = fs.openSync(this.#path(stream.node), flags | O_NONBLOCK | O_NOFOLLOW);
    if (fs.fstatSync(file).isFile()) {
      stream.file = file;
    } else {
      fs.closeSync(file);
      throw this.#failure("ENXIO");
    }
  }

  #map({ file }, length, position) {
    const ptr = length > LARGEST ? 0 : this.#engine._malloc(length + ZEROS) >>> 0;
    if (ptr === 0) throw this.#failure("ENOMEM");
    const memory = this.#engine.HEAPU8.subarray(ptr, ptr + length + ZEROS);
    let done = 0;
    for (let read = -1; done < length && read !== 0; done += read)
      read = fs.readSync(file, memory, done, length - done, position + done);
    memory.fill(0, done); // also if the file became shorter meanwhile
    return { ptr, allocated: true };
  }
}

/** Gives the engine the files of this machine in place of its own. */
export function attachHostFiles(engine) {
  new HostFiles(engine).attach();
}
