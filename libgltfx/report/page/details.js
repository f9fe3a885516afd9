// SPDX-License-Identifier: Apache-2.0
// One asset, unfolded. Built when it is opened.

const SEVERITIES = ["error", "warning", "info", "hint"];
const FINDINGS_AT_ONCE = 20;
const USES = ["images", "meshes", "animations", "skins", "json", "other", "unused", "base64", "padding"];

function place(finding) {
  const parts = [];
  if (finding.line) parts.push(make("span.mono", {}, "line " + finding.line + ", column " + finding.column));
  if (finding.offset !== undefined) parts.push(make("span.mono", {}, "byte " + finding.offset));
  if (finding.pointer) parts.push(make("span.mono", {}, isolated(finding.pointer)));
  if (finding.object) parts.push(make("span", {}, "‘", isolated(finding.object), "’"));
  const joined = parts.flatMap((part, i) => (i === 0 ? [part] : [" · ", part]));
  return parts.length > 0 ? make("p.where", {}, joined) : null;
}

function excerpt(finding) {
  if (!finding.excerpt) return null;
  const { text, caret, width, cutLeft, cutRight } = finding.excerpt;
  const signs = Array.from(text);
  const part = (from, to) => visible(signs.slice(from, to).join(""));
  return make("pre.excerpt", { tabindex: "0", role: "group", "aria-label": "Line " + finding.line },
    make("span.line", { "aria-hidden": "true" }, String(finding.line)),
    make("bdi", {}, cutLeft ? "…" : "", part(0, caret),
      make("mark", {}, part(caret, caret + width) || " "), part(caret + width), cutRight ? "…" : ""));
}

/** Scrolls a line that does not fit to its marked part. */
function scrollToMark(line) {
  const mark = line.querySelector("mark");
  if (mark.offsetLeft + mark.offsetWidth > line.offsetLeft + line.clientWidth) {
    line.scrollLeft = mark.offsetLeft - line.offsetLeft - line.clientWidth / 3;
  }
}

function repeats(finding) {
  if (!finding.count) return null;
  return make("p.where", {}, "Repeated " + counted(finding.count - 1, "more time", "more times") + ", last at ",
    make("span.mono", {}, isolated(finding.lastPointer)));
}

function findingItem(finding) {
  const rule = report.rules[finding.code];
  const help = finding.help || (rule ? rule.help : "");
  return make("li.finding." + finding.severity, {},
    make("p", {}, make("span.label.is-" + finding.severity, {}, finding.severity), " ", isolated(finding.message)),
    place(finding),
    excerpt(finding),
    repeats(finding),
    finding.fixable ? make("p.help", {}, make("b", {}, "gltfx fix"), " does this.") : null,
    help ? make("p.help", {}, make("b", {}, "To do: "), isolated(help)) : null,
    make("details", {}, make("summary", {}, make("span.code", {}, finding.code)),
      rule ? make("p", {}, rule.summary + ". " + rule.why) : null));
}

/** The findings that pass the filter, some at a time, and notes on others. */
function findingsOf(asset, matches) {
  const shown = asset.findings.filter(matches)
    .sort((a, b) => SEVERITIES.indexOf(a.severity) - SEVERITIES.indexOf(b.severity));
  const list = make("ol.findings");
  const more = make("button", { type: "button" }, "Show more findings");
  const add = () => {
    const from = list.childElementCount;
    list.append(...shown.slice(from, from + FINDINGS_AT_ONCE).map(findingItem));
    requestAnimationFrame(() => list.querySelectorAll(".excerpt").forEach(scrollToMark));
    more.hidden = list.childElementCount >= shown.length;
    if (from > 0) list.children[from].setAttribute("tabindex", "-1"), list.children[from].focus();
  };
  more.addEventListener("click", add);
  add();
  const left = asset.findings.length - shown.length;
  const notes = [];
  if (asset.findings.length === 0) notes.push("No findings.");
  if (left > 0) notes.push(counted(left, "finding") + " outside of the filter.");
  if (asset.truncated) notes.push("More findings are not listed (--max-issues).");
  if (asset.unverified > 0) notes.push(counted(asset.unverified, "file") + " not verified (Git-LFS pointers).");
  if (asset.suppressed > 0) notes.push(counted(asset.suppressed, "finding") + " known to the baseline.");
  if (asset.leftOut > 0) notes.push(counted(asset.leftOut, "finding") + " left out, as the asset asks.");
  if (asset.findingsOmitted > 0) notes.push(counted(asset.findingsOmitted, "more finding") + ".");
  return [list, more, notes.map((note) => make("p.soft", {}, note))];
}

