// SPDX-License-Identifier: Apache-2.0
// Many small files in one process: walking and reading them, and validating them.
//
//   bench_batch FOLDER [--benchmark_... options]
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "read_all.hpp"

namespace {

std::vector<std::string> assets_in(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".gltf" || extension == ".glb") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

void walk_and_read(benchmark::State& state, const std::string& folder) {
  for (auto _ : state) benchmark::DoNotOptimize(gltfx::bench::read_all(folder));
}

void validate(benchmark::State& state, const std::string& folder, unsigned jobs) {
  std::size_t findings = 0;
  for (auto _ : state) {
    findings = 0;
    gltfx::validate_files(assets_in(folder), {}, jobs, [&](gltfx::FileReport&& report) {
      findings += report.diagnostics.size();
    });
  }
  state.counters["findings"] = static_cast<double>(findings);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fputs("usage: bench_batch FOLDER\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  benchmark::RegisterBenchmark("read", [&](benchmark::State& s) { walk_and_read(s, folder); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  for (const unsigned jobs : {1U, 2U}) {
    benchmark::RegisterBenchmark(
        ("validate/jobs:" + std::to_string(jobs)).c_str(),
        [&folder, jobs](benchmark::State& s) { validate(s, folder, jobs); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
