// SPDX-License-Identifier: Apache-2.0
#include "steps/image_store.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/companions.hpp"
#include "container/base64.hpp"
#include "container/near_files.hpp"
#include "container/uri.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "steps/image_sources.hpp"
#include "steps/json_edits.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;
using model::RootArray;
using model::Storage;

std::map<std::string, std::size_t> count_references(const json::Document& document) {
  std::map<std::string, std::size_t> counts;
  for (const auto& [node, path] : change::referred_files(document)) ++counts[path];
  return counts;
}

std::string_view ending_for(std::string_view media_type) {
  if (media_type == "image/jpeg") return ".jpg";
  if (media_type == "image/webp") return ".webp";
  if (media_type == "image/ktx2") return ".ktx2";
  return media_type == "image/avif" ? ".avif" : ".png";
}

}  // namespace

std::vector<ImageGroup> group_images(const model::Asset& asset, const model::AssetBytes& bytes) {
  std::vector<ImageGroup> groups;
  std::map<std::string, std::size_t> by_path;
  std::map<json::NodeId, std::size_t> by_view;
  for (std::uint32_t i = 0; i < asset.count(RootArray::images); ++i) {
    const json::NodeId image = asset.elements(RootArray::images)[i];
    ImageGroup group{{i}, bytes.image_storage(i), json::kNoNode, {}};
    std::size_t at = groups.size();
    if (group.storage == Storage::file) {
      group.path =
          container::classify_uri(model::string_member(asset.document(), image, "uri")).path;
      if (!group.path.empty()) at = by_path.try_emplace(group.path, at).first->second;
    } else if (group.storage == Storage::buffer_view) {
      const auto view = asset.index(image, "bufferView", RootArray::buffer_views);
      if (view) group.view = asset.elements(RootArray::buffer_views)[*view];
      at = by_view.try_emplace(group.view, at).first->second;
    }
    if (at == groups.size()) {
      groups.push_back(std::move(group));
    } else {
      groups[at].images.push_back(i);
    }
  }
  return groups;
}

ImageStore::ImageStore(const StepInput& input, const model::Asset& elements,
                       const graph::Graph& graph, json::Editor& editor)
    : input_(input),
      document_(input.asset.document()),
      elements_(elements),
      graph_(graph),
      editor_(editor),
      names_(taken_names(input)),
      referred_(count_references(document_)),
      keeps_names_(keeps_file_names(input)),
      buffer_(input.asset) {
  change_.additions = change::Additions(document_);
}

std::string ImageStore::find_obstacle(const ImageGroup& group) const {
  for (const std::uint32_t i : group.images) {
    const json::NodeId image = elements_.elements(RootArray::images)[i];
    const bool both = document_.find(image, "uri") != json::kNoNode &&
                      document_.find(image, "bufferView") != json::kNoNode;
    if (both) return "it has both a uri and a bufferView";
  }
  if (group.view == json::kNoNode) return {};
  const bool extended = document_.find(group.view, "extensions") != json::kNoNode;
  return extended ? "its buffer view has extensions" : "";
}

std::optional<Error> ImageStore::store(const ImageGroup& group, NewImage image) {
  const std::string type = json::string_value(image.media_type);
  const bool in_view = group.storage == Storage::buffer_view;
  // Some engines read a format of an extension only if it is named.
  const bool is_named = in_view || (!image.same_format && !is_core_type(image.media_type));
  if (in_view) {
    store_in_view(group, std::move(image));
  } else if (group.storage == Storage::data_uri) {
    const json::NodeId object = elements_.elements(RootArray::images)[group.images.front()];
    set(object, "uri", json::string_value(container::data_uri(image.media_type, image.bytes)),
        false);
  } else if (auto trouble = store_in_file(group, std::move(image))) {
    return trouble;
  }
  for (const std::uint32_t i : group.images) {
    set(elements_.elements(RootArray::images)[i], "mimeType", type, is_named);
  }
  return std::nullopt;
}