function findingsPart(asset, matches) {
  return make("section", {}, make("h4", {}, "Findings"), ...findingsOf(asset, matches));
}

/** Unfolded, its findings: those of all severities, which are not among the counts of the page. */
function externalAsset(one) {
  const folded = make("details.external", {}, make("summary", {}, make("span.mono", {}, isolated(one.path)), " · ",
    stateText(one)));
  folded.addEventListener("toggle", () => {
    if (folded.open && folded.childElementCount === 1) folded.append(make("div", {}, ...findingsOf(one, () => true)));
  });
  return folded;
}

function externalPart(asset) {
  const all = asset.externalAssets || [];
  if (all.length === 0) return null;
  return make("section", {}, make("h4", {}, "External assets"), all.map(externalAsset),
    asset.externalAssetsOmitted > 0 ? make("p.soft", {}, counted(asset.externalAssetsOmitted, "more external asset") + ".")
      : null);
}

function upgradePart(asset) {
  if (asset.upgrade.length === 0) return null;
  const steps = asset.upgrade.map((step) => make("li", {},
    make("p.mono", {}, isolated(step.pointer)),
    make("p.soft", {}, make("span.mono", {}, isolated(step.from), step.to ? " → " : "", step.to ? isolated(step.to) : ""),
      " · " + (step.done ? "" : "left alone: ") + step.outcome),
    step.notes.map((note) => make("p.soft", {}, isolated(note.replace(/\.?$/, "."))))));
  return make("section", {}, make("h4", {}, "What gltfx upgrade changes"), make("ol.steps", {}, steps),
    asset.upgradeOmitted > 0 ? make("p.soft", {}, counted(asset.upgradeOmitted, "more object") + ".") : null,
    asset.upgradeProblem ? make("p.soft", {}, "Nothing is done: ", isolated(asset.upgradeProblem)) : null);
}

function picture(shot, caption, name) {
  if (shot.src) {
    return make("figure", {}, make("img", { src: shot.src, width: shot.size, height: shot.size,
      alt: "Preview of " + visible(name) + (caption ? ", " + caption.toLowerCase() : "") }),
    caption ? make("figcaption", {}, caption) : null);
  }
  return shot.problem ? make("p.none", {}, "No picture: ", isolated(shot.problem)) : null;
}

function picturesPart(asset) {
  const before = picture(asset.picture, asset.upgraded ? "As it is" : "", asset.path);
  const after = asset.upgraded ? picture(asset.upgraded, "Upgraded", asset.path) : null;
  return before || after ? make("div.pictures", {}, before, after) : null;
}

/** "32 × 12 × 9.5 cm": the unit is that of the longest side. */
function boundsText(box) {
  const sides = box.max.map((most, i) => most - box.min[i]);
  const longest = Math.max(...sides);
  const [size, unit] = longest < 0.01 ? [0.001, "mm"] : longest < 1 ? [0.01, "cm"] : longest < 1000 ? [1, "m"] : [1000, "km"];
  return sides.map((side) => String(Number((side / size).toPrecision(3)))).join(" × ") + " " + unit;
}

function generalPart(facts) {
  const list = make("dl.facts");
  const add = (name, value) => {
    if (value) list.append(make("dt", {}, name), make("dd", {}, value));
  };
  const counts = facts.counts;
  add("Format", (facts.mimeType === "model/gltf-binary" ? "GLB" : "glTF") + " " + (facts.version || "of no version"));
  add("Generator", facts.generator && isolated(facts.generator));
  add("Copyright", facts.copyright && isolated(facts.copyright));
  add("Extent", facts.bounds && boundsText(facts.bounds));
  add("Triangles", grouped(counts.triangles) + (counts.drawnTriangles === counts.triangles ? ""
    : ", " + grouped(counts.drawnTriangles) + " drawn"));
  add("Vertices", grouped(counts.vertices));
  add("Contents", ["scenes", "nodes", "meshes", "primitives", "materials", "textures", "images", "animations",
    "skins", "cameras", "lights"].filter((kind) => counts[kind] > 0)
    .map((kind) => counted(counts[kind], kind === "meshes" ? "mesh" : kind.slice(0, -1), kind)).join(", "));
  add("GPU memory", "about " + sizeText(facts.gpuBytes.images + facts.gpuBytes.meshes) + " (images "
    + sizeText(facts.gpuBytes.images) + ")");
  return list;
}

