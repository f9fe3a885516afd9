// SPDX-License-Identifier: Apache-2.0
#include "change/apply.hpp"

#include <utility>

#include "change/rewrite.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using container::Container;
using container::Format;
using Pieces = std::vector<Bytes>;
using model::OpenedAsset;

// Whether two JSON texts are equal except for trailing blanks, as in a GLB.
bool same_but_for_padding(std::string_view one, std::string_view other) {
  const auto content = [](std::string_view json) {
    return json.substr(0, json.find_last_not_of(' ') + 1);
  };
  return content(one) == content(other);
}

// The ending matches the container.
std::string name_of(const OpenedAsset& before, const Change& change) {
  if (!change.format || *change.format == before.container().format) return before.name();
  std::filesystem::path name(before.name());
  return name.replace_extension(*change.format == Format::glb ? ".glb" : ".gltf").native();
}

bool changes_chunks(const Change& change) {
  return !change.bins.empty() || change.sound_chunks || change.glb_version;
}

Result<Pieces> chunks_of(const Container& old, const Change& change, std::string_view text) {
  if (old.format != Format::glb) {
    const auto bin = change.bins.find(kNewBin);
    return make_glb(text,
                    bin == change.bins.end() ? Pieces() : bin->second.whole.value_or(Pieces()),
                    change.glb_version.value_or(2));
  }
  if (change.glb_version && change.glb_version != old.glb_version) {
    return convert_glb(old, text, change.bins, *change.glb_version);
  }
  return change.sound_chunks ? rewrite_sound(old, text, change.bins)
                             : rewrite_glb(old, text, change.bins);
}

// With the new text if only the text changed; otherwise read again.
Result<Container> changed_container(const OpenedAsset& before, const Change& change,
                                    const SharedText& text, DraftPlace& place) {
  const Container& old = before.container();
  const Format format = change.format.value_or(old.format);
  if (format == Format::gltf && old.format == Format::glb) {
    // All blanks at the end, which may be more than padding.
    const std::size_t end = text->find_last_not_of(' ') + 1;
    const bool whole = end == text->size();
    return container::open_bytes(
        Bytes::from_text(whole ? text : share_text(std::string(text->substr(0, end)))), format);
  }
  if (format == Format::gltf || (old.format == format && !changes_chunks(change))) {
    Container now = old;
    now.json = text;
    return now;
  }
  const auto pieces = chunks_of(old, change, *text);
  if (!pieces) return pieces.error();
  Container now = container::open_bytes(place.hold_asset(*pieces), format);
  if (now.json && same_but_for_padding(*now.json, *text)) now.json = text;
  return now;
}

}  // namespace

Result<OpenedAsset> apply(const OpenedAsset& before, const Change& change, NewText now,
                          DraftPlace& place) {
  const SharedText& old = before.container().json;
  if (!old) return Error{"it has no JSON"};
  if (auto why = find_glb_obstacle(before.container())) {
    return Error{"it cannot be written anew: " + *why};
  }
  if (!now.text) now.text = share_text(json::apply_edits(*old, change.edits));
  auto container = changed_container(before, change, now.text, place);
  if (!container) return container.error();
  container::Resolver resolver = before.resolver();
  for (const ReplacedFile& file : change.replaced) {
    resolver.add(file.path, file.after, file.state);
  }
  for (const NewFile& file : change.files) {
    resolver.add(file.path, place.hold_file(file.pieces));
  }
  const std::string name = name_of(before, change);
  if (now.parsed.document.empty() || container->json != now.text) {
    return OpenedAsset(name, *std::move(container), std::move(resolver));
  }
  return OpenedAsset(name, *std::move(container), std::move(resolver), std::move(now.parsed));
}

Result<OpenedAsset> apply(const OpenedAsset& before, const Change& change, NewText now) {
  DraftPlace memory;
  return apply(before, change, std::move(now), memory);
}

}  // namespace gltfx::change
