// SPDX-License-Identifier: Apache-2.0
// The public description of `--format json`. Members are only ever added within one format number.
#include <gltfx/report.hpp>

namespace gltfx {
namespace {

constexpr std::string_view kSchema = R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "gltfx:report/1",
  "title": "gltfx report",
  "description": "What `gltfx validate --format json` writes: one object for a run.",
  "type": "object",
  "required": ["gltfx", "format", "files", "summary"],
  "properties": {
    "gltfx": { "type": "string", "description": "Version of the program." },
    "format": { "const": 1, "description": "Version of this structure." },
    "profile": { "type": "string", "description": "What was asked for: default, khronos or strict." },
    "pixels": { "type": "string", "description": "How far images were looked into: headers, needed or all." },
    "files": {
      "type": "array",
      "description": "One entry a file, in the order they were named.",
      "items": { "$ref": "#/$defs/file" }
    },
    "summary": {
      "type": "object",
      "description": "Sums over all files.",
      "required": ["files", "filesWithErrors", "unreadable", "unverified", "suppressed",
                   "errors", "warnings", "infos", "hints"],
      "properties": {
        "files": { "$ref": "#/$defs/count" },
        "filesWithErrors": { "$ref": "#/$defs/count" },
        "unreadable": { "$ref": "#/$defs/count", "description": "Files that could not be opened." },
        "unverified": { "$ref": "#/$defs/count", "description": "Git-LFS pointers met." },
        "suppressed": { "$ref": "#/$defs/count", "description": "Findings the baseline knew." },
        "leftOut": { "$ref": "#/$defs/count", "description": "Findings that assets ask to leave out." },
        "imagesWanted": { "$ref": "#/$defs/count", "description": "Images to decode (--pixels)." },
        "imagesDecoded": { "$ref": "#/$defs/count", "description": "Those that could be decoded." },
        "unchanged": { "$ref": "#/$defs/count", "description": "Findings on lines that did not change (--diff-base)." },
        "errors": { "$ref": "#/$defs/count" },
        "warnings": { "$ref": "#/$defs/count" },
        "infos": { "$ref": "#/$defs/count" },
        "hints": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    }
  },
  "additionalProperties": false,
  "$defs": {
    "count": { "type": "integer", "minimum": 0 },
    "position": { "type": "integer", "minimum": 1 },
    "file": {
      "type": "object",
      "required": ["path", "readable", "counts", "truncated", "suppressed", "unverified", "findings"],
      "properties": {
        "path": { "type": "string", "description": "As the user named it; - is standard input." },
        "mimeType": {
          "enum": ["model/gltf+json", "model/gltf-binary"],
          "description": "Missing when the bytes are neither."
        },
        "readable": { "type": "boolean", "description": "False: the file could not be opened." },
        "counts": {
          "type": "object",
          "description": "Findings by severity, repeats counted one by one, known ones not.",
          "required": ["errors", "warnings", "infos", "hints"],
          "properties": {
            "errors": { "$ref": "#/$defs/count" },
            "warnings": { "$ref": "#/$defs/count" },
            "infos": { "$ref": "#/$defs/count" },
            "hints": { "$ref": "#/$defs/count" }
          },
          "additionalProperties": false
        },
        "truncated": { "type": "boolean", "description": "--max-issues ended the listing." },
        "suppressed": { "$ref": "#/$defs/count", "description": "Findings the baseline knew." },
        "leftOut": { "$ref": "#/$defs/count", "description": "Findings that assets ask to leave out." },
        "imagesWanted": { "$ref": "#/$defs/count", "description": "Images to decode (--pixels)." },
        "imagesDecoded": { "$ref": "#/$defs/count", "description": "Those that could be decoded." },
        "unchanged": { "$ref": "#/$defs/count", "description": "Findings on lines that did not change (--diff-base)." },
        "unverified": { "$ref": "#/$defs/count", "description": "Git-LFS pointers met." },
        "findings": {
          "type": "array",
          "description": "In the order in which they were found.",
          "items": { "$ref": "#/$defs/finding" }
        },
        "info": { "$ref": "#/$defs/info" }
      },
      "additionalProperties": false
    },
    "finding": {
      "type": "object",
      "required": ["code", "severity", "message"],
      "properties": {
        "code": { "type": "string", "description": "Stable name of the rule." },
        "severity": { "enum": ["error", "warning", "info", "hint"] },
        "message": { "type": "string", "description": "One sentence for a person." },
        "help": { "type": "string", "description": "What to do about it." },
        "pointer": {
          "type": "string",
          "description": "JSON pointer (RFC 6901) into the document; empty: all of it. Missing for findings on the container or on a file that could not be opened."
        },
        "offset": {
          "$ref": "#/$defs/count",
          "description": "Byte in the file, for findings on the GLB container."
        },
        "location": {
          "type": "object",
          "description": "Place in the JSON text; in a GLB lines count within the JSON chunk.",
          "required": ["line", "column", "endLine", "endColumn", "byte", "length"],
          "properties": {
            "line": { "$ref": "#/$defs/position" },
            "column": { "$ref": "#/$defs/position", "description": "In Unicode code points." },
            "endLine": { "$ref": "#/$defs/position" },
            "endColumn": { "$ref": "#/$defs/position", "description": "One past the last." },
            "byte": { "$ref": "#/$defs/count", "description": "From the start of the file." },
            "length": { "$ref": "#/$defs/count", "description": "In bytes." }
          },
          "additionalProperties": false
        },
        "object": { "type": "string", "description": "Name of the object around it." },
        "count": {
          "type": "integer",
          "minimum": 2,
          "description": "How often this was found at the same place but for array indices."
        },
        "lastPointer": { "type": "string", "description": "Pointer of the last repeat." }
      },
      "additionalProperties": false
    },
    "info": {
      "type": "object",
      "description": "Facts about the asset, in the words of the Khronos validator's report.",
      "required": ["animationCount", "materialCount", "hasMorphTargets", "hasSkins", "hasTextures",
                   "hasDefaultScene", "drawCallCount", "totalVertexCount", "totalTriangleCount",
                   "maxUVs", "maxInfluences", "maxAttributes"],
      "properties": {
        "version": { "type": "string" },
        "minVersion": { "type": "string" },
        "generator": { "type": "string" },
        "extensionsUsed": { "type": "array", "items": { "type": "string" } },
        "extensionsRequired": { "type": "array", "items": { "type": "string" } },
        "resources": { "type": "array", "items": { "$ref": "#/$defs/resource" } },
        "animationCount": { "$ref": "#/$defs/count" },
        "materialCount": { "$ref": "#/$defs/count" },
        "hasMorphTargets": { "type": "boolean" },
        "hasSkins": { "type": "boolean" },
        "hasTextures": { "type": "boolean" },
        "hasDefaultScene": { "type": "boolean" },
        "drawCallCount": { "$ref": "#/$defs/count" },
        "totalVertexCount": { "$ref": "#/$defs/count" },
        "totalTriangleCount": { "$ref": "#/$defs/count" },
        "maxUVs": { "$ref": "#/$defs/count" },
        "maxInfluences": { "$ref": "#/$defs/count" },
        "maxAttributes": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    },
    "resource": {
      "type": "object",
      "required": ["pointer"],
      "properties": {
        "pointer": { "type": "string" },
        "mimeType": { "type": "string" },
        "storage": { "enum": ["external", "data-uri", "glb", "buffer-view"] },
        "uri": { "type": "string" },
        "byteLength": { "$ref": "#/$defs/count" },
        "image": {
          "type": "object",
          "required": ["width", "height"],
          "properties": {
            "width": { "$ref": "#/$defs/count" },
            "height": { "$ref": "#/$defs/count" },
            "format": { "type": "string" },
            "primaries": { "type": "string" },
            "transfer": { "type": "string" },
            "bits": { "$ref": "#/$defs/count" }
          },
          "additionalProperties": false
        }
      },
      "additionalProperties": false
    }
  }
}
)json";

}  // namespace

std::string_view json_report_schema() { return kSchema; }

}  // namespace gltfx
