// SPDX-License-Identifier: Apache-2.0
// KHR_xmp_json_ld and KHR_xmp: names of properties and the forms of JSON-LD allowed in packets. The
// members of a packet are free, so no schema states them; this file is about the two extensions and
// names them.
#include <algorithm>
#include <deque>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kRdf = "http://www.w3.org/1999/02/22-rdf-syntax-ns#";

// The prefixes of a packet, and the one used for languages.
class Prefixes {
 public:
  Prefixes(const json::Document& document, json::NodeId object) {
    for (const auto member : document.members(object)) {
      const std::string_view prefix = document.key(member.key_id);
      if (prefix.starts_with('@')) continue;
      known_.insert(prefix);
      if (document.is_string(member.value) && document.string(member.value) == kRdf) rdf_ = prefix;
    }
  }
  bool contain(std::string_view prefix) const { return known_.count(prefix) != 0; }
  std::string_view rdf() const { return rdf_; }

 private:
  std::unordered_set<std::string_view> known_;
  std::string_view rdf_ = "rdf";
};

// Members and elements are visited without recursion: paths are on the stack of open ones.
class PacketCheck {
 public:
  PacketCheck(const Context& context, const Prefixes& prefixes, bool json_ld)
      : context_(context), document_(context.document), prefixes_(prefixes), json_ld_(json_ld) {}

  void run(json::NodeId packet, const Path& path) {
    open(packet, path);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      if (frame.next == frame.entries.size()) {
        frames_.pop_back();
        continue;
      }
      const Entry entry = frame.entries[frame.next++];
      if (frame.is_array) {
        const Path element(frame.path, entry.index);
        if (document_.is_object(entry.value) && !refuse_value(entry.value, element)) {
          open(entry.value, Path(frame.path, entry.index));
        }
      } else {
        check_member(frame, entry);
      }
    }
  }

 private:
  struct Entry {
    std::string_view name;    ///< name of a member
    std::uint64_t index = 0;  ///< index of an element
    json::NodeId key = json::kNoNode;
    json::NodeId value = json::kNoNode;
  };
  struct Frame {
    Path path;
    bool is_array = false;
    bool is_languages = false;
    std::vector<Entry> entries;
    std::size_t next = 0;
  };

  void open(json::NodeId node, const Path& path) {
    Frame frame;
    frame.path = path;
    frame.is_array = !document_.is_object(node);
    if (frame.is_array) {
      std::uint64_t index = 0;
      for (const json::NodeId element : document_.elements(node)) {
        frame.entries.push_back({{}, index++, json::kNoNode, element});
      }
    } else {
      for (const auto member : document_.members(node)) {
        frame.entries.push_back({document_.key(member.key_id), 0, member.key, member.value});
      }
      frame.is_languages = is_languages(node);
    }
    frames_.push_back(std::move(frame));
  }

  bool is_languages(json::NodeId object) const {
    return json_ld_ && model::string_member(document_, object, "@type") ==
                           fmt::format("{}:Alt", prefixes_.rdf());
  }

  // The languages of a text in KHR_xmp: {"en-us": "text"}. Members of structures have prefixes.
  bool is_dictionary(json::NodeId object) const {
    if (!document_.is_object(object)) return false;
    for (const auto member : document_.members(object)) {
      const bool prefixed = document_.key(member.key_id).find(':') != std::string_view::npos;
      if (prefixed || !document_.is_string(member.value)) return false;
    }
    return true;
  }

  void check_member(const Frame& frame, const Entry& entry) {
    const Path path(frame.path, entry.name);
    const bool keyword = entry.name.starts_with('@');
    if (entry.name == "@context") return check_context(entry, path);
    if (!keyword && !check_name(entry, path)) return;
    if (frame.is_languages && keyword && entry.name != "@type" && entry.name != "@id") {
      return report_link(
          context_, path, entry.key, Code::XMP_LANGUAGE_INVALID,
          fmt::format("The language alternative {1} must be {0}:_1 or another number.",
                      prefixes_.rdf(), gltfx::quoted(entry.name)));
    }
    if (frame.is_languages && !keyword) return check_language(entry, path);
    if (!json_ld_ && is_dictionary(entry.value)) return;
    if (document_.is_object(entry.value)) {
      if (refuse_value(entry.value, path) || refuse_language(entry, path)) return;
      return open(entry.value, Path(frame.path, entry.name));
    }
    if (!document_.is_array(entry.value)) return;
    if (json_ld_ && entry.name != "@list" && entry.name != "@set" && entry.name != "@type") {
      return report_link(
          context_, path, entry.value, Code::XMP_ARRAY_BARE,
          fmt::format("The array of {} is neither a @list nor a @set.", gltfx::quoted(entry.name)));
    }
    if (document_.kind(entry.value) == json::Kind::array) {
      open(entry.value, Path(frame.path, entry.name));
    }
  }

  // Only the packet has a context; its values may have a language.
  void check_context(const Entry& entry, const Path& path) const {
    if (frames_.size() < 2 || !json_ld_) return;
    const bool object = document_.is_object(entry.value);
    bool language = object;
    if (object) {
      for (const auto member : document_.members(entry.value)) {
        language = language && document_.key(member.key_id) == "@language";
      }
    }
    if (language) return;
    report_link(context_, path, entry.value, Code::XMP_FORM_FORBIDDEN,
                "A @context inside of a packet may only have a @language.");
  }

  // A text in a language may be written as {"@language": ..., "@value": ...}, without other
  // members.
  bool refuse_value(json::NodeId object, const Path& path) const {
    const json::NodeId value = document_.find(object, "@value");
    if (!json_ld_ || value == json::kNoNode) return false;
    if (document_.find(object, "@language") != json::kNoNode) return false;
    report_link(context_, Path(path, "@value"), value, Code::XMP_FORM_FORBIDDEN,
                "The @value has no @language; it must be written as a plain value.");
    return true;
  }

  // A language alternative outside an object of its type.
  bool refuse_language(const Entry& entry, const Path& path) const {
    const bool numbered = entry.name.starts_with(fmt::format("{}:_", prefixes_.rdf()));
    if (!json_ld_ || !numbered) return false;
    if (document_.find(entry.value, "@language") == json::kNoNode) return false;
    report_link(context_, path, entry.key, Code::XMP_LANGUAGE_INVALID,
                fmt::format("{} is a language alternative, but the @type of the object is not "
                            "{}:Alt.",
                            gltfx::quoted(entry.name), prefixes_.rdf()));
    return true;
  }

  bool check_name(const Entry& entry, const Path& path) {
    const std::size_t colon = entry.name.find(':');
    if (colon == std::string_view::npos || colon == 0) {
      report_link(context_, path, entry.key, Code::XMP_NAME_WITHOUT_PREFIX,
                  fmt::format("{} is not of the form prefix:name.", gltfx::quoted(entry.name)));
      return false;
    }
    const std::string_view prefix = entry.name.substr(0, colon);
    if (prefixes_.contain(prefix)) return true;
    report_link(context_, path, entry.key, Code::XMP_PREFIX_UNKNOWN,
                fmt::format("The prefix {} is not in @context.", gltfx::quoted(prefix)));
    return false;
  }

  // rdf:_1 and so on, each with a language and a text.
  void check_language(const Entry& entry, const Path& path) {
    std::string_view name = entry.name;
    name.remove_prefix(std::min(name.find(':') + 1, name.size()));
    const bool numbered = name.size() > 1 && name.front() == '_' &&
                          name.find_first_not_of("0123456789", 1) == std::string_view::npos &&
                          entry.name.starts_with(fmt::format("{}:", prefixes_.rdf()));
    const auto is_text = [&](std::string_view member) {
      const json::NodeId value = document_.find(entry.value, member);
      return value != json::kNoNode && document_.is_string(value);
    };
    if (numbered && document_.is_object(entry.value) && is_text("@language") && is_text("@value")) {
      return;
    }
    report_link(context_, path, entry.value, Code::XMP_LANGUAGE_INVALID,
                numbered ? fmt::format("{} must have both a @language and a @value.",
                                       gltfx::quoted(entry.name))
                         : fmt::format("{} must be {}:_1 or another number.",
                                       gltfx::quoted(entry.name), prefixes_.rdf()));
  }

  const Context& context_;
  const json::Document& document_;
  const Prefixes& prefixes_;
  bool json_ld_;
  std::deque<Frame> frames_;  // does not move elements: paths point to each other
};

