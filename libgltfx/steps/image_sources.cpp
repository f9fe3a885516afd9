// SPDX-License-Identifier: Apache-2.0
#include "steps/image_sources.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/name_list.hpp"
#include "graph/extensions.hpp"
#include "model/fields.hpp"

namespace gltfx::steps {
namespace {

using model::RootArray;
using schema::Extension;

bool has_type(const Extension& extension, std::string_view media_type) {
  const auto& types = extension.image_mime_types;
  return std::find(types.begin(), types.end(), media_type) != types.end();
}

// The number of objects that have an extension, and of those without a fallback.
struct Holders {
  std::uint64_t all = 0;
  std::uint64_t without_fallback = 0;
};

}  // namespace

ImageSources::ImageSources(const model::Asset& asset, const graph::Graph& graph,
                           const OtherUsers& others)
    : asset_(asset),
      graph_(graph),
      others_(others),
      by_image_(asset.count(RootArray::images)),
      by_texture_(asset.count(RootArray::textures)) {
  const auto& textures = asset.elements(RootArray::textures);
  for (std::uint32_t i = 0; i < textures.size(); ++i) {
    if (textures[i] != json::kNoNode) read(i, textures[i]);
  }
}

void ImageSources::read(std::uint32_t texture, json::NodeId object) {
  const json::Document& document = asset_.document();
  const auto image = asset_.index(object, "source", RootArray::images);
  if (image) add({texture, *image, document.find(object, "source")});
  const json::NodeId extensions = model::object_member(document, object, "extensions");
  if (extensions == json::kNoNode) return;
  for (const auto member : document.members(extensions)) {
    const auto its = asset_.index(member.value, "source", RootArray::images);
    if (!its) continue;
    const schema::ExtensionId id = graph_.set().find_extension(document.key(member.key_id));
    add({texture, *its, document.find(member.value, "source"), member.key,
         id == schema::kNone ? nullptr : &graph_.set().extensions()[id]});
  }
}

void ImageSources::add(Source source) {
  by_image_[source.image].push_back(sources_.size());
  by_texture_[source.texture].push_back(sources_.size());
  sources_.push_back(source);
}

// The texture extension for a format, the most established one; null: none.
const Extension* ImageSources::extension_for(std::string_view media_type) const {
  const schema::TypeId texture = graph_.set().find_type("texture");
  const auto& all = graph_.set().extensions();
  const Extension* best = nullptr;
  for (const Extension& extension : all) {
    if (!has_type(extension, media_type) || extension.shape_on(texture) == schema::kNone) continue;
    if (best == nullptr || extension.status < best->status) best = &extension;
  }
  return best;
}

bool ImageSources::allow(std::uint32_t image, std::string_view media_type) const {
  if (is_core_type(media_type)) return true;
  const auto allows = [&](std::size_t i) {
    const Source& source = sources_[i];
    if (source.is_core()) return false;
    return source.extension == nullptr || has_type(*source.extension, media_type);
  };
  const auto& sources = by_image_[image];
  if (!sources.empty()) return std::all_of(sources.begin(), sources.end(), allows);
  const auto& names = graph_.checked().extensions_used;
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    const schema::ExtensionId id = graph_.set().find_extension(name);
    return id != schema::kNone && has_type(graph_.set().extensions()[id], media_type);
  });
}

std::string ImageSources::find_obstacle(std::uint32_t image, std::string_view media_type) const {
  const bool core = is_core_type(media_type);
  const Extension* extension = core ? nullptr : extension_for(media_type);
  if (!core && extension == nullptr) return "no extension allows the format";
  const auto other = others_.of_images.find(image);
  if (!core && other != others_.of_images.end()) {
    return fmt::format("{} uses it without a texture", printable(other->second));
  }
  if (!core && by_image_[image].empty()) return "no texture uses it";
  for (const std::size_t i : by_image_[image]) {
    if (is_unlinked(sources_[i])) continue;
    std::string why = find_obstacle(sources_[i], extension);
    if (!why.empty()) return why;
  }
  return {};
}

