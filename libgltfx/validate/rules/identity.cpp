// SPDX-License-Identifier: Apache-2.0
// Files that are not quite glTF 2.0, named for what they are (VRM by the extensions it is told by).
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMinimal = R"({"asset": {"version": "2.0"}})";

constexpr RuleDescription kRules[] = {
    {"FILE_EXTENSION_MISMATCH", Severity::warning,
     "The name of the file promises another container",
     "Loaders choose their reader by the ending of the name.",
     "Rename the file: .gltf for JSON text, .glb for the binary container.",
     "base64:Z2xURgIAAAAwAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g", kMinimal, Fix::none,
     false},
    {"GIT_LFS_POINTER", Severity::info, "The file is a Git-LFS pointer",
     "The real content is kept outside the repository and was not fetched, so it could not be "
     "checked.",
     "Fetch it with 'git lfs pull', or count it as an error with --lfs error.",
     "base64:dmVyc2lvbiBodHRwczovL2dpdC1sZnMuZ2l0aHViLmNvbS9zcGVjL3YxCm9pZCBzaGEyNTY6NGQ3YTIxN"
     "DYxNGFiMjkzNWM5NDNmOWUwZmY2OWQyMmVhZGJiOGYzMmIxMjU4ZGFhYTVlMmNhMjRkMTdlMjM5MwpzaXplIDEyM"
     "zQ1Cg==",
     kMinimal, Fix::none, false},
    {"GLTF_VERSION_1", Severity::error, "The asset is glTF 1.0",
     "Version 2.0 is another format: objects are in arrays, materials are physically based. "
     "Current programs do not read 1.0.",
     "Convert it with the tool that made it, or with a glTF 1.0 converter.",
     R"({"asset": {"version": "1.0"}})", kMinimal, Fix::none, false},
    {"GLTF_VERSION_2_1_DRAFT", Severity::info, "The asset follows a draft of glTF 2.1",
     "The draft changes until it is released; the asset is checked by the rules of 2.0.",
     "Use version 2.0 unless a feature of the draft is needed.", R"({"asset": {"version": "2.1"}})",
     kMinimal, Fix::none, false},
    {"TOO_MANY_OBJECTS", Severity::error, "The asset has far more objects than text for them",
     "Millions of objects in a few bytes each are no content, but cost a reader many times the "
     "size "
     "of the file. Nothing more of the asset is checked.",
     "Remove the objects without content.",
     R"({"asset": {"version": "2.0"}, "nodes": [0{{,0*1200000}}]})", kMinimal, Fix::none, false},
    {"VRM_ASSET", Severity::info, "The asset is a VRM avatar",
     "VRM adds rules of its own (bones, expressions, licence) that are not checked here.",
     "Check it with a VRM tool as well.",
     R"({"asset": {"version": "2.0"}, "extensions": {"VRMC_vrm": {}}, "extensionsUsed": ["VRMC_vrm"]})",
     kMinimal, Fix::none, false},
};

}  // namespace

const Family& identity_family() {
  static const Family family{"identity", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
