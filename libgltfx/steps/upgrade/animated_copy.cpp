// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/animated_copy.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "json/writer.hpp"
#include "model/accessor_writer.hpp"

namespace gltfx::upgrade {
namespace {

constexpr Rgb kUntouched{1, 1, 1};

bool holds(const json::Document& document, json::NodeId outer, json::NodeId inner) {
  return outer < inner && inner < document.next(outer);
}

// The element of an array of objects that holds a node, or kNoNode.
json::NodeId element_with(const json::Document& document, json::NodeId array, json::NodeId node) {
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return json::kNoNode;
  if (!holds(document, array, node)) return json::kNoNode;
  for (const json::NodeId element : document.elements(array)) {
    if (holds(document, element, node)) return element;
  }
  return json::kNoNode;
}

// The text of a value with replacements for two scalars inside it.
std::string with_scalars(const json::Document& document, json::NodeId value,
                         std::vector<std::pair<json::NodeId, std::string>> scalars) {
  const Span whole = document.span(value);
  std::sort(scalars.begin(), scalars.end());
  std::vector<json::Edit> edits;
  for (auto& [node, json] : scalars) {
    const Span span = document.span(node);
    edits.push_back({{span.begin - whole.begin, span.end - whole.begin}, std::move(json)});
  }
  return json::apply_edits(document.raw(value), edits);
}

/// The values of an accessor cut to `take` components, as bytes, in their own type or as floats.
std::string cut(const model::AccessorData& data, std::uint64_t take, const Rgb& tint) {
  std::string bytes;
  model::with_component_type(data.format().component, [&](auto type) {
    using T = decltype(type);
    data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
      for (std::size_t i = 0; i < elements * data.components(); ++i) {
        const std::size_t component = i % data.components();
        if (component >= take) continue;
        if (tint == kUntouched) {
          model::append_number(bytes, values[i]);
        } else if constexpr (std::is_floating_point_v<T>) {
          model::append_number(bytes, static_cast<float>(values[i] * tint[component]));
        } else {
          model::append_number(bytes,
                               static_cast<float>(model::normalize(values[i]) * tint[component]));
        }
      }
    });
  });
  return bytes;
}

// A new accessor with the cut values; equal requests share one.
std::uint64_t cut_accessor(Context& context, const Follower& follower, const Rgb& tint) {
  const auto data = context.values.open(follower.output);
  const std::string key =
      fmt::format("{} {} {}", follower.output, follower.take, fmt::join(tint, " "));
  const auto known = context.cut_accessors.find(key);
  if (known != context.cut_accessors.end()) return known->second;
  const bool own_type = tint == kUntouched;
  const model::ComponentType type =
      own_type ? data->format().component : model::ComponentType::float32;
  const bool normalized = own_type && data->format().normalized;
  const std::uint64_t index = context.plan.change.additions.add_accessor(
      {fmt::format(R"({{"componentType":{},{}"count":{},"type":"VEC{}"}})",
                   static_cast<unsigned>(type), normalized ? R"("normalized":true,)" : "",
                   data->count(), follower.take),
       cut(*data, follower.take, tint)});
  return context.cut_accessors.emplace(key, index).first->second;
}

// Adds a twin of the follower's sampler with another output. Returns its index.
std::uint64_t add_sampler(Context& context, const Follower& follower, const Rgb& tint) {
  const json::Document& document = context.document;
  const json::NodeId samplers = document.find(follower.animation, "samplers");
  const std::uint64_t accessor = cut_accessor(context, follower, tint);
  const auto key = std::make_pair(follower.sampler, accessor);
  const auto known = context.cut_samplers.find(key);
  if (known != context.cut_samplers.end()) return known->second;
  std::uint64_t& added = context.added_samplers[samplers];
  const std::uint64_t index = document.array_size(samplers) + added++;
  context.editor.append_element(
      samplers,
      with_scalars(document, follower.sampler,
                   {{document.find(follower.sampler, "output"), std::to_string(accessor)}}));
  return context.cut_samplers.emplace(key, index).first->second;
}

