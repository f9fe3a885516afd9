// SPDX-License-Identifier: Apache-2.0
// The page: totals, the filter and a list that grows as it is read.

const report = JSON.parse(document.getElementById("data").textContent);
const ROWS_AT_ONCE = 50;
const state = { text: "", path: "", verdict: "all", rule: "", order: "worst", requirement: "", result: "", view: "list" };

// --- Filter and order of the list ---

const VERDICTS = [
  ["all", "any", () => true],
  ["error", "with errors", (asset) => asset.counts.errors > 0],
  ["warning", "with warnings", (asset) => asset.counts.warnings > 0],
  ["info", "with infos", (asset) => asset.counts.infos > 0],
  ["clean", "without findings", (asset) => verdictOf(asset) === "good"],
  ["unreadable", "not readable", (asset) => !asset.readable],
  ["upgrade", "to upgrade", (asset) => toUpgrade(asset) > 0],
];

const size = (asset) => (asset.facts ? asset.facts.bytes.total : 0);
const ORDERS = [
  ["worst", "worst first", (a, b) => b.counts.errors - a.counts.errors || b.counts.warnings - a.counts.warnings
    || b.counts.infos - a.counts.infos || a.index - b.index],
  ["run", "as in the run", (a, b) => a.index - b.index],
  ["name", "by path", (a, b) => (a.path < b.path ? -1 : a.path > b.path ? 1 : a.index - b.index)],
  ["size", "largest first", (a, b) => size(b) - size(a) || a.index - b.index],
  ["triangles", "most triangles", (a, b) => count(b, "triangles") - count(a, "triangles") || a.index - b.index],
  ["gpu", "most image memory", (a, b) => imageMemory(b) - imageMemory(a) || a.index - b.index],
];

function count(asset, kind) {
  return asset.facts ? asset.facts.counts[kind] : 0;
}

function imageMemory(asset) {
  return asset.facts ? asset.facts.gpuBytes.images : 0;
}

function toUpgrade(asset) {
  return asset.upgrade.filter((step) => step.done).length;
}

function verdictOf(asset) {
  if (!asset.readable) return "unreadable";
  const { errors, warnings, infos, hints } = asset.counts;
  return errors > 0 ? "error" : warnings > 0 ? "warning" : infos + hints > 0 ? "info" : "good";
}

/** The text that the search covers; built once. */
function words(asset) {
  if (asset.words === undefined) {
    const found = [];
    for (const one of asset.externalAssets || []) found.push(one.path);
    for (const one of asset.findings) found.push(one.code, one.message, one.pointer || "", one.object || "");
    for (const one of asset.facts ? asset.facts.extensions : []) found.push(one.name);
    for (const kind of asset.facts ? ["meshes", "materials", "images", "animations"] : []) {
      for (const one of asset.facts[kind]) found.push(one.name || one.uri || "");
    }
    asset.words = (asset.path + "\n" + found.join("\n")).toLowerCase();
  }
  return asset.words;
}

function findingMatches(finding) {
  if (SEVERITIES.includes(state.verdict) && finding.severity !== state.verdict) return false;
  return state.rule === "" || finding.code === state.rule;
}

function assetMatches(asset) {
  if (state.path && !asset.path.toLowerCase().includes(state.path)) return false;
  if (!VERDICTS.find(([name]) => name === state.verdict)[2](asset)) return false;
  if (state.rule && !asset.findings.some(findingMatches)) return false;
  if ((state.requirement || state.result) && !requirementMatches(asset, state.requirement, state.result)) return false;
  return !state.text || words(asset).includes(state.text);
}

// --- The list ---

let shown = [];
let limits = [];  // of all assets, with counts
let opened = "";  // path of the asset that was opened last

function stateText(asset) {
  if (!asset.readable) return make("span.is-error", {}, "not readable");
  const counts = { error: asset.counts.errors, warning: asset.counts.warnings, info: asset.counts.infos,
    hint: asset.counts.hints };
  const parts = SEVERITIES.filter((one) => counts[one] > 0)
    .map((one) => make("span.is-" + one, {}, counted(counts[one], one)));
  if (parts.length === 0) return make("span.is-good", {}, "no findings");
  return make("span", {}, parts.flatMap((part, i) => (i === 0 ? [part] : [" · ", part])));
}

function thumb(asset) {
  if (asset.picture.src) return make("img.thumb", { src: asset.picture.src, alt: "", width: 48, height: 48 });
  return make("span.thumb.none", { "aria-hidden": "true", title: asset.picture.problem || "no picture" }, "–");
}

function cell(kind, value, unit, known) {
  return make("span.cell." + kind, {}, known ? value : "–", make("small", {}, unit));
}

