// SPDX-License-Identifier: Apache-2.0
// The assets that were checked: totals and rows. make(), details() and similar functions are those of the report page.
import { toUpgrade } from "./assets.mjs";

const ROWS_AT_ONCE = 100;
const byId = (id) => document.getElementById(id);
const size = (asset) => (asset.facts ? asset.facts.bytes.total : 0);
const triangles = (asset) => (asset.facts ? asset.facts.counts.triangles : 0);

export function verdictOf(asset) {
  if (!asset.readable || asset.counts.errors > 0) return "error";
  const { warnings, infos, hints } = asset.counts;
  return warnings > 0 ? "warning" : infos + hints > 0 ? "info" : "good";
}

const PICKS = [
  ["all", "All", () => true],
  ["error", "Errors", (asset) => verdictOf(asset) === "error"],
  ["warning", "Warnings", (asset) => asset.counts.warnings > 0],
  ["upgrade", "To upgrade", (asset) => toUpgrade(asset) > 0],
];

let assets = [];
let picked = PICKS[0];
let most = ROWS_AT_ONCE; // rows that are shown

function stateText(asset) {
  if (!asset.readable) return make("span.is-error", {}, asset.why ? "not checked" : "not readable");
  const { errors, warnings, infos, hints } = asset.counts;
  const parts = [
    ["error", errors],
    ["warning", warnings],
    ["info", infos],
    ["hint", hints],
  ]
    .filter(([, count]) => count > 0)
    .map(([kind, count]) => make(`span.is-${kind}`, {}, counted(count, kind)));
  if (parts.length === 0) return make("span.is-good", {}, "no findings");
  return make(
    "span",
    {},
    parts.flatMap((part, i) => (i === 0 ? [part] : [" · ", part])),
  );
}

function cell(kind, value, unit, known) {
  return make(`span.cell.${kind}`, {}, known ? value : "–", make("small", {}, unit));
}

function row(asset) {
  const cut = asset.path.lastIndexOf("/") + 1;
  const steps = toUpgrade(asset);
  const known = Boolean(asset.facts);
  const summary = make(
    "summary",
    {},
    make(`span.dot.fill-${verdictOf(asset)}`, { "aria-hidden": "true" }),
    make(
      "span.path",
      {},
      cut > 0 ? make("span.folder", {}, isolated(asset.path.slice(0, cut))) : null,
      make("h3", {}, isolated(asset.path.slice(cut))),
    ),
    make(
      "span.state",
      {},
      stateText(asset),
      steps > 0 ? make("span.to-do", {}, `${counted(steps, "object")} to upgrade`) : null,
    ),
    cell("bytes", sizeText(size(asset)), "bytes", known),
    cell("triangles", shortCount(triangles(asset)), "triangles", known),
    cell("textures", grouped(known ? asset.facts.counts.textures : 0), "textures", known),
  );
  const folded = make("details.asset", {}, summary);
  folded.addEventListener("toggle", () => {
    if (!folded.open || folded.childElementCount > 1) return;
    folded.append(
      asset.why
        ? make("div.body", {}, make("p", {}, "Not checked: ", isolated(asset.why)))
        : details(asset, () => true),
    );
  });
  return make("li", {}, folded);
}

/** Adds the rows that are missing at the end of the list. */
function fill() {
  const shown = assets.filter(picked[2]);
  const list = byId("list");
  list.append(...shown.slice(list.childElementCount, most).map(row));
  byId("more").hidden = shown.length <= most;
}

function refill() {
  most = ROWS_AT_ONCE;
  byId("list").replaceChildren();
  fill();
}

function fillPicks() {
  byId("filter").replaceChildren(make("legend.hidden", {}, "Which assets to show"));
  const options = PICKS.map((pick) => [pick, assets.filter(pick[2]).length]).filter(([, count]) => count > 0);
  if (assets.length < 2 || options.length < 2) return;
  byId("filter").append(
    ...options.map(([pick, count]) => {
      const input = make("input", { type: "radio", name: "pick", value: pick[0], checked: pick === picked });
      input.addEventListener("change", () => {
        picked = pick;
        refill();
      });
      return make("label", {}, input, make("span", {}, pick[1], make("small", {}, grouped(count))));
    }),
  );
}

function sum(of) {
  return assets.reduce((total, asset) => total + of(asset), 0);
}

export function clear() {
  assets = [];
  picked = PICKS[0];
  byId("filter").hidden = true;
  byId("summary").replaceChildren();
  byId("left-out").replaceChildren();
  refill();
}

export function add(asset) {
  assets.push(asset);
  if (byId("list").childElementCount < most) fill();
  else byId("more").hidden = false;
}

/** Totals, when no more assets come. */
export function finish() {
  const bars = [
    ["error", "with errors"],
    ["warning", "with warnings"],
    ["info", "with infos only"],
    ["good", "without findings"],
  ].map(([kind, words]) => {
    const count = assets.filter((asset) => verdictOf(asset) === kind).length;
    return [kind, `${grouped(count)} ${words}`, count];
  });
  const figures = [
    ["Errors", grouped(sum((asset) => asset.counts.errors))],
    ["Warnings", grouped(sum((asset) => asset.counts.warnings))],
    ["Infos", grouped(sum((asset) => asset.counts.infos + asset.counts.hints))],
    ["Size", sizeText(sum(size))],
    ["Triangles", shortCount(sum(triangles))],
    ["To upgrade", grouped(assets.filter((asset) => toUpgrade(asset) > 0).length)],
  ];
  byId("summary").replaceChildren(
    ...(assets.length > 1 ? bar(bars) : []),
    make(
      "dl.figures",
      {},
      figures.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))),
    ),
  );
  fillPicks();
  byId("filter").hidden = byId("filter").childElementCount < 2;
  if (assets.length === 1) byId("list").querySelector("details").open = true;
}

/** "2 of 3 assets have errors." */
export function verdict() {
  const wrong = assets.filter((asset) => verdictOf(asset) === "error").length;
  const all = counted(assets.length, "asset");
  if (wrong === 0) return assets.length === 1 ? "No errors." : `None of ${all} has errors.`;
  if (assets.length === 1)
    return assets[0].readable ? `${counted(assets[0].counts.errors, "error")}.` : "Not checked.";
  return `${grouped(wrong)} of ${all} ${wrong === 1 ? "has" : "have"} errors.`;
}

export function showLeftOut(files, open) {
  if (files.length === 0) return;
  const rows = files.slice(0, ROWS_AT_ONCE).map(({ path, why }) => [isolated(path), isolated(why)]);
  const words = files.length > rows.length ? `The first ${rows.length} of them` : "Files left out";
  byId("left-out").replaceChildren(
    make(
      "details.fold.left-out",
      { open },
      make("summary", {}, make("h3", {}, `${counted(files.length, "file")} left out`)),
      make("div", {}, table(words, [["file"], ["why"]], rows)),
    ),
  );
}

export function startList() {
  byId("more").addEventListener("click", () => {
    most += ROWS_AT_ONCE;
    fill();
  });
}
