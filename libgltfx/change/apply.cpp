// SPDX-License-Identifier: Apache-2.0
#include "change/apply.hpp"

#include <utility>

#include "change/rewrite.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using container::Container;
using model::OpenedAsset;

// Whether two JSON texts are equal except for trailing blanks, as in a GLB.
bool same_but_for_padding(std::string_view one, std::string_view other) {
  const auto content = [](std::string_view json) {
    return json.substr(0, json.find_last_not_of(' ') + 1);
  };
  return content(one) == content(other);
}

// The container with the new text if only that changed, else read again.
Result<Container> changed_container(const OpenedAsset& before, const Change& change,
                                    const SharedText& text) {
  const Container& old = before.container();
  if (old.format != container::Format::glb || (change.bin.empty() && !change.sound_chunks)) {
    Container now = old;
    now.json = text;
    return now;
  }
  const auto pieces = change.sound_chunks ? rewrite_sound(old, *text, change.bin)
                                          : rewrite_glb(old, *text, change.bin);
  if (!pieces) return pieces.error();
  Container now =
      container::open_bytes(Bytes::from_string(container::join(*pieces)), before.name());
  if (now.json && same_but_for_padding(*now.json, *text)) now.json = text;
  return now;
}

}  // namespace

Result<OpenedAsset> apply(const OpenedAsset& before, const Change& change, NewText now) {
  const SharedText& old = before.container().json;
  if (!old) return Error{"it has no JSON"};
  if (auto why = find_glb_obstacle(before.container())) {
    return Error{"it cannot be written anew: " + *why};
  }
  if (!now.text) now.text = share_text(json::apply_edits(*old, change.edits));
  auto container = changed_container(before, change, now.text);
  if (!container) return container.error();
  container::Resolver resolver = before.resolver();
  for (const ReplacedFile& file : change.replaced) {
    resolver.add(file.path, file.after, file.state);
  }
  for (const NewFile& file : change.files) resolver.add(file.path, file.content());
  if (now.parsed.document.empty() || container->json != now.text) {
    return OpenedAsset(before.name(), *std::move(container), std::move(resolver));
  }
  return OpenedAsset(before.name(), *std::move(container), std::move(resolver),
                     std::move(now.parsed));
}

}  // namespace gltfx::change
