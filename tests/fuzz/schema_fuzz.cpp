// SPDX-License-Identifier: Apache-2.0
// Any text as a schema file, any text as a document. The input is a schema file, a line "---" and a
// document; without that line it is both. What is made of the file is used for all that the program
// does with it: documents are checked, the extension is shown, upgrades are planned.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "json/parse.hpp"
#include "schema/check.hpp"
#include "schema/compile.hpp"
#include "schema_print.hpp"
#include "steps/upgrade/choice.hpp"
#include "steps/upgrade/plan.hpp"

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
    require(!finding.message.empty());
    require(finding.span.begin < finding.span.end && finding.span.end <= document_.text().size());
    std::optional<std::uint64_t> element;
    require(document_.resolve(path.pointer(), &element) != json::kNoNode);
  }

 private:
  const json::Document& document_;
};

void check_document(const json::Document& document, const schema::Set& set) {
  for (const auto& deviations : {schema::Deviations(), schema::kKhronosValidator}) {
    Promises sink(document);
    schema::CheckOptions options;
    options.deviations = deviations;
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

// The objects of core, extensions that upgrades may lead to, and one file more.
schema::Compiled compile_with_core(const std::string& text) {
  std::vector<schema::SourceFile> files;
  for (const schema::SourceFile& file : schema::builtin_files()) {
    const bool successor = file.name.find("/KHR_materials_") != std::string::npos;
    if (file.name.rfind("core/", 0) == 0 || successor) files.push_back(file);
  }
  files.push_back({"fuzz.json", text, true});
  return schema::compile(files);
}

// Materials and nodes that have the extension ACME_x, in several forms.
constexpr std::string_view kAsset =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_x"], "images": [{"uri": "a.png"}],
"textures": [{"source": 0}], "nodes": [{"extensions": {"ACME_x": {"p": 0, "q": [1, {}]}}}], "materials": [
{"name": "m", "extensions": {"ACME_x": {"a": 0.5, "b": [{"p": 0}, [[1]]], "c": 1, "d": "/a", "n": "m", "t": {"index": 0}, "extensions": {}}}},
{"extensions": {"ACME_x": {"a": "x", "b": [1, 2], "c": {"c": {"c": {}}}, "t": {}}, "KHR_materials_unlit": {}}},
{"extensions": {"ACME_x": []}}]})";

void show(const schema::Set& set) {
  const tool::Style plain(false);
  require(!tool::schema_list_text(set, {}, plain).empty() &&
          !tool::schema_list_json(set, {}).empty());
  for (schema::ExtensionId id = 0; id < set.extensions().size(); ++id) {
    if (!set.extensions()[id].from_user) continue;
    require(!tool::extension_text(set, id, plain).empty());
    require(json::parse(tool::extension_json(set, id)).ok());
  }
  for (schema::TypeId id = 0; id < set.types().size(); ++id) {
    require(!tool::type_text(set, id, plain).empty());
  }
}

void plan_upgrades(const json::Document& document, const schema::Set& set) {
  for (const std::string& to : upgrade::successor_names(set)) {
    UpgradeOptions options;
    options.unsafe = true;
    options.to = {to};
    const upgrade::Plan plan = upgrade::make_plan(document, set, options);
    require(json::parse(json::apply_edits(document.text(), plan.change.edits)).ok());
  }
}

void use(const schema::Set& set, const json::Document& document) {
  const json::Parsed asset = json::parse(kAsset);
  check_document(asset.document, set);
  plan_upgrades(asset.document, set);
  show(set);
  if (document.empty()) return;
  check_document(document, set);
  if (json::parse(document.text()).ok()) plan_upgrades(document, set);
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
  require((compiled.set == nullptr) == !compiled.errors.empty());
  for (const schema::SchemaError& error : compiled.errors) {
    require(error.line >= 1 && error.column >= 1 && !error.message.empty());
  }
  if (compiled.set) use(*compiled.set, parsed.document);
  return 0;
}
