// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/skin_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"name": "tip"}],
 "skins": [{"joints": [1, 2], "skeleton": 1}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})";

constexpr std::string_view kGoodMatrices =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"name": "tip"}],
 "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1},
  {"componentType": 5126, "type": "MAT4", "count": 2}]})";

constexpr RuleDescription kRules[] = {
    {"INVALID_IBM_ACCESSOR_COUNT", Severity::error,
     "A skin has fewer inverse bind matrices than joints",
     "Each joint needs its matrix; readers run past the end of the accessor or reject the skin.",
     "Write one matrix a joint, in the order of `joints`.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"name": "tip"}],
 "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1},
  {"componentType": 5126, "type": "MAT4", "count": 1}]})",
     kGoodMatrices, Fix::none, true},
    {"SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE", Severity::error,
     "Inverse bind matrices lie in a buffer view with a stride",
     "Only vertex attributes may have gaps between them; readers take these matrices as one block.",
     "Write the matrices without gaps and remove byteStride.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"name": "joint"}],
 "skins": [{"joints": [1], "inverseBindMatrices": 3}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1},
  {"bufferView": 0, "componentType": 5126, "type": "MAT4", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 64, "byteStride": 64}],
 "buffers": [{"byteLength": 64, "uri": "data:application/octet-stream;base64,AACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPw=="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"name": "joint"}],
 "skins": [{"joints": [1], "inverseBindMatrices": 3}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1},
  {"bufferView": 0, "componentType": 5126, "type": "MAT4", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 64}],
 "buffers": [{"byteLength": 64, "uri": "data:application/octet-stream;base64,AACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPw=="}]})",
     Fix::none, true},
    {"SKIN_IBM_INVALID_FORMAT", Severity::error,
     "Inverse bind matrices are no 4 by 4 matrices of floats",
     "Readers copy them as they are; another format gives other matrices.",
     "Use an accessor of type MAT4 with component type FLOAT (5126).",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"name": "tip"}],
 "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1},
  {"componentType": 5126, "type": "MAT3", "count": 2}]})",
     kGoodMatrices, Fix::none, true},
    {"SKIN_NO_COMMON_ROOT", Severity::error, "The joints of a skin are in trees of their own",
     "The skeleton of a skin is one tree; joints without a node above them all cannot be moved as "
     "one.",
     "Put the joints below one node.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"name": "left"}, {"name": "right"}],
 "skins": [{"joints": [1, 2]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGood, Fix::none, true},
    {"SKIN_SKELETON_INVALID", Severity::error,
     "The skeleton root of a skin is not above its joints",
     "`skeleton` names the pivot of the whole skeleton, so every joint is that node or below it.",
     "Name a node above all joints, or remove `skeleton`.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"name": "tip"}],
 "skins": [{"joints": [1, 2], "skeleton": 2}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGood, Fix::none, true},
};

}  // namespace

std::span<const RuleDescription> skin_rules() { return kRules; }

}  // namespace gltfx::validate