function pathPart(asset) {
  const cut = asset.path.lastIndexOf("/") + 1;
  const folder = cut > 0 ? make("span.folder", {}, isolated(asset.path.slice(0, cut))) : null;
  return make("span.path", {}, folder, make("h3", {}, isolated(asset.path.slice(cut))));
}

function row(asset) {
  const known = Boolean(asset.facts);
  const steps = toUpgrade(asset);
  const summary = make("summary", {}, thumb(asset), pathPart(asset),
    make("span.state", {}, stateText(asset),
      steps > 0 ? make("span.to-do", {}, counted(steps, "object") + " to upgrade") : null),
    cell("bytes", sizeText(size(asset)), "bytes", known),
    cell("triangles", shortCount(count(asset, "triangles")), "triangles", known),
    cell("textures", grouped(count(asset, "textures")), "textures", known));
  const folded = make("details.asset", {}, summary);
  folded.addEventListener("toggle", () => {
    if (folded.open && folded.childElementCount === 1) folded.append(details(asset, findingMatches));
    if (folded.open) opened = asset.path;
    else if (opened === asset.path) opened = "";
    writeAddress();
  });
  return make("li", {}, folded);
}

/** Limits that are columns of the matrix: those of the assets that are shown. */
let columns = [];

/** The element whose children are the assets that are shown. */
function listed() {
  return state.view === "matrix" ? byId("matrix").querySelector("tbody") : byId("list");
}

function showMore() {
  const list = listed();
  const from = list.childElementCount;
  const next = shown.slice(from, from + ROWS_AT_ONCE);
  list.append(...next.map((asset) => (state.view === "matrix" ? matrixRow(asset, columns) : row(asset))));
  byId("more").hidden = list.childElementCount >= shown.length;
}

/** An empty list, or the head of the matrix. */
function clearList() {
  const matrix = state.view === "matrix";
  byId("list").replaceChildren();
  byId("matrix").hidden = !matrix;
  byId("list").hidden = matrix;
  if (!matrix) return byId("matrix").replaceChildren();
  const used = new Set(shown.flatMap((asset) => (asset.requirements || []).map((entry) => entry.key)));
  columns = limits.filter((limit) => used.has(limit.key) && (state.requirement === "" || limit.key === state.requirement));
  byId("matrix").replaceChildren(make("table", {}, make("caption.hidden", {}, "Requirements by asset"),
    make("thead", {}, matrixHead(columns)), make("tbody")));
}

/** Why a rule has no assets, if known. */
function nothingFound() {
  const nowhere = state.rule && !report.assets.some((asset) => asset.findings.some((one) => one.code === state.rule));
  return nowhere ? ": " + visible(state.rule) + " found nothing" : "";
}

function refresh() {
  shown = report.assets.filter(assetMatches).sort(ORDERS.find(([name]) => name === state.order)[2]);
  clearList();
  showMore();
  const all = counted(report.assets.length, "asset");
  byId("count").textContent = shown.length === report.assets.length ? all
    : grouped(shown.length) + " of " + all + nothingFound();
}

// --- The address: filter and open asset, for links ---

/** A plus sign is itself, as in paths: a blank is %20. */
function addressOf(words) {
  return new URLSearchParams(words).toString().replaceAll("+", "%20");
}

function writeAddress() {
  const words = new URLSearchParams();
  for (const name of Object.keys(state)) {
    const field = byId(name);
    const usual = field.tagName === "SELECT" ? field.options[0].value : "";
    if (field.value !== usual) words.set(name, field.value);
  }
  if (opened) words.set("asset", opened);
  const address = addressOf(words);
  if (address !== location.hash.slice(1)) history.replaceState(null, "", address ? "#" + address : "#assets");
}

/** Opens the asset with that path, if it passes the filter. */
function openAsset(path) {
  const place = shown.findIndex((asset) => asset.path === path);
  if (place < 0) return;
  if (state.view === "matrix") return;
  while (byId("list").childElementCount <= place) showMore();
  const folded = byId("list").children[place].querySelector("details.asset");
  folded.open = true;
  folded.scrollIntoView();
}

/** A link to a rule or a limit works even if no asset has it. */
function offer(field, value) {
  if (!value || Array.from(byId(field).options).some((one) => one.value === value)) return;
  byId(field).append(make("option", { value }, visible(value) + " (0)"));
}

function readAddress() {
  const words = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"));
  offer("rule", words.get("rule"));
  offer("requirement", words.get("requirement"));
  for (const name of Object.keys(state)) {
    const field = byId(name);
    const value = words.get(name);
    if (field.tagName !== "SELECT") field.value = value || "";
    else field.selectedIndex = Math.max(0, Array.from(field.options).findIndex((one) => one.value === value));
  }
  readFilter();
  if (words.has("asset")) openAsset(words.get("asset"));
  else if (words.has("rule") || words.has("requirement") || words.has("view")) byId("assets").scrollIntoView();
}

