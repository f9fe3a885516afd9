// SPDX-License-Identifier: Apache-2.0
import type compat from "./compat.js";
import type { AssetInfo, KhronosReport } from "./compat.js";
export * from "./compat.js";

/**
 * Bytes of buffers and images, or a function that reads them, by path from the folder of the asset: decoded, with "/",
 * never one that leads out of that folder. null: there are none.
 */
export type Resources =
  | ReadonlyMap<string, Uint8Array | null>
  | ((path: string) => Uint8Array | null | undefined | PromiseLike<Uint8Array | null | undefined>);

export interface ValidateOptions {
  uri?: string;
  format?: "gltf" | "glb";
  profile?: "default" | "strict" | "khronos";
  maxIssues?: number;
  ignoredIssues?: string[];
  onlyIssues?: string[];
  severityOverrides?: Record<string, 0 | 1 | 2 | 3>;
  resources?: Resources;
}

export interface Finding {
  code: string;
  severity: "error" | "warning" | "info" | "hint";
  message: string;
  help?: string;
  pointer?: string;
  offset?: number;
  location?: {
    line: number;
    column: number;
    endLine: number;
    endColumn: number;
    byte: number;
    length: number;
  };
  object?: string;
  fixable?: true;
  count?: number;
  lastPointer?: string;
  measure?: CheckedLimit & { name: string };
}

export type MeasureValue = number | boolean | string | string[];

/** A limit on a measure, and what was measured. */
export interface CheckedLimit {
  on: string;
  value: MeasureValue | null;
  op: "min" | "max" | "equal" | "match" | "deny-match" | "unique" | "allow" | "deny";
  limit: MeasureValue;
  unit?: string;
  from: string;
}

export interface Requirement extends CheckedLimit {
  measure: string;
  pointer?: string;
  object?: string;
  verdict: "pass" | "fail" | "not-measured" | "not-applicable";
  severity: "error" | "warning" | "info" | "hint";
}

export interface Report {
  path: string;
  mimeType?: string;
  readable: boolean;
  counts: { errors: number; warnings: number; infos: number; hints: number };
  truncated: boolean;
  findings: Finding[];
  requirements?: Requirement[];
  unlistedRequirements?: number;
  info?: AssetInfo;
}

/** The result of a verb that changes an asset. */
export interface Changed<R> {
  /** The new bytes; the given ones where nothing changes. */
  asset: Uint8Array;
  /** New files, and those that have other bytes than before, by path from the folder of the asset. */
  files: Map<string, Uint8Array>;
  report: R;
}

export interface ChangeReport {
  problem: "none" | "refused" | "not written";
  error?: string;
  changes: boolean;
}

export interface FixOptions {
  resources?: Resources;
  profile?: "default" | "strict" | "khronos";
  unsafe?: boolean;
  only?: string[];
  skip?: string[];
}

export interface FixReport extends ChangeReport {
  actions: { code: string; fix: "safe" | "unsafe"; count: number; pointers: string[]; done: boolean; why?: string }[];
  changedFiles: string[];
  newFiles: string[];
}

export interface UpgradeOptions {
  resources?: Resources;
  unsafe?: boolean;
  strict?: boolean;
  prune?: boolean;
  only?: string[];
  to?: string[];
}

export interface UpgradeReport extends ChangeReport {
  actions: { pointer: string; from: string; to: string; done: boolean }[];
}

export interface EditOptions {
  resources?: Resources;
  /** JSON pointers. */
  delete: string[];
  /** Also deletes objects that refer to a deleted one. */
  cascade?: boolean;
}

export interface EditReport extends ChangeReport {
  deleted: { pointer: string; cause?: string }[];
  obstacles: { pointer: string; target: string; mustHave: boolean }[];
  renumbered: number;
  /** Bytes removed from the BIN chunk. */
  bytes: number;
  /** Extensions that lost their last object: the lists no longer name them. */
  namesRemoved: string[];
  /** JSON pointers to values that may be indices; they do not change. */
  doubtful: string[];
  newWarnings: string[];
}

export interface ConvertOptions {
  resources?: Resources;
  /** The default is the storage of the asset. */
  to?: "glb" | "gltf" | "embedded";
  compress?: "none" | "meshopt";
  dedup?: boolean;
  prune?: boolean;
  weld?: boolean;
  reorder?: boolean;
  resample?: boolean;
  /** The five above, and images compressed again. */
  shrink?: boolean;
  /** Gives an asset although a part of the request was refused. */
  partial?: boolean;
}

interface ConvertNote {
  pointer: string;
  reason: string;
}

export interface ConvertReport extends ChangeReport {
  steps: {
    step: string;
    what: string;
    changed: boolean;
    left: ConvertNote[];
    refused: ConvertNote[];
    loss: { quantity: string; bound?: number; measured?: number; unit?: string }[];
    bytes_before: number;
    bytes_after: number;
    /** Bytes of images on a graphics card; absent if the step changes no image. */
    gpu_bytes_before?: number;
    gpu_bytes_after?: number;
  }[];
  newFiles: string[];
  newWarnings: string[];
}

export interface CompareOptions {
  /** Of both assets, unless one has its own. */
  resources?: Resources;
  oldResources?: Resources;
  newResources?: Resources;
  drawn?: boolean;
  /** As the list of `--bounds`: "position=0.1%,normal=2deg". */
  bounds?: string;
  ignore?: string[];
  count?: string[];
}

export type CompareLevel = "identical" | "storage" | "bounds" | "differs";

export interface CompareChange {
  kind: string;
  level: CompareLevel;
  /** JSON pointers; null: it was added, or removed. */
  old: string | null;
  new: string | null;
  name?: string;
  what: string;
  before?: string;
  after?: string;
  measure?: { quantity: string; value: number | null; unit: string; bound: number };
  also?: string[];
}

export interface Comparison {
  level: CompareLevel;
  changes: CompareChange[];
  storage: string[];
  unproven: string[];
}

export function validate(
  asset: Uint8Array,
  options: ValidateOptions & { profile: "khronos" },
): Promise<KhronosReport>;
export function validate(asset: Uint8Array, options?: ValidateOptions): Promise<Report>;
export function fix(asset: Uint8Array, options?: FixOptions): Promise<Changed<FixReport>>;
export function upgrade(asset: Uint8Array, options?: UpgradeOptions): Promise<Changed<UpgradeReport>>;
export function edit(asset: Uint8Array, options: EditOptions): Promise<Changed<EditReport>>;
export function convert(asset: Uint8Array, options?: ConvertOptions): Promise<Changed<ConvertReport>>;
export function compare(before: Uint8Array, after: Uint8Array, options?: CompareOptions): Promise<Comparison>;
export function inspect(
  asset: Uint8Array,
  options?: { resources?: Resources },
): Promise<Record<string, unknown>>;

/** All of them, with those of gltfx/compat. */
declare const gltfx: typeof compat & {
  validate: typeof validate;
  fix: typeof fix;
  upgrade: typeof upgrade;
  edit: typeof edit;
  convert: typeof convert;
  compare: typeof compare;
  inspect: typeof inspect;
};
export default gltfx;
