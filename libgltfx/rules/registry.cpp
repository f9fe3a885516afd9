// SPDX-License-Identifier: Apache-2.0
// Rules by code and by name with their examples, and spans that findings mark.
#include <gltfx/validate.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "container/base64.hpp"
#include "rules/context.hpp"
#include "rules/own/own_rules.hpp"

namespace gltfx {
namespace {

// Appends the expansion of `text*N`.
void append_repeat(std::string& out, std::string_view repeat) {
  const std::size_t star = repeat.rfind('*');
  if (star == std::string_view::npos) return;
  std::size_t count = 0;
  std::from_chars(repeat.data() + star + 1, repeat.data() + repeat.size(), count);
  for (std::size_t i = 0; i < count; ++i) out += repeat.substr(0, star);
}

std::string expand_repeats(std::string_view example) {
  std::string text;
  while (true) {
    const std::size_t open = example.find("{{");
    const std::size_t close = example.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos ||
        example.substr(open, close - open).find('*') == std::string_view::npos) {
      return text += example;
    }
    text += example.substr(0, open);
    append_repeat(text, example.substr(open + 2, close - open - 2));
    example.remove_prefix(close + 2);
  }
}

}  // namespace

std::string_view pixel_level_name(PixelLevel level) {
  constexpr std::array<std::string_view, 3> kNames{"headers", "needed", "all"};
  return kNames[static_cast<std::size_t>(level)];
}

PixelLevel pixel_level(const ValidateOptions& options) {
  if (options.profile == Profile::khronos) return PixelLevel::headers;
  const bool strict = options.profile == Profile::strict;
  return options.pixels.value_or(strict ? PixelLevel::needed : PixelLevel::headers);
}

const RuleDescription* find_rule(std::string_view code, std::span<const RuleDescription> all) {
  const auto at = std::lower_bound(
      all.begin(), all.end(), code,
      [](const RuleDescription& rule, std::string_view wanted) { return rule.code < wanted; });
  return at != all.end() && at->code == code ? &*at : nullptr;
}

const RuleDescription* find_rule(std::string_view code) { return find_rule(code, rules()); }

namespace validate {

const RuleDescription& description(Code code) {
  return gltfx::rules()[static_cast<std::size_t>(code)];
}

const RuleDescription& description(const ValidateOptions& options, Code code) {
  const std::size_t count = gltfx::rules().size();
  const auto position = static_cast<std::size_t>(code);
  return position < count ? description(code) : options.own_rules->descriptions()[position - count];
}

std::optional<Code> code_of(std::string_view name, const OwnRules* own) {
  const RuleDescription* const rule = gltfx::find_rule(name);
  if (rule != nullptr) return static_cast<Code>(rule - gltfx::rules().data());
  if (own == nullptr) return std::nullopt;
  const RuleDescription* const one = find_rule(name, own->descriptions());
  if (one == nullptr) return std::nullopt;
  return own_code(static_cast<std::size_t>(one - own->descriptions().data()));
}

}  // namespace validate

std::string example_bytes(std::string_view example) {
  constexpr std::string_view kBase64 = "base64:";
  std::string text = expand_repeats(example);
  if (example.substr(0, kBase64.size()) != kBase64) return text;
  auto bytes = container::decode_base64(std::string_view(text).substr(kBase64.size()));
  return bytes ? *std::move(bytes) : std::string();
}

}  // namespace gltfx

namespace gltfx::validate {

Span first_character(const json::Document& document, json::NodeId value) {
  const Span span = document.span(value);
  return {span.begin, span.empty() ? span.end : span.begin + 1};
}

Span member_span(const json::Document& document, json::NodeId object, std::string_view member) {
  const json::NodeId value = document.find(object, member);
  return value != json::kNoNode ? document.span(value) : first_character(document, object);
}

}  // namespace gltfx::validate
