// SPDX-License-Identifier: Apache-2.0
// Any text as a schema file, any text as a document. The input is a schema file, a line "---" and a
// document; without that line it is both.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "json/parse.hpp"
#include "schema/check.hpp"
#include "schema/compile.hpp"

namespace {

using namespace gltfx;

void require(bool promise) {
  if (!promise) std::abort();
}

// Whatever is found lies inside the text, at a place that exists or is missing from one that does.
class Promises : public Sink {
 public:
  explicit Promises(const json::Document& document) : document_(document) {}
  void report(const Path& path, Finding finding) override {
    require(!finding.code.empty() && !finding.message.empty());
    require(finding.span.begin < finding.span.end && finding.span.end <= document_.text().size());
    std::optional<std::uint64_t> element;
    require(document_.resolve(path.pointer(), &element) != json::kNoNode);
  }

 private:
  const json::Document& document_;
};

void check_document(const json::Document& document, const schema::Set& set) {
  for (const schema::Scope scope : {schema::Scope::all, schema::Scope::khronos}) {
    Promises sink(document);
    schema::CheckOptions options;
    options.scope = scope;
    const schema::CheckResult result =
        schema::check(document, set, options, sink, sink,
                      [](const schema::ObjectType& type, json::NodeId, const Path&) {
                        require(!type.name.empty());
                      });
    for (const schema::TargetArray& target : result.targets) {
      require(document.is_array(target.node) &&
              target.used.size() == document.array_size(target.node));
    }
    for (const schema::SlotUse& slot : result.slots) {
      require(slot.slot != nullptr && document.is_object(slot.texture_info));
    }
  }
}

// The objects of core and one file more.
schema::Compiled compile_with_core(const std::string& text) {
  std::vector<schema::SourceFile> files;
  for (const schema::SourceFile& file : schema::builtin_files()) {
    if (file.name.rfind("core/", 0) == 0) files.push_back(file);
  }
  files.push_back({"fuzz.json", text, true});
  return schema::compile(files);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t line = text.find("\n---\n");
  const std::string schema_text = text.substr(0, line);
  const std::string document_text = line == std::string::npos ? text : text.substr(line + 5);
  const json::Parsed parsed = json::parse(document_text);
  if (!parsed.document.empty()) check_document(parsed.document, *schema::builtin_set());

  const schema::Compiled compiled = compile_with_core(schema_text);
  require((compiled.set == nullptr) == !compiled.faults.empty());
  for (const schema::SchemaFault& fault : compiled.faults) {
    require(fault.line >= 1 && fault.column >= 1 && !fault.message.empty());
  }
  if (compiled.set && !parsed.document.empty()) check_document(parsed.document, *compiled.set);
  return 0;
}
