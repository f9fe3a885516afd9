// SPDX-License-Identifier: Apache-2.0
// The page of a comparison: totals, the filter, a list of pairs with pictures and changes. It comes before its data,
// which it shows while the browser still reads: a page of 1,000 pairs has tens of megabytes.

const data = { pairs: [], summary: null };
const ROWS_AT_ONCE = 20;
const READ_AGAIN = 100;  // milliseconds
const CHANGES_AT_ONCE = 100;
const MOST_REGIONS = 40;
const BLINK = 700;  // milliseconds
const LEVELS = ["differs", "bounds", "storage", "identical"];
const VIEWS = { usual: "Usual view", opposite: "From the other side", change: "The change" };
const MODES = { side: "Side by side", slider: "Slider", blink: "Blink", difference: "Difference" };
const state = { text: "", level: "", kind: "" };

// --- What is said of a pair ---

const isWhole = (pair) => pair.old !== null && pair.new !== null;

function levelOf(pair) {
  if (pair.error) return "unreadable";
  return pair.level;
}

function levelText(pair) {
  if (pair.error) return make("span.is-error", {}, "not compared");
  if (pair.old === null) return make("span.is-differs", {}, "added");
  if (pair.new === null) return make("span.is-differs", {}, "removed");
  return make("span.is-" + pair.level, {}, pair.level);
}

function kindCounts(pair) {
  const counts = new Map();
  for (const change of pair.changes) counts.set(change.kind, (counts.get(change.kind) || 0) + 1);
  return [...counts.entries()].sort((a, b) => b[1] - a[1] || (a[0] < b[0] ? -1 : 1));
}

function sentence(change) {
  return (change.name && !change.what.startsWith('renamed "') ? "\u2018" + visible(change.name) + "\u2019 " : "") + visible(change.what);
}

/** The first changes in words; of many the kinds. */
function headline(pair) {
  if (pair.error) return visible(pair.error);
  const kinds = kindCounts(pair);
  const few = pair.changes.length <= 2;
  const named = (change) => (change.name ? "" : visible(change.new || change.old || "") + " ") + sentence(change);
  const parts = few ? pair.changes.map(named) : kinds.slice(0, 4).map(([kind, count]) => count + " " + kind);
  if (!few && kinds.length > 4) parts.push(counted(kinds.length - 4, "more kind"));
  if (pair.unproven.length > 0) parts.push(counted(pair.unproven.length, "part") + " not proven");
  return parts.join(few ? "; " : ", ");
}

function filesOf(pair) {
  return (pair.sizes || []).find((one) => one.what === "files");
}

function sizeChange({ old: before, new: after }) {
  if (before === 0) return "";
  const part = 100 * (after - before) / before;
  const sign = part > 0 ? "+" : "";
  if (Math.abs(part) < 0.05) return sign + (after - before) + " B";
  return sign + part.toFixed(Math.abs(part) < 10 ? 1 : 0) + " %";
}

function placeText(pointer, line, column) {
  const place = line ? " (" + line + ":" + column + ")" : "";
  return [make("span.mono", {}, isolated(pointer === "" ? "(whole asset)" : pointer)), place];
}

function placeOf(change) {
  const before = change.old === null ? null : placeText(change.old, change.oldLine, change.oldColumn);
  const after = change.new === null ? null : placeText(change.new, change.newLine, change.newColumn);
  if (before === null) return after;
  if (after === null) return before;
  if (change.old !== change.new) return [...before, " → ", ...after];
  const same = change.oldLine === change.newLine && change.oldColumn === change.newColumn;
  return same ? before : [...before, " →", after[1]];
}

function measureText({ quantity, value, unit, bound }) {
  const number = (one) => (one === null ? "∞" : Number(one.toPrecision(3)).toString());
  const end = unit === "" ? "" : unit === "%" || unit === "/255" ? unit : " " + unit;
  return [quantity + " " + number(value) + end, make("span.kind", {}, "bound " + number(bound) + end)];
}

