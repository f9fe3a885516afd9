// SPDX-License-Identifier: Apache-2.0
#include "schema_tests.hpp"

#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "json/equal.hpp"
#include "json/parse.hpp"
#include "read_input.hpp"
#include "schema/compile.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStart = R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "gltfx:ext/@",
  "title": "@",
  "description": "What the extension is for, in one sentence.",
  "type": "object",
  "required": ["amount"],
  "properties": {
    "amount": {
      "$comment": "type: boolean, integer, number, string, array or object; default where the member is optional",
      "description": "How much.",
      "type": "number", "minimum": 0, "maximum": 1
    },
    "amountTexture": {
      "$comment": "slot: the channels that are read, of r, g, b and a; colorSpace: linear or srgb",
      "description": "How much, by texture.",
      "$ref": "gltfx:core/textureInfo",
      "x-gltfx": { "slot": { "channels": "r", "colorSpace": "linear" } }
    },
    "extensions": { "type": "object" },
    "extras": {}
  },
  "x-gltfx": {
    "extension": "@",
    "on": ["material"],
    "status": "vendor",
    "excludes": [{ "extension": "KHR_materials_unlit", "because": "Unlit materials have no shading." }],
    "tests": {
      "good": [
        { "asset": { "version": "2.0" }, "extensionsUsed": ["@"],
          "materials": [{ "extensions": { "@": { "amount": 0.5 } } }] }
      ],
      "bad": [
        { "finding": "VALUE_NOT_IN_RANGE",
          "asset": { "asset": { "version": "2.0" }, "extensionsUsed": ["@"],
            "materials": [{ "extensions": { "@": { "amount": 2 } } }] } }
      ],
      "upgrade": []
    }
  }
}
)json";

