// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/shared_text.hpp"
#include "base/text.hpp"
#include "json/lines.hpp"
#include "json/parse.hpp"
#include "model/fields.hpp"
#include "rules/payload/metadata/phase.hpp"
#include "rules/resource_fetch.hpp"
#include "schema/check.hpp"

namespace gltfx::validate {
namespace {

constexpr std::size_t kMostSchemaBytes = std::size_t{64} << 20U;

// Reports problems of a file at the member that names the file.
class SchemaFileSink final : public Sink {
 public:
  SchemaFileSink(std::string_view name, std::string_view text, const Path& member, Span span,
                 Sink& sink)
      : name_(name), lines_(text), member_(member), span_(span), sink_(sink) {}

  void report(const Path& path, Finding finding) override {
    const Location at = lines_.locate(finding.span);
    finding.about = path.pointer();
    finding.message =
        fmt::format("Line {} of {}: {}", at.line, gltfx::quoted(name_), finding.message);
    finding.span = span_;
    sink_.report(member_, std::move(finding));
  }

 private:
  std::string_view name_;
  json::LineIndex lines_;
  const Path& member_;
  Span span_;
  Sink& sink_;
};

// The problem of the text as JSON; empty: none, or a byte order mark.
std::string unreadable_reason(const json::Parsed& parsed, std::string_view text) {
  const auto error =
      std::find_if(parsed.errors.begin(), parsed.errors.end(), [](const json::ParseError& each) {
        return each.error != json::SyntaxError::byte_order_mark;
      });
  if (error != parsed.errors.end()) {
    const Location at = json::LineIndex(text).locate(error->span);
    return fmt::format("is not valid JSON at line {}, column {}.", at.line, at.column);
  }
  if (parsed.document.empty() || !parsed.document.is_object(parsed.document.root())) {
    return "holds no JSON object; it must be a schema of metadata.";
  }
  return {};
}

}  // namespace

bool MetadataSource::read_file(MetadataPhase& phase, const Path& path) {
  ResourceInfo info;
  const Resource resource{phase.context(), phase.sink(), phase.report, path,
                          phase.root,      info,         "schemaUri"};
  check_resource_uri(resource);
  const auto bytes = fetch_uri(resource);
  if (!bytes) return false;
  name_ = info.uri.empty() ? "schemaUri" : info.uri;
  std::string reason;
  if (bytes->size() > kMostSchemaBytes) {
    reason = fmt::format("has {} bytes; at most {} are read.", bytes->size(), kMostSchemaBytes);
  } else {
    const SharedText text = share_text(std::string(bytes->text()));
    json::Parsed parsed = json::parse(text);
    reason = unreadable_reason(parsed, *text);
    file_ = std::move(parsed.document);
  }
  if (reason.empty()) return true;
  resource.find(Code::METADATA_SCHEMA_UNREADABLE, "schemaUri",
                fmt::format("{} {}", gltfx::quoted(name_), reason));
  return false;
}

void MetadataSource::check_file(MetadataPhase& phase, const Path& path) {
  const Path member(path, "schemaUri");
  const schema::Set& schemas = phase.context().schemas;
  SchemaFileSink sink(name_, file_.text(), member,
                      member_span(phase.document(), phase.root, "schemaUri"), phase.sink());
  schema::CheckOptions options;
  options.root = schemas.find_type("EXT_structural_metadata.schema");
  if (options.root != schema::kNone) schema::check(file_, schemas, options, sink, sink);
  phase.schema = model::MetadataSchema(file_, file_.root());
  check_metadata_schema(phase.schema, {}, sink);
}

void MetadataSource::load(MetadataPhase& phase) {
  const json::Document& document = phase.document();
  const json::NodeId inside = model::object_member(document, phase.root, "schema");
  with_metadata_path([&](const Path& path) {
    if (inside != json::kNoNode) {
      phase.schema = model::MetadataSchema(document, inside);
      check_metadata_schema(phase.schema, Path(path, "schema"), phase.sink());
    } else if (read_file(phase, path)) {
      check_file(phase, path);
    }
  });
}

}  // namespace gltfx::validate
