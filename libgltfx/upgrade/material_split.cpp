// SPDX-License-Identifier: Apache-2.0
#include "upgrade/material_split.hpp"

#include <utility>

#include "json/parse.hpp"
#include "upgrade/context.hpp"

namespace gltfx::upgrade {
namespace {

// The text of a value as the edits leave it.
std::string edited(const Context& context, json::NodeId value) {
  const Span whole = context.document.span(value);
  std::vector<json::Edit> inside;
  for (const json::Edit& edit : context.plan.edits) {
    if (edit.span.begin < whole.begin || edit.span.end > whole.end) continue;
    inside.push_back({{edit.span.begin - whole.begin, edit.span.end - whole.begin}, edit.text});
  }
  return json::apply_edits(context.document.raw(value), inside);
}

// The object with a member of that value, which need not be there, below those that are.
std::string with_member(const std::string& text, const std::vector<std::string>& path,
                        const std::string& json) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  const json::Document& document = parsed.document;
  json::NodeId owner = document.root();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) owner = document.find(owner, path[i]);
  const json::NodeId value = document.find(owner, path.back());
  json::Editor editor(document);
  if (value == json::kNoNode) {
    editor.append_member(owner, path.back(), json);
  } else {
    editor.replace(owner, value, json);
  }
  return json::apply_edits(text, editor.take());
}

}  // namespace

std::uint64_t split_material(Context& context, MaterialSplit split) {
  const std::uint64_t index = context.plan.additions.old_count("materials") + context.splits.size();
  for (const json::NodeId user : split.users) {
    context.editor.replace_scalar(user, std::to_string(index));
  }
  context.splits.push_back(std::move(split));
  return index;
}

void settle_splits(Context& context) {
  for (const MaterialSplit& split : context.splits) {
    context.plan.additions.add_element(
        "materials", with_member(edited(context, split.material), split.member, split.json));
  }
}

}  // namespace gltfx::upgrade