std::string ImageSources::find_obstacle(const Source& source, const Extension* extension) const {
  const json::NodeId object = asset_.elements(RootArray::textures)[source.texture];
  const json::Document& document = asset_.document();
  const auto refuse = [&](std::string_view why) {
    return fmt::format("/textures/{} {}", source.texture, why);
  };
  if (source.is_core() && extension == nullptr) return {};
  if (!source.is_core() && source.extension == nullptr) {
    return refuse(
        fmt::format("refers to it through {}, which has no schema (describe it with --schema)",
                    gltfx::quoted(document.key(document.node(source.key).next))));
  }
  if (source.extension != nullptr && source.extension == extension) return {};
  const json::NodeId extensions = document.find(object, "extensions");
  if (extensions != json::kNoNode && !document.is_object(extensions)) {
    return refuse("has broken extensions");
  }
  const bool moves_between = extension != nullptr && !source.is_core();
  if (!has_other(source, !moves_between)) return {};
  return refuse(source.is_core() ? "uses it as the fallback for another image"
                                 : "has another image in another format");
}

// Whether the texture refers to another image; `own_too` includes its own `source`.
bool ImageSources::has_other(const Source& source, bool own_too) const {
  const auto& all = by_texture_[source.texture];
  return std::any_of(all.begin(), all.end(), [&](std::size_t i) {
    const Source& other = sources_[i];
    return other.image != source.image && (own_too || !other.is_core());
  });
}

void ImageSources::set_type(std::uint32_t image, std::string_view media_type) {
  const Extension* extension = is_core_type(media_type) ? nullptr : extension_for(media_type);
  for (const std::size_t i : by_image_[image]) {
    const Source& source = sources_[i];
    if (extension == nullptr ? source.is_core() : source.extension == extension) continue;
    if (is_unlinked(source)) continue;
    Move& move = moves_[source.texture];
    if (source.is_core()) {
      move.loses_own = true;
    } else {
      move.removed.push_back(source.key);
    }
    const auto& all = by_texture_[source.texture];
    const bool there = std::any_of(all.begin(), all.end(), [&](std::size_t other) {
      const Source& has = sources_[other];
      return extension == nullptr ? has.is_core() : has.extension == extension;
    });
    if (there) continue;
    if (extension == nullptr) {
      move.own = image;
    } else {
      move.extension = extension;
      move.image = image;
    }
  }
}

bool ImageSources::is_format_of(std::string_view name, std::string_view media_type) const {
  const schema::ExtensionId id = graph_.set().find_extension(name);
  return id != schema::kNone && has_type(graph_.set().extensions()[id], media_type);
}

std::optional<std::uint32_t> ImageSources::own_image(std::uint32_t texture) const {
  for (const std::size_t i : by_texture_[texture]) {
    if (sources_[i].is_core()) return sources_[i].image;
  }
  return std::nullopt;
}

bool ImageSources::is_unlinked(const Source& source) const {
  const auto found = moves_.find(source.texture);
  if (source.is_core() || found == moves_.end()) return false;
  const auto& keys = found->second.removed;
  return std::find(keys.begin(), keys.end(), source.key) != keys.end();
}

bool ImageSources::has_fallbacks(std::uint32_t image) const {
  const auto& all = by_image_[image];
  return !all.empty() && std::all_of(all.begin(), all.end(), [this](std::size_t i) {
    return !sources_[i].is_core() && own_image(sources_[i].texture);
  });
}

void ImageSources::unlink(std::uint32_t image) {
  for (const std::size_t i : by_image_[image]) {
    const Source& source = sources_[i];
    if (source.is_core() || !own_image(source.texture) || is_unlinked(source)) continue;
    moves_[source.texture].removed.push_back(source.key);
    unlinked_.insert(image);
  }
}

