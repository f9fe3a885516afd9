// SPDX-License-Identifier: Apache-2.0
"use strict";
// Elements and numbers. Text of assets is set by textContent only: it never becomes markup.

const byId = (id) => document.getElementById(id);

/** An element: classes after the name ("p.note.soft"), attributes, then children or texts. */
function make(name, attributes, ...children) {
  const [tag, ...classes] = name.split(".");
  const element = document.createElement(tag);
  if (classes.length > 0) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value === false || value === undefined) continue;
    element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

const UNSEEN = new RegExp("[\\p{Cc}\\p{Cf}\\p{Co}\\p{Zl}\\p{Zp}\\p{Default_Ignorable_Code_Point}" +
  "\\p{Noncharacter_Code_Point}\\u2800]", "gu");

/** Text of an asset with invisible and reordering characters as escapes. */
function visible(text) {
  return text.replace(UNSEEN, (sign) => {
    const hex = sign.codePointAt(0).toString(16);
    return hex.length > 4 ? "\\u{" + hex + "}" : "\\u" + hex.padStart(4, "0");
  });
}

/** Text of an asset, isolated from the text direction around it. */
function isolated(text) {
  return make("bdi", {}, visible(text));
}

/** "1,234,567". */
function grouped(number) {
  return String(number).replace(/\B(?=(\d{3})+$)/g, ",");
}

/** "1 error", "3 errors"; other words have their own plural. */
function counted(count, one, several) {
  return grouped(count) + " " + (count === 1 ? one : several || one + "s");
}

/** "1.23 MB". */
function sizeText(bytes) {
  const units = ["B", "kB", "MB", "GB", "TB", "PB", "EB"];
  let unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.length) {
    bytes /= 1000;
    ++unit;
  }
  return bytes.toFixed(unit === 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2) + " " + units[unit];
}

/** "12.3 k". */
function shortCount(number) {
  if (number < 10000) return grouped(number);
  const [size, unit] = number < 1e6 ? [1e3, "k"] : number < 1e9 ? [1e6, "M"] : [1e9, "G"];
  return (number / size).toFixed(number / size < 99.95 ? 1 : 0) + " " + unit;
}

/** A table in a scrolling box. Columns: [title, isNumber]. */
function table(caption, columns, rows) {
  const head = columns.map(([title, number]) => make(number ? "th.num" : "th", { scope: "col" }, title));
  const body = rows.map((row) =>
    make("tr", {}, row.map((cell, i) => make(columns[i][1] ? "td.num" : "td", {}, cell))));
  const content = make("table", {}, make("caption", {}, caption),
    make("thead", {}, make("tr", {}, head)), make("tbody", {}, body));
  return make("div.scroll", { tabindex: "0", role: "group", "aria-label": caption }, content);
}

/** Parts of a whole as a bar, with a legend as the alternative. Parts: [class, words, amount]. */
function bar(parts) {
  const shown = parts.filter(([, , amount]) => amount > 0);
  const line = make("div.bar", { "aria-hidden": "true" }, shown.map(([kind, , amount]) => {
    const piece = make("span.fill-" + kind);
    piece.style.flex = amount + " 1 0";
    return piece;
  }));
  const legend = make("ul.legend", {}, shown.map(([kind, words]) =>
    make("li", {}, make("i.fill-" + kind, { "aria-hidden": "true" }), words)));
  return [line, legend];
}

/** A link to another site, if the address is valid. */
function link(address, text) {
  const safe = typeof address === "string" && /^https:\/\//.test(address);
  return safe ? make("a", { href: address, rel: "noreferrer" }, text) : make("span", {}, text);
}

/** "/" goes to the search, as on many sites. */
function searchByKey(event) {
  const typing = ["INPUT", "SELECT", "TEXTAREA"].includes(document.activeElement.tagName) &&
    document.activeElement.type !== "radio";
  if (event.key !== "/" || typing || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  byId("text").focus();
}

function chooseTheme(event) {
  if (event.target.value === "auto") {
    delete document.documentElement.dataset.theme;
  } else {
    document.documentElement.dataset.theme = event.target.value;
  }
}
