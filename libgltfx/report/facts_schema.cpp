// SPDX-License-Identifier: Apache-2.0
// The public description of `gltfx inspect --format json`. Members are only ever added within one
// format number.
#include <gltfx/inspect.hpp>

namespace gltfx {
namespace {

constexpr std::string_view kSchema = R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "gltfx:inspect/1",
  "title": "gltfx facts",
  "description": "What `gltfx inspect --format json` writes: one object for a run.",
  "type": "object",
  "required": ["gltfx", "format", "assets"],
  "properties": {
    "gltfx": { "type": "string", "description": "Version of the program." },
    "format": { "const": 1, "description": "Version of this structure." },
    "assets": {
      "type": "array",
      "description": "One entry a file, in the order they were named.",
      "items": { "$ref": "#/$defs/asset" }
    }
  },
  "additionalProperties": false,
  "$defs": {
    "count": { "type": "integer", "minimum": 0 },
    "names": { "type": "array", "items": { "type": "string" } },
    "asset": {
      "type": "object",
      "required": ["path", "upgrade"],
      "properties": {
        "path": { "type": "string", "description": "As the user named it." },
        "error": { "type": "string", "description": "Why there are no facts." },
        "facts": { "$ref": "#/$defs/facts" },
        "upgrade": {
          "type": "array",
          "description": "What `gltfx upgrade` makes of each legacy object.",
          "items": { "$ref": "#/$defs/upgrade" }
        },
        "upgradeProblem": { "type": "string", "description": "Why nothing of it can be done." }
      },
      "additionalProperties": false
    },
    "facts": {
      "type": "object",
      "required": ["mimeType", "counts", "bytes", "gpuBytes", "files", "extensions", "meshes", "materials",
                   "images", "animations", "skins", "cameras", "lights", "problems"],
      "properties": {
        "mimeType": { "enum": ["model/gltf+json", "model/gltf-binary"] },
        "version": { "type": "string" },
        "minVersion": { "type": "string" },
        "generator": { "type": "string" },
        "copyright": { "type": "string" },
        "counts": { "$ref": "#/$defs/counts" },
        "bounds": {
          "type": "object",
          "description": "Of what the default scene shows, in metres, at rest.",
          "required": ["min", "max"],
          "properties": { "min": { "$ref": "#/$defs/point" }, "max": { "$ref": "#/$defs/point" } },
          "additionalProperties": false
        },
        "bytes": { "$ref": "#/$defs/bytes" },
        "gpuBytes": {
          "type": "object",
          "description": "Estimated memory of a graphics card.",
          "required": ["images", "meshes"],
          "properties": { "images": { "$ref": "#/$defs/count" }, "meshes": { "$ref": "#/$defs/count" } },
          "additionalProperties": false
        },
        "files": { "type": "array", "items": { "$ref": "#/$defs/file" } },
        "extensions": { "type": "array", "items": { "$ref": "#/$defs/extension" } },
        "meshes": { "type": "array", "items": { "$ref": "#/$defs/mesh" } },
        "materials": { "type": "array", "items": { "$ref": "#/$defs/material" } },
        "images": { "type": "array", "items": { "$ref": "#/$defs/image" } },
        "animations": { "type": "array", "items": { "$ref": "#/$defs/animation" } },
        "skins": { "type": "array", "items": { "$ref": "#/$defs/skin" } },
        "cameras": { "type": "array", "items": { "$ref": "#/$defs/named" } },
        "lights": { "type": "array", "items": { "$ref": "#/$defs/named" } },
        "problems": { "$ref": "#/$defs/names", "description": "What could not be read, a sentence each." }
      },
      "additionalProperties": false
    },
    "counts": {
      "type": "object",
      "required": ["scenes", "nodes", "meshes", "primitives", "triangles", "vertices", "drawnTriangles",
                   "accessors", "materials", "textures", "images", "animations", "skins", "cameras", "lights"],
      "properties": {
        "scenes": { "$ref": "#/$defs/count" },
        "nodes": { "$ref": "#/$defs/count" },
        "meshes": { "$ref": "#/$defs/count" },
        "primitives": { "$ref": "#/$defs/count", "description": "Each once, like triangles and vertices." },
        "triangles": { "$ref": "#/$defs/count" },
        "vertices": { "$ref": "#/$defs/count" },
        "drawnTriangles": {
          "$ref": "#/$defs/count",
          "description": "By the default scene, each time a node draws them."
        },
        "accessors": { "$ref": "#/$defs/count" },
        "materials": { "$ref": "#/$defs/count" },
        "textures": { "$ref": "#/$defs/count" },
        "images": { "$ref": "#/$defs/count" },
        "animations": { "$ref": "#/$defs/count" },
        "skins": { "$ref": "#/$defs/count" },
        "cameras": { "$ref": "#/$defs/count" },
        "lights": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    },
    "point": { "type": "array", "items": { "type": "number" }, "description": "x, y, z." },
    "bytes": {
      "type": "object",
      "description": "Of all files. What several objects refer to counts once.",
      "required": ["total", "json", "meshes", "images", "animations", "skins", "other", "unused", "base64", "padding"],
      "properties": {
        "total": { "$ref": "#/$defs/count", "description": "The sum of the others." },
        "json": { "$ref": "#/$defs/count", "description": "Without the payloads of data URIs." },
        "meshes": { "$ref": "#/$defs/count" },
        "images": { "$ref": "#/$defs/count" },
        "animations": { "$ref": "#/$defs/count" },
        "skins": { "$ref": "#/$defs/count" },
        "other": { "$ref": "#/$defs/count", "description": "What else refers to buffers." },
        "unused": { "$ref": "#/$defs/count", "description": "Nothing that is known refers to them." },
        "base64": { "$ref": "#/$defs/count", "description": "Beyond what data URIs stand for." },
        "padding": { "$ref": "#/$defs/count", "description": "Headers of a GLB, gaps of up to 15 bytes." }
      },
      "additionalProperties": false
    },
    "file": {
      "type": "object",
      "required": ["index", "bytes"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "uri": { "type": "string", "description": "Missing: the asset itself." },
        "bytes": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    },
    "extension": {
      "type": "object",
      "required": ["index", "name", "status", "used", "required", "seen"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "status": { "enum": ["ratified", "release-candidate", "draft", "legacy", "archived", "vendor", "unknown"] },
        "used": { "type": "boolean", "description": "In extensionsUsed." },
        "required": { "type": "boolean", "description": "In extensionsRequired." },
        "seen": { "type": "boolean", "description": "Some object has it." },
        "spec": { "type": "string" },
        "successor": { "type": "string" }
      },
      "additionalProperties": false
    },
    "mesh": {
      "type": "object",
      "required": ["index", "primitives", "triangles", "vertices", "bytes", "gpuBytes"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "primitives": { "$ref": "#/$defs/count" },
        "triangles": { "$ref": "#/$defs/count" },
        "vertices": { "$ref": "#/$defs/count" },
        "bytes": { "$ref": "#/$defs/count" },
        "gpuBytes": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    },
    "material": {
      "type": "object",
      "required": ["index", "alphaMode", "doubleSided", "textures", "extensions"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "alphaMode": { "type": "string" },
        "doubleSided": { "type": "boolean" },
        "textures": { "$ref": "#/$defs/count", "description": "Slots that are filled." },
        "extensions": { "$ref": "#/$defs/names" }
      },
      "additionalProperties": false
    },
    "image": {
      "type": "object",
      "required": ["index", "width", "height", "bits", "levels", "slots", "textures", "bytes", "gpuBytes"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "uri": { "type": "string", "description": "Of a file; missing: inside the asset." },
        "format": { "type": "string", "description": "Media type by the first bytes; missing: unknown." },
        "encoding": { "type": "string", "description": "Of KTX2." },
        "width": { "$ref": "#/$defs/count", "description": "Pixels; 0: could not be read." },
        "height": { "$ref": "#/$defs/count" },
        "bits": { "$ref": "#/$defs/count", "description": "Per channel." },
        "channels": { "type": "string" },
        "levels": { "$ref": "#/$defs/count", "description": "Of mipmaps that are stored." },
        "slots": { "$ref": "#/$defs/names", "description": "Of materials that show it." },
        "colorSpace": { "enum": ["sRGB", "linear", "both"], "description": "In which those read it." },
        "textures": { "$ref": "#/$defs/count", "description": "That name it." },
        "bytes": { "$ref": "#/$defs/count" },
        "gpuBytes": { "$ref": "#/$defs/count", "description": "With all mipmaps." }
      },
      "additionalProperties": false
    },
    "animation": {
      "type": "object",
      "required": ["index", "duration", "channels", "samplers", "keyframes", "bytes"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "duration": { "type": "number", "description": "Seconds, to the last keyframe." },
        "channels": { "$ref": "#/$defs/count" },
        "samplers": { "$ref": "#/$defs/count" },
        "keyframes": { "$ref": "#/$defs/count" },
        "bytes": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    },
    "skin": {
      "type": "object",
      "required": ["index", "joints", "bytes"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "joints": { "$ref": "#/$defs/count" },
        "bytes": { "$ref": "#/$defs/count" }
      },
      "additionalProperties": false
    },
    "named": {
      "type": "object",
      "required": ["index"],
      "properties": {
        "index": { "$ref": "#/$defs/count" },
        "name": { "type": "string" },
        "type": { "type": "string" }
      },
      "additionalProperties": false
    },
    "upgrade": {
      "type": "object",
      "required": ["pointer", "from", "outcome", "done", "notes"],
      "properties": {
        "pointer": { "type": "string", "description": "JSON pointer (RFC 6901) to the object." },
        "from": { "type": "string" },
        "to": { "type": "string" },
        "outcome": {
          "enum": ["safe", "unsafe", "needs an image", "not possible", "on request", "no successor", "removed"]
        },
        "done": { "type": "boolean", "description": "Whether `gltfx upgrade` does it without being asked for more." },
        "notes": { "$ref": "#/$defs/names" }
      },
      "additionalProperties": false
    }
  }
})json";

}  // namespace

std::string_view inspect_report_schema() { return kSchema; }

}  // namespace gltfx
