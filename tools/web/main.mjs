// SPDX-License-Identifier: Apache-2.0
// The page: files in, a run of checks, downloads out.
import { isFixable, toUpgrade } from "./assets.mjs";
import { Checks } from "./checks.mjs";
import { fromDrop, fromFiles, titleOf } from "./dropped.mjs";
import { add, clear, finish, showLeftOut, startList, verdict } from "./list.mjs";

const MOST_ARCHIVES = 3; // in the verdict; the list of left-out files has all
const byId = (id) => document.getElementById(id);
globalThis.report = { rules: Object.create(null) }; // the rules with findings, for details()

let checks = null;
let title = "";
let done = 0;
const changes = { fixed: 0, upgraded: 0, packed: 0 }; // assets that have some
let paths = []; // of all assets
let leftOut = []; // {path, why, isArchive, mayHideAssets}
let address = ""; // of the last file that was made

function say(words, quiet = false) {
  byId("status").textContent = words;
  byId("status").classList.toggle("quiet", quiet);
}

function showProgress() {
  byId("meter").max = Math.max(1, paths.length);
  byId("meter").value = done;
  byId("doing").textContent =
    `${grouped(done)} of ${counted(paths.length, "asset")}` +
    (done < paths.length ? `: ${visible(paths[done])}` : "");
}

function showBusy(words) {
  byId("progress").hidden = words === "";
  byId("doing").textContent = words;
  for (const button of byId("downloads").querySelectorAll("button")) button.disabled = words !== "";
  if (words) byId("meter").removeAttribute("value");
}

function begin(dropped) {
  if (dropped.length === 0) return say("Nothing in it can be read.", true);
  checks?.stop();
  title = titleOf(dropped);
  done = changes.fixed = changes.upgraded = changes.packed = 0;
  paths = [];
  leftOut = [];
  clear();
  document.body.classList.add("small");
  byId("title").textContent = visible(title);
  document.title = `${visible(title)} – gltfx`;
  byId("results").hidden = false;
  byId("downloads").hidden = true;
  byId("left-out").replaceChildren();
  byId("comparison").hidden = true;
  say("");
  showBusy("Opening");
  checks = new Checks(dropped, hear);
}

function end(words) {
  showBusy("");
  finish();
  say(words);
}

const notChecked = ({ path, why }) => `${visible(path)} is not checked: ${visible(why)}.`;

/** The verdict, and the archives that it does not cover. */
function verdictOfAll() {
  const archives = leftOut.filter((one) => one.isArchive).slice(0, MOST_ARCHIVES);
  return [verdict(), ...archives.map(notChecked)].join(" ");
}

function hear(said) {
  if (said.assets) {
    ({ assets: paths, leftOut } = said);
    showLeftOut(leftOut, paths.length === 0);
    showProgress();
  } else if (said.asset) {
    Object.assign(report.rules, said.rules);
    if (isFixable(said.asset)) ++changes.fixed;
    if (toUpgrade(said.asset) > 0) ++changes.upgraded;
    if (said.asset.readable) ++changes.packed;
    ++done;
    add(said.asset);
    showProgress();
  } else if (said.checked) {
    if (paths.length === 0) {
      showBusy("");
      byId("results").hidden = byId("left-out").childElementCount === 0;
      const cause = leftOut.find((one) => one.mayHideAssets);
      return say(cause ? notChecked(cause) : "There is no .gltf, .glb or .vrm file in it.");
    }
    byId("downloads").hidden = false;
    for (const [kind, count] of Object.entries(changes)) {
      const button = byId(`get-${kind}`);
      button.hidden = count === 0;
      const name = count === 1 ? `${kind} file` : `${grouped(count)} ${kind} files`;
      button.textContent = name[0].toUpperCase() + name.slice(1);
    }
    byId("get-compared").hidden = paths.length !== 2;
    end(verdictOfAll());
  } else if (said.compared !== undefined) {
    showBusy("");
    byId("comparison").textContent = said.compared;
    byId("comparison").hidden = false;
  } else if (said.broken) {
    stop(`The checks ended early: ${visible(said.broken)}.`);
  } else {
    deliver(said);
  }
}

/** Passes a file to the browser, with a name that the user can change. */
function deliver({ made, name, why, failed = [] }) {
  showBusy("");
  if (made === null) return say(`It cannot be written: ${visible(why)}`, true);
  const rest = failed.length > 0 ? ` ${counted(failed.length, "asset")} left out; ${visible(failed[0])}` : "";
  say(verdictOfAll() + rest);
  if (address) URL.revokeObjectURL(address);
  address = URL.createObjectURL(made);
  make("a", { href: address, download: name }).click();
}

function stop(words) {
  checks?.stop();
  checks = null;
  byId("downloads").hidden = true;
  const left = paths.length - done;
  end(
    words +
      (left > 0 && paths.length > 0
        ? ` ${counted(left, "asset")} not checked, from ` + `${visible(paths[done])} on.`
        : ""),
  );
  byId("title").focus();
}

function startFields() {
  for (const [button, field] of [
    ["choose-files", "files"],
    ["choose-folder", "folder"],
  ]) {
    byId(button).addEventListener("click", () => byId(field).click());
    byId(field).addEventListener("change", () => {
      if (byId(field).files.length > 0) begin(fromFiles(byId(field).files));
      byId(field).value = "";
    });
  }
  const drop = byId("drop");
  let inside = 0;
  const over = (more) => {
    inside = Math.max(0, inside + more);
    drop.classList.toggle("over", inside > 0);
  };
  addEventListener("dragenter", () => over(1));
  addEventListener("dragleave", () => over(-1));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", async (event) => {
    event.preventDefault();
    over(-inside);
    begin(await fromDrop(event.dataTransfer));
  });
}

function start() {
  startList();
  startFields();
  byId("stop").addEventListener("click", () => stop("Stopped."));
  for (const kind of ["html", "sarif", "fixed", "upgraded", "packed", "compared"]) {
    byId(`get-${kind}`).addEventListener("click", () => {
      showBusy(kind === "compared" ? "Comparing" : "Writing");
      checks.make(kind, title);
    });
  }
  document.querySelector(".theme").addEventListener("change", ({ target }) => {
    if (target.value === "auto") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = target.value;
  });
}

start();
