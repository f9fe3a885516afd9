// SPDX-License-Identifier: Apache-2.0
#include "change/chain.hpp"

#include <set>
#include <string>
#include <utility>

#include "change/companions.hpp"
#include "json/edit.hpp"
#include "json/parse.hpp"

namespace gltfx::change {

void append(Change& all, const Change& next, std::string_view text) {
  if (all.empty()) {
    all = next;
    return;
  }
  all.edits = json::chain_edits(text, all.edits, next.edits);
  all.files.insert(all.files.end(), next.files.begin(), next.files.end());
  all.replaced.insert(all.replaced.end(), next.replaced.begin(), next.replaced.end());
  if (next.format) {  // with all bytes of the asset before it
    all.format = next.format;
    all.bin = {};
  }
  if (!next.bin.empty()) all.bin = next.bin;
}

NewText drop_unnamed_files(Change& all, std::string_view text) {
  if (all.files.empty() && all.replaced.empty()) return {};
  NewText now;
  now.text = share_text(json::apply_edits(text, all.edits));
  now.parsed = json::parse(now.text);
  const std::set<std::string> named = referred_paths(now.parsed.document);
  std::erase_if(all.files, [&](const NewFile& file) { return !named.contains(file.path); });
  std::erase_if(all.replaced, [&](const ReplacedFile& file) { return !named.contains(file.path); });
  return now;
}

}  // namespace gltfx::change
