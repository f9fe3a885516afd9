// SPDX-License-Identifier: Apache-2.0
// One large JSON text: the bare parse into the flat document, and the whole validation.
//
//   bench_json FILE.gltf [--benchmark_... options]
#include <gltfx/pipeline.hpp>

#include <cstdio>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "json/parse.hpp"
#include "read_all.hpp"

namespace {

gltfx::SharedText load(const char* path) {
  std::vector<char> bytes;
  const std::size_t size = gltfx::bench::read_file(path, bytes);
  return gltfx::share_text(std::string(bytes.data(), size));
}

void parse_only(benchmark::State& state, const gltfx::SharedText& text) {
  std::size_t nodes = 0;
  for (auto _ : state) {
    const gltfx::json::Parsed parsed = gltfx::json::parse(text);
    nodes = parsed.document.node_count();
    benchmark::DoNotOptimize(nodes);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text->size()));
  state.counters["nodes"] = static_cast<double>(nodes);
}

void validate(benchmark::State& state, const std::string& path, std::size_t size) {
  std::size_t findings = 0;
  for (auto _ : state) findings = gltfx::validate_file(path).diagnostics.size();
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
  state.counters["findings"] = static_cast<double>(findings);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fputs("usage: bench_json FILE.gltf\n", stderr);
    return 2;
  }
  const std::string path = argv[1];
  const auto text = load(argv[1]);
  benchmark::RegisterBenchmark("parse", [&](benchmark::State& s) { parse_only(s, text); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  benchmark::RegisterBenchmark("validate",
                               [&](benchmark::State& s) { validate(s, path, text->size()); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
