// SPDX-License-Identifier: Apache-2.0
// The storage of the text, the buffers and the images of an asset (glTF 2.0 sections 3.6.1, 4).
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/text.hpp"
#include "change/commit.hpp"
#include "change/companions.hpp"
#include "container/uri.hpp"
#include "graph/unknown_indices.hpp"
#include "report/wording.hpp"
#include "schema/version.hpp"
#include "steps/file_names.hpp"
#include "steps/older_version.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

Result<StepOutcome> store(const StepInput& input) {
  auto outcome = input.options.to.value_or(StoredAs::glb) == StoredAs::glb ? pack(input)
                                                                           : store_as_text(input);
  const json::Document& document = input.asset.document();
  const bool becomes_older =
      !input.options.later.gltf.empty() && schema::stated_version(document) > schema::kVersion2;
  if (!outcome || !becomes_older) return outcome;
  json::Editor editor(document);
  restate_version(document, editor);
  auto& edits = outcome->change.edits;
  edits = json::merge_edits(std::move(edits), editor.take());
  outcome->freedom.version = true;
  return outcome;
}

}  // namespace

std::set<std::string> taken_names(const StepInput& input) {
  std::set<std::string> taken = change::referred_paths(input.asset.document());
  taken.insert(input.file_name);
  return taken;
}

bool keeps_file_names(const StepInput& input) {
  const ConvertOptions& options = input.options;
  if (options.in_place || options.shared_folder) return false;
  if (options.output.empty()) return true;
  std::error_code error;
  return !std::filesystem::equivalent(change::target_folder(input.asset.name(), options.output),
                                      change::target_folder(input.asset.name(), {}), error);
}

std::string asset_stem(const StepInput& input) {
  std::string name = clean_name(std::filesystem::path(input.file_name).stem().native());
  if (name.empty()) return "model";
  return input.options.targets.empty() ? name : unescaped_name(std::move(name));
}

std::string stem_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t begin = slash == path.npos ? 0 : slash + 1;
  const std::size_t dot = path.rfind('.');
  return dot == path.npos || dot <= begin ? path : path.substr(0, dot);
}

std::string stem_in_folder(const std::string& path) {
  std::string stem = stem_of(path);
  if (container::leads_out(stem)) stem.erase(0, stem.rfind('/') + 1);
  return stem;
}

std::string content_mark(const std::vector<container::Bytes>& pieces) {
  constexpr std::uint64_t kPrime = 0x100000001B3;
  std::uint64_t hash = 0;
  for (const container::Bytes& piece : pieces) hash = hash * kPrime ^ content_hash(piece.text());
  return fmt::format("-{:08x}", hash & UINT32_MAX);
}

std::string find_doubt(const graph::Graph& graph, std::string_view things) {
  const json::NodeId unknown = graph::find_unknown_with_integer(graph);
  if (unknown == json::kNoNode) return {};
  return fmt::format("{} may hold indices of {} (describe it with --schema)",
                     printable(graph.tree().pointer(unknown)), things);
}

std::string describe_moves(std::string_view form, std::uint64_t buffers, std::uint64_t images) {
  std::string what(form);
  if (buffers > 0) what += fmt::format(", {}", report::counted(buffers, "buffer"));
  if (images > 0) what += fmt::format(", {}", report::counted(images, "image"));
  return what;
}

// Up to three blanks at the end are replaced by new padding.
std::optional<json::Edit> blanks_after(std::string_view text) {
  constexpr std::size_t kEnough = 7;
  const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
  const std::string_view space = text.substr(end);
  if (space.size() >= kEnough || space.find_first_not_of(' ') == space.npos) return std::nullopt;
  const auto size = static_cast<std::uint32_t>(text.size());
  return json::Edit{{size, size}, std::string(kEnough - space.size(), ' ')};
}

StepDescription container_step();
StepDescription container_step() {
  return {"container",
          "moves buffers and images into one GLB of version 2 or 3, files or data URIs",
          "all bytes, and the text except `uri`, `chunk`, `buffer`, offsets and views of images",
          "the `name` of a buffer that becomes part of another, and numbers of other chunks",
          [](const ConvertOptions& options) {
            return options.to.has_value() || options.later.glb_version.has_value();
          },
          store};
}

}  // namespace gltfx::steps
