// SPDX-License-Identifier: Apache-2.0
#include "help_text.hpp"

#include <iterator>

#include <fmt/format.h>

#include "exit_code.hpp"

namespace gltfx::tool {
namespace {

constexpr std::string_view kProgramExamples = R"(Examples:
  gltfx validate model.glb           is this asset valid, and if not, where and why
  gltfx validate assets/ --jobs 4    every .gltf and .glb below a folder
  gltfx upgrade assets/ --in-place   bring legacy extensions to their successors
  gltfx bake model.glb -o model.png  what it looks like
  gltfx report assets/ -o r.html     findings, pictures and sizes as one page
  gltfx inspect model.glb            what is in it, and where the bytes go
  gltfx explain VALUE_NOT_IN_RANGE   why a rule exists and how to satisfy it
  gltfx schema KHR_materials_volume  what is known of an extension
  gltfx VERB --help                  all options of a verb
)";

constexpr std::string_view kValidateExamples = R"(Examples:
  gltfx validate model.gltf
  gltfx validate assets/ 'props/**/*.glb' --fail-on warning
  gltfx validate assets/ --format text --format json=report.json
  cat model.glb | gltfx validate - --format json
  gltfx validate assets/ --write-baseline known.json   once, then:
  gltfx validate assets/ --baseline known.json         fails on what is new
  gltfx validate model.gltf --schema ACME_leaf.schema.json
  gltfx validate library/ --cache .gltfx-cache         only what changed since the last run
)";

constexpr std::string_view kUpgradeExamples = R"(Examples:
  gltfx upgrade model.gltf                  what would be done, and why; nothing is written
  gltfx upgrade model.gltf --diff           the same as a diff
  gltfx upgrade assets/ --in-place          only what keeps the picture the same
  gltfx upgrade model.glb -o new.glb --pack --prune   with no more images than before
  gltfx upgrade assets/ --check             for CI: 1 when there is something to do
  gltfx upgrade assets/ -o current/         the same tree there, with what the assets refer to
  gltfx upgrade old.glb -o new.glb --unsafe --generation v2
  gltfx upgrade wax.gltf --only KHR_materials_sss --in-place   a draft: on request
  gltfx upgrade wax.gltf --to KHR_materials_scatter --in-place
)";

constexpr std::string_view kBakeExamples = R"(Examples:
  gltfx bake model.glb -o model.png
  gltfx bake assets/ -o thumbnails/ --size 256      one each, and a contact sheet
  gltfx bake model.glb -o model.webp --transparent --camera 30,20
  gltfx bake model.glb -o turn.png --turntable 24
  gltfx bake model.glb -o still.exr --samples 1024 --denoise off --environment sky.hdr
  gltfx bake old.glb --compare new.glb -o difference.png
  gltfx bake model.glb --embed                      writes asset.thumbnail into the file
)";

constexpr std::string_view kReportExamples = R"(Examples:
  gltfx report assets/ -o report.html                   everything on one page, with pictures
  gltfx report model.glb -o model.html --profile strict
  gltfx report assets/ -o report.html --no-thumbnails --fail-on never
)";

constexpr std::string_view kInspectExamples = R"(Examples:
  gltfx inspect model.glb               counts, sizes, extensions, images, animations
  gltfx inspect model.glb --top 0       every row of every table
  gltfx inspect assets/ --format json | jq -r '.assets[] | [.path, .facts.bytes.total] | @tsv'
)";

constexpr std::string_view kHookExamples =
    R"(Assets are those that are staged, and those in the index that refer to a staged texture or buffer,
also one that is gone. Fails while a file that they refer to is not staged.

Examples:
  gltfx hook upgrade --check             in .git/hooks/pre-commit
  gltfx hook upgrade --in-place          names what is to be staged then
  gltfx hook validate --fail-on warning
)";

constexpr std::string_view kMergeExamples = R"(Examples:
  gltfx merge 1.jsonl 2.jsonl --format sarif=report.sarif      of what these wrote:
  gltfx validate library/ --shard 1/2 --format jsonl=1.jsonl   each part anywhere, also twice
  gltfx validate library/ --shard 2/2 --format jsonl=2.jsonl
)";

constexpr std::string_view kExplainExamples = R"(Examples:
  gltfx explain UNDEFINED_PROPERTY
  gltfx explain value_not_in_range
)";

constexpr std::string_view kRulesExamples = R"(Examples:
  gltfx rules
  gltfx rules --format json | jq -r '.rules[] | select(.severity == "error").code'
)";

constexpr std::string_view kSchemaExamples = R"(Examples:
  gltfx schema                          every extension: status and where it may sit
  gltfx schema KHR_materials_ior        properties, ranges, defaults, exclusions
  gltfx schema material --format json   a core type, for programs
)";

constexpr std::string_view kConfigExamples = R"(Examples:
  gltfx config                          what holds everywhere, and which line says so
  gltfx config props/lamp.glb           what holds for one path
  gltfx config import khronos.yaml >gltfx.toml
)";

}  // namespace

std::string_view help_examples(std::string_view verb) {
  if (verb == "validate") return kValidateExamples;
  if (verb == "upgrade") return kUpgradeExamples;
  if (verb == "bake") return kBakeExamples;
  if (verb == "report") return kReportExamples;
  if (verb == "inspect") return kInspectExamples;
  if (verb == "hook") return kHookExamples;
  if (verb == "merge") return kMergeExamples;
  if (verb == "explain") return kExplainExamples;
  if (verb == "rules") return kRulesExamples;
  if (verb == "schema") return kSchemaExamples;
  if (verb == "config") return kConfigExamples;
  return kProgramExamples;
}

std::string help_footer(std::string_view verb) {
  std::string footer = fmt::format("{}\nExit codes (4 before 2 before 3 before 1):\n{}",
                                   help_examples(verb), exit_code_table());
  footer.pop_back();  // CLI11 ends the help with a line break of its own
  return footer;
}

std::string exit_code_table() {
  std::string table;
  for (const ExitCodeEntry& entry : kExitCodes) {
    fmt::format_to(std::back_inserter(table), "  {}  {}\n", static_cast<int>(entry.code),
                   entry.meaning);
  }
  return table;
}

}  // namespace gltfx::tool
