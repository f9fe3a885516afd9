// SPDX-License-Identifier: Apache-2.0
#include "schema/findings.hpp"

#include <gtest/gtest.h>

#include "json/parse.hpp"

namespace gltfx::test {
namespace {

class Recorder : public Sink {
 public:
  Recorder(std::vector<Found>& found, std::string_view text, bool is_reference)
      : found_(found), text_(text), is_reference_(is_reference) {}
  void report(const Path& path, Finding finding) override {
    found_.push_back({std::string(code_name(finding.code)), path.pointer(),
                      std::move(finding.message), std::move(finding.help),
                      std::string(finding.span.in(text_)), is_reference_,
                      !finding.severity || *finding.severity == Severity::error});
  }

 private:
  std::vector<Found>& found_;
  std::string_view text_;
  bool is_reference_;
};

schema::CheckResult run(std::string_view json, schema::Deviations deviations,
                        const schema::Set& set, std::vector<Found>& found) {
  const json::Parsed parsed = json::parse(json);
  EXPECT_TRUE(parsed.ok()) << "the test's own JSON is broken: " << json;
  Recorder schema_sink(found, json, false);
  Recorder reference_sink(found, json, true);
  schema::CheckOptions options;
  options.deviations = deviations;
  return schema::check(parsed.document, set, options, schema_sink, reference_sink);
}

}  // namespace

std::vector<Found> find(std::string_view json, schema::Deviations deviations,
                        const schema::Set& set) {
  std::vector<Found> found;
  run(json, deviations, set, found);
  return found;
}

std::vector<std::string> verdict(std::string_view json, schema::Deviations deviations,
                                 const schema::Set& set) {
  std::vector<std::string> lines;
  for (const Found& one : find(json, deviations, set))
    lines.push_back(one.code + " " + one.pointer);
  return lines;
}

Found only(std::string_view json, const schema::Set& set) {
  const std::vector<Found> found = find(json, {}, set);
  EXPECT_EQ(found.size(), 1U) << json;
  return found.empty() ? Found{} : found.front();
}

schema::CheckResult result_of(std::string_view json, schema::Deviations deviations,
                              const schema::Set& set) {
  std::vector<Found> found;
  return run(json, deviations, set, found);
}

std::string asset(std::string_view members) {
  std::string text = R"({"asset": {"version": "2.0"})";
  if (!members.empty()) text.append(", ").append(members);
  return text + "}";
}

std::string asset_using(std::string_view extensions, std::string_view members) {
  std::string list = "\"extensionsUsed\": [";
  while (!extensions.empty()) {
    const std::size_t end = std::min(extensions.find(','), extensions.size());
    list.append("\"").append(extensions.substr(0, end)).append("\"");
    extensions.remove_prefix(std::min(end + 1, extensions.size()));
    if (!extensions.empty()) list += ", ";
  }
  return asset(list + "], " + std::string(members));
}

std::string material(std::string_view members) {
  return asset("\"materials\": [{" + std::string(members) + "}]");
}

}  // namespace gltfx::test
