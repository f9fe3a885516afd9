// SPDX-License-Identifier: Apache-2.0
// KHR_xmp becomes JSON-LD: each packet has a separate context, arrays state whether their order has
// a meaning, and texts in several languages are lists of values with their language. ISO 16684-1
// defines which properties are ordered arrays (Seq), unordered ones (Bag) or alternatives.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "steps/upgrade/conversion.hpp"
#include "steps/upgrade/generation.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::string_view kRdf = "http://www.w3.org/1999/02/22-rdf-syntax-ns#";

// Names with the prefixes that the extension recommends.
constexpr std::array<std::string_view, 4> kOrdered{"dc:creator", "dc:date", "xmpMM:History",
                                                   "xmpMM:Versions"};
constexpr std::array<std::string_view, 10> kUnordered{
    "dc:contributor", "dc:language",  "dc:publisher",   "dc:relation",       "dc:subject",
    "dc:type",        "xmpMM:Pantry", "xmp:Identifier", "xmpMM:Ingredients", "xmpRights:Owner"};

template <std::size_t N>
bool has(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// One packet and its changes.
class Packet {
 public:
  Packet(const json::Document& document, json::NodeId node) : document_(document), node_(node) {}

  std::optional<std::string> prepare(UpgradeAction& action) {
    if (!document_.is_object(node_)) return "a packet is not an object";
    if (document_.find(node_, "@context") != json::kNoNode) {
      return "a packet already has an @context";
    }
    std::string_view name;
    std::vector<json::NodeId> around{node_};
    const json::NodeId end = document_.next(node_);
    for (json::NodeId at = node_ + 1; at < end;) {
      while (at >= document_.next(around.back())) around.pop_back();
      if (document_.kind(at) == json::Kind::key) {
        name = document_.key(document_.node(at).next);
        ++at;
        continue;
      }
      if (document_.is_array(at)) note_array({around.back(), at}, name, action);
      const bool languages = document_.is_object(at) && is_languages(at);
      if (languages) languages_.push_back({around.back(), at});
      if (!languages) around.push_back(at);
      at = languages ? document_.next(at) : at + 1;
    }
    return std::nullopt;
  }

  bool has_languages() const { return !languages_.empty(); }

  json::NodeId node() const { return node_; }

  void apply(json::Editor& editor, const std::string& context, std::string_view rdf) const {
    for (const auto& [place, keyword] : arrays_) {
      editor.enclose(place.around, place.value, keyword);
    }
    for (const Place& place : languages_) {
      editor.replace(place.around, place.value, alternatives_json(place.value, rdf));
    }
    editor.append_member(node_, "@context", context);
    if (document_.find(node_, "@id") == json::kNoNode) editor.append_member(node_, "@id", "\"\"");
  }

 private:
  struct Place {
    json::NodeId around;  ///< the object or array that holds the value
    json::NodeId value;
  };

  // `name` is the last key: an array in an array has the name of the outer one.
  void note_array(const Place& place, std::string_view name, UpgradeAction& action) {
    if (name.starts_with('@')) return;
    arrays_.emplace_back(place, has(kUnordered, name) ? "@set" : "@list");
    if (has(kUnordered, name) || has(kOrdered, name)) return;
    std::string note = fmt::format("the array {} is treated as ordered", quoted(name));
    auto& notes = action.notes;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) {
      notes.push_back(std::move(note));
    }
  }

  // Members of structures have a prefix; languages do not.
  bool is_languages(json::NodeId object) const {
    bool any = false;
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (!document_.is_string(member.value) || name.starts_with('@')) return false;
      if (name.find(':') != std::string_view::npos) return false;
      any = true;
    }
    return any;
  }

  std::string alternatives_json(json::NodeId object, std::string_view rdf) const {
    std::string json;
    json::Writer writer(json);
    writer.begin_object();
    writer.member("@type", fmt::format("{}:Alt", rdf));
    int number = 0;
    for (const auto member : document_.members(object)) {
      writer.key(fmt::format("{}:_{}", rdf, ++number));
      writer.begin_object();
      writer.member("@language", document_.key(member.key_id));
      writer.key("@value");
      writer.raw(document_.raw(member.value));
      writer.end_object();
    }
    writer.end_object();
    return json;
  }

  const json::Document& document_;
  json::NodeId node_;
  std::vector<std::pair<Place, std::string_view>> arrays_;
  std::vector<Place> languages_;
};

// Packets of the root's object of an extension; kNoNode: there are none.
json::NodeId packets_of(const json::Document& document, const schema::Extension& extension) {
  const json::NodeId root = model::extension_object(document, document.root(), extension.name);
  const json::NodeId packets = document.find(root, "packets");
  return packets != json::kNoNode && document.is_array(packets) ? packets : json::kNoNode;
}

std::uint64_t packet_count(Context& context, const schema::Extension& extension) {
  const json::NodeId packets = packets_of(context.document, extension);
  return packets == json::kNoNode ? 0 : context.size_of(packets);
}

/// The root's object, whose packets are appended to those that its successor already has, or an
/// object that refers to one of them.
class Xmp : public Conversion {
 public:
  bool joins(const ConversionContext& context) override {
    const json::Document& document = context.run.document;
    return context.host.array.empty() &&
           document.find(context.host.extensions, context.successor.name) != json::kNoNode;
  }

