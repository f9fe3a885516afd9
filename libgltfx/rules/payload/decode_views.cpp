// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/meshopt_view.hpp"
#include "rules/finding.hpp"
#include "rules/phases.hpp"

namespace gltfx::validate {
namespace {

namespace meshopt = model::meshopt;
using meshopt::DecodeError;

using Job = model::DecodedStream;

std::string_view mode_text(meshopt::Mode mode) {
  constexpr std::string_view kTexts[] = {"attributes", "triangles", "indices"};
  return kTexts[static_cast<std::size_t>(mode)];
}

Code code_of(DecodeError error) {
  switch (error) {
    case DecodeError::header:
    case DecodeError::version:
      return Code::MESHOPT_INVALID_HEADER;
    case DecodeError::trailing:
      return Code::MESHOPT_TRAILING_BYTES;
    default:
      return Code::MESHOPT_DECODE_FAILED;
  }
}

std::string sentence(const Job& job, DecodeError error) {
  const meshopt::Layout& layout = job.view.layout;
  switch (error) {
    case DecodeError::header:
      return fmt::format("The header of the compressed data is {:#04x}, which is invalid for {}.",
                         std::to_integer<unsigned>(job.stream.view().front()),
                         mode_text(layout.mode));
    case DecodeError::version:
      return fmt::format(
          "The header of the compressed data is {:#04x}; {} does not support that version of {}.",
          std::to_integer<unsigned>(job.stream.view().front()), job.view.extension,
          mode_text(layout.mode));
    case DecodeError::too_short:
      return fmt::format(
          "The compressed data has {} bytes, which is too short for count {} and byteStride {}.",
          job.stream.size(), layout.count, layout.stride);
    case DecodeError::channel:
      return "The compressed data has an invalid channel mode.";
    case DecodeError::table:
      return "The table in the last 16 bytes of the compressed data is invalid.";
    case DecodeError::unwritten:
      return "A compressed triangle refers to an edge or vertex before the first one.";
    case DecodeError::number:
      return "A compressed number has more than five bytes.";
    case DecodeError::trailing:
      return "The compressed data has extra bytes after its last element.";
    default:
      return fmt::format("The compressed data ends before its last element; count is {}.",
                         layout.count);
  }
}

class Reporting {
 public:
  Reporting(const Context& context, model::ResourceData& resources, Sink& sink)
      : context_(context), resources_(resources), sink_(sink) {}

  void run() {
    for (Job& job :
         model::decode_streams(context_.asset, context_.views, resources_, context_.options.jobs)) {
      finish(job);
    }
  }

 private:
  void report(const Job& job, Code code, std::string message) const {
    const Path root;
    const Path views(root, "bufferViews");
    const Path view(views, std::uint64_t{job.index});
    const Path extensions(view, "extensions");
    sink_.report(Path(extensions, job.view.extension),
                 finding_on(context_, job.view.object, code, std::move(message)));
  }

  void finish(Job& job) {
    const meshopt::Layout& layout = job.view.layout;
    if (job.error != DecodeError::none)
      return report(job, code_of(job.error), sentence(job, job.error));
    if (!job.affordable) {
      return report(job, Code::MESHOPT_NOT_DECODED,
                    fmt::format("{} bytes of compressed data have {} elements of {} bytes, which "
                                "exceeds the limit; the data is not checked.",
                                job.stream.size(), layout.count, layout.stride));
    }
    if (job.misfits.count != 0) {
      return report(
          job, Code::MESHOPT_FILTER_INPUT_INVALID,
          fmt::format("{} of {} elements are invalid input for the filter, starting at element {}.",
                      job.misfits.count, layout.count, job.misfits.first));
    }
    if (job.differs) {
      report(job, Code::MESHOPT_FALLBACK_DIFFERS,
             "The fallback data differs from the decoded data.");
    }
    if (job.plain) return;
    const bool rounded = layout.filter != meshopt::Filter::none;
    resources_.decoded_views.emplace(context_.views.buffer_views[job.index].node,
                                     model::DecodedView{std::move(job.elements), rounded});
  }

  const Context& context_;
  model::ResourceData& resources_;
  Sink& sink_;
};

}  // namespace

void decode_views(const Context& context, model::ResourceData& resources, Sink& sink) {
  const bool meaningless = context.deviations.unsupported_extensions_are_skipped;
  if (!meaningless) Reporting(context, resources, sink).run();
}

}  // namespace gltfx::validate
