// SPDX-License-Identifier: Apache-2.0
// What changed between two dropped assets.
import { Reading } from "./files.mjs";

/** The text of `gltfx compare`, in the order of the list. */
export async function compareTexts(engine, files, [before, after]) {
  const reading = new Reading(files);
  await reading.addAsset(before);
  await reading.addAsset(after);
  const words = ["compare", "--isolated", "--color", "never", "--all", "--", before, after];
  const done = await engine.run(words, reading.content);
  if (done.code > 1) throw new Error(done.stderr.trim() || `gltfx compare ended with code ${done.code}`);
  return new TextDecoder().decode(done.stdout);
}
