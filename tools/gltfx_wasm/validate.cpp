// SPDX-License-Identifier: Apache-2.0
// Validation of bytes for JavaScript: a request is made, gets its options, and is validated once.
#include <gltfx/pipeline.hpp>
#include <gltfx/version.hpp>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <emscripten.h>

// The bytes of a URI or a path, allocated here, with their number in `size`; null when there are
// none.
EM_JS(char*, gltfx_read_resource, (const char* uri, std::size_t* size), {
  const bytes = Module.readResource(UTF8ToString(uri));
  if (!bytes) return 0;
  const to = _malloc(bytes.length || 1);
  HEAPU8.set(bytes, to);
  HEAPU32[size >> 2] = bytes.length;
  return to;
});

namespace {

using gltfx::AssetFormat;
using gltfx::FileReport;
using gltfx::Profile;
using gltfx::ReportFormat;
using gltfx::Severity;

struct Request {
  gltfx::MemoryAsset asset;
  gltfx::ValidateOptions options;
  std::string report;
};

struct Free {
  void operator()(char* memory) const { std::free(memory); }
};

std::optional<std::string> read(const std::string& uri) {
  std::size_t size = 0;
  const std::unique_ptr<char, Free> bytes(gltfx_read_resource(uri.c_str(), &size));
  if (!bytes) return std::nullopt;
  return std::string(bytes.get(), size);
}

std::string text_of(const FileReport& report, const gltfx::ValidateOptions& options) {
  const bool khronos = options.profile == Profile::khronos;
  gltfx::FormatOptions format;
  format.profile = options.profile == Profile::strict ? "strict" : "default";
  format.pixel_level = gltfx::pixel_level_name(gltfx::pixel_level(options));
  format.rules = gltfx::rules();
  const auto writer =
      gltfx::make_report_writer(khronos ? ReportFormat::khronos : ReportFormat::json, format);
  gltfx::RunSummary summary;
  std::string out;
  writer->begin(out);
  const auto write = [&](const FileReport& each) {
    summary.add(each);
    writer->file(each, out);
  };
  write(report);
  for (const FileReport& external : report.external_assets) write(external);
  writer->end(summary, out);
  return out;
}

}  // namespace

extern "C" {

const char* gltfx_version() {
  static const std::string text(gltfx::version());
  return text.c_str();
}

// Whether there is a rule of that code.
int gltfx_is_code(const char* code) { return gltfx::find_rule(code) != nullptr ? 1 : 0; }

// A request for an asset of that size, which the caller writes to gltfx_request_bytes(); null:
// there is not enough memory.
Request* gltfx_request(std::size_t size) {
  try {
    auto request = std::make_unique<Request>();
    request->asset.bytes.resize(size);
    request->asset.read = read;
    request->options.jobs = 1;
    return request.release();
  } catch (const std::exception&) {
    return nullptr;
  }
}

char* gltfx_request_bytes(Request* request) { return request->asset.bytes.data(); }

void gltfx_request_name(Request* request, const char* name) { request->asset.name = name; }

// The format of the asset and the profile: positions in AssetFormat and Profile.
void gltfx_request_kind(Request* request, int format, int profile) {
  request->asset.format = static_cast<AssetFormat>(format);
  request->options.profile = static_cast<Profile>(profile);
}

// Resources are requested by paths below the folder of the asset, not by URIs.
void gltfx_request_paths(Request* request) {
  request->asset.names = gltfx::MemoryAsset::Names::paths;
}

void gltfx_request_limit(Request* request, double issues) {
  request->options.max_issues = static_cast<std::uint64_t>(issues);
}

void gltfx_request_ignore(Request* request, const char* code) {
  request->options.ignore.emplace(code);
}

void gltfx_request_select(Request* request, const char* code) {
  request->options.select.emplace(code);
}

// `severity`: 0 error, 1 warning, 2 information, 3 hint.
void gltfx_request_severity(Request* request, const char* code, int severity) {
  constexpr Severity kSeverities[]{Severity::error, Severity::warning, Severity::info,
                                   Severity::hint};
  request->options.severity.insert_or_assign(code, kSeverities[severity]);
}

// The report, which belongs to the request.
const char* gltfx_validate(Request* request) {
  const FileReport report = gltfx::validate_bytes(std::move(request->asset), request->options);
  request->report = text_of(report, request->options);
  return request->report.data();
}

std::size_t gltfx_report_size(const Request* request) { return request->report.size(); }

void gltfx_release(Request* request) { const std::unique_ptr<Request> last(request); }

}  // extern "C"
