// SPDX-License-Identifier: Apache-2.0
#include <gltfx/report.hpp>

namespace gltfx {

void Counts::add(Severity severity, std::uint64_t count) {
  switch (severity) {
    case Severity::error:
      errors += count;
      break;
    case Severity::warning:
      warnings += count;
      break;
    case Severity::info:
      infos += count;
      break;
    case Severity::hint:
      hints += count;
      break;
  }
}

std::uint64_t Counts::at_least(Severity severity) const {
  std::uint64_t count = errors;
  if (severity >= Severity::warning) count += warnings;
  if (severity >= Severity::info) count += infos;
  if (severity >= Severity::hint) count += hints;
  return count;
}

Counts& Counts::operator+=(const Counts& other) {
  errors += other.errors;
  warnings += other.warnings;
  infos += other.infos;
  hints += other.hints;
  return *this;
}

void RunSummary::add(const FileReport& report) {
  ++files;
  if (report.counts.errors > 0) ++files_with_errors;
  if (!report.readable) ++unreadable;
  unverified += report.unverified;
  suppressed += report.suppressed;
  left_out += report.left_out;
  images_wanted += report.images_wanted;
  images_decoded += report.images_decoded;
  unchanged += report.unchanged;
  if (report.fixable > 0) fixable_path = fixable == 0 ? report.path : std::string();
  fixable += report.fixable;
  counts += report.counts;
}

}  // namespace gltfx