void check_namespaces(const Context& context, json::NodeId object, const Path& path) {
  std::unordered_map<std::string, std::string_view> seen;
  for (const auto member : context.document.members(object)) {
    if (!context.document.is_string(member.value)) continue;
    const std::string_view prefix = context.document.key(member.key_id);
    if (context.document.string(member.value).starts_with('@')) {
      report_link(
          context, Path(path, prefix), member.value, Code::XMP_FORM_FORBIDDEN,
          fmt::format("{} is an alias of a keyword, which is not allowed.", gltfx::quoted(prefix)));
      continue;
    }
    const auto [first, fresh] = seen.emplace(context.document.string(member.value), prefix);
    if (fresh || prefix == first->second) continue;
    report_link(
        context, Path(path, prefix), member.value, Code::XMP_NAMESPACE_REPEATED,
        fmt::format("The prefix {} already has this namespace.", gltfx::quoted(first->second)));
  }
}

// A packet with a context of its own.
void check_packet(const Context& context, json::NodeId packet, const Path& path) {
  const json::NodeId object = model::object_member(context.document, packet, "@context");
  if (object == json::kNoNode) return;
  check_namespaces(context, object, Path(path, "@context"));
  const Prefixes prefixes(context.document, object);
  PacketCheck(context, prefixes, true).run(packet, path);
  if (context.document.find(packet, "@id") != json::kNoNode) return;
  report_link(context, path, packet, Code::XMP_ID_MISSING, "The packet has no @id.");
}

template <typename Use>
void for_each_packet(const Context& context, std::string_view extension, Use use) {
  const json::NodeId object = root_extension(context, extension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path at(extensions, extension);
  const Path list(at, "packets");
  const auto packets = object_list(context.document, object, "packets");
  for (std::size_t i = 0; i < packets.size(); ++i) {
    if (packets[i] != json::kNoNode) use(packets[i], Path(list, i));
  }
}

void check_xmp(const Context& context) {
  for_each_packet(context, "KHR_xmp_json_ld", [&](json::NodeId packet, const Path& path) {
    check_packet(context, packet, path);
  });
  // Packets of the older extension share a context.
  constexpr std::string_view kOlder = "KHR_xmp";
  const json::NodeId shared =
      model::object_member(context.document, root_extension(context, kOlder), "@context");
  if (shared == json::kNoNode) return;
  const Prefixes prefixes(context.document, shared);
  for_each_packet(context, kOlder, [&](json::NodeId packet, const Path& path) {
    PacketCheck(context, prefixes, false).run(packet, path);
  });
}

}  // namespace

const RuleGroup& xmp_rules() {
  static constexpr LinkRule kLinkRules[] = {check_xmp};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
