// SPDX-License-Identifier: Apache-2.0
// What a user drops or chooses, as [{path, file}]. Folders are walked without recursion.

const MOST_FILES = 200000; // the worker says what is left out below that

function readAll(folder) {
  const reader = folder.createReader();
  const all = [];
  return new Promise((done, failed) => {
    const next = () => reader.readEntries((some) => {
      if (some.length === 0) return done(all);
      all.push(...some);
      next();
    }, failed);
    next();
  });
}

const fileOf = (entry) => new Promise((done, failed) => entry.file(done, failed));

async function walk(entries) {
  const found = [];
  const waiting = entries.slice().reverse();
  while (waiting.length > 0 && found.length < MOST_FILES) {
    const entry = waiting.pop();
    try {
      if (entry.isDirectory) waiting.push(...(await readAll(entry)));
      else found.push({ path: entry.fullPath.replace(/^\//, ""), file: await fileOf(entry) });
    } catch {
      // What may not be read is as if it were not there: an asset that needs it says so.
    }
  }
  return found;
}

/** Of a drop. The entries are taken at once: they are gone when the event is over. */
export function fromDrop(transfer) {
  const items = [...transfer.items].filter((item) => item.kind === "file");
  const entries = items.map((item) => item.webkitGetAsEntry());
  if (entries.length > 0 && entries.every((entry) => entry !== null)) return walk(entries);
  return Promise.resolve(fromFiles(transfer.files));
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
