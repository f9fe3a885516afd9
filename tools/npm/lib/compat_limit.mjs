// SPDX-License-Identifier: Apache-2.0
// The limit of issues: gltf-validator stops at the first issue beyond it, and its report has the results until then.
// Reports here have one issue more than the limit.

// Issues about bytes, which are checked when `info` is complete except for its resources.
const aboutBytes = new RegExp(
  "^(IO_ERROR|BUFFER_(BYTE_LENGTH_MISMATCH|MISSING_GLB_DATA|GLB_CHUNK_TOO_BIG)|" +
    "IMAGE_(?!BUFFER_VIEW_WITH_BYTESTRIDE).*|TEXTURE_INVALID_IMAGE_MIME_TYPE|ACCESSOR_(MIN|MAX)_MISMATCH|" +
    "ACCESSOR_(ELEMENT_OUT_OF|SPARSE_IND(EX|ICES)|VECTOR3|INDEX|ANIMATION|JOINTS|WEIGHTS|" +
    "INVALID|NON_CLAMPED)(_.*)?)$",
);
const atResource = /^\/(buffers|images)\/\d+/;

function firstBeyond({ issues }, limit) {
  return limit ? issues.messages[limit] : undefined;
}

// The index in info.resources at which the validator stopped; -1: none.
function stoppedAt(report, issue) {
  const pointer = atResource.exec(issue.pointer ?? "")?.[0];
  return (report.info?.resources ?? []).findIndex((resource) => resource.pointer === pointer);
}

/** The results when the resource at which the validator stops was requested. */
export function withoutResourcesAfter(report, limit) {
  const issue = firstBeyond(report, limit);
  if (issue === undefined) return report;
  if (!aboutBytes.test(issue.code)) return { ...report, info: undefined };
  const index = stoppedAt(report, issue);
  if (index < 0) return report;
  return { ...report, info: { ...report.info, resources: report.info.resources.slice(0, index + 1) } };
}

/** The report at the limit. */
export function cutAt(report, limit) {
  const issue = firstBeyond(report, limit);
  if (issue === undefined) return report;
  const messages = report.issues.messages.slice(0, limit);
  const count = (severity) => messages.filter((message) => message.severity === severity).length;
  const issues = {
    numErrors: count(0),
    numWarnings: count(1),
    numInfos: count(2),
    numHints: count(3),
    messages,
    truncated: true,
  };
  const { info } = withoutResourcesAfter(report, limit);
  if (info === undefined) return { issues }; // not even the media type was known
  const { resources, ...facts } = info;
  const known = stoppedAt(report, issue) < 0 ? resources : resources.slice(0, -1);
  if (!known?.length) return { ...report, issues, info: facts };
  const entries = Object.entries(info).map(([name, value]) => [name, name === "resources" ? known : value]);
  return { ...report, issues, info: Object.fromEntries(entries) };
}