// --- Pictures ---

let timer = 0;

function stopBlinking() {
  clearInterval(timer);
  timer = 0;
}

/** An image of the page by its id. */
function image(id, alt, ...classes) {
  return make(["img", ...classes].join("."), { src: byId(id).value, alt, draggable: "false", decoding: "async" });
}

const isCompared = (picture) => Boolean(picture.old && picture.new);

/** Where the objects of changes are: dashed in the old asset, bold that of the picked one. Of very many only that one.
 * `side`: of one of both only. */
function regionsOf(picture, picked, side) {
  const all = picture.regions || [];
  const few = all.length <= MOST_REGIONS;
  const meant = (one) => (few || one.change === picked) && (side !== "old" || one.old) && (side !== "new" || !one.old);
  return all.filter(meant).map((one) => {
    const kind = (one.old ? "old" : "new") + (one.change === picked ? ".bold" : "");
    const box = make("div.region." + kind, { "aria-hidden": "true" });
    box.style.left = 100 * one.left + "%";
    box.style.top = 100 * one.top + "%";
    box.style.width = 100 * (one.right - one.left) + "%";
    box.style.height = 100 * (one.bottom - one.top) + "%";
    return box;
  });
}

function framed(caption, frame) {
  return make("figure", {}, frame, make("figcaption", {}, caption));
}

/** Old, new and what differs beside each other. */
function sideBySide(picture, picked) {
  const same = picture.changed === false;
  const shown = [["old", "Old"], ["new", same ? "Old and new" : "New"], ["difference", "Difference: orange where pixels changed"]];
  return shown.filter(([name]) => picture[name]).map(([name, words]) =>
    framed(words, make("div.frame", {}, image(picture[name], words), regionsOf(picture, picked, same ? "" : name))));
}

function slider(picture, picked) {
  const frame = make("div.frame.slides", {}, image(picture.old, "Old"), image(picture.new, "New", "upper"),
    make("div.edge"), make("span.side-name.at-left", {}, "old"), make("span.side-name.at-right", {}, "new"),
    regionsOf(picture, picked));
  const range = make("input.slide", { type: "range", min: 0, max: 100, value: 50, step: 1,
    "aria-label": "Part of the old picture that is shown, in percent" });
  const show = () => frame.style.setProperty("--cut", range.value + "%");
  range.addEventListener("input", show);
  const drag = (event) => {
    if (event.buttons === 0 && event.type !== "pointerdown") return;
    const box = frame.getBoundingClientRect();
    range.value = String(Math.round(100 * (event.clientX - box.left) / box.width));
    show();
  };
  frame.addEventListener("pointerdown", drag);
  frame.addEventListener("pointermove", drag);
  return [framed("Old on the left, new on the right", frame), range];
}