/** Another link on the page, except the one that skips to the assets. */
function followLink() {
  if (location.hash !== "#assets") readAddress();
}

// --- Totals ---

function sum(of) {
  return report.assets.reduce((total, asset) => total + of(asset), 0);
}

function fillSummary() {
  const kinds = { error: 0, unreadable: 0, warning: 0, info: 0, good: 0 };
  for (const asset of report.assets) ++kinds[verdictOf(asset)];
  const all = report.assets.length;
  const wrong = kinds.error + kinds.unreadable;
  const number = make("strong" + (wrong > 0 ? ".is-error" : ".is-good"), {}, wrong > 0 ? counted(wrong, "asset") : "None");
  const verdict = all === 0 ? ["There are no assets."] : wrong === 0
    ? [number, " of " + counted(all, "asset") + " has errors."]
    : [number, " of " + grouped(all) + (wrong === 1 ? " has errors." : " have errors.")];
  const names = { error: "with errors", unreadable: "not readable", warning: "with warnings",
    info: "with infos only", good: "without findings" };
  const parts = Object.keys(kinds).map((kind) => [kind, grouped(kinds[kind]) + " " + names[kind], kinds[kind]]);
  const failing = report.assets.filter((asset) => requirementMatches(asset, "", "fail")).length;
  const figures = [
    ["Errors", grouped(report.summary.errors)], ["Warnings", grouped(report.summary.warnings)],
    ["Infos", grouped(report.summary.infos + report.summary.hints)],
    ["Size", sizeText(sum(size))],
    ["Triangles", shortCount(sum((asset) => count(asset, "triangles")))],
    ["Images, GPU", sizeText(sum(imageMemory))],
    ["To upgrade", grouped(report.assets.filter((asset) => toUpgrade(asset) > 0).length)],
    ...(limits.length > 0 ? [["Beyond limits", grouped(failing)]] : [])];
  byId("summary").append(make("p.verdict", {}, verdict),
    ...bar(parts),
    make("dl.figures", {}, figures.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value)))));
}

/** Per rule: findings, and assets with findings. */
function ruleCounts() {
  const counts = new Map();
  for (const asset of report.assets) {
    const seen = new Set();
    for (const finding of asset.findings) {
      const entry = counts.get(finding.code) || { code: finding.code, severity: finding.severity, findings: 0, assets: 0 };
      if (SEVERITIES.indexOf(finding.severity) < SEVERITIES.indexOf(entry.severity)) entry.severity = finding.severity;
      entry.findings += finding.count || 1;
      if (!seen.has(finding.code)) ++entry.assets;
      seen.add(finding.code);
      counts.set(finding.code, entry);
    }
  }
  return [...counts.values()].sort((a, b) => SEVERITIES.indexOf(a.severity) - SEVERITIES.indexOf(b.severity)
    || b.assets - a.assets || (a.code < b.code ? -1 : 1));
}

function extensionCounts() {
  const counts = new Map();
  for (const asset of report.assets) {
    for (const one of asset.facts ? asset.facts.extensions : []) {
      const entry = counts.get(one.name) || { ...one, assets: 0 };
      ++entry.assets;
      counts.set(one.name, entry);
    }
  }
  return [...counts.values()].sort((a, b) => b.assets - a.assets || (a.name < b.name ? -1 : 1));
}

/** Features that targets refuse or ignore: a severity, the words after the name of the target, and assets by target. */
function targetLosses() {
  const losses = new Map();
  for (const asset of report.assets) {
    const seen = new Set();
    for (const { code, severity, message } of asset.findings) {
      const target = code.startsWith("TARGET_") ? report.targets.find((one) => message.startsWith(one + " ")) : undefined;
      if (target === undefined || seen.has(message)) continue;
      seen.add(message);
      const words = message.slice(target.length + 1);
      const loss = losses.get(words) || { words, severity, assets: new Map() };
      if (SEVERITIES.indexOf(severity) < SEVERITIES.indexOf(loss.severity)) loss.severity = severity;
      loss.assets.set(target, (loss.assets.get(target) || 0) + 1);
      losses.set(words, loss);
    }
  }
  return [...losses.values()].sort((a, b) => SEVERITIES.indexOf(a.severity) - SEVERITIES.indexOf(b.severity)
    || (a.words < b.words ? -1 : 1));
}

function targetTable() {
  const losses = targetLosses();
  if (losses.length === 0) return make("p.soft", {}, "Every target reads every feature that was measured.");
  const rows = losses.map((loss) => [make("span.label.is-" + loss.severity, {}, loss.severity),
    make("a", { href: "#" + addressOf({ text: loss.words }) }, visible(loss.words)),
    ...report.targets.map((one) => grouped(loss.assets.get(one) || 0))]);
  return table("What targets refuse or ignore, and in how many assets",
    [["severity"], ["the target …"], ...report.targets.map((one) => [visible(one), true])], rows);
}

