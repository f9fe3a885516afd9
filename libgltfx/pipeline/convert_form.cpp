// SPDX-License-Identifier: Apache-2.0
#include "pipeline/convert_form.hpp"

#include "base/text.hpp"
#include "change/commit.hpp"
#include "steps/glb_chunks.hpp"

namespace gltfx {

using model::OpenedAsset;

std::optional<StoredAs> form_of(const OpenedAsset& asset, const ConvertOptions& options) {
  if (options.to || options.output.empty() || options.in_place) return options.to;
  const bool is_glb = asset.container().format == container::Format::glb;
  if (is_glb && ending_of(options.output) == ".gltf") return StoredAs::gltf;
  if (is_glb && options.later.flatten) return StoredAs::glb;  // the bytes of other assets, too
  if (!is_glb && has_glb_ending(options.output)) return StoredAs::glb;
  return std::nullopt;
}

std::optional<GlbVersion> glb_version_of(const OpenedAsset& asset, const ConvertOptions& options) {
  const bool is_glb = asset.container().format == container::Format::glb;
  const bool becomes_glb = options.to ? options.to == StoredAs::glb : is_glb;
  if (!becomes_glb) return std::nullopt;
  const GlbVersion wanted = options.later.glb_version.value_or(GlbVersion::least);
  if (options.to) return wanted;
  const bool becomes_older = !options.later.gltf.empty();  // glTF 2.0 has GLBs of version 2
  const bool keeps = options.output.empty() || change::is_in_place(options, asset.name());
  if (!options.later.glb_version && keeps && !becomes_older) return std::nullopt;
  if (becomes_older && steps::names_chunks(asset.document())) return wanted;
  const bool has_it = (asset.container().glb_version == 3U) == (wanted == GlbVersion::three);
  return has_it ? std::nullopt : std::optional(wanted);
}

}  // namespace gltfx
