// SPDX-License-Identifier: Apache-2.0
// What a user drops or chooses, as [{path, file}], or [{path, why}] for what the browser does not hand over. Folders
// are walked without recursion.

const MOST_FILES = 200000; // the worker says what is left out below that

/** Of a file-system handle: Chromium has those on pages from a disk too, where it has no entries. */
const HANDLE = {
  isFolder: (handle) => handle.kind === "directory",
  file: (handle) => handle.getFile(),
  async list(handle) {
    const all = [];
    for await (const one of handle.values()) all.push(one);
    return all;
  },
};

/** Of an entry, as all browsers have it. */
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

/** Of a drop. All is asked for at once: it is gone when the event is over. */
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

/** Of a field of files or of a folder. */
export function fromFiles(files) {
  return [...files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** What it is called: the folder or file, or how many there are. */
export function titleOf(dropped) {
  const tops = new Set(dropped.map(({ path }) => path.split("/")[0]));
  return tops.size === 1 ? [...tops][0] : `${dropped.length} files`;
}
