// SPDX-License-Identifier: Apache-2.0
// Stands for tools/web/engine.js where the WebAssembly engine is not built: asks the native program, over
// the server of stand_in_server.mjs, whose address the test puts in.
const ADDRESS = "@ADDRESS@";

function base64(bytes) {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}

const bytesOf = (text) => Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));

async function run(args, files) {
  const sent = { args, files: [...files].map(([path, bytes]) => [path, base64(bytes)]) };
  const answer = await (await fetch(ADDRESS, { method: "POST", body: JSON.stringify(sent) })).json();
  return { ...answer, stdout: bytesOf(answer.stdout),
    files: new Map(answer.files.map(([path, text]) => [path, bytesOf(text)])) };
}

export async function startEngine() {
  return { version: "stand-in", run };
}