  Problem prepare(const ConversionContext& context) override {
    if (!context.host.array.empty()) return check_reference(context);
    const json::Document& document = context.run.document;
    const json::NodeId packets = context.member("packets");
    if (context.member("xmps") != json::kNoNode) return kFirstDraft;
    if (packets == json::kNoNode || document.kind(packets) != json::Kind::array) {
      return "its packets are invalid; see 'gltfx validate'";
    }
    if (Problem problem = check_successor(context)) return problem;
    if (Problem problem = check_context(document, context.member("@context"))) return problem;
    for (const json::NodeId node : document.elements(packets)) {
      packets_.emplace_back(document, node);
      if (Problem problem = packets_.back().prepare(context.action)) return problem;
    }
    const bool languages = std::any_of(packets_.begin(), packets_.end(),
                                       [](const Packet& one) { return one.has_languages(); });
    return languages ? need_rdf(document, context.member("@context")) : std::nullopt;
  }

  void apply(const ConversionContext& context) override {
    if (!context.host.array.empty()) return apply_reference(context);
    if (!joins(context)) {
      context.drop("@context");
      return apply_packets(context, context.run.editor);
    }
    json::Editor aside(context.run.document);
    apply_packets(context, aside);
    append_packets(context, aside.take());
  }

 private:
  static constexpr const char* kFirstDraft =
      "it follows the first draft (2019), which does not define the namespaces of its prefixes";

  static Problem check_reference(const ConversionContext& context) {
    const json::Document& document = context.run.document;
    if (context.member("xmp") != json::kNoNode) return kFirstDraft;
    const auto index = model::unsigned_member(document, context.host.object, "packet");
    const bool there = index && *index < packet_count(context.run, context.extension);
    return there ? std::nullopt : Problem("it does not reference a packet");
  }

  // An index after the last packet of the successor would refer to one of the appended packets.
  static Problem check_successor(const ConversionContext& context) {
    const json::Document& document = context.run.document;
    const std::string& name = context.successor.name;
    const auto hosts = hosts_of(document, context.run.set, context.successor);
    const std::uint64_t count = packet_count(context.run, context.successor);
    for (const Host& host : hosts) {
      const bool valid = context.run.holds(context.successor.shape_on(host.type), {host.object});
      if (valid && host.array.empty()) continue;
      const auto index = model::unsigned_member(document, host.object, "packet");
      if (valid && index && *index < count) continue;
      return fmt::format("{}/extensions/{} is invalid; see 'gltfx validate'", host.pointer(), name);
    }
    if (count > 0) {
      context.action.notes.push_back(fmt::format(
          "{} already has packets; these are appended, and their indices increase by {}", name,
          count));
    }
    return std::nullopt;
  }

  static void apply_reference(const ConversionContext& context) {
    const std::uint64_t before = packet_count(context.run, context.successor);
    const json::NodeId index = context.member("packet");
    const std::uint64_t old = context.run.document.unsigned_integer(index).value_or(0);
    if (before > 0) context.run.editor.replace_scalar(index, std::to_string(before + old));
  }

  void apply_packets(const ConversionContext& context, json::Editor& editor) const {
    const json::NodeId names = context.member("@context");
    const std::string plain(context.run.document.raw(names));
    const std::string with_rdf = add_rdf_ ? rdf_added(context.run.document, names) : plain;
    for (const Packet& packet : packets_) {
      packet.apply(editor, packet.has_languages() ? with_rdf : plain, rdf_);
    }
  }

  // The edits are those of the packets, in order.
  void append_packets(const ConversionContext& context,
                      const std::vector<json::Edit>& edits) const {
    const json::Document& document = context.run.document;
    const json::NodeId list = packets_of(document, context.successor);
    auto edit = edits.begin();
    for (const Packet& packet : packets_) {
      const Span whole = document.span(packet.node());
      std::vector<json::Edit> inside;
      for (; edit != edits.end() && edit->span.begin < whole.end; ++edit) {
        inside.push_back(
            {{edit->span.begin - whole.begin, edit->span.end - whole.begin}, edit->text});
      }
      context.run.editor.append_element(list,
                                        json::apply_edits(document.raw(packet.node()), inside));
    }
  }

  static Problem check_context(const json::Document& document, json::NodeId context) {
    const Problem problem = "its @context is invalid; see 'gltfx validate'";
    if (context == json::kNoNode || !document.is_object(context)) return problem;
    for (const auto member : document.members(context)) {
      if (!document.is_string(member.value)) return problem;
    }
    return std::nullopt;
  }

  // The prefix of the namespace for languages: the existing one, or "rdf".
  Problem need_rdf(const json::Document& document, json::NodeId context) {
    for (const auto member : document.members(context)) {
      if (document.string(member.value) != kRdf) continue;
      rdf_ = document.key(member.key_id);
      return std::nullopt;
    }
    if (document.find(context, rdf_) != json::kNoNode) {
      return "its prefix rdf does not have the RDF namespace";
    }
    add_rdf_ = true;
    return std::nullopt;
  }

  std::string rdf_added(const json::Document& document, json::NodeId context) const {
    std::string json;
    json::Writer writer(json);
    writer.begin_object();
    for (const auto member : document.members(context)) {
      writer.key(document.key(member.key_id));
      writer.raw(document.raw(member.value));
    }
    writer.member(rdf_, kRdf);
    writer.end_object();
    return json;
  }

  std::vector<Packet> packets_;
  std::string rdf_ = "rdf";
  bool add_rdf_ = false;
};

}  // namespace

std::unique_ptr<Conversion> make_xmp() { return std::make_unique<Xmp>(); }

}  // namespace gltfx::upgrade