function fold(heading, note, content) {
  return make("details.fold", {}, make("summary", {}, make("h3", {}, heading), " ", make("span.soft", {}, note)),
    make("div", {}, content));
}

function ruleTable(caption, rules) {
  const rows = rules.map((entry) => [make("span.label.is-" + entry.severity, {}, entry.severity),
    make("a.mono", { href: "#rule=" + entry.code }, entry.code),
    report.rules[entry.code] ? report.rules[entry.code].summary : "", grouped(entry.findings), grouped(entry.assets)]);
  return table(caption, [["severity"], ["rule"], ["what it says"], ["findings", true], ["assets", true]], rows);
}

function fillOverview(rules) {
  const extensions = extensionCounts();
  const extensionRows = extensions.map((one) => [make("span.mono", {}, link(one.spec, visible(one.name))), one.status,
    one.successor ? make("span.mono", {}, isolated(one.successor)) : "", grouped(one.assets)]);
  const uses = USES.map((use) => [use, sum((asset) => (asset.facts ? asset.facts.bytes[use] : 0))])
    .sort((a, b) => b[1] - a[1]).map(([use, bytes]) => [use, use + " " + sizeText(bytes), bytes]);
  const overview = byId("overview");
  if (rules.length > 0) {
    overview.append(fold("Findings by rule", counted(rules.length, "rule"), ruleTable("Rules that found something", rules)));
  }
  const shows = rules.filter((entry) => (report.rules[entry.code] || {}).group === "shows");
  if (shows.length > 0) {
    overview.append(fold("What the assets show", counted(shows.length, "rule"),
      ruleTable("Why nothing is to be seen, or what is not meant", shows)));
  }
  if (limits.length > 0) {
    overview.append(fold("Requirements", counted(limits.length, "limit"), [limitTable(limits),
      make("p", {}, make("a", { href: "#view=matrix" }, "All assets and limits as a matrix"))]));
  }
  if (report.targets.length > 0) {
    overview.append(fold("Targets", counted(report.targets.length, "target"), targetTable()));
  }
  if (extensions.length > 0) {
    overview.append(fold("Extensions", grouped(extensions.length), table("Extensions in use",
      [["name"], ["status"], ["successor"], ["assets", true]], extensionRows)));
  }
  if (sum(size) > 0) overview.append(fold("Where the bytes go", sizeText(sum(size)), bar(uses)));
}

// --- The filter ---

function readFilter() {
  for (const name of Object.keys(state)) {
    const value = byId(name).value;
    state[name] = name === "text" || name === "path" ? value.trim().toLowerCase() : value;
  }
  refresh();
}

function read() {
  opened = "";
  readFilter();
  writeAddress();
}

function reset() {
  for (const name of Object.keys(state)) {
    const field = byId(name);
    if (field.tagName === "SELECT") field.selectedIndex = 0;
    else field.value = "";
  }
  read();
}

function fillFilter(rules) {
  const option = ([value, text]) => make("option", { value }, text);
  byId("verdict").append(...VERDICTS.map(option));
  byId("order").append(...ORDERS.map(option));
  byId("rule").append(option(["", "any"]),
    ...rules.slice().sort((a, b) => (a.code < b.code ? -1 : 1))
      .map((entry) => option([entry.code, entry.code + " (" + entry.assets + ")"])));
  byId("requirement").append(option(["", "any"]), ...limits.map((limit) =>
    option([limit.key, measureName(limit.entry) + " " + limitText({ ...limit.entry, value: null }) + " (" + limit.fail + ")"])));
  byId("result").append(option(["", "any"]), ...RESULTS.map(([name, , words]) => option([name, words])));
  byId("view").append(option(["list", "list"]), option(["matrix", "matrix"]));
  byId("filter").classList.toggle("with-limits", limits.length > 0);
  byId("filter").addEventListener("input", read);
  byId("reset").addEventListener("click", reset);
}

function start() {
  report.assets.forEach((asset, index) => { asset.index = index; });
  document.title = visible(report.title) + " – gltfx report";
  byId("title").textContent = visible(report.title);
  const rules = ruleCounts();
  limits = limitCounts();
  fillSummary();
  fillOverview(rules);
  fillFilter(rules);
  byId("more").addEventListener("click", showMore);
  new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting) && !byId("more").hidden) showMore();
  }, { rootMargin: "600px" }).observe(byId("more"));
  document.querySelector(".theme").addEventListener("change", chooseTheme);
  byId("about").textContent = "gltfx " + report.gltfx + ", profile " + report.profile + ", images: " + report.pixels;
  document.addEventListener("keydown", searchByKey);
  window.addEventListener("hashchange", followLink);
  readAddress();
}

start();