function bytesPart(facts) {
  const parts = USES.filter((use) => facts.bytes[use] > 0)
    .sort((a, b) => facts.bytes[b] - facts.bytes[a])
    .map((use) => [use, use + " " + sizeText(facts.bytes[use]), facts.bytes[use]]);
  const files = counted(facts.files.length, "file");
  return make("section", {}, make("h4", {}, sizeText(facts.bytes.total) + " in " + files), bar(parts));
}

function extensionsPart(facts) {
  if (facts.extensions.length === 0) return null;
  return table("Extensions", [["name"], ["status"]], facts.extensions.map((one) => [
    make("span.mono", {}, link(one.spec, visible(one.name))),
    one.status + (one.required ? ", required" : one.used ? "" : ", not declared") + (one.seen ? "" : ", in no object"),
  ]));
}

function named(entry) {
  return make("span", {}, entry.name || entry.uri ? isolated(entry.name || entry.uri) : "#" + entry.index);
}

function title(words, list, all) {
  return list.length < all ? words + ", the largest " + list.length + " of " + grouped(all) : words;
}

const bySize = (a, b) => b.bytes - a.bytes || a.index - b.index;

function imageRow(image) {
  const format = (image.format || "not read").replace("image/", "") + (image.encoding ? " " + image.encoding : "");
  return [named(image), isolated(format), image.width ? image.width + " × " + image.height : "",
    image.colorSpace || "", make("span", {}, visible(image.slots.join(", "))), sizeText(image.bytes),
    sizeText(image.gpuBytes)];
}

function listParts(facts) {
  const parts = [];
  const add = (words, kind, columns, row) => {
    const list = facts[kind].slice().sort(bySize);
    if (list.length > 0) parts.push(table(title(words, list, facts.counts[kind]), columns, list.map(row)));
  };
  add("Images", "images", [["image"], ["format"], ["pixels"], ["space"], ["slots"], ["bytes", true], ["GPU", true]],
    imageRow);
  add("Meshes", "meshes", [["mesh"], ["primitives", true], ["triangles", true], ["vertices", true], ["bytes", true]],
    (mesh) => [named(mesh), grouped(mesh.primitives), grouped(mesh.triangles), grouped(mesh.vertices),
      sizeText(mesh.bytes)]);
  add("Animations", "animations", [["animation"], ["seconds", true], ["channels", true], ["keyframes", true],
    ["bytes", true]], (one) => [named(one), String(Number(one.duration.toPrecision(3))), grouped(one.channels),
    grouped(one.keyframes), sizeText(one.bytes)]);
  return parts;
}

function materialsPart(facts) {
  if (facts.materials.length === 0) return null;
  return table(title("Materials", facts.materials, facts.counts.materials),
    [["material"], ["alpha"], ["textures", true], ["extensions"]], facts.materials.map((one) => [named(one),
      isolated(one.alphaMode.toLowerCase()), grouped(one.textures), isolated(one.extensions.join(", "))]));
}

function problemsPart(facts) {
  if (facts.problems.length === 0) return null;
  return make("section", {}, make("h4", {}, "Not read"), facts.problems.map((one) => make("p", {}, isolated(one))));
}

/** If the browser gives the page no clipboard, the path is selected instead. */
function pathLine(asset) {
  const path = make("bdi.mono", {}, visible(asset.path));
  const button = make("button", { type: "button" }, "Copy path");
  const said = make("span.soft", { role: "status" });
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(asset.path);
      said.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(path);
      said.textContent = "Selected";
    }
  });
  return make("p.path-line", {}, path, " ", button, " ", said);
}

function details(asset, matches) {
  const facts = asset.facts;
  return make("div.body", {},
    make("div.main-side", {}, pathLine(asset), findingsPart(asset, matches), externalPart(asset),
      requirementsPart(asset), upgradePart(asset),
      facts ? listParts(facts) : null, facts ? materialsPart(facts) : null),
    make("div.fact-side", {}, picturesPart(asset), facts ? bytesPart(facts) : null,
      facts ? generalPart(facts) : make("p.soft", {}, "No facts: ", isolated(asset.error || "it could not be read")),
      facts ? extensionsPart(facts) : null, facts ? problemsPart(facts) : null));
}