std::map<std::uint32_t, std::uint32_t> ImageSources::stand_ins() const {
  std::map<std::uint32_t, std::uint32_t> images;
  for (const std::uint32_t image : unlinked_) {
    const auto& all = by_image_[image];
    const bool used = others_.of_images.contains(image) ||
                      std::any_of(all.begin(), all.end(),
                                  [this](std::size_t i) { return !is_unlinked(sources_[i]); });
    const auto other = own_image(sources_[all.front()].texture);
    if (!used && other && !unlinked_.contains(*other)) images.emplace(image, *other);
  }
  return images;
}

void ImageSources::edit(json::Editor& editor) const {
  for (const auto& [texture, move] : moves_) edit_texture(texture, move, editor);
  if (!moves_.empty() || !unrequired_.empty()) edit_lists(editor);
}

void ImageSources::edit_texture(std::uint32_t texture, const Move& move,
                                json::Editor& editor) const {
  const json::Document& document = asset_.document();
  const json::NodeId object = asset_.elements(RootArray::textures)[texture];
  const json::NodeId extensions = document.find(object, "extensions");
  const std::string added =
      move.extension == nullptr ? std::string() : fmt::format(R"({{"source":{}}})", move.image);
  if (move.loses_own) editor.remove(object, document.find(object, "source") - 1);
  if (move.own) editor.append_member(object, "source", std::to_string(*move.own));
  if (extensions == json::kNoNode) {
    if (added.empty()) return;
    const std::string member = fmt::format(R"({{"{}":{}}})", move.extension->name, added);
    return editor.append_member(object, "extensions", member);
  }
  if (added.empty() && move.removed.size() == document.object_size(extensions)) {
    return editor.remove(object, extensions - 1);
  }
  if (!added.empty() && move.removed.size() == 1) {
    return editor.rename(move.removed.front(), move.extension->name);
  }
  for (const json::NodeId key : move.removed) editor.remove(extensions, key);
  if (!added.empty()) editor.append_member(extensions, move.extension->name, added);
}

// Updates the lists for extensions that textures gained or lost.
void ImageSources::edit_lists(json::Editor& editor) const {
  const json::Document& document = asset_.document();
  std::map<std::string, Holders, std::less<>> touched;
  std::set<json::NodeId> removed;
  for (const auto& [texture, move] : moves_) {
    for (const json::NodeId key : move.removed) {
      removed.insert(key);
      touched[std::string(document.key(document.node(key).next))];
    }
    if (move.extension != nullptr) touched[move.extension->name];
  }
  for (const std::string& name : unrequired_) touched[name];
  graph::each_extension(document, [&](const auto& member) {
    const auto found = touched.find(document.key(member.key_id));
    if (found != touched.end() && !removed.contains(member.key)) ++found->second.all;
  });
  const auto& textures = asset_.elements(RootArray::textures);
  for (std::uint32_t i = 0; i < textures.size(); ++i) {
    if (textures[i] == json::kNoNode) continue;
    const auto found = moves_.find(i);
    const Move move = found == moves_.end() ? Move() : found->second;
    const bool own =
        move.own || (!move.loses_own && document.find(textures[i], "source") != json::kNoNode);
    if (move.extension != nullptr) {
      Holders& holders = touched[move.extension->name];
      ++holders.all;
      if (!own) ++holders.without_fallback;
    }
    const json::NodeId extensions = model::object_member(document, textures[i], "extensions");
    if (own || extensions == json::kNoNode) continue;
    for (const auto member : document.members(extensions)) {
      const auto its = touched.find(document.key(member.key_id));
      if (its != touched.end() && !removed.contains(member.key)) ++its->second.without_fallback;
    }
  }
  change::NameList used(document, "extensionsUsed");
  change::NameList required(document, "extensionsRequired");
  for (const auto& [name, holders] : touched) {
    const schema::ExtensionId id = graph_.set().find_extension(name);
    if (holders.all == 0) {
      used.remove(name);
      required.remove(name);
      continue;
    }
    used.add(name);
    if (holders.without_fallback > 0) {
      required.add(name);
    } else if (unrequired_.contains(name) ||
               (id != schema::kNone && graph_.set().extensions()[id].optional_with_fallback)) {
      required.remove(name);
    }
  }
  used.apply(editor);
  required.apply(editor);
}

}  // namespace gltfx::steps