// A temporary folder for upgrades of assets.
class WorkFolder {
 public:
  WorkFolder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "gltfx-schema-XXXXXX").native();
    if (!error && ::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The tests of one schema file.
class SchemaTests {
 public:
  SchemaTests(const json::Document& document, std::shared_ptr<const schema::Set> schemas)
      : document_(document), schemas_(std::move(schemas)) {}

  // The failures, a line each.
  std::vector<std::string> run() {
    const json::NodeId tests = document_.find(document_.find(document_.root(), "x-gltfx"), "tests");
    if (tests == json::kNoNode || !document_.is_object(tests)) return {};
    for (const auto& member : document_.members(tests)) {
      const std::string kind = document_.string(member.key);
      if (kind == "good") {
        each(member.value, kind, &SchemaTests::check_good);
      } else if (kind == "bad") {
        each(member.value, kind, &SchemaTests::check_bad);
      } else if (kind == "upgrade") {
        each(member.value, kind, &SchemaTests::check_upgrade);
      } else {
        failures_.push_back(fmt::format("tests/{}: not good, bad or upgrade", printable(kind)));
      }
    }
    return std::move(failures_);
  }
  std::size_t passed() const { return passed_; }

 private:
  using Check = std::optional<std::string> (SchemaTests::*)(json::NodeId) const;

  void each(json::NodeId list, std::string_view kind, Check check) {
    if (!document_.is_array(list)) {
      failures_.push_back(fmt::format("tests/{}: not an array", kind));
      return;
    }
    std::size_t number = 0;
    for (const json::NodeId test : document_.elements(list)) {
      if (const auto why = (this->*check)(test)) {
        failures_.push_back(fmt::format("tests/{}/{}: {}", kind, number, *why));
      } else {
        ++passed_;
      }
      ++number;
    }
  }

  FileReport validate(json::NodeId asset) const {
    ValidateOptions options;
    options.schemas = schemas_;
    return validate_bytes(std::string(document_.raw(asset)), "test", options);
  }

  std::optional<std::string> check_good(json::NodeId asset) const {
    const FileReport report = validate(asset);
    for (const Diagnostic& finding : report.diagnostics) {
      if (finding.severity > Severity::warning) continue;
      return fmt::format("{}[{}] at {}: {}", severity_name(finding.severity), finding.code,
                         printable(finding.pointer), printable(finding.message));
    }
    return std::nullopt;
  }

  std::optional<std::string> check_bad(json::NodeId test) const {
    const json::NodeId asset = document_.find(test, "asset");
    const json::NodeId finding = document_.find(test, "finding");
    if (asset == json::kNoNode || finding == json::kNoNode || !document_.is_string(finding)) {
      return "needs an 'asset' and the code of its 'finding'";
    }
    const std::string code = document_.string(finding);
    const FileReport report = validate(asset);
    std::vector<std::string_view> found;
    for (const Diagnostic& each : report.diagnostics) {
      if (each.code == code) return std::nullopt;
      found.push_back(each.code);
    }
    return fmt::format("{} is not found, but: {}", gltfx::quoted(code),
                       found.empty() ? "nothing" : fmt::format("{}", fmt::join(found, ", ")));
  }

  std::optional<std::string> check_upgrade(json::NodeId test) const {
    const json::NodeId before = document_.find(test, "before");
    const json::NodeId after = document_.find(test, "after");
    if (before == json::kNoNode || after == json::kNoNode) return "needs 'before' and 'after'";
    const WorkFolder folder;
    if (folder.path().empty()) return "there is no folder for temporary files";
    const std::string path = folder.path() / "before.gltf";
    std::ofstream(path, std::ios::binary) << document_.raw(before);
    UpgradeOptions options;
    options.schemas = schemas_;
    options.unsafe = true;
    options.output = folder.path() / "after.gltf";
    const UpgradeReport report = upgrade_file(path, options);
    if (report.problem != EditProblem::none) return printable(report.error);
    const auto text = read_text_file(options.output, kLongestAsset);
    if (!text) return printable(text.error().message);
    const std::string both = fmt::format("[{},{}]", *text, document_.raw(after));
    const json::Parsed parsed = json::parse(std::string_view(both));
    const json::NodeId first = parsed.document.root() + 1;
    if (json::equal(parsed.document, first, parsed.document.next(first))) return std::nullopt;
    return "the upgraded asset differs:\n" + printable(*text);
  }

  const json::Document& document_;
  std::shared_ptr<const schema::Set> schemas_;
  std::vector<std::string> failures_;
  std::size_t passed_ = 0;
};

bool run_tests(const std::string& file, const std::shared_ptr<const schema::Set>& schemas,
               std::string& out) {
  const auto text = read_text_file(file, schema::kLongestFile);
  if (!text) return false;
  const json::Parsed parsed = json::parse(std::string_view(*text));
  SchemaTests tests(parsed.document, schemas);
  const std::vector<std::string> failures = tests.run();
  for (const std::string& failure : failures) {
    out += fmt::format("{}: {}\n", printable(file), failure);
  }
  out +=
      fmt::format("{}: {} passed, {} failed\n", printable(file), tests.passed(), failures.size());
  return failures.empty();
}

}  // namespace

bool is_extension_name(std::string_view name) {
  const std::size_t end = name.find('_');
  const auto is_prefix = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  const auto is_word = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return end != std::string_view::npos && end > 0 && end + 1 < name.size() &&
         std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(end), is_prefix) &&
         std::all_of(name.begin(), name.end(), is_word);
}

std::string new_schema(std::string_view name) {
  std::string text;
  for (const char c : kStart) {
    if (c == '@') {
      text += name;
    } else {
      text += c;
    }
  }
  return text;
}

ExitCode check_schemas(const SchemaRequest& request) {
  std::vector<std::string> files = request.check_files;
  files.insert(files.end(), request.test_files.begin(), request.test_files.end());
  std::vector<std::string> all = request.schema_files;
  all.insert(all.end(), files.begin(), files.end());
  const auto schemas = load_schemas(all, request.schema_folders);
  if (!schemas) {
    complain(schemas.error().message);
    return ExitCode::findings;
  }
  std::string out;
  bool passed = true;
  for (const std::string& file : request.check_files) {
    out += printable(file) + ": no mistakes\n";
  }
  for (const std::string& file : request.test_files) passed &= run_tests(file, *schemas, out);
  const ExitCode printed = print(out);
  return printed == ExitCode::ok && !passed ? ExitCode::findings : printed;
}

}  // namespace gltfx::tool
