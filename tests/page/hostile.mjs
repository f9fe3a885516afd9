// SPDX-License-Identifier: Apache-2.0
// Assets whose every text would like to be markup, a script or another direction.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const BREAKERS = [
  "</script><img src=x onerror=window.broken=1>",
  "<!--<script>window.broken=1",
  "\u202egnp.elif\u202c \u0007\u0000\u001b[2J",
  "مرحبا بالعالم (a)",
  "'\"><svg onload=window.broken=1>",
  "javascript:window.broken=1",
];

/** Writes one asset for each text; returns the paths. */
export function writeHostile(folder) {
  const place = join(folder, "<b>hostile</b>&amp;");
  mkdirSync(place, { recursive: true });
  BREAKERS.forEach((text, i) => {
    writeFileSync(join(place, `${i}<img src=x>.gltf`), JSON.stringify({
      asset: { version: "2.0", generator: text, copyright: text },
      extensionsUsed: [text, "KHR_materials_unlit"],
      [text]: text,
      meshes: [{ name: text, primitives: [{ attributes: { [text]: 0 } }] }],
      materials: [{ name: text, alphaMode: text, emissiveFactor: text, extensions: { [text]: {} } }],
      images: [{ name: text, uri: text }],
      animations: [{ name: text, samplers: [], channels: [] }],
      nodes: [{ name: text, mesh: 99 }],
    }, null, 1));
  });
  writeFileSync(join(place, "cut + torn.gltf"), `{"asset": ${BREAKERS[0]}`);
  return place;
}
