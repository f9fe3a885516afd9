// SPDX-License-Identifier: Apache-2.0
// The table of what phase 5 finds in the data of animations.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "mode": 0}]}],
 "animations": [{"samplers": [{"input": 0, "output": 1}],
  "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [1]},
  {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 2},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 8},
  {"buffer": 0, "byteOffset": 8, "byteLength": 24}],
 "buffers": [{"byteLength": 32, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAIA/AACAPwAAgD8AAABAAAAAQAAAAEA="}]})";

constexpr RuleDescription kRules[] = {
    {"ACCESSOR_ANIMATION_INPUT_NEGATIVE", Severity::error, "An animation has a time before 0",
     "Animations begin at 0; what lies before is never shown.",
     "Move the keyframes so that the first is at 0 or later.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "mode": 0}]}],
 "animations": [{"samplers": [{"input": 0, "output": 1}],
  "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [-1], "max": [1]},
  {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 2},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 8},
  {"buffer": 0, "byteOffset": 8, "byteLength": 24}],
 "buffers": [{"byteLength": 32, "uri": "data:application/octet-stream;base64,AACAvwAAgD8AAIA/AACAPwAAgD8AAABAAAAAQAAAAEA="}]})",
     kGood, Fix::none, true},
    {"ACCESSOR_ANIMATION_INPUT_NON_INCREASING", Severity::error,
     "The times of an animation do not increase",
     "Readers search for the keyframe by its time and find the wrong one, or divide by a duration "
     "of zero.",
     "Sort the keyframes and leave one of those with the same time.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "mode": 0}]}],
 "animations": [{"samplers": [{"input": 0, "output": 1}],
  "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 3, "min": [0], "max": [1]},
  {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12},
  {"buffer": 0, "byteOffset": 12, "byteLength": 36}],
 "buffers": [{"byteLength": 48, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAIA/AACAPwAAgD8AAIA/AAAAQAAAAEAAAABAAABAQAAAQEAAAEBA"}]})",
     kGood, Fix::none, true},
    {"ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION", Severity::error,
     "A rotation of an animation is not of unit length",
     "A quaternion that is not of unit length scales or shears the node while it turns.",
     "Normalize the quaternions.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "mode": 0}]}],
 "animations": [{"samplers": [{"input": 0, "output": 1}],
  "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 1, "min": [0], "max": [0]},
  {"bufferView": 1, "componentType": 5126, "type": "VEC4", "count": 1},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 4},
  {"buffer": 0, "byteOffset": 4, "byteLength": 16}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAEA="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "mode": 0}]}],
 "animations": [{"samplers": [{"input": 0, "output": 1}],
  "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 1, "min": [0], "max": [0]},
  {"bufferView": 1, "componentType": 5126, "type": "VEC4", "count": 1},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 4},
  {"buffer": 0, "byteOffset": 4, "byteLength": 16}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAgD8="}]})",
     Fix::none, true},
};

}  // namespace

const Family& animation_data_family() {
  static const Family family{"animation_data", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
