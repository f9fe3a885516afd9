// SPDX-License-Identifier: Apache-2.0
#include "report/packed.hpp"

#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "report/rule_lookup.hpp"

namespace gltfx::report {
namespace {

// The two directions have the same calls, so that carry() below is written once.
class Packer {
 public:
  static constexpr bool kPacks = true;

  void number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7U) out_ += static_cast<char>(value | 0x80U);
    out_ += static_cast<char>(value);
  }
  void text(std::string_view value) {
    number(value.size());
    out_ += value;
  }
  void code(std::string_view value) { text(value); }
  std::string finish() { return std::move(out_); }

 private:
  std::string out_;
};

class Unpacker {
 public:
  static constexpr bool kPacks = false;

  Unpacker(std::string_view bytes, std::span<const RuleDescription> rules)
      : rest_(bytes), rules_(rules) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (rest_.empty()) break;
      const auto byte = static_cast<unsigned char>(rest_.front());
      rest_.remove_prefix(1);
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) return value;
    }
    whole_ = false;
    return 0;
  }
  std::string_view text() {
    const std::uint64_t size = number();
    if (size > rest_.size()) {
      whole_ = false;
      return {};
    }
    const std::string_view value = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return value;
  }
  std::string_view code() {
    const RuleDescription* rule = find_rule_in(rules_, text());
    whole_ = whole_ && rule != nullptr;
    return rule != nullptr ? rule->code : std::string_view();
  }
  /// An element takes at least a byte: a list cannot be longer than what is left.
  std::uint64_t length() {
    const std::uint64_t size = number();
    whole_ = whole_ && size <= rest_.size();
    return whole_ ? size : 0;
  }
  void refuse() { whole_ = false; }
  bool whole() const { return whole_; }
  bool finished() const { return whole_ && rest_.empty(); }

 private:
  std::string_view rest_;
  std::span<const RuleDescription> rules_;
  bool whole_ = true;
};

template <class Archive, class Number>
void carry_number(Archive& archive, Number& value) {
  if constexpr (Archive::kPacks) {
    archive.number(static_cast<std::uint64_t>(value));
  } else {
    value = static_cast<std::remove_reference_t<Number>>(archive.number());
  }
}

template <class Archive, class Text>
void carry_text(Archive& archive, Text& value) {
  if constexpr (Archive::kPacks) {
    archive.text(value);
  } else {
    value = archive.text();
  }
}

template <class Archive, class... Values>
void carry_all(Archive& archive, Values&... values) {
  const auto carry_one = [&archive](auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::string>) {
      carry_text(archive, value);
    } else {
      carry_number(archive, value);
    }
  };
  (carry_one(values), ...);
}

template <class Archive, class List, class Element>
void carry_list(Archive& archive, List& list, const Element& element) {
  if constexpr (Archive::kPacks) {
    archive.number(list.size());
    for (const auto& each : list) element(each);
  } else {
    for (std::uint64_t left = archive.length(); left > 0 && archive.whole(); --left) {
      element(list.emplace_back());
    }
  }
}

// Something behind a std::optional or a pointer to it; `make` fills it with a new one.
template <class Archive, class Holder, class Make, class Content>
void carry_if_any(Archive& archive, Holder& holder, const Make& make, const Content& content) {
  if constexpr (Archive::kPacks) {
    archive.number(holder ? 1 : 0);
    if (holder) content(*holder);
  } else if (archive.number() != 0) {
    content(make(holder));
  }
}

template <class Archive, class Optional, class Content>
void carry_optional(Archive& archive, Optional& value, const Content& content) {
  carry_if_any(
      archive, value, [](auto& empty) -> auto& {
        empty = typename Optional::value_type();  // clang 14 cannot emplace what lies in a class
        return *empty;
      },
      content);
}

template <class Archive, class Place>
void carry_location(Archive& archive, Place& at) {
  carry_all(archive, at.line, at.column, at.end_line, at.end_column, at.utf16_column,
            at.utf16_end_column, at.offset, at.length);
}

