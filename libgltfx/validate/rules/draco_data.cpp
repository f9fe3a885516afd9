// SPDX-License-Identifier: Apache-2.0
// What decoding Draco bitstreams finds. Examples of an extension name it, as those of any extension
// do.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

// One triangle: (0, 0, 0), (1, 0, 0), (0, 1, 0).
constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 3}],
 "bufferViews": [{"buffer": 0, "byteLength": 61}],
 "buffers": [{"byteLength": 61, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="}]})";

constexpr RuleDescription kRules[] = {
    {"DRACO_ATTRIBUTE_ID_UNKNOWN", Severity::error,
     "An attribute is said to be in compressed geometry but is not there",
     "Readers look attributes up by that id; they leave the attribute out, or refuse the asset.",
     "Use the unique id that the encoder gave the attribute.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 5}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 3}],
 "bufferViews": [{"buffer": 0, "byteLength": 61}],
 "buffers": [{"byteLength": 61, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="}]})",
     kGood, Fix::none, false},
    {"DRACO_COUNT_MISMATCH", Severity::warning,
     "Compressed geometry has another number of elements than its accessor",
     "Readers that make room by the accessor lose vertices, or read what is not there.",
     "Write the numbers that the decoder gives into the accessors: encoding can add and drop "
     "vertices.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 6}],
 "bufferViews": [{"buffer": 0, "byteLength": 61}],
 "buffers": [{"byteLength": 61, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="}]})",
     kGood, Fix::none, false},
    {"DRACO_DECODE_FAILED", Severity::error, "Compressed geometry cannot be decoded",
     "The bytes are cut short or damaged, or no triangle mesh at all: nothing can be drawn.",
     "Compress the mesh again, and copy the length that the encoder gives.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 3}],
 "bufferViews": [{"buffer": 0, "byteLength": 50}],
 "buffers": [{"byteLength": 50, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAA="}]})",
     kGood, Fix::none, false},
    {"DRACO_FORMAT_MISMATCH", Severity::error,
     "Compressed geometry has another type than its accessor",
     "Readers that trust the accessor take the bytes for what they are not.",
     "Give the accessor the type and component type of the decoded attribute.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 3}],
 "bufferViews": [{"buffer": 0, "byteLength": 49}],
 "buffers": [{"byteLength": 49, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAABAwEAAQIBAQAJAgAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPw=="}]})",
     kGood, Fix::none, false},
    {"DRACO_INDEX_TYPE_TOO_SMALL", Severity::error,
     "Compressed geometry has more vertices than its index type can count",
     "Readers that copy indices into that type get triangles between the wrong vertices.",
     "Use UNSIGNED_SHORT (5123) or UNSIGNED_INT (5125) for the indices.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 258, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 768}],
 "bufferViews": [{"buffer": 0, "byteLength": 180}],
 "buffers": [{"byteLength": 180, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEBAAAAggKAAgCAAgAAYO+6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6ruu6bv8BEQH/AAABAAkDAAACAQEBAQIEbT9AQBQL3CSSh+fuJd37/4IAAAAAfwAAAAAAAAAAAAAAAAAAAAAAgD8H"}]})",
     kGood, Fix::none, false},
    {"DRACO_LIMIT_EXCEEDED", Severity::error,
     "Compressed geometry asks for far more memory or time than its bytes can be worth",
     "Such bitstreams exhaust readers; they are damaged, or made for that.",
     "Compress the mesh again; split one that is truly so large.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
  "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 3}],
 "bufferViews": [{"buffer": 0, "byteLength": 65}],
 "buffers": [{"byteLength": 65, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAAB/////wcBAAECAQEACQMAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAA="}]})",
     kGood, Fix::none, false},
    {"DRACO_NOT_CHECKED", Severity::info, "Compressed geometry was not looked at",
     "Other bitstreams of the file took all that decoding may take, or the program that decodes is "
     "not installed: faults inside are not seen.",
     "Mend what was found before, or install gltfx with its gltfx-codec programs.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [
  {"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}},
  {"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 1, "attributes": {"POSITION": 0}}}},
  {"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 2, "attributes": {"POSITION": 0}}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 3}],
 "bufferViews": [{"buffer": 0, "byteLength": 65}, {"buffer": 0, "byteLength": 65}, {"buffer": 0, "byteLength": 65}],
 "buffers": [{"byteLength": 65, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAAB/////wcBAAECAQEACQMAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAA="}]})",
     kGood, Fix::none, false},
};

}  // namespace

const Family& draco_data_family() {
  static const Family family{"draco_data", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
