// SPDX-License-Identifier: Apache-2.0
// For programs: one object per run, one line per file (schema/meta/report.schema.json describes
// it); or JSON Lines: one object per line, each complete when written, from which any other format
// can be made. The first line describes the run, the last is the summary, and there is one for each
// file.
#include <gltfx/version.hpp>

#include "json/writer.hpp"
#include "report/entry.hpp"
#include "report/read_line.hpp"
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

class JsonLinesWriter final : public ReportWriter {
 public:
  explicit JsonLinesWriter(const FormatOptions& options) : options_(options) {}

  void begin(std::string& out) override {
    line(out, [this](json::Writer& writer) {
      writer.begin_object();
      writer.member("gltfx", version());
      writer.member("format", kJsonFormat);
      if (!options_.profile.empty()) writer.member("profile", options_.profile);
      if (!options_.pixel_level.empty()) writer.member("pixels", options_.pixel_level);
      writer.member("failOn", options_.fail_on ? severity_name(*options_.fail_on) : kNever);
      if (options_.timings) writer.member("timings", true);
      writer.key("shard");
      writer.begin_object();
      writer.member("index", std::uint64_t{options_.shard.index});
      writer.member("count", std::uint64_t{options_.shard.count});
      writer.end_object();
      writer.end_object();
    });
  }

  void file(const FileReport& report, std::string& out) override {
    line(out, [&](json::Writer& writer) {
      write_entry(writer, report, Detail::full, options_.timings);
    });
  }

  void end(const RunSummary& summary, std::string& out) override {
    line(out, [&](json::Writer& writer) {
      writer.begin_object();
      writer.key("summary");
      write_summary(writer, summary);
      writer.end_object();
    });
  }

 private:
  template <class Write>
  static void line(std::string& out, const Write& write) {
    const std::size_t from = out.size();
    json::Writer writer(out);
    write(writer);
    defuse_json(out, from);
    out += '\n';
  }

  const FormatOptions options_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_json_writer(const FormatOptions& options) {
  return std::make_unique<JsonWriter>(options);
}

std::unique_ptr<ReportWriter> make_json_lines_writer(const FormatOptions& options) {
  return std::make_unique<JsonLinesWriter>(options);
}

}  // namespace gltfx::report
