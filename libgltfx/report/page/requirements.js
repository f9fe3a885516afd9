// SPDX-License-Identifier: Apache-2.0
// Requirements: limits and what was measured, of one asset and over all.

const RESULTS = [["fail", "✗", "fail"], ["not-measured", "?", "not measured"], ["pass", "✓", "pass"],
  ["not-applicable", "–", "not applicable"]];
const ELEMENTS_AT_ONCE = 3;

/** Colour of a result: a limit that does not hold has that of its finding. */
function toneOf(result, severity) {
  return result === "pass" ? "good" : result === "fail" ? severity : "hint";
}

function resultMark(result, severity) {
  const [, sign, words] = RESULTS.find(([name]) => name === result);
  return make("span.result.is-" + toneOf(result, severity), {}, make("span", { "aria-hidden": "true" }, sign), " " + words);
}

/** A number as people write it: whole ones in full, others with four digits. */
function numberText(number) {
  if (Number.isInteger(number)) return Math.abs(number) < 1e15 ? grouped(number) : String(number);
  const short = Number(number.toPrecision(4));
  return Number.isInteger(short) && Math.abs(short) < 1e15 ? grouped(short) : String(short);
}

function withUnit(text, unit) {
  return unit ? text + "\u00a0" + unit : text;
}

/** A value of a measure; `exact`: with all digits. */
function valueText(value, unit, exact) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value === "string") return "‘" + visible(value) + "’";
  if (Array.isArray(value)) return value.length > 0 ? value.map(visible).join(", ") : "none";
  if (exact) return withUnit(Number.isInteger(value) ? grouped(value) : String(value), unit);
  return unit === "B" ? sizeText(value) : withUnit(numberText(value), unit);
}

/** Whether a value and its limit differ only in digits that are left out. */
function needsDigits(entry) {
  return typeof entry.value === "number" && entry.value !== entry.limit &&
    valueText(entry.value, entry.unit) === valueText(entry.limit, entry.unit);
}

function limitText(entry) {
  const limit = valueText(entry.limit, entry.unit, needsDigits(entry));
  switch (entry.op) {
    case "max": return "≤ " + limit;
    case "min": return "≥ " + limit;
    case "equal": return "= " + limit;
    case "match": return "matches " + visible(entry.limit);
    case "deny-match": return "does not match " + visible(entry.limit);
    case "unique": return entry.limit === false ? "any" : "unique";
    case "allow": return "only " + limit;
    default: return "not " + limit;
  }
}

/** "triangles", "mesh hard-edges (angle 30 deg)". */
function measureName(entry) {
  const name = (entry.on === "asset" ? "" : entry.on + " ") + entry.measure;
  return entry.parameters ? name + " (" + visible(entry.parameters) + ")" : name;
}

/** "5 meshes": those that a limit does not hold for; empty for the asset itself. */
function shareText(entry) {
  const outside = (entry.failed || 0) + (entry.notMeasured || 0);
  return outside === 0 || entry.on === "asset" ? "" : counted(outside, entry.on, entry.on + (entry.on === "mesh" ? "es" : "s"));
}

/** What an earlier run measured, and the result if it was another one. */
function beforeText(entry) {
  if (!entry.before) return make("span.soft", {}, "–");
  const result = entry.before.verdict;
  const value = valueText(entry.before.value, entry.unit);
  if (result === entry.verdict) return make("span", {}, value === valueText(entry.value, entry.unit) ? "same" : value);
  return make("span", {}, value + " ", resultMark(result, entry.severity));
}

function elementText(element, entry) {
  return make("span", {}, isolated(element.object || element.pointer), " ", make("span.soft", {},
    valueText(element.value, entry.unit, needsDigits({ ...entry, value: element.value }))));
}

/** The elements that a limit does not hold for, the first in sight. */
function elementsPart(entry) {
  const all = entry.elements || [];
  if (all.length === 0) return null;
  const lines = all.map((element) => make("li", {}, elementText(element, entry)));
  const outside = (entry.failed || 0) + (entry.notMeasured || 0);
  const left = outside - all.length;
  if (left > 0) lines.push(make("li.soft", {}, grouped(left) + " more"));
  if (lines.length <= ELEMENTS_AT_ONCE) return make("ul.elements", {}, lines);
  return make("details", {}, make("summary", {}, "which"), make("ul.elements", {}, lines));
}

const RESULT_ORDER = RESULTS.map(([name]) => name);
const byResult = (a, b) => RESULT_ORDER.indexOf(a.verdict) - RESULT_ORDER.indexOf(b.verdict);

