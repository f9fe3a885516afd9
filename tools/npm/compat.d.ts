// SPDX-License-Identifier: Apache-2.0
/** 0 error, 1 warning, 2 information, 3 hint. */
export type KhronosSeverity = 0 | 1 | 2 | 3;

export interface ValidationOptions {
  /** Name of the asset, copied to the report. */
  uri?: string | null;
  /** `glb` or `gltf`; anything else: the first byte decides. */
  format?: string | null;
  /** Greatest number of issues; 0: no limit. */
  maxIssues?: number | null;
  ignoredIssues?: readonly string[] | null;
  onlyIssues?: readonly string[] | null;
  severityOverrides?: Readonly<Record<string, KhronosSeverity>> | null;
  externalResourceFunction?: ((uri: string) => PromiseLike<Uint8Array>) | null;
  /** Default: true. */
  writeTimestamp?: boolean | null;
}

export interface KhronosMessage {
  code: string;
  message: string;
  severity: KhronosSeverity;
  pointer?: string;
  offset?: number;
}

export interface KhronosReport {
  uri?: string;
  mimeType?: string;
  validatorVersion: string;
  validatedAt?: string;
  issues: {
    numErrors: number;
    numWarnings: number;
    numInfos: number;
    numHints: number;
    messages: KhronosMessage[];
    truncated: boolean;
  };
  info?: AssetInfo;
}

export interface AssetInfo {
  version?: string;
  minVersion?: string;
  generator?: string;
  extensionsUsed?: string[];
  extensionsRequired?: string[];
  resources?: {
    pointer: string;
    mimeType?: string;
    storage?: string;
    uri?: string;
    byteLength?: number;
    image?: Record<string, unknown>;
  }[];
  animationCount: number;
  materialCount: number;
  hasMorphTargets: boolean;
  hasSkins: boolean;
  hasTextures: boolean;
  hasDefaultScene: boolean;
  drawCallCount: number;
  totalVertexCount: number;
  totalTriangleCount: number;
  maxUVs: number;
  maxInfluences: number;
  maxAttributes: number;
}

export function version(): string;
export function supportedExtensions(): string[];
/** Rejected with a string for misuse. */
export function validateBytes(data: Uint8Array, options?: ValidationOptions | null): Promise<KhronosReport>;
export function validateString(json: string, options?: ValidationOptions | null): Promise<KhronosReport>;

/** All of them. */
declare const compat: {
  version: typeof version;
  supportedExtensions: typeof supportedExtensions;
  validateBytes: typeof validateBytes;
  validateString: typeof validateString;
};
export default compat;
