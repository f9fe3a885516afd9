// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/image_fixes.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "container/uri.hpp"
#include "image/header.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

std::string with_media_type(const std::string& uri, std::string_view type) {
  const std::size_t end = uri.find_first_of(";,");
  return json::string_value(fmt::format("data:{}{}", type, std::string_view(uri).substr(end)));
}

bool say_type(Fixing& fixing, std::uint32_t index) {
  const json::Document& document = fixing.document();
  const json::NodeId image = fixing.elements().elements(model::RootArray::images)[index];
  const auto& format = fixing.resources().images[index].format;
  if (!format || !fixing.claim(image)) return false;
  const std::string_view type = image::media_type(*format);
  bool changed = false;
  const json::NodeId declared = document.find(image, "mimeType");
  if (declared != json::kNoNode && document.is_string(declared) &&
      document.string(declared) != type) {
    changed = fixing.replace_scalar(declared, fmt::format("\"{}\"", type));
  }
  const std::string uri = model::string_member(document, image, "uri");
  const auto data = container::split_data_uri(uri);
  if (container::classify_uri(uri).kind == container::UriKind::data && data &&
      data->media_type != type) {
    changed = fixing.replace_scalar(document.find(image, "uri"), with_media_type(uri, type));
  }
  return changed;
}

}  // namespace

bool correct_image_type(Fixing& fixing, const Subject& member) {
  const auto image = fixing.index(model::RootArray::images, member.owner);
  return image && say_type(fixing, *image);
}

bool request_conversion(Fixing& fixing, const Subject& image) {
  const auto index = fixing.index(model::RootArray::images, image.value);
  if (!index) return false;
  fixing.convert_image(*index);
  return true;
}

}  // namespace gltfx::validate
