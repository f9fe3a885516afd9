// SPDX-License-Identifier: Apache-2.0
/// allocation_errors PROGRAM INJECTOR FIXTURES FOLDER STRIDE [NAME]
///
/// Runs validate, upgrade and bake over small assets and lets each STRIDE-th allocation fail, one
/// in each run. A run either says that there is not enough memory and ends with the code of a
/// failure, or it ends as if nothing had happened; files are all there or none is. NAME limits it
/// to the cases whose name holds it. FOLDER is for output.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "program/process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::vector<std::string> words;  ///< arguments of the program; "{out}" is a separate folder
};

std::vector<Case> cases(const fs::path& fixtures) {
  std::vector<Case> all;
  const auto add = [&](const std::string& verb, const std::string& asset,
                       const std::vector<std::string>& more) {
    std::vector<std::string> words{verb, (fixtures / asset).native(), "--jobs", "1"};
    words.insert(words.end(), more.begin(), more.end());
    all.push_back({verb + " " + asset, words});
  };
  for (const char* asset :
       {"good/beacon.gltf", "good/bowl.glb", "good/chair.gltf", "good/coral.glb", "good/flag.gltf",
        "good/kelp.gltf", "good/lamp.gltf", "good/leaf.gltf", "good/reed.gltf", "good/stone.gltf",
        "bad/kelp-bounds.gltf", "bad/leaf-wrong-members.gltf", "tour/lamp.gltf"}) {
    add("validate", asset, {"--profile", "strict"});
  }
  all.push_back({"validate folder",
                 {"validate", (fixtures / "tour").native(), "--format", "json", "--jobs", "2"}});
  for (const char* asset :
       {"legacy/awning.gltf", "legacy/curtain.gltf", "legacy/lantern.glb", "legacy/poster.gltf"}) {
    add("upgrade", asset, {"-o", "{out}/" + fs::path(asset).filename().native(), "--unsafe"});
  }
  for (const char* asset : {"good/triangle.gltf", "good/leaf.gltf", "good/bowl.glb"}) {
    add("bake", asset, {"-o", "{out}/a.png", "--size", "8", "--samples", "1"});
  }
  return all;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[entry.path().native()] = text_of(entry.path());
  }
  return files;
}

/// One run with one failure.
struct Run {
  Outcome outcome;
  std::map<std::string, std::string> files;
  bool failed = false;   ///< an allocation did
  long allocations = 0;  ///< from main() on
};

class Runner {
 public:
  Runner(std::string program, std::string injector, fs::path folder)
      : program_(std::move(program)), injector_(std::move(injector)), folder_(std::move(folder)) {}

  Run run(const Case& subject, long fail_at) const {
    const fs::path out = folder_ / "out";
    const fs::path log = folder_ / "log";
    fs::remove_all(folder_);
    fs::create_directories(out);
    std::vector<std::string> words{"timeout",
                                   "600",  // a hang; no run takes a hundredth of that
                                   "env",
                                   "LD_PRELOAD=" + injector_,
                                   "GLTFX_FAIL_AT=" + std::to_string(fail_at),
                                   "GLTFX_FAIL_LOG=" + log.native(),
                                   program_};
    for (std::string word : subject.words) {
      if (word.starts_with("{out}")) word.replace(0, 5, out.native());
      words.push_back(std::move(word));
    }
    Run run;
    run.outcome = program::run(words, {});
    run.files = files_in(out);
    const std::string said = text_of(log);
    run.failed = said.starts_with("failed ");
    run.allocations = std::atol(said.c_str() + (run.failed ? 7 : 0));
    return run;
  }

 private:
  std::string program_, injector_;
  fs::path folder_;
};

/// The failure of a run; empty when there is none.
std::string error_of(const Run& run, const Run& sound) {
  const int code = run.outcome.code;
  if (code == 124) return "took too long";
  if (code > 124) return "ended by signal or abort, code " + std::to_string(code);
  const bool same = code == sound.outcome.code && run.outcome.out == sound.outcome.out;
  if (!run.failed && !same) return "is not always the same";
  if (same && run.files == sound.files) return {};
  for (const auto& [name, bytes] : run.files) {
    const auto whole = sound.files.find(name);
    if (whole == sound.files.end() || whole->second != bytes) return "left " + name;
  }
  const std::string said = run.outcome.out + run.outcome.err;
  if (said.find("not enough memory") == std::string::npos) return "does not say why it failed";
  // 1: a file that the asset refers to could not be read, which is a finding.
  if (code != 1 && code != 3 && code != 4) return "ended with code " + std::to_string(code);
  return {};
}

class Campaign {
 public:
  Campaign(const Runner& runner, long stride) : runner_(runner), stride_(stride) {}

  /// Number of runs that went wrong.
  long run(const Case& subject) {
    const Run sound = runner_.run(subject, 0);
    long errors = 0, runs = 0;
    for (long at = 1; at <= sound.allocations; at += stride_, ++runs) {
      const Run run = runner_.run(subject, at);
      const std::string error = error_of(run, sound);
      if (error.empty()) continue;
      if (++errors <= kMostPrinted) print(subject, at, error, run);
    }
    std::printf("%-36s %7ld allocations %7ld runs %5ld faults\n", subject.name.c_str(),
                sound.allocations, runs, errors);
    std::fflush(stdout);
    return errors;
  }

 private:
  static constexpr long kMostPrinted = 5;

  static void print(const Case& subject, long at, const std::string& error, const Run& run) {
    const std::string said = run.outcome.err + run.outcome.out;
    std::printf("%s, allocation %ld: %s\n  %.300s\n", subject.name.c_str(), at, error.c_str(),
                said.c_str());
  }

  const Runner& runner_;
  long stride_;
};

}  // namespace
}  // namespace gltfx::program

int main(int argc, char** argv) {
  using namespace gltfx::program;
  if (argc < 6) return 2;
  const long stride = std::max(1L, std::atol(argv[5]));
  const std::string wanted = argc > 6 ? argv[6] : "";
  const std::vector<Case> all = cases(argv[3]);
  std::atomic<std::size_t> next{0};
  std::atomic<long> errors{0};
  const auto work = [&](unsigned worker) {
    const Runner runner(argv[1], argv[2], std::filesystem::path(argv[4]) / std::to_string(worker));
    for (std::size_t i = next++; i < all.size(); i = next++) {
      if (all[i].name.find(wanted) != std::string::npos) {
        errors += Campaign(runner, stride).run(all[i]);
      }
    }
  };
  std::vector<std::thread> workers;
  const unsigned count = std::max(1U, std::thread::hardware_concurrency());
  for (unsigned i = 0; i < count; ++i) workers.emplace_back(work, i);
  for (std::thread& worker : workers) worker.join();
  std::printf("%ld faults\n", errors.load());
  return errors == 0 ? 0 : 1;
}