/** The requirements of one asset, those that do not hold first. */
function requirementsPart(asset) {
  const all = asset.requirements || [];
  if (all.length === 0) return null;
  const trend = all.some((entry) => entry.before);
  const columns = [["result"], ["measure"], ["value"], ["limit"], ...(trend ? [["before"]] : []), ["stated in"]];
  const rows = all.slice().sort(byResult).map((entry) => [resultMark(entry.verdict, entry.severity),
    make("span", {}, make("span.mono", {}, measureName(entry)), " ", make("span.soft", {}, shareText(entry)), elementsPart(entry)),
    make("span", {}, valueText(entry.value, entry.unit, needsDigits(entry))), make("span", {}, limitText(entry)),
    ...(trend ? [beforeText(entry)] : []), make("span.soft", {}, isolated(entry.from))]);
  const notes = asset.unlistedRequirements ? make("p.soft", {}, counted(asset.unlistedRequirements, "more limit") + " not listed.") : null;
  return make("section.requirements", {}, table("Requirements", columns, rows), notes);
}

// --- Over all assets ---

/** Each limit with the numbers of assets by result, those with most failures first. */
function limitCounts() {
  const counts = new Map();
  for (const asset of report.assets) {
    for (const entry of asset.requirements || []) {
      const { key } = entry;
      const limit = counts.get(key) || { key, entry, "fail": 0, "not-measured": 0, "pass": 0, "not-applicable": 0, before: 0, compared: 0, from: new Set() };
      ++limit[entry.verdict];
      limit.from.add(entry.from);
      if (entry.before) ++limit.compared;
      if (entry.before && entry.before.verdict === "fail") ++limit.before;
      counts.set(key, limit);
    }
  }
  return [...counts.values()].sort((a, b) => b.fail - a.fail || b["not-measured"] - a["not-measured"]
    || (a.key < b.key ? -1 : 1));
}

function limitTable(limits) {
  const trend = limits.some((limit) => limit.compared > 0);
  const number = (limit, result) => (limit[result] === 0 ? make("span.soft", {}, "0")
    : make("a", { href: "#" + addressOf({ requirement: limit.key, result }), "aria-label":
      grouped(limit[result]) + " " + RESULTS.find(([name]) => name === result)[2] + ": " + measureName(limit.entry) }, grouped(limit[result])));
  const rows = limits.map((limit) => [make("span.mono", {}, measureName(limit.entry)), limitText({ ...limit.entry, value: null }),
    make("span.label.is-" + limit.entry.severity, {}, limit.entry.severity),
    make("span.soft.line", {}, isolated([...limit.from].join(", "))), number(limit, "fail"),
    ...(trend ? [make("span", {}, limit.compared > 0 ? grouped(limit.before) : "–")] : []),
    number(limit, "not-measured"), number(limit, "pass"), number(limit, "not-applicable")]);
  return table("Limits, and in how many assets they hold", [["measure"], ["limit"], ["severity"], ["stated in"],
    ["fail", true], ...(trend ? [["failed before", true]] : []), ["not measured", true], ["pass", true],
    ["not applicable", true]], rows);
}

/** Whether an asset has a limit with a result; empty texts stand for any. */
function requirementMatches(asset, key, result) {
  return (asset.requirements || []).some((entry) => (key === "" || entry.key === key) &&
    (result === "" || entry.verdict === result));
}

// --- The matrix: assets and limits ---

/** A value in few signs: the beginning of a text, the first of a set. */
function shortValue(entry) {
  const { value } = entry;
  if (typeof value === "string" && value.length > 20) return valueText(value.slice(0, 18) + "…");
  if (Array.isArray(value) && value.length > 1) return visible(value[0]) + " +" + (value.length - 1);
  return valueText(value, entry.unit, needsDigits(entry));
}

function matrixCell(entry) {
  if (!entry) return make("td.num.soft", {}, make("span", { "aria-hidden": "true" }, "·"), make("span.hidden", {}, "no limit"));
  const result = entry.verdict;
  const [, sign, words] = RESULTS.find(([name]) => name === result);
  const share = shareText(entry) ? make("small", {}, shareText(entry)) : null;
  const before = entry.before && valueText(entry.before.value, entry.unit) !== valueText(entry.value, entry.unit)
    ? make("small", {}, "was " + shortValue({ ...entry, ...entry.before })) : null;
  return make("td.num.on-" + toneOf(result, entry.severity), {}, make("span.result.is-" + toneOf(result, entry.severity), {},
    make("span", { "aria-hidden": "true" }, sign), make("span.hidden", {}, words)), " ",
  make("span", {}, shortValue(entry)), share, before);
}

/** The head of a matrix with these limits. */
function matrixHead(limits) {
  return make("tr", {}, make("th", { scope: "col" }, "asset"), limits.map((limit) =>
    make("th.num", { scope: "col" }, make("span", {}, measureName(limit.entry)), make("small", {}, limitText({ ...limit.entry, value: null })))));
}

function matrixRow(asset, limits) {
  const own = new Map((asset.requirements || []).map((entry) => [entry.key, entry]));
  const cut = asset.path.lastIndexOf("/") + 1;
  const folder = cut > 0 ? make("small", {}, isolated(asset.path.slice(0, cut))) : null;
  return make("tr", {}, make("th", { scope: "row" }, folder,
    make("a", { href: "#" + addressOf({ asset: asset.path }) }, isolated(asset.path.slice(cut)))),
    limits.map((limit) => matrixCell(own.get(limit.key))));
}