// Reuses the view if only these images use it; otherwise adds one.
void ImageStore::store_in_view(const ImageGroup& group, NewImage image) {
  std::set<json::NodeId> own;
  for (const std::uint32_t i : group.images) {
    own.insert(document_.find(elements_.elements(RootArray::images)[i], "bufferView"));
  }
  const auto users = graph_.users(group.view);
  const bool shared = !std::all_of(
      users.begin(), users.end(), [&](const graph::Use& use) { return own.contains(use.at.node); });
  const std::size_t length = image.bytes.size();
  const std::uint64_t begin = buffer_.add(std::move(image.bytes));
  if (!shared) {
    set(group.view, "buffer", std::to_string(buffer_.index()), true);
    set(group.view, "byteOffset", std::to_string(begin), true);
    set(group.view, "byteLength", std::to_string(length), true);
    return;
  }
  const std::uint64_t view =
      change_.additions.add_element("bufferViews", view_json({buffer_.index(), begin, length}));
  for (const json::NodeId member : own) editor_.replace_scalar(member, std::to_string(view));
}

std::optional<Error> ImageStore::store_in_file(const ImageGroup& group, NewImage image) {
  Bytes bytes = Bytes::from_string(std::move(image.bytes));
  const bool keeps_ending =
      image.same_format || ending_of(group.path) == ending_for(image.media_type);
  if (keeps_ending && may_replace(group)) {
    const json::NodeId first = elements_.elements(RootArray::images)[group.images.front()];
    const auto uri = container::classify_uri(model::string_member(document_, first, "uri"));
    container::Resolved file = input_.asset.resolver().open(uri);
    if (file.error != container::ResolveError::none) return Error{"its file cannot be read"};
    change_.replaced.push_back({group.path, file.state, std::move(file.bytes), std::move(bytes)});
    return std::nullopt;
  }
  const std::string path = new_path(group, image, bytes);
  for (const std::uint32_t i : group.images) {
    const json::NodeId object = elements_.elements(RootArray::images)[i];
    set(object, "uri", json::string_value(uri_for(object, group.path, path)), false);
  }
  change_.files.push_back({path, {std::move(bytes)}});
  return std::nullopt;
}

// Whether the file can be overwritten because nothing else uses its old bytes.
bool ImageStore::may_replace(const ImageGroup& group) const {
  if (!keeps_names_ || container::leads_out(group.path)) return false;
  const auto found = referred_.find(group.path);
  return found != referred_.end() && found->second == group.images.size();
}

// New files are never outside the folder of the asset.
std::string ImageStore::new_path(const ImageGroup& group, const NewImage& image,
                                 const Bytes& bytes) {
  const std::string own = ending_of(group.path);
  const std::string_view ending =
      image.same_format && !own.empty() ? std::string_view(own) : ending_for(image.media_type);
  const bool marked = input_.options.shared_folder || own == ending;
  return names_.take(stem_in_folder(group.path), ending,
                     marked ? content_mark({bytes}) : std::string());
}

// Keeps the spelling of the old URI if it then refers to the new path.
std::string ImageStore::uri_for(json::NodeId image, const std::string& old_path,
                                const std::string& path) const {
  const std::string old = model::string_member(document_, image, "uri");
  const std::string stem = stem_of(old_path);
  if (path.starts_with(stem)) {
    std::string uri = stem_of(old) + path.substr(stem.size());
    const container::Uri read = container::classify_uri(uri);
    if (read.kind == container::UriKind::relative_path && read.path == path) return uri;
  }
  return container::uri_of_path(path);
}

// `add`: append the member if it does not exist.
void ImageStore::set(json::NodeId object, std::string_view name, const std::string& json,
                     bool add) {
  const json::NodeId old = document_.find(object, name);
  if (old == json::kNoNode) {
    if (add) editor_.append_member(object, name, json);
  } else if (document_.raw(old) != json) {
    editor_.replace(object, old, json);
  }
}

void ImageStore::add_to(change::Change& change) {
  buffer_.add_to(change_);
  change.files = std::move(change_.files);
  change.replaced = std::move(change_.replaced);
  change.additions = std::move(change_.additions);
}

}  // namespace gltfx::steps
