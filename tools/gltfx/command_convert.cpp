// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "convert_print.hpp"
#include "edit_run.hpp"
#include "output_places.hpp"

namespace gltfx::tool {
namespace {

// The name of a converted asset in a folder.
std::string stored_name(const std::string& place, StoredAs to) {
  const bool fits = to == StoredAs::glb ? has_glb_ending(place) : ending_of(place) == ".gltf";
  if (fits) return place;
  return std::filesystem::path(place)
      .replace_extension(to == StoredAs::glb ? ".glb" : ".gltf")
      .native();
}

struct ConvertVerb : EditVerb {
  using Request = ConvertRequest;
  using Options = ConvertOptions;
  using Report = ConvertReport;
  using Summary = ConvertSummary;
  static constexpr auto run = convert_files;
  static constexpr auto text = convert_text;
  static constexpr auto summary_text = convert_summary_text;
  static constexpr auto json = convert_json;
  static constexpr auto json_end = convert_json_end;

  static ConvertOptions options_of(const ConvertRequest& request) { return request.convert; }

  static Result<std::vector<EditInput>> place(Inputs named, ConvertOptions& options) {
    options.shared_folder = named.several;
    if (options.to) {
      for (auto* places : {&named.places, &named.places_of_others}) {
        for (std::string& name : *places) name = stored_name(name, *options.to);
      }
    }
    return place_outputs(named, options.output, Ending::may_change);
  }

  static void note_beside_diff(const ConvertReport& report) {
    for (const std::string& file : report.new_files) {
      complain(fmt::format("note: {}: the diff lacks the new file {}, which it refers to",
                           printable(report.path), printable(file)));
    }
  }

  static bool is_finding(const ConvertReport& report, const ConvertRequest& request,
                         bool /*writing*/) {
    return (request.check && report.changes) || report.refused() > 0;
  }
};

}  // namespace

ExitCode run(const ConvertRequest& request) { return run_edit<ConvertVerb>(request); }

}  // namespace gltfx::tool
