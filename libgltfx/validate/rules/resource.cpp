// SPDX-License-Identifier: Apache-2.0
// Where buffers and images come from: the form of a URI, and what phase 5 finds behind it.
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/uri.hpp"
#include "image/header.hpp"
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGoodBuffer =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})";

constexpr RuleDescription kRules[] = {
    {"BUFFER_BYTE_LENGTH_MISMATCH", Severity::error, "A buffer has fewer bytes than it declares",
     "What lies behind the end is missing: meshes lose vertices or fail to load.",
     "Write the whole buffer, or correct byteLength.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 16, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     kGoodBuffer, Fix::none, true},
    {"BUFFER_DATA_URI_MIME_TYPE_INVALID", Severity::error,
     "The data URI of a buffer has another media type than that of a buffer",
     "Readers refuse data they do not take for a buffer.",
     "Begin the URI with data:application/octet-stream;base64, or "
     "data:application/gltf-buffer;base64,",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:text/plain;base64,AAAAAAAAAAAAAAAA"}]})",
     kGoodBuffer, Fix::none, true},
    {"BUFFER_GLB_CHUNK_TOO_BIG", Severity::warning,
     "The BIN chunk of a GLB is longer than its buffer and the padding",
     "Bytes that nobody refers to travel with the file.",
     "Cut the chunk to byteLength, padded to a multiple of four.",
     "base64:Z2xURgIAAAC4AQAAiAEAAEpTT057ImFzc2V0IjogeyJ2ZXJzaW9uIjogIjIuMCJ9LCAic2NlbmUiOiAwL"
     "CAic2NlbmVzIjogW3sibm9kZXMiOiBbMF19XSwgIm5vZGVzIjogW3sibWVzaCI6IDB9XSwKICJtZXNoZXMiOiBbe"
     "yJwcmltaXRpdmVzIjogW3siYXR0cmlidXRlcyI6IHsiUE9TSVRJT04iOiAwfSwgIm1vZGUiOiAwfV19XSwKICJhY"
     "2Nlc3NvcnMiOiBbeyJidWZmZXJWaWV3IjogMCwgImNvbXBvbmVudFR5cGUiOiA1MTI2LCAidHlwZSI6ICJWRUMzI"
     "iwgImNvdW50IjogMSwgIm1pbiI6IFswLCAwLCAwXSwgIm1heCI6IFswLCAwLCAwXX1dLAogImJ1ZmZlclZpZXdzI"
     "jogW3siYnVmZmVyIjogMCwgImJ5dGVMZW5ndGgiOiAxMiwgInRhcmdldCI6IDM0OTYyfV0sCiAiYnVmZmVycyI6I"
     "Ft7ImJ5dGVMZW5ndGgiOiAxMn1dfRQAAABCSU4AAAAAAAAAAAAAAAAAAAAAAAAAAAA=",
     "base64:Z2xURgIAAACwAQAAiAEAAEpTT057ImFzc2V0IjogeyJ2ZXJzaW9uIjogIjIuMCJ9LCAic2NlbmUiOiAwL"
     "CAic2NlbmVzIjogW3sibm9kZXMiOiBbMF19XSwgIm5vZGVzIjogW3sibWVzaCI6IDB9XSwKICJtZXNoZXMiOiBbe"
     "yJwcmltaXRpdmVzIjogW3siYXR0cmlidXRlcyI6IHsiUE9TSVRJT04iOiAwfSwgIm1vZGUiOiAwfV19XSwKICJhY"
     "2Nlc3NvcnMiOiBbeyJidWZmZXJWaWV3IjogMCwgImNvbXBvbmVudFR5cGUiOiA1MTI2LCAidHlwZSI6ICJWRUMzI"
     "iwgImNvdW50IjogMSwgIm1pbiI6IFswLCAwLCAwXSwgIm1heCI6IFswLCAwLCAwXX1dLAogImJ1ZmZlclZpZXdzI"
     "jogW3siYnVmZmVyIjogMCwgImJ5dGVMZW5ndGgiOiAxMiwgInRhcmdldCI6IDM0OTYyfV0sCiAiYnVmZmVycyI6I"
     "Ft7ImJ5dGVMZW5ndGgiOiAxMn1dfQwAAABCSU4AAAAAAAAAAAAAAAAA",
     Fix::none, true},
    {"BUFFER_MISSING_GLB_DATA", Severity::error,
     "A buffer refers to the BIN chunk, but the GLB has none",
     "A first buffer without uri stands for the BIN chunk. Its data is missing.",
     "Add the BIN chunk, or give the buffer a uri.",
     "base64:Z2xURgIAAACcAQAAiAEAAEpTT057ImFzc2V0IjogeyJ2ZXJzaW9uIjogIjIuMCJ9LCAic2NlbmUiOiAwL"
     "CAic2NlbmVzIjogW3sibm9kZXMiOiBbMF19XSwgIm5vZGVzIjogW3sibWVzaCI6IDB9XSwKICJtZXNoZXMiOiBbe"
     "yJwcmltaXRpdmVzIjogW3siYXR0cmlidXRlcyI6IHsiUE9TSVRJT04iOiAwfSwgIm1vZGUiOiAwfV19XSwKICJhY"
     "2Nlc3NvcnMiOiBbeyJidWZmZXJWaWV3IjogMCwgImNvbXBvbmVudFR5cGUiOiA1MTI2LCAidHlwZSI6ICJWRUMzI"
     "iwgImNvdW50IjogMSwgIm1pbiI6IFswLCAwLCAwXSwgIm1heCI6IFswLCAwLCAwXX1dLAogImJ1ZmZlclZpZXdzI"
     "jogW3siYnVmZmVyIjogMCwgImJ5dGVMZW5ndGgiOiAxMiwgInRhcmdldCI6IDM0OTYyfV0sCiAiYnVmZmVycyI6I"
     "Ft7ImJ5dGVMZW5ndGgiOiAxMn1dfQ==",
     "base64:Z2xURgIAAACwAQAAiAEAAEpTT057ImFzc2V0IjogeyJ2ZXJzaW9uIjogIjIuMCJ9LCAic2NlbmUiOiAwL"
     "CAic2NlbmVzIjogW3sibm9kZXMiOiBbMF19XSwgIm5vZGVzIjogW3sibWVzaCI6IDB9XSwKICJtZXNoZXMiOiBbe"
     "yJwcmltaXRpdmVzIjogW3siYXR0cmlidXRlcyI6IHsiUE9TSVRJT04iOiAwfSwgIm1vZGUiOiAwfV19XSwKICJhY"
     "2Nlc3NvcnMiOiBbeyJidWZmZXJWaWV3IjogMCwgImNvbXBvbmVudFR5cGUiOiA1MTI2LCAidHlwZSI6ICJWRUMzI"
     "iwgImNvdW50IjogMSwgIm1pbiI6IFswLCAwLCAwXSwgIm1heCI6IFswLCAwLCAwXX1dLAogImJ1ZmZlclZpZXdzI"
     "jogW3siYnVmZmVyIjogMCwgImJ5dGVMZW5ndGgiOiAxMiwgInRhcmdldCI6IDM0OTYyfV0sCiAiYnVmZmVycyI6I"
     "Ft7ImJ5dGVMZW5ndGgiOiAxMn1dfQwAAABCSU4AAAAAAAAAAAAAAAAA",
     Fix::none, true},
    {"DATA_URI_GLB", Severity::warning, "A GLB carries data as text",
     "Base64 takes a third more room than the BIN chunk and must be decoded before use.",
     "Move the data into the BIN chunk.",
     "base64:Z2xURgIAAADcAQAAyAEAAEpTT057ImFzc2V0IjogeyJ2ZXJzaW9uIjogIjIuMCJ9LCAic2NlbmUiOiAwL"
     "CAic2NlbmVzIjogW3sibm9kZXMiOiBbMF19XSwgIm5vZGVzIjogW3sibWVzaCI6IDB9XSwKICJtZXNoZXMiOiBbe"
     "yJwcmltaXRpdmVzIjogW3siYXR0cmlidXRlcyI6IHsiUE9TSVRJT04iOiAwfSwgIm1vZGUiOiAwfV19XSwKICJhY"
     "2Nlc3NvcnMiOiBbeyJidWZmZXJWaWV3IjogMCwgImNvbXBvbmVudFR5cGUiOiA1MTI2LCAidHlwZSI6ICJWRUMzI"
     "iwgImNvdW50IjogMSwgIm1pbiI6IFswLCAwLCAwXSwgIm1heCI6IFswLCAwLCAwXX1dLAogImJ1ZmZlclZpZXdzI"
     "jogW3siYnVmZmVyIjogMCwgImJ5dGVMZW5ndGgiOiAxMiwgInRhcmdldCI6IDM0OTYyfV0sCiAiYnVmZmVycyI6I"
     "Ft7ImJ5dGVMZW5ndGgiOiAxMiwgInVyaSI6ICJkYXRhOmFwcGxpY2F0aW9uL29jdGV0LXN0cmVhbTtiYXNlNjQsQ"
     "UFBQUFBQUFBQUFBQUFBQSJ9XX0=",
     kGoodBuffer, Fix::none, true},
    {"INVALID_URI", Severity::error, "A URI cannot be read",
     "Readers cannot find the file or decode the data.",
     "Percent-encode what a URI does not allow; write base64 with its padding and without line"
     " breaks.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAA*AAA"}]})",
     kGoodBuffer, Fix::none, true},
    {"IO_ERROR", Severity::error, "A file cannot be read",
     "A buffer or image that is not there leaves holes in the model, or no model at all.",
     "Put the file where the asset looks for it, or correct the path. Upper and lower case "
     "count.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "missing.bin"}]})",
     kGoodBuffer, Fix::none, true},
    {"NON_RELATIVE_URI", Severity::warning, "A resource is not named by a relative path",
     "Absolute paths and network addresses do not travel with the asset; many programs refuse "
     "them.",
     "Put the file beside the asset and name it by a relative path.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "https://example.com/a.bin"}]})",
     kGoodBuffer, Fix::none, true},
    {"RESOURCE_NOT_A_FILE", Severity::error, "A resource is a folder or device",
     "Only regular files are read.", "Name a file.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "."}]})",
     kGoodBuffer, Fix::none, false},
    {"RESOURCE_NOT_CHECKED", Severity::info, "A resource was not looked up",
     "An asset from standard input has no folder, so the files it names are not searched for.",
     "Give the folder with --root.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "a.bin"}]})",
     kGoodBuffer, Fix::none, false},
    {"URI_GLB", Severity::info, "A GLB refers to another file",
     "A GLB is chosen to keep everything in one file; this one loses part of itself when it is"
     " moved.",
     "Put the data into the BIN chunk.",
     "base64:Z2xURgIAAADAAQAArAEAAEpTT057ImFzc2V0IjogeyJ2ZXJzaW9uIjogIjIuMCJ9LCAic2NlbmUiOiAwL"
     "CAic2NlbmVzIjogW3sibm9kZXMiOiBbMF19XSwgIm5vZGVzIjogW3sibWVzaCI6IDB9XSwKICJtZXNoZXMiOiBbe"
     "yJwcmltaXRpdmVzIjogW3siYXR0cmlidXRlcyI6IHsiUE9TSVRJT04iOiAwfSwgIm1vZGUiOiAwfV19XSwKICJhY"
     "2Nlc3NvcnMiOiBbeyJidWZmZXJWaWV3IjogMCwgImNvbXBvbmVudFR5cGUiOiA1MTI2LCAidHlwZSI6ICJWRUMzI"
     "iwgImNvdW50IjogMSwgIm1pbiI6IFswLCAwLCAwXSwgIm1heCI6IFswLCAwLCAwXX1dLAogImJ1ZmZlclZpZXdzI"
     "jogW3siYnVmZmVyIjogMCwgImJ5dGVMZW5ndGgiOiAxMiwgInRhcmdldCI6IDM0OTYyfV0sCiAiYnVmZmVycyI6I"
     "Ft7ImJ5dGVMZW5ndGgiOiAxMiwgInVyaSI6ICJodHRwczovL2V4YW1wbGUuY29tL2EuYmluIn1dfQ==",
     kGoodBuffer, Fix::none, true},
    {"URI_OUTSIDE_ROOT", Severity::error, "A resource lies outside the folder of the asset",
     "An asset that reaches into other folders can read files it should not, and breaks when "
     "it is moved.",
     "Put the file into the folder of the asset, or name a common folder with --root.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "../a.bin"}]})",
     kGoodBuffer, Fix::none, false},
};

