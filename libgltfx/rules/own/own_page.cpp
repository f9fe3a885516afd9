// SPDX-License-Identifier: Apache-2.0
#include "rules/own/own_page.hpp"

#include <gltfx/validate.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/code.hpp"
#include "base/interned.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "json/lines.hpp"
#include "rules/own/own_names.hpp"
#include "schema/page_reader.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

constexpr std::array kScopes{
    OwnScope{"glTF", OwnScope::Place::root},
    OwnScope{"asset", OwnScope::Place::asset},
    OwnScope{"scene", OwnScope::Place::element, RootArray::scenes},
    OwnScope{"node", OwnScope::Place::element, RootArray::nodes},
    OwnScope{"mesh", OwnScope::Place::element, RootArray::meshes},
    OwnScope{"primitive", OwnScope::Place::primitive},
    OwnScope{"material", OwnScope::Place::element, RootArray::materials},
    OwnScope{"texture", OwnScope::Place::element, RootArray::textures},
    OwnScope{"image", OwnScope::Place::element, RootArray::images},
    OwnScope{"sampler", OwnScope::Place::element, RootArray::samplers},
    OwnScope{"skin", OwnScope::Place::element, RootArray::skins},
    OwnScope{"animation", OwnScope::Place::element, RootArray::animations},
    OwnScope{"camera", OwnScope::Place::element, RootArray::cameras},
    OwnScope{"accessor", OwnScope::Place::element, RootArray::accessors},
    OwnScope{"bufferView", OwnScope::Place::element, RootArray::buffer_views},
    OwnScope{"buffer", OwnScope::Place::element, RootArray::buffers},
};

constexpr auto kScopeNames = [] {
  std::array<std::string_view, kScopes.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kScopes[i].name;
  return names;
}();

constexpr std::array<std::string_view, 5> kKeys{"severity", "on", "message", "help", "link"};
constexpr std::string_view kPageEnding = ".md";

// The nearest of some words, or all of them.
std::string one_of(std::string_view word, std::span<const std::string_view> words) {
  const std::string near = did_you_mean(word, words);
  return near.empty() ? fmt::format("; expected one of {}", fmt::join(words, ", ")) : near;
}

// Reads one page. Line numbers are those of the file.
class OwnPageReader {
 public:
  OwnPageReader(const OwnRulePage& page, std::vector<std::string>& mistakes)
      : file_(page.file), text_(page.text), mistakes_(mistakes) {
    // Line breaks of Windows, and the mark that its editors put first.
    std::erase(text_, '\r');
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  }

  std::unique_ptr<const OwnPage> run() {
    if (text_.size() > kLongestOwnPage) {
      add(1, fmt::format("the page has more than {} bytes", kLongestOwnPage));
      return nullptr;
    }
    if (!read_code()) return nullptr;
    schema::PageReader reader(text_, mistake_);
    read_front_matter(reader);
    read_sections(reader);
    if (!mistake_.empty()) mistakes_.push_back(fmt::format("{}:{}", printable(file_), mistake_));
    if (!mistake_.empty() || !schema_) return nullptr;
    page_->schema = *std::move(schema_);
    page_->file = file_;
    HashParts source;
    source.add(file_);
    source.add(text_);
    page_->source = source.finish();
    return std::move(page_);
  }

 private:
  void add(std::uint64_t line, std::string_view what) {
    mistakes_.push_back(fmt::format("{}:{}: {}", printable(file_), line, what));
  }

  bool read_code() {
    std::string_view name = file_;
    name.remove_prefix(std::min(name.find_last_of("/\\") + 1, name.size()));
    if (name.ends_with(kPageEnding)) name.remove_suffix(kPageEnding.size());
    if (!has_code_form(name)) {
      add(1, fmt::format("{} is not a code: name the file PREFIX_NAME.md, in capitals, digits and "
                         "underscores, as in ACME_NODE_NAME.md",
                         gltfx::quoted(name)));
      return false;
    }
    if (gltfx::find_rule(name) != nullptr) {
      add(1, fmt::format("{} is a rule of gltfx; give this one a prefix of your own", name));
      return false;
    }
    page_->code = interned(name);
    return true;
  }

