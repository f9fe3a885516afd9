// SPDX-License-Identifier: Apache-2.0
#include "report/packed.hpp"

#include <memory>
#include <set>
#include <span>

#include <gmock/gmock.h>

#include "report/read_line.hpp"
#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

// All that formats can show of a report.
std::string shown(const FileReport& report) {
  return run(ReportFormat::jsonl, {report}) + run(ReportFormat::text, {report}) +
         run(ReportFormat::khronos, {report}) + run(ReportFormat::sarif, {report});
}

FileReport with_everything() {
  FileReport report = file("leaf.gltf", {wrong_type()});
  Diagnostic& finding = report.diagnostics.front();
  finding.offset = 7;
  finding.location.utf16_column = 5;
  finding.excerpt.text = "a \xFF b";
  ProposedFix fix{"Mend it.", {{{1, 2, 3, 4, 5, 6, 7, 8}, "text"}, {{}, ""}}};
  finding.fix = std::make_shared<const ProposedFix>(std::move(fix));
  Diagnostic again = out_of_range();
  again.help = "Write less.";
  again.object_name = "Stem";
  again.count = 3;
  keep_repeat(report, again);
  keep_repeat(report, bad_chunk());
  report.truncated = true;
  report.suppressed = 3;
  report.left_out = 300;
  report.unverified = 1;
  report.images_wanted = 7;
  report.images_decoded = 6;
  AssetInfo& info = report.info.emplace();
  info.version = "2.0";
  info.generator = "";
  info.extensions_used = {"A", "B"};
  ResourceInfo resource;
  resource.pointer = "/images/0";
  resource.byte_length = std::uint64_t{1} << 53U;
  resource.image = {1, 2, 8, "rgb", "srgb", "linear"};
  info.resources = {resource, {}};
  info.max_uvs = 2;
  info.has_skins = true;
  report.diagnostics.push_back(over_budget());
  Diagnostic other = over_budget();
  CheckedLimit limit = *other.requirement;
  limit.value = 40000.0;
  other.requirement = std::make_shared<const CheckedLimit>(std::move(limit));
  keep_repeat(report, other);
  report.requirements = requirements();
  report.unlisted_requirements = 12;
  return report;
}

std::vector<FileReport> all_kinds() {
  std::vector<FileReport> reports = sample_run();
  reports.push_back(with_everything());
  return reports;
}

// Rules with only their code.
std::span<const RuleDescription> known() {
  static const std::vector<RuleDescription> rules = [] {
    std::set<std::string_view> codes;
    for (const FileReport& report : all_kinds()) {
      for (const Diagnostic& finding : report.diagnostics) codes.insert(finding.code);
    }
    std::vector<RuleDescription> found;
    for (const std::string_view code : codes) {
      found.emplace_back();
      found.back().code = code;
    }
    return found;
  }();
  return rules;
}

TEST(PackedReport, ComesBackWhole) {
  for (const FileReport& report : all_kinds()) {
    auto back = unpack(pack(report), known());
    ASSERT_TRUE(back) << report.path;
    back->path = report.path;
    EXPECT_EQ(shown(*back), shown(report));
  }
}

TEST(PackedReport, CutOffAtAnyPlaceItIsNone) {
  const std::string bytes = pack(with_everything());
  for (std::size_t end = 0; end < bytes.size(); ++end) {
    EXPECT_FALSE(unpack(bytes.substr(0, end), known())) << end;
  }
  EXPECT_FALSE(unpack(bytes + '\0', known()));
}

TEST(PackedReport, AnyBytesAreReadWithoutHarm) {
  const std::string bytes = pack(with_everything());
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int bits : {0x01, 0x7F, 0x80, 0xFF}) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ bits);
      static_cast<void>(unpack(other, known()));
    }
  }
}

TEST(PackedReport, ACodeThatIsUnknownMakesItNone) {
  EXPECT_FALSE(unpack(pack(with_everything()), {}));
}

TEST(ReportLines, ComeBackWhole) {
  for (const FileReport& report : all_kinds()) {
    const std::string lines = run(ReportFormat::jsonl, {report});
    const std::size_t begin = lines.find('\n') + 1;
    const auto line = read_line(lines.substr(begin, lines.find('\n', begin) - begin), known());
    ASSERT_TRUE(line) << line.error().message;
    EXPECT_EQ(shown(std::get<FileReport>(*line)), shown(report));
  }
}

TEST(EarlierRequirements, AreReadByPath) {
  FileReport report = file("b\xff.gltf");
  report.requirements = requirements();
  const auto read = read_requirements(run(ReportFormat::json, {report, file("other.gltf")}));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  FileReport back = file("other.gltf");
  back.requirements = read->begin()->second;
  back.path = report.path;
  EXPECT_EQ(run(ReportFormat::json, {back}), run(ReportFormat::json, {report}));
  EXPECT_TRUE(read->at("other.gltf").empty());
}

TEST(EarlierRequirements, OfOtherTextsAreAnError) {
  for (const char* const text :
       {"", "[]", "{}", R"({"format": 1})", R"({"format": 2, "files": []})",
        R"({"format": 1, "files": {}})", R"({"format": 1, "files": [{"path": 1}]})",
        R"({"format": 1, "files": [{"path": "a", "requirements": [{"verdict": "good"}]}]})"}) {
    EXPECT_FALSE(read_requirements(text)) << text;
  }
}

TEST(ReportLines, SayWhatIsWrongWithThem) {
  const auto problem = [](std::string_view line) {
    const auto read = read_line(line, known());
    return read ? std::string() : read.error().message;
  };
  EXPECT_THAT(problem("{\"path\": 1}"), ::testing::HasSubstr("'path'"));
  EXPECT_THAT(problem("{\"path\": \"a\", \"findings\": [{\"code\": \"NEW\"}]}"),
              ::testing::HasSubstr("'code'"));
  EXPECT_THAT(problem("{\"path\": \"a\", \"counts\": []}"), ::testing::HasSubstr("'counts'"));
  EXPECT_THAT(problem("{\"path\": \"a\", \"suppressed\": -1}"),
              ::testing::HasSubstr("'suppressed'"));
  EXPECT_THAT(problem("{\"path\": \"a\", \"requirements\": [{\"verdict\": \"good\"}]}"),
              ::testing::HasSubstr("'verdict'"));
  EXPECT_THAT(problem("{\"path\": \"a\", \"requirements\": [{\"value\": {}}]}"),
              ::testing::HasSubstr("'value'"));
  EXPECT_THAT(problem("{\"path\": \"a\""), ::testing::HasSubstr("cut off"));
  EXPECT_THAT(problem("{}"), ::testing::HasSubstr("no line of a report"));
}

}  // namespace
}  // namespace gltfx::report::testing
