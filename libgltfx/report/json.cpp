// SPDX-License-Identifier: Apache-2.0
// For programs: one object a run, one line a file. schema/meta/report.schema.json describes it.
#include <gltfx/version.hpp>

#include "json/writer.hpp"
#include "report/entry.hpp"
#include "report/safe_text.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

class JsonWriter final : public ReportWriter {
 public:
  explicit JsonWriter(const FormatOptions& options)
      : profile_(options.profile), pixel_level_(options.pixel_level) {}

  void begin(std::string& out) override {
    json::Writer writer(out);
    writer.begin_object();
    writer.member("gltfx", version());
    writer.member("format", kJsonFormat);
    if (!profile_.empty()) writer.member("profile", profile_);
    if (!pixel_level_.empty()) writer.member("pixels", pixel_level_);
    writer.key("files");
    out += '[';
  }

  void file(const FileReport& report, std::string& out) override {
    const std::size_t from = out.size();
    out += has_files_ ? ",\n" : "\n";
    has_files_ = true;
    json::Writer writer(out);
    write_entry(writer, report, Detail::plain);
    defuse_json(out, from);
  }

  void end(const RunSummary& summary, std::string& out) override {
    out += has_files_ ? "\n],\"summary\":" : "],\"summary\":";
    json::Writer writer(out);
    write_summary(writer, summary);
    out += "}\n";
  }

 private:
  std::string profile_;
  std::string pixel_level_;
  bool has_files_ = false;
};

}  // namespace

std::unique_ptr<ReportWriter> make_json_writer(const FormatOptions& options) {
  return std::make_unique<JsonWriter>(options);
}

}  // namespace gltfx::report
