// SPDX-License-Identifier: Apache-2.0
#include "report/page_parts.hpp"

#include <gltfx/version.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "json/parse.hpp"
#include "report/page_source.hpp"
#include "report/read_line.hpp"

namespace gltfx::report {
namespace {

using json::NodeId;

constexpr std::string_view kAssets = ",\"assets\":[";  // ends the line before the first asset
constexpr std::string_view kPosition = "{\"position\":";

Error foreign() {
  return {fmt::format("it is no page that 'gltfx report --shard' of version {} wrote", version())};
}

/// Members of an object; missing ones and wrong types are recorded.
class Members {
 public:
  Members(const json::Document& document, NodeId object) : document_(document), object_(object) {}

  bool complete() const { return complete_; }
  NodeId find(std::string_view name) {
    const NodeId node = object_ == json::kNoNode ? json::kNoNode : document_.find(object_, name);
    complete_ = complete_ && node != json::kNoNode;
    return node;
  }
  std::string text(std::string_view name) {
    const NodeId node = find(name);
    const bool fits = node != json::kNoNode && document_.is_string(node);
    complete_ = complete_ && fits;
    return fits ? document_.string(node) : std::string();
  }
  std::uint64_t number(std::string_view name) {
    const NodeId node = find(name);
    const bool fits = node != json::kNoNode && document_.is_number(node);
    const auto value = fits ? document_.unsigned_integer(node) : std::nullopt;
    complete_ = complete_ && value.has_value();
    return value.value_or(0);
  }
  NodeId object(std::string_view name) {
    const NodeId node = find(name);
    complete_ = complete_ && node != json::kNoNode && document_.is_object(node);
    return complete_ ? node : json::kNoNode;
  }
  template <class Visit>
  void elements(std::string_view name, const Visit& visit) {
    const NodeId node = find(name);
    complete_ = complete_ && node != json::kNoNode && document_.kind(node) == json::Kind::array;
    if (!complete_) return;
    for (const NodeId element : document_.elements(node)) visit(element);
  }

 private:
  const json::Document& document_;
  NodeId object_;
  bool complete_ = true;
};

void add_codes(const json::Document& document, Members& report, std::vector<std::string>& codes) {
  report.elements("findings", [&](NodeId finding) {
    if (!document.is_object(finding)) return;
    codes.push_back(Members(document, finding).text("code"));
  });
}

// Text of a page is copied unchanged: nothing in it may end the block of data.
bool is_harmless(std::string_view text, const json::Parsed& parsed) {
  return text.find('<') == std::string_view::npos && parsed.ok() &&
         parsed.document.is_object(parsed.document.root());
}

std::optional<Shard> read_shard(const json::Document& document, NodeId node,
                                std::optional<Severity>& fail_on) {
  Members shard(document, node);
  const std::uint64_t index = shard.number("index");
  const std::uint64_t count = shard.number("count");
  const std::string level = shard.text("failOn");
  fail_on = severity_from_name(level);
  const bool sound = shard.complete() && index >= 1 && index <= count && count <= UINT32_MAX &&
                     (fail_on || level == kNever);
  if (!sound) return std::nullopt;
  return Shard{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(count)};
}

}  // namespace

std::size_t least_page_head() { return page_begin().size(); }

Result<PageHead> read_page_head(std::string_view text) {
  if (!text.starts_with(page_begin()) || !text.ends_with(kAssets)) return foreign();
  text.remove_prefix(page_begin().size());
  const std::string whole = std::string(text) + "]}";
  const json::Parsed parsed = json::parse(whole);
  if (!is_harmless(whole, parsed)) return foreign();
  Members members(parsed.document, parsed.document.root());
  PageHead head;
  const std::string made_by = members.text("gltfx");
  head.title = members.text("title");
  head.profile = members.text("profile");
  head.pixel_level = members.text("pixels");
  const NodeId node = members.object("shard");
  const auto shard =
      members.complete() ? read_shard(parsed.document, node, head.fail_on) : std::optional<Shard>();
  if (!shard || made_by != version()) return foreign();
  head.shard = *shard;
  return head;
}

bool is_page_end(std::string_view line) { return line == "],"; }

Result<PageLine> read_page_line(std::string_view line) {
  if (line.ends_with(',')) line.remove_suffix(1);
  const json::Parsed parsed = json::parse(line);
  const std::size_t comma = line.find(',');
  if (!is_harmless(line, parsed) || !line.starts_with(kPosition) || comma == line.npos) {
    return foreign();
  }
  PageLine read;
  Members members(parsed.document, parsed.document.root());
  read.position = members.number("position");
  read.path = members.text("path");
  add_codes(parsed.document, members, read.codes);
  if (parsed.document.holds(parsed.document.root(), "externalAssets")) {
    members.elements("externalAssets", [&](NodeId external) {
      if (!parsed.document.is_object(external)) return;
      Members report(parsed.document, external);
      add_codes(parsed.document, report, read.codes);
    });
  }
  if (!members.complete()) return foreign();
  read.json = "{" + std::string(line.substr(comma + 1));
  return read;
}

Result<PageEnd> read_page_end(std::string_view text) {
  const std::size_t size = std::min(text.find('<'), text.size());
  if (text.substr(size) != page_end()) return foreign();
  const std::string whole = "{" + std::string(text.substr(0, size));
  const json::Parsed parsed = json::parse(whole);
  if (!is_harmless(whole, parsed)) return foreign();
  Members members(parsed.document, parsed.document.root());
  PageEnd end;
  members.elements("targets", [&](NodeId target) {
    if (parsed.document.is_string(target)) end.targets.insert(parsed.document.string(target));
  });
  Members summary(parsed.document, members.object("summary"));
  end.summary.files = summary.number("files");
  end.summary.files_with_errors = summary.number("filesWithErrors");
  end.summary.unreadable = summary.number("unreadable");
  end.summary.counts.errors = summary.number("errors");
  end.summary.counts.warnings = summary.number("warnings");
  end.summary.counts.infos = summary.number("infos");
  end.summary.counts.hints = summary.number("hints");
  if (!members.complete() || !summary.complete()) return foreign();
  return end;
}

}  // namespace gltfx::report
