// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/context.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "json/parse.hpp"

namespace gltfx::upgrade {
namespace {

// The text of a value after the edits.
std::string edited(const Context& context, json::NodeId value) {
  const Span whole = context.document.span(value);
  std::vector<json::Edit> inside;
  for (const json::Edit& edit : context.plan.change.edits) {
    if (edit.span.begin < whole.begin || edit.span.end > whole.end) continue;
    inside.push_back({{edit.span.begin - whole.begin, edit.span.end - whole.begin}, edit.text});
  }
  return json::apply_edits(context.document.raw(value), inside);
}

// The object with a new value for the member at `path`. The member may be missing, but not its
// parents.
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
  const std::uint64_t index =
      context.plan.change.additions.old_count("materials") + context.splits.size();
  for (const json::NodeId user : split.users) {
    context.editor.replace_scalar(user, std::to_string(index));
  }
  context.splits.push_back(std::move(split));
  return index;
}

void resolve_splits(Context& context) {
  for (const MaterialSplit& split : context.splits) {
    context.plan.change.additions.add_element(
        "materials", with_member(edited(context, split.material), split.member, split.json));
  }
}

std::uint64_t Context::add_texture(const ImageJob& job, std::optional<std::uint64_t> sampler) {
  change::Additions& additions = plan.change.additions;
  std::string what = "image";
  for (const ChannelSource& channel : job.channels) {
    const std::string from = channel.image ? std::to_string(*channel.image) : std::string();
    fmt::format_to(std::back_inserter(what), " {}.{}*{}+{}", from, channel.channel, channel.scale,
                   channel.offset);
  }
  const auto [image, is_new] = new_textures.emplace(what, 0);
  if (is_new) {
    image->second = additions.add_image({});
    plan.images.push_back(job);
  }
  const std::string by = sampler ? fmt::format(R"("sampler":{},)", *sampler) : std::string();
  const std::string json = fmt::format(R"({{{}"source":{}}})", by, image->second);
  const auto [texture, is_new_texture] = new_textures.emplace(json, 0);
  if (is_new_texture) texture->second = additions.add_element("textures", json);
  return texture->second;
}

std::vector<MaterialUse> Context::uses_of(std::uint64_t material) {
  if (!graph) graph.emplace(document, set);
  return find_material_uses(asset, *graph, material);
}

std::string Host::pointer() const {
  if (array.empty()) return {};
  return single ? fmt::format("/{}", array) : fmt::format("/{}/{}", array, index);
}

std::uint64_t Context::size_of(json::NodeId array) {
  const auto [known, is_new] = sizes.emplace(array, 0);
  if (is_new) known->second = document.array_size(array);
  return known->second;
}

bool Context::is_pointed_at(const Host& host, std::span<const std::string> path) const {
  if (pointers.all().empty()) return false;
  std::vector<std::string> steps;
  if (!host.array.empty()) steps.emplace_back(host.array);
  if (!host.array.empty() && !host.single) steps.push_back(std::to_string(host.index));
  steps.insert(steps.end(), path.begin(), path.end());
  if (steps.size() < 2) return false;
  return pointers.lead_below(steps[0], steps[1], std::span(steps).subspan(2));
}

bool Context::has_beside(const Host& host, const std::string& extension) const {
  if (given.contains({host.node, extension})) return true;
  const json::NodeId value = document.find(host.extensions, extension);
  return value != json::kNoNode && gone.count(value) == 0;
}

std::optional<MemberSource> Context::find_taken_over(const Host& host,
                                                     std::string_view path) const {
  const auto [first, last] = takeovers.equal_range(host.node);
  for (auto at = last; at != first;) {
    const Takeover& takeover = (--at)->second;
    const auto& steps = takeover.extension->upgrade.steps;
    const auto step = std::find_if(steps.rbegin(), steps.rend(), [&](const auto& each) {
      return each.kind == schema::UpgradeStep::Kind::place && each.to == path &&
             is_meant(each.generations, takeover.generation);
    });
    if (step == steps.rend()) continue;
    return MemberSource{document.find(takeover.object, step->from),
                        {"extensions", takeover.extension->name, step->from}};
  }
  return std::nullopt;
}

MemberSource Context::source_of(const Host& host, const std::string& path) const {
  if (auto elsewhere = find_taken_over(host, path)) return *std::move(elsewhere);
  std::vector<std::string> steps = split_path(path);
  const json::NodeId value = find_path(document, host.node, steps);
  return {value, std::move(steps)};
}

bool Context::is_used_with(const std::string& attribute, std::uint64_t material) {
  const std::vector<MaterialUse> users = uses_of(material);
  return std::any_of(users.begin(), users.end(), [&](const MaterialUse& use) {
    const json::NodeId attributes = document.find(use.primitive, "attributes");
    return document.find(attributes, attribute) != json::kNoNode;
  });
}

bool is_meant(const std::vector<std::string>& generations, std::string_view generation) {
  return generations.empty() ||
         std::find(generations.begin(), generations.end(), generation) != generations.end();
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> steps;
  while (true) {
    const std::size_t end = std::min(path.find('/'), path.size());
    steps.emplace_back(path.substr(0, end));
    if (end == path.size()) return steps;
    path.remove_prefix(end + 1);
  }
}

json::NodeId find_path(const json::Document& document, json::NodeId object,
                       std::span<const std::string> path) {
  for (const std::string& name : path) object = document.find(object, name);
  return object;
}

}  // namespace gltfx::upgrade