function blink(picture, picked) {
  const before = image(picture.old, "Old");
  const after = image(picture.new, "New", "off");
  const name = make("span.side-name.at-left", {}, "old");
  const frame = make("div.frame", {}, before, after, name, regionsOf(picture, picked));
  const swap = () => {
    const isOld = after.classList.toggle("off");
    before.classList.toggle("off", !isOld);
    name.textContent = isOld ? "old" : "new";
  };
  const step = make("button", { type: "button" }, "Swap");
  const run = make("button", { type: "button", "aria-pressed": "false" }, "Blink");
  const start = (on) => {
    stopBlinking();
    if (on) timer = setInterval(swap, BLINK);
    run.setAttribute("aria-pressed", String(on));
    run.textContent = on ? "Pause" : "Blink";
  };
  step.addEventListener("click", () => { start(false); swap(); });
  run.addEventListener("click", () => start(timer === 0));
  start(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  return [framed("Old and new in turn", frame), make("div.choices", {}, step, run)];
}

function difference(picture, picked) {
  return [framed("Orange where pixels changed, on the new picture",
    make("div.frame", {}, image(picture.difference, "Difference"), regionsOf(picture, picked)))];
}

const DRAWERS = { side: sideBySide, slider, blink, difference };

function radios(name, legend, entries, chosen, use) {
  const group = make("fieldset.theme", {}, make("legend.hidden", {}, legend));
  for (const [value, words] of entries) {
    const input = make("input", { type: "radio", name, value, checked: value === chosen });
    group.append(make("label", {}, input, make("span", {}, words)));
  }
  group.addEventListener("change", (event) => use(event.target.value));
  return group;
}

function check(group, value) {
  for (const input of group.querySelectorAll("input")) input.checked = input.value === value;
}

function verdictOf(picture) {
  if (picture.changed === undefined) return "";
  const number = (one) => (one < 10 ? one.toFixed(1) : one.toFixed(0));
  const noise = picture.limit > 1 ? "; noise explains " + number(picture.limit) : "";
  const steps = number(picture.distance) + " of 255 steps" + noise + ".";
  if (picture.changed) return "The picture changes by up to " + steps;
  return picture.limit > 1 ? "No visible change: it differs by " + steps : "No visible change.";
}

let pictures = 0;  // groups of buttons on the page

/** The pictures of a pair, and a function that shows a change in them. */
function pictureParts(pair) {
  const all = pair.pictures || [];
  if (all.length === 0) {
    const why = pair.pictureProblem;
    return { part: why ? make("p.note", {}, "No pictures: " + visible(why)) : null, show: () => false };
  }
  const group = "picture" + (++pictures);
  const both = all.some(isCompared);
  const best = all.reduce((most, one) => (one.distance > most.distance ? one : most), all[0]);
  const shown = { view: best.view, mode: "side", picked: null };
  const stage = make("div.stage");
  const verdict = make("p.verdict-of-view");
  const find = (view) => all.find((one) => one.view === view);
  const draw = () => {
    stopBlinking();
    const picture = find(shown.view);
    const mode = isCompared(picture) ? shown.mode : "side";
    stage.className = "stage " + mode;
    stage.replaceChildren(...DRAWERS[mode](picture, shown.picked));
    verdict.textContent = verdictOf(picture);
  };
  const views = radios(group + "-view", "View", all.map((one) => [one.view, VIEWS[one.view] || one.view]),
    shown.view, (view) => { shown.view = view; draw(); });
  const modes = radios(group + "-mode", "Comparison", Object.entries(MODES), shown.mode,
    (mode) => { shown.mode = mode; draw(); });
  const show = (index) => {
    shown.picked = index;
    const holds = (one) => (one.regions || []).some((region) => region.change === index);
    const own = all.find((one) => one.change === index);
    const seen = own || (holds(find(shown.view)) ? find(shown.view) : all.find(holds));
    if (seen) shown.view = seen.view;
    check(views, shown.view);
    draw();
    return Boolean(seen);
  };
  draw();
  const choices = make("div.choices", {}, both ? modes : null, all.length > 1 ? views : null);
  const part = make("div.pair-body", {}, choices, verdict, stage,
    pair.pictureProblem ? make("p.note", {}, visible(pair.pictureProblem)) : null);
  part.className = "pictures-part";
  part.addEventListener("keydown", (event) => {
    const mode = Object.keys(MODES)[Number(event.key) - 1];
    if (!both || !mode || event.ctrlKey || event.metaKey || event.altKey) return;
    shown.mode = mode;
    check(modes, mode);
    draw();
  });
  return { part, show };
}

// --- Changes of a pair ---

function changeMatches(change) {
  if (state.kind && change.kind !== state.kind) return false;
  return !["differs", "bounds"].includes(state.level) || change.level === state.level;
}

/** Whether a value is short, and the sentence does not say it. */
const isUnsaid = (change, side) => change[side] !== undefined && !change.what.includes(change[side]);

function changeRow(change, index, values, pick) {
  const button = make("button.pick", { type: "button" }, make("bdi", {}, sentence(change)));
  const row = make("tr", {},
    make("td.level", {}, make("span.label.is-" + change.level, {}, change.level)),
    make("td.said", {}, button, make("span.kind", {}, change.kind, make("span.narrow", {}, ", " + change.level))),
    values.map((side) => make("td.value", {}, isUnsaid(change, side) ? isolated(change[side]) : "")),
    make("td.measure", {}, change.measure ? measureText(change.measure) : ""),
    make("td.place", {}, placeOf(change),
      change.also ? make("span.kind", {}, "also " + counted(change.also.length, "place") + ": " +
        visible(change.also.slice(0, 5).join(", "))) : null));
  button.addEventListener("click", () => pick(index, row, true));
  return row;
}

function changeTable(pair, show, stage) {
  const all = pair.changes.map((change, index) => [change, index]).filter(([change]) => changeMatches(change));
  if (all.length === 0) {
    return make("p.soft", {}, pair.changes.length === 0 ? "No change that counts." : "No change passes the filter.");
  }
  const values = ["before", "after"].filter((side) => all.some(([change]) => isUnsaid(change, side)));
  const body = make("tbody");
  const pick = (index, row, scroll) => {
    for (const other of body.querySelectorAll(".picked")) other.classList.remove("picked");
    row.classList.add("picked");
    const target = show(index) ? stage : row;
    if (scroll) target.scrollIntoView({ block: "nearest", behavior: "smooth" });
  };
  const more = make("button.more", { type: "button" }, "Show more changes");
  const add = () => {
    const from = body.childElementCount;
    body.append(...all.slice(from, from + CHANGES_AT_ONCE).map(([change, index]) => changeRow(change, index, values, pick)));
    more.hidden = body.childElementCount >= all.length;
  };
  more.addEventListener("click", add);
  add();
  const head = [["level", "level"], ["said", "change"], ...values.map((side) => ["value", side]), ["measure", "measure"],
    ["place", "place (line:column)"]];
  const caption = counted(all.length, "change") + (all.length < pair.changes.length ? " of " + pair.changes.length : "");
  const content = make("table.changes", {}, make("caption", {}, caption),
    make("thead", {}, make("tr", {}, head.map(([kind, title]) => make("th." + kind, { scope: "col" }, title)))), body);
  const framedChange = (pair.pictures || []).find((one) => one.change !== undefined && one.change !== null);
  const first = framedChange ? all.findIndex(([, index]) => index === framedChange.change) : all.length === 1 ? 0 : -1;
  if (first >= 0 && first < body.childElementCount) body.children[first].classList.add("picked");
  if (first >= 0) show(all[first][1]);
  return make("div", {}, make("div.scroll", { tabindex: "0", role: "group", "aria-label": "Changes" }, content), more);
}

function sizeTable(pair) {
  const rows = (pair.sizes || []).filter((one) => one.old !== one.new).map((one) => [one.what, sizeText(one.old), sizeText(one.new), sizeChange(one)]);
  if (rows.length === 0) return null;
  return table("Bytes in files", [["use"], ["old", true], ["new", true], ["change", true]], rows);
}

function sentences(title, texts) {
  if (texts.length === 0) return null;
  return make("div", {}, make("h4", {}, title),
    make("ul.plain", {}, texts.map((text) => make("li", {}, isolated(text)))));
}

function details(pair) {
  const { part, show } = pictureParts(pair);
  const isOne = !isWhole(pair) || pair.old === pair.new;
  const paths = isOne ? [isolated(pair.old || pair.new)] : [isolated(pair.old), " → ", isolated(pair.new)];
  return make("div.pair-body", {}, make("p.path-line", {}, paths),
    pair.error ? make("p.note", {}, visible(pair.error)) : null, part,
    isWhole(pair) && !pair.error ? changeTable(pair, show, part || document.body) : null,
    sentences("Could not be compared", pair.unproven), sentences("Stored differently", pair.storage), sizeTable(pair));
}

// --- The list ---

let shownPairs = [];

function words(pair) {
  if (pair.words === undefined) {
    const changes = pair.changes.map((one) => [one.kind, one.name, one.what, one.old, one.new].join(" "));
    pair.words = [pair.old, pair.new, pair.error, ...changes, ...pair.storage, ...pair.unproven].join("\n").toLowerCase();
  }
  return pair.words;
}

function pairMatches(pair) {
  if (state.level === "unproven" ? pair.unproven.length === 0 : state.level && levelOf(pair) !== state.level) {
    const changes = ["differs", "bounds"].includes(state.level) && pair.changes.some((one) => one.level === state.level);
    if (!changes) return false;
  }
  if (state.kind && !pair.changes.some(changeMatches)) return false;
  return !state.text || words(pair).includes(state.text);
}

/** The old and the new picture of a pair that looks different, else one. */
function thumbs(pair) {
  const all = pair.pictures || [];
  const picture = all.find((one) => one.changed) || all[0];
  const ids = picture ? [picture.old, picture.new].filter((id) => id !== null) : [];
  const shown = ids.map((id) => make("img.thumb", { src: byId(id).value, alt: "", width: 48, height: 48, decoding: "async" }));
  if (shown.length === 0) shown.push(make("span.thumb.none", { "aria-hidden": "true" }, "–"));
  return make("span.thumbs", {}, shown);
}

function pathPart(pair) {
  const path = pair.new === null ? pair.old : pair.new;
  const cut = path.lastIndexOf("/") + 1;
  const folder = cut > 0 ? make("span.folder", {}, isolated(path.slice(0, cut))) : null;
  return make("span.path", {}, folder, make("h3", {}, isolated(path.slice(cut))));
}

function row(pair) {
  const files = filesOf(pair);
  const summary = make("summary", {}, thumbs(pair), pathPart(pair),
    make("span.state", {}, levelText(pair), make("span.to-do", {}, headline(pair))),
    make("span.cell.bytes", {}, files ? sizeText(files.new) : "–",
      make("small", {}, files && files.old !== files.new ? "was " + sizeText(files.old) : "bytes")));
  const folded = make("details.asset.pair", {}, summary);
  folded.addEventListener("toggle", () => {
    if (folded.open && folded.childElementCount === 1) folded.append(details(pair));
    if (!folded.open) {
      stopBlinking();
      folded.lastElementChild.remove();  // its pictures take memory
    }
  });
  return make("li", {}, folded);
}

function showMore() {
  const from = byId("list").childElementCount;
  byId("list").append(...shownPairs.slice(from, from + ROWS_AT_ONCE).map(row));
  byId("more").hidden = byId("list").childElementCount >= shownPairs.length;
}

function showCount() {
  const all = counted(data.pairs.length, "pair");
  const shown = shownPairs.length === data.pairs.length ? all : grouped(shownPairs.length) + " of " + all;
  byId("count").textContent = shown + (data.summary === null ? " so far" : "");
}

function refresh() {
  stopBlinking();
  shownPairs = data.pairs.filter(pairMatches);
  byId("list").replaceChildren();
  showMore();
  showCount();
}

/** New pairs below those that are shown. */
function addPairs(pairs) {
  data.pairs.push(...pairs);
  shownPairs.push(...pairs.filter(pairMatches));
  if (byId("list").childElementCount < ROWS_AT_ONCE) showMore();
  byId("more").hidden = byId("list").childElementCount >= shownPairs.length;
  fillSummary();
  showCount();
}

// --- Totals and filter ---

function fillSummary() {
  const counts = { differs: 0, bounds: 0, storage: 0, identical: 0, unreadable: 0 };
  for (const pair of data.pairs) ++counts[levelOf(pair)];
  const differ = counts.differs;
  const number = make("strong" + (differ > 0 ? ".is-differs" : ".is-good"), {}, differ > 0 ? counted(differ, "pair") : "No pair");
  const names = { differs: counts.differs === 1 ? "differs" : "differ", bounds: "within bounds", storage: "stored differently",
    identical: "identical", unreadable: "not compared" };
  const parts = Object.keys(counts).map((level) => [level, grouped(counts[level]) + " " + names[level], counts[level]]);
  const sum = (side) => data.pairs.reduce((total, pair) => total + (filesOf(pair) ? filesOf(pair)[side] : 0), 0);
  const figures = [["Pairs", grouped(data.pairs.length)],
    ["Changes", grouped(data.pairs.reduce((total, pair) => total + pair.changes.length, 0))],
    ["Added", grouped(data.pairs.filter((pair) => pair.old === null).length)],
    ["Removed", grouped(data.pairs.filter((pair) => pair.new === null).length)],
    ["Not proven", grouped(data.pairs.filter((pair) => pair.unproven.length > 0).length)],
    ["Bytes of pairs", sizeText(sum("old")) + " → " + sizeText(sum("new"))]];
  const allowed = data.summary !== null && data.summary.allowed ? "All are within the allowed level." : "";
  byId("summary").replaceChildren(byId("summary-title"),
    make("p.verdict", {}, number, differ > 1 ? " differ. " : " differs. ", allowed), ...bar(parts),
    make("dl.figures", {}, figures.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value)))));
}