  void read_front_matter(schema::PageReader& reader) {
    bool has_severity = false;
    reader.front_matter([&](std::string_view key, std::string_view value) {
      if (key == "severity") {
        const auto severity = severity_from_name(value);
        if (!severity) return reader.fail("expected one of error, warning, info, hint");
        page_->severity = *severity;
        has_severity = true;
      } else if (key == "on") {
        read_scope(value, reader);
      } else if (key == "message") {
        page_->message = unquoted(value);
        const bool open =
            !page_->message.empty() &&
            std::string_view(".!?").find(page_->message.back()) == std::string_view::npos;
        if (open) page_->message += '.';
      } else if (key == "help") {
        page_->advice = without_stop(unquoted(value));
      } else if (key == "link") {
        page_->link = unquoted(value);
      } else {
        reader.fail(
            fmt::format("{} is no key of a rule{}", gltfx::quoted(key), one_of(key, kKeys)));
      }
    });
    if (!has_severity) reader.fail("expected 'severity: error', or warning, info or hint");
    if (page_->scope == nullptr) {
      reader.fail(
          fmt::format("expected 'on: node', or another of {}", fmt::join(kScopeNames, ", ")));
    }
    if (page_->message.empty()) reader.fail("expected 'message: What is wrong, in one sentence.'");
  }

  void read_scope(std::string_view value, schema::PageReader& reader) {
    page_->scope = find_own_scope(value);
    if (page_->scope != nullptr) return;
    reader.fail(fmt::format("{} is nothing that a rule can be about{}", gltfx::quoted(value),
                            one_of(value, kScopeNames)));
  }

  // A value may be in double quotes, as in YAML.
  static std::string unquoted(std::string_view value) {
    const bool quotes = value.size() >= 2 && value.front() == '"' && value.back() == '"';
    if (quotes) value = value.substr(1, value.size() - 2);
    if (value.find_first_not_of(" \t") == std::string_view::npos) return {};
    return std::string(value);
  }

  void read_sections(schema::PageReader& reader) {
    reader.skip_blank_lines();
    reader.expect(fmt::format("# {}", page_->code));
    page_->summary = without_stop(text(reader.paragraph(), reader));
    page_->why = text(reader.section("## Why it matters"), reader);
    page_->help = text(reader.section("## How to fix it"), reader);
    if (const auto block = reader.block_below("## Schema"); !reader.failed()) read_schema(block);
    page_->bad = example(reader.block_below("## Bad"));
    page_->good = example(reader.block_below("## Good"));
    reader.expect_end();
  }

  static std::string text(std::string paragraph, schema::PageReader& reader) {
    if (paragraph.empty()) reader.fail("expected a paragraph");
    return paragraph;
  }

  void read_schema(const schema::PageBlock& block) {
    std::vector<schema::JsonSchema::Mistake> found;
    schema_ = schema::JsonSchema::compile(block.text, found);
    const json::LineIndex lines(block.text);
    for (const schema::JsonSchema::Mistake& one : found) {
      const std::uint64_t line = lines.locate(one.span).line;
      add(line + static_cast<std::uint64_t>(block.line) - 1, one.message);
    }
    if (!schema_ || page_->scope == nullptr) return;
    for (const UnknownMember& one : unknown_members(*schema_, *page_->scope)) {
      const std::size_t at = std::min(block.text.find('"' + one.name + '"'), block.text.size());
      const auto line = std::count(block.text.begin(),
                                   block.text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      add(static_cast<std::uint64_t>(line + block.line), one.mistake);
    }
  }

  // "json SM_hall.gltf": the name behind the language is that of the asset.
  static OwnExample example(const schema::PageBlock& block) {
    OwnExample example{block.text, "example.gltf", block.line};
    const std::size_t space = block.words.find(' ');
    if (space != std::string::npos) example.file = block.words.substr(space + 1);
    return example;
  }

  std::string file_;
  std::string text_;
  std::vector<std::string>& mistakes_;
  std::string mistake_;
  std::optional<schema::JsonSchema> schema_;
  std::unique_ptr<OwnPage> page_ = std::make_unique<OwnPage>();
};

}  // namespace

const OwnScope* find_own_scope(std::string_view name) {
  const auto found = std::find_if(kScopes.begin(), kScopes.end(),
                                  [&](const OwnScope& scope) { return scope.name == name; });
  return found == kScopes.end() ? nullptr : &*found;
}

RuleDescription OwnPage::description() const {
  RuleDescription rule{};
  rule.code = code;
  rule.severity = rule.khronos_severity = severity;
  rule.summary = summary;
  rule.why = why;
  rule.help = help;
  rule.link = link;
  rule.bad = bad.text;
  rule.good = good.text;
  rule.own = true;
  return rule;
}

std::unique_ptr<const OwnPage> read_own_page(const OwnRulePage& page,
                                             std::vector<std::string>& mistakes) {
  return OwnPageReader(page, mistakes).run();
}

}  // namespace gltfx::validate

namespace gltfx {

std::span<const std::string_view> own_rule_scopes() { return validate::kScopeNames; }

}  // namespace gltfx
