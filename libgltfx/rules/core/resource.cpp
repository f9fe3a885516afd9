// SPDX-License-Identifier: Apache-2.0
// Sources of buffers, images and files: the form of a URI, and the media type and data of data
// URIs.
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "container/uri.hpp"
#include "image/header.hpp"
#include "json/writer.hpp"
#include "rules/context.hpp"
#include "rules/core/uri_form.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

void report(const Context& context, const Path& path, json::NodeId value, Code code,
            std::string message) {
  Finding finding(code);
  finding.message = std::move(message);
  finding.span = context.document.span(value);
  context.schema_sink.report(path, std::move(finding));
}

// If the type differs from that of the data URI, it is an error of the URI; otherwise it is an
// error of the image, found when the image is read.
void check_image_type(const Context& context, json::NodeId value, const Path& path,
                      std::string_view media_type, const container::Bytes& data) {
  const image::Sniffed sniffed = image::sniff(data.view());
  if (sniffed.known && image::media_type(sniffed.format) == media_type) return;
  report(context, path, value, Code::INVALID_URI,
         fmt::format("The media type of the data URI is {}, but its data is not of that type.",
                     gltfx::quoted(media_type)));
}

void check_data_uri(const Context& context, json::NodeId value, const Path& path,
                    std::string_view text, bool buffer) {
  const auto& uri = context.data_uris->get(value, text);
  if (!uri) {
    report(context, path, value, Code::INVALID_URI, uri.error().message);
    return;
  }
  const std::string& type = uri->media_type;
  if (buffer && type != "application/octet-stream" && type != "application/gltf-buffer") {
    report(context, path, value, Code::BUFFER_DATA_URI_MIME_TYPE_INVALID,
           fmt::format("The media type of the data URI is {}; it must be application/octet-stream "
                       "or application/gltf-buffer.",
                       gltfx::quoted(type)));
  }
  if (!uri->decoded) {
    report(context, path, value, Code::INVALID_URI, uri->decoded.error().message);
  } else if (!buffer && context.deviations.mistyped_data_uris_are_dropped) {
    check_image_type(context, value, path, type, *uri->decoded);
  }
}

enum class Holder : std::uint8_t { buffer, image, file };

void check_uri(const Context& context, json::NodeId object, const Path& path, Holder holder) {
  const json::Document& document = context.document;
  const json::NodeId value = document.find(object, "uri");
  if (value == json::kNoNode || !document.is_string(value)) return;
  std::string unescaped;
  const std::string_view text = document.string(value, unescaped);
  const container::Uri uri = container::classify_uri(text, context.uri_reading());
  const Path at(path, "uri");
  const bool data = uri.kind == container::UriKind::data;
  if (data) check_data_uri(context, value, at, text, holder == Holder::buffer);
  check_uri_form(context, context.schema_sink, value, at);
  if (context.container.format != container::Format::glb || holder == Holder::file) return;
  if (!data || context.deviations.data_uris_are_external) {
    report(context, at, value, Code::URI_GLB, "The GLB references an external file.");
  }
  if (data) report(context, at, value, Code::DATA_URI_GLB, "The GLB contains a data URI.");
}

void check_buffer(const Context& context, json::NodeId object, const Path& path) {
  check_uri(context, object, path, Holder::buffer);
}

void check_image(const Context& context, json::NodeId object, const Path& path) {
  check_uri(context, object, path, Holder::image);
}

void check_file(const Context& context, json::NodeId object, const Path& path) {
  check_uri(context, object, path, Holder::file);
}

// --- Fixes ---

// `place` is the URI.
bool say_octets(Fixing& fixing, const Subject& subject) {
  if (subject.value == json::kNoNode || !fixing.document().is_string(subject.value)) return false;
  const std::string uri = fixing.document().string(subject.value);
  const std::size_t end = uri.find_first_of(";,");
  if (container::classify_uri(uri).kind != container::UriKind::data || end == std::string::npos) {
    return false;
  }
  std::string text;
  json::append_string(text, "data:application/octet-stream" + uri.substr(end));
  return fixing.replace_scalar(subject.value, std::move(text));
}

constexpr FixEntry kUriFixes[] = {{Code::BUFFER_DATA_URI_MIME_TYPE_INVALID, say_octets}};

}  // namespace

const RuleGroup& resource_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"buffer", check_buffer}, {"image", check_image}, {"file", check_file}};
  static constexpr RuleGroup group{.object_rules = kObjectRules, .fixes = kUriFixes};
  return group;
}

}  // namespace gltfx::validate
