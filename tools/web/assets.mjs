// SPDX-License-Identifier: Apache-2.0
// What can be done with a checked asset. For the page and its worker.
export const isFixable = (asset) => asset.findings.some((finding) => finding.fixable);
/** The number of objects to upgrade. */
export const toUpgrade = (asset) => asset.upgrade.filter((step) => step.done).length;
/** The path of the GLB of an asset, other than those in a Map by path. */
export function nameOfGlb(path, taken) {
  const stem = path.replace(/\.[^./]*$/, "");
  let name = `${stem}.glb`;
  for (let number = 2; taken.has(name); ++number) name = `${stem}-${number}.glb`;
  return name;
}
