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
}

export interface Report {
  path: string;
  mimeType?: string;
  readable: boolean;
  counts: { errors: number; warnings: number; infos: number; hints: number };
  truncated: boolean;
  findings: Finding[];
  info?: AssetInfo;
}

export interface UpgradeOptions {
  resources?: Resources;
  unsafe?: boolean;
  strict?: boolean;
  prune?: boolean;
  only?: string[];
  to?: string[];
}

export interface Upgrade {
  asset: Uint8Array;
  /** Files that belong beside the asset now, by relative path. */
  files: Map<string, Uint8Array>;
  report: {
    problem: string;
    changes: boolean;
    actions: { pointer: string; from: string; to: string; done: boolean }[];
  };
}

export function validate(
  asset: Uint8Array,
  options: ValidateOptions & { profile: "khronos" },
): Promise<KhronosReport>;
export function validate(asset: Uint8Array, options?: ValidateOptions): Promise<Report>;
export function upgrade(asset: Uint8Array, options?: UpgradeOptions): Promise<Upgrade>;
export function inspect(
  asset: Uint8Array,
  options?: { resources?: Resources },
): Promise<Record<string, unknown>>;

/** All of them, with those of gltfx/compat. */
declare const gltfx: typeof compat & {
  validate: typeof validate;
  upgrade: typeof upgrade;
  inspect: typeof inspect;
};
export default gltfx;