template <class Archive, class Fix>
void carry_fix(Archive& archive, Fix& fix) {
  carry_text(archive, fix.description);
  carry_list(archive, fix.replacements, [&](auto& replacement) {
    carry_location(archive, replacement.place);
    carry_text(archive, replacement.text);
  });
}

template <class Archive, class Finding>
void carry_finding(Archive& archive, Finding& finding) {
  if constexpr (Archive::kPacks) {
    archive.code(finding.code);
  } else {
    finding.code = archive.code();
  }
  carry_number(archive, finding.severity);
  if constexpr (!Archive::kPacks) {
    if (finding.severity > Severity::hint) archive.refuse();
  }
  carry_all(archive, finding.message, finding.pointer, finding.help, finding.object_name,
            finding.count, finding.last_pointer, finding.fixable);
  carry_optional(archive, finding.offset, [&](auto& value) { carry_number(archive, value); });
  carry_location(archive, finding.location);
  auto& excerpt = finding.excerpt;
  carry_all(archive, excerpt.text, excerpt.caret, excerpt.width, excerpt.cut_left,
            excerpt.cut_right);
  carry_if_any(
      archive, finding.fix,
      [](auto& empty) -> ProposedFix& {
        auto fresh = std::make_shared<ProposedFix>();
        ProposedFix& fix = *fresh;
        empty = std::move(fresh);
        return fix;
      },
      [&](auto& fix) { carry_fix(archive, fix); });
}

template <class Archive, class Repeat>
void carry_repeat(Archive& archive, Repeat& repeat) {
  carry_all(archive, repeat.finding, repeat.message, repeat.help, repeat.pointer,
            repeat.object_name, repeat.count);
  carry_location(archive, repeat.location);
}

template <class Archive, class Info>
void carry_info(Archive& archive, Info& info) {
  const auto texts = [&](auto& list) {
    carry_list(archive, list, [&](auto& text) { carry_text(archive, text); });
  };
  carry_all(archive, info.version, info.min_version);
  carry_optional(archive, info.generator, [&](auto& text) { carry_text(archive, text); });
  texts(info.extensions_used);
  texts(info.extensions_required);
  carry_list(archive, info.resources, [&](auto& resource) {
    carry_all(archive, resource.pointer, resource.mime_type, resource.storage, resource.uri);
    carry_optional(archive, resource.byte_length,
                   [&](auto& value) { carry_number(archive, value); });
    carry_optional(archive, resource.image, [&](auto& image) {
      carry_all(archive, image.width, image.height, image.bits, image.format, image.primaries,
                image.transfer);
    });
  });
  carry_all(archive, info.animation_count, info.material_count, info.draw_call_count,
            info.total_vertex_count, info.total_triangle_count, info.max_uvs, info.max_influences,
            info.max_attributes, info.has_morph_targets, info.has_skins, info.has_textures,
            info.has_default_scene);
}

template <class Archive, class Report>
void carry(Archive& archive, Report& report) {
  carry_all(archive, report.mime_type, report.readable, report.truncated, report.suppressed,
            report.left_out, report.unverified, report.images_wanted, report.images_decoded,
            report.fixable);
  auto& counts = report.counts;
  carry_all(archive, counts.errors, counts.warnings, counts.infos, counts.hints);
  carry_list(archive, report.diagnostics, [&](auto& finding) { carry_finding(archive, finding); });
  carry_list(archive, report.repeats, [&](auto& repeat) { carry_repeat(archive, repeat); });
  carry_optional(archive, report.info, [&](auto& info) { carry_info(archive, info); });
}

}  // namespace

std::string pack(const FileReport& report) {
  Packer packer;
  carry(packer, report);
  return packer.finish();
}

std::optional<FileReport> unpack(std::string_view bytes, std::span<const RuleDescription> rules) {
  Unpacker unpacker(bytes, rules);
  FileReport report;
  carry(unpacker, report);
  if (!unpacker.finished()) return std::nullopt;
  return report;
}

}  // namespace gltfx::report