function listenToFilter() {
  const read = () => {
    for (const name of Object.keys(state)) state[name] = byId(name).value;
    state.text = state.text.trim().toLowerCase();
    refresh();
  };
  for (const name of Object.keys(state)) byId(name).addEventListener("input", read);
  byId("reset").addEventListener("click", () => {
    for (const name of Object.keys(state)) byId(name).value = "";
    read();
  });
}

function fillFilter() {
  const option = ([value, text]) => make("option", { value }, text);
  const count = (level) => data.pairs.filter((pair) => levelOf(pair) === level).length;
  byId("level").append(...LEVELS.map((level) => option([level, level + " (" + count(level) + ")"])),
    option(["unproven", "not proven (" + data.pairs.filter((pair) => pair.unproven.length > 0).length + ")"]),
    option(["unreadable", "not compared (" + count("unreadable") + ")"]));
  const kinds = new Map();
  for (const pair of data.pairs) {
    for (const [kind, amount] of kindCounts(pair)) kinds.set(kind, (kinds.get(kind) || 0) + amount);
  }
  byId("kind").append(
    ...[...kinds.entries()].sort().map(([kind, amount]) => option([kind, kind + " (" + amount + ")"])));
}

// --- Reading ---

let lastRead = null;

function readHead({ gltfx, title }) {
  document.title = visible(title) + " – gltfx compare";
  byId("title").textContent = visible(title);
  byId("about").textContent = "gltfx " + gltfx;
}