void report(const Context& context, const Path& path, json::NodeId value, std::string_view code,
            std::string message) {
  Finding finding;
  finding.code = code;
  finding.message = std::move(message);
  finding.span = context.document.span(value);
  context.schema_sink.report(path, std::move(finding));
}

// The Khronos validator takes an image whose type is not that of its data URI for a fault of the
// URI; otherwise it is one of the image, and found when that is read.
void check_image_type(const Context& context, json::NodeId value, const Path& path,
                      std::string_view media_type, const container::Bytes& data) {
  const image::Sniffed sniffed = image::sniff(data.view());
  if (sniffed.known && image::media_type(sniffed.format) == media_type) return;
  report(context, path, value, "INVALID_URI",
         fmt::format("The data URI says {}, but its bytes are not of that type.",
                     gltfx::quoted(media_type)));
}

void check_data_uri(const Context& context, json::NodeId value, const Path& path,
                    std::string_view text, bool buffer) {
  const auto& uri = context.data_uris->get(value, text);
  if (!uri) {
    report(context, path, value, "INVALID_URI", uri.error().message);
    return;
  }
  const std::string& type = uri->media_type;
  if (buffer && type != "application/octet-stream" && type != "application/gltf-buffer") {
    report(context, path, value, "BUFFER_DATA_URI_MIME_TYPE_INVALID",
           fmt::format("The data URI says {}; a buffer's is application/octet-stream or "
                       "application/gltf-buffer.",
                       gltfx::quoted(type)));
  }
  if (!uri->decoded) {
    report(context, path, value, "INVALID_URI", uri->decoded.error().message);
  } else if (!buffer && context.khronos()) {
    check_image_type(context, value, path, type, *uri->decoded);
  }
}