/// Looks for the channels of one copied value.
class Search {
 public:
  Search(Context& context, const Host& host, const std::vector<std::string>& from,
         const std::vector<std::string>& to, std::uint64_t take)
      : context_(context),
        document_(context.document),
        host_(host),
        from_(from),
        to_(to),
        take_(take) {}

  Result<std::vector<Follower>> run() {
    std::vector<Follower> followers;
    const std::string index = std::to_string(host_.index);
    for (const graph::PointerUse* use : context_.pointers.below(host_.array, index, from_)) {
      if (graph::Pointers::is_template(*use)) return Error{"a graph references all elements"};
      auto follower = follower_of(*use);
      if (!follower) return follower.error();
      followers.push_back(*std::move(follower));
    }
    return followers;
  }

 private:
  Result<Follower> follower_of(const graph::PointerUse& use) {
    Follower follower;
    follower.pointer = use.node;
    for (const json::NodeId animation : context_.asset.elements(model::RootArray::animations)) {
      if (animation != json::kNoNode && holds(document_, animation, use.node)) {
        follower.animation = animation;
      }
    }
    follower.channel =
        element_with(document_, document_.find(follower.animation, "channels"), use.node);
    const json::NodeId sampler = document_.find(follower.channel, "sampler");
    if (sampler == json::kNoNode || !document_.is_number(sampler)) {
      return Error{"something other than an animation channel references it"};
    }
    follower.target = target_of(use);
    if (take_ == 0) return follower;
    if (use.steps.size() != from_.size() + 2) return Error{"a channel targets a part of its value"};
    follower.take = take_;
    if (!find_values(follower, sampler)) return Error{"its keyframes cannot be read"};
    return follower;
  }

  std::string target_of(const graph::PointerUse& use) const {
    std::string pointer;
    append_pointer_step(pointer, use.steps[0]);
    append_pointer_step(pointer, use.steps[1]);
    for (const std::string& step : to_) append_pointer_step(pointer, step);
    for (std::size_t i = 2 + from_.size(); i < use.steps.size(); ++i) {
      append_pointer_step(pointer, use.steps[i]);
    }
    return pointer;
  }

  bool find_values(Follower& follower, json::NodeId index) {
    const json::NodeId samplers = document_.find(follower.animation, "samplers");
    const auto wanted = document_.unsigned_integer(index);
    if (samplers == json::kNoNode || document_.kind(samplers) != json::Kind::array || !wanted) {
      return false;
    }
    std::uint64_t at = 0;
    for (const json::NodeId sampler : document_.elements(samplers)) {
      if (at++ == *wanted) follower.sampler = sampler;
    }
    const auto output =
        context_.asset.index(follower.sampler, "output", model::RootArray::accessors);
    const auto data = output ? context_.values.open(*output) : std::nullopt;
    if (!data || data->components() <= take_ || model::is_matrix(data->format().type)) return false;
    follower.output = *output;
    const model::Format& format = data->format();
    return format.component == model::ComponentType::float32 || format.normalized;
  }

  Context& context_;
  const json::Document& document_;
  const Host& host_;
  const std::vector<std::string>& from_;
  const std::vector<std::string>& to_;
  std::uint64_t take_;
};

}  // namespace

Result<std::vector<Follower>> find_followers(Context& context, const Host& host,
                                             const std::vector<std::string>& from,
                                             const std::vector<std::string>& to,
                                             std::uint64_t take) {
  return Search(context, host, from, to, take).run();
}

void follow(Context& context, const Follower& follower, const Rgb& tint) {
  const json::Document& document = context.document;
  std::string target;
  json::append_string(target, follower.target);
  std::vector<std::pair<json::NodeId, std::string>> scalars{{follower.pointer, std::move(target)}};
  if (follower.take > 0) {
    scalars.emplace_back(document.find(follower.channel, "sampler"),
                         std::to_string(add_sampler(context, follower, tint)));
  }
  context.editor.append_element(document.find(follower.animation, "channels"),
                                with_scalars(document, follower.channel, std::move(scalars)));
}

}  // namespace gltfx::upgrade