/** Takes what the browser has read. `all`: also what nothing follows yet. */
function readStore(all) {
  const store = byId("store");
  const pairs = [];
  let next = lastRead ? lastRead.nextElementSibling : store && store.firstElementChild;
  for (; next && (all || next.nextElementSibling); next = next.nextElementSibling) {
    lastRead = next;
    if (next.localName !== "script") continue;
    const content = JSON.parse(next.textContent);
    if (next.id === "head") readHead(content);
    else if (next.id === "tail") data.summary = content;
    else pairs.push(content);
  }
  return pairs;
}

function readMore() {
  if (data.summary !== null) return;
  const pairs = readStore(false);
  if (pairs.length > 0) addPairs(pairs);
  setTimeout(readMore, READ_AGAIN);
}

function readRest() {
  addPairs(readStore(true));
  fillFilter();
  if (data.pairs.length === 1) byId("list").querySelector("details").open = true;
}

function start() {
  listenToFilter();
  byId("more").addEventListener("click", showMore);
  new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting) && !byId("more").hidden) showMore();
  }, { rootMargin: "600px" }).observe(byId("more"));
  document.querySelector(".theme").addEventListener("change", chooseTheme);
  document.addEventListener("keydown", searchByKey);
  document.addEventListener("DOMContentLoaded", readRest);
  readMore();
}

start();