void check_uri(const Context& context, json::NodeId object, const Path& path, bool buffer) {
  const json::Document& document = context.document;
  const json::NodeId value = document.find(object, "uri");
  if (value == json::kNoNode || !document.is_string(value)) return;
  std::string unescaped;
  const std::string_view text = document.string(value, unescaped);
  const container::Uri uri = container::classify_uri(text);
  const Path at(path, "uri");
  const bool data = uri.kind == container::UriKind::data;
  if (data) check_data_uri(context, value, at, text, buffer);
  if (uri.kind == container::UriKind::invalid) {
    report(context, at, value, "INVALID_URI",
           fmt::format("{} is no URI: {}.", gltfx::quoted(text), uri.problem));
  }
  if (uri.kind == container::UriKind::non_relative) {
    const bool outside = uri.local && !context.khronos();
    report(
        context, at, value, outside ? "URI_OUTSIDE_ROOT" : "NON_RELATIVE_URI",
        fmt::format("{} is no relative path; it is not looked up.", gltfx::quoted(uri.normalized)));
  }
  if (context.container.format != container::Format::glb) return;
  report(context, at, value, "URI_GLB", "A GLB should carry this in its BIN chunk.");
  if (data) report(context, at, value, "DATA_URI_GLB", "Data in a GLB is written as text.");
}

void check_buffer(const Context& context, json::NodeId object, const Path& path) {
  check_uri(context, object, path, true);
}

void check_image(const Context& context, json::NodeId object, const Path& path) {
  check_uri(context, object, path, false);
}

constexpr ObjectRuleEntry kObjectRules[] = {{"buffer", check_buffer}, {"image", check_image}};

}  // namespace

const Family& resource_family() {
  static const Family family{"resource", kRules, kObjectRules, {}};
  return family;
}

}  // namespace gltfx::validate
