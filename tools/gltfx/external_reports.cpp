// SPDX-License-Identifier: Apache-2.0
#include "external_reports.hpp"

#include <filesystem>
#include <utility>

namespace gltfx::tool {
namespace {

std::string normal(const std::string& path) {
  return std::filesystem::path(path).lexically_normal().native();
}

}  // namespace

void ExternalReports::name(const std::string& path) {
  ++inputs_;
  if (path == "-") return;
  const std::string plain = normal(path);
  named_.insert(hash_bytes(plain));
  waiting_.erase(plain);
}

void ExternalReports::take_from(FileReport& report) {
  for (FileReport& external : report.external_assets) {
    std::string plain = normal(external.path);
    if (named_.count(hash_bytes(plain)) > 0) continue;
    external.path = plain;
    const auto known = waiting_.find(plain);
    if (known == waiting_.end()) {
      waiting_.emplace(std::move(plain), std::move(external));
    } else if (known->second.counts.errors < external.counts.errors) {
      // The two were opened with different aliases.
      known->second = std::move(external);
    }
  }
  report.external_assets = {};
}

std::vector<FileReport> ExternalReports::take() {
  std::vector<FileReport> reports;
  for (auto& [path, report] : waiting_) {
    report.position = inputs_;
    reports.push_back(std::move(report));
  }
  waiting_.clear();
  return reports;
}

}  // namespace gltfx::tool
