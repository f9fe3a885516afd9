// SPDX-License-Identifier: Apache-2.0
// References to resources in the form that the Khronos validator reports and requests.

const unreserved = /[A-Za-z0-9\-._~]/;
const allowed = { path: /[!$&'()*+,;=:@/]/, query: /[!$&'()*+,;=:@/?]/ };
const utf8 = new TextEncoder();

function escapeByte(byte) {
  return "%" + byte.toString(16).toUpperCase().padStart(2, "0");
}

// A lone surrogate is written as three bytes, as if it were a character.
function escapeCharacter(character) {
  const code = character.codePointAt(0);
  if (code < 0xd800 || code > 0xdfff) return Array.from(utf8.encode(character), escapeByte).join("");
  return [0xe0 | (code >> 12), 0x80 | ((code >> 6) & 0x3f), 0x80 | (code & 0x3f)].map(escapeByte).join("");
}

// Escapes what must be escaped, and nothing else.
function normalizeEscapes(text, extra) {
  return text.replace(/%[0-9A-Fa-f]{2}|[^]/gu, (part) => {
    if (part.length === 3 && part[0] === "%") {
      const plain = String.fromCharCode(parseInt(part.slice(1), 16));
      return unreserved.test(plain) ? plain : part.toUpperCase();
    }
    return unreserved.test(part) || extra.test(part) ? part : escapeCharacter(part);
  });
}

// Without "." and "..", except those that lead out of a relative path.
function withoutDots(path, isRelative) {
  if (!/(^|\/)\.\.?(\/|$)/.test(path)) return path;
  const kept = [];
  let endsInFolder = false;
  for (const segment of path.split("/")) {
    endsInFolder = segment === "." || segment === "..";
    if (segment === "..") {
      const above = kept.length > 0 && kept.at(-1) !== "..";
      if (isRelative ? above : kept.length > 1 || (kept.length === 1 && kept[0] !== "")) kept.pop();
      else if (isRelative) kept.push("..");
    } else if (segment !== ".") {
      kept.push(segment);
    }
  }
  if (isRelative && (kept.length === 0 || (kept.length === 1 && kept[0] === ""))) return "./";
  if (endsInFolder || (isRelative && kept.at(-1) === "..")) kept.push("");
  return kept.join("/");
}

function invalid(text, problem, at) {
  return new SyntaxError(`${problem} (at character ${at + 1})\n${text}\n${" ".repeat(at)}^\n`);
}

function schemeOf(text) {
  const end = text.search(/[:/?#\\]/);
  if (end < 0 || text[end] !== ":") return "";
  if (end === 0) throw invalid(text, "Invalid empty scheme", 0);
  if (!/[A-Za-z]/.test(text[0])) throw invalid(text, "Scheme not starting with alphabetic character", 0);
  const bad = text.slice(0, end).search(/[^A-Za-z0-9+\-.]/);
  if (bad >= 0) throw invalid(text, "Illegal scheme character", bad);
  return text.slice(0, end);
}

function normalizeAuthority(text, authority, begin) {
  const host = authority.slice(authority.lastIndexOf("@") + 1);
  const user = authority.slice(0, authority.length - host.length);
  const at = begin + user.length;
  if (host.startsWith("[") && !host.includes("]")) {
    throw invalid(text, "Missing end `]` to match `[` in host", at);
  }
  const [, name, port] = /^(\[.*\]|[^:]*)(?::(.*))?$/su.exec(host);
  const bad = (port ?? "").search(/[^0-9]/);
  if (bad >= 0) throw invalid(text, "Invalid port", at + name.length + 1 + bad);
  const escaped = normalizeEscapes(name, /[!$&'()*+,;=:[\]]/);
  return (
    (user === "@" ? "" : normalizeEscapes(user, allowed.path)) +
    escaped.replace(/%..|[A-Z]/g, (part) => (part.length > 1 ? part : part.toLowerCase())) +
    (port ? ":" + Number(port) : "")
  );
}

/** Throws SyntaxError for an invalid reference. */
export function normalizeUri(text) {
  const scheme = schemeOf(text);
  if (/^data$/i.test(scheme)) return "data" + text.slice(4);
  const rest = text.slice(scheme === "" ? 0 : scheme.length + 1);
  const [, beforeQuery, query, fragment] = /^([^?#]*)(\?[^#]*)?(#[^]*)?$/.exec(rest);
  let path = beforeQuery.replaceAll("\\", "/");
  let authority;
  if (path.startsWith("//")) {
    const end = path.indexOf("/", 2);
    authority = path.slice(2, end < 0 ? undefined : end);
    authority = normalizeAuthority(text, authority, text.length - rest.length + 2);
    path = end < 0 ? "" : path.slice(end);
  }
  const isRelative = scheme === "" && authority === undefined && !path.startsWith("/");
  path = withoutDots(normalizeEscapes(path, allowed.path), isRelative);
  if (isRelative && /^[^/]*:/.test(path)) path = "./" + path;
  return (
    (scheme === "" ? "" : scheme.toLowerCase() + ":") +
    (authority === undefined ? "" : "//" + authority) +
    path +
    (query === undefined ? "" : "?" + normalizeEscapes(query.slice(1), allowed.query)) +
    (fragment === undefined ? "" : "#" + normalizeEscapes(fragment.slice(1), allowed.query))
  );
}
