// SPDX-License-Identifier: Apache-2.0
// What a user drops or chooses, as [{path, file}], or [{path, why}] for files that the browser does not provide.
// Folders are walked without recursion.

const MOST_FILES = 200000; // the worker reports files left out below that

/** Files of a file-system handle: Chromium has handles on pages from a disk too, where it has no entries. */
const HANDLE = {
  isFolder: (handle) => handle.kind === "directory",
  file: (handle) => handle.getFile(),
  async list(handle) {
    const all = [];
    for await (const one of handle.values()) all.push(one);
    return all;
  },
};

/** Files of an entry, which all browsers have. */
const ENTRY = {
  isFolder: (entry) => entry.isDirectory,
  file: (entry) => new Promise((done, failed) => entry.file(done, failed)),
  async list(entry) {
    const reader = entry.createReader();
    const all = [];
    for (;;) {
      const some = await new Promise((done, failed) => reader.readEntries(done, failed));
      if (some.length === 0) return all;
      all.push(...some);
    }
  },
};

async function walk(roots, kind) {
  const found = [];
  const waiting = roots.map((one) => [one.name, one]).reverse();
  while (waiting.length > 0 && found.length < MOST_FILES) {
    const [path, one] = waiting.pop();
    try {
      if (!kind.isFolder(one)) found.push({ path, file: await kind.file(one) });
      else for (const each of await kind.list(one)) waiting.push([`${path}/${each.name}`, each]);
    } catch {
      found.push(refused(path));
    }
  }
  return found;
}

const refused = (path) => ({ path, why: "the browser cannot read it" });

/** Files of a drop. All items are requested at once: they are unavailable after the event. */
export async function fromDrop(transfer) {
  const items = [...transfer.items].filter((item) => item.kind === "file");
  const files = [...transfer.files];
  const entries = items.map((item) => item.webkitGetAsEntry());
  if (!entries.some((entry) => entry?.isDirectory)) return fromFiles(files);
  const handles = items.map((item) => item.getAsFileSystemHandle?.().catch(() => null));
  const areHandles = !handles.includes(undefined);
  const roots = areHandles ? await Promise.all(handles) : entries;
  const nameOf = (i) => entries[i]?.name ?? files[i]?.name ?? "a file";
  const lost = roots.flatMap((root, i) => (root ? [] : [refused(nameOf(i))]));
  return [...lost, ...(await walk(roots.filter(Boolean), areHandles ? HANDLE : ENTRY))];
}

/** Files of an input field for files or a folder. */
export function fromFiles(files) {
  return [...files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** The name of the selection: the folder or file, or the number of items. */
export function titleOf(dropped) {
  const tops = new Set(dropped.map(({ path }) => path.split("/")[0]));
  return tops.size === 1 ? [...tops][0] : `${dropped.length} files`;
}
