// SPDX-License-Identifier: Apache-2.0
// What can be done with a checked asset. For the page and its worker.
export const isFixable = (asset) => asset.findings.some((finding) => finding.fixable);
/** The number of objects to upgrade. */
export const toUpgrade = (asset) => asset.upgrade.filter((step) => step.done).length;
