// SPDX-License-Identifier: Apache-2.0
#include "validate/data/decode_views.hpp"

#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "model/meshopt_view.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

namespace meshopt = model::meshopt;
using meshopt::Fault;

// What may be decoded of one asset: all of one of a usual size, and what streams of usual data
// hold. A stream of nothing but zeros holds a thousand times its size, and views may share it.
constexpr std::uint64_t kFreeBytes = std::uint64_t{128} << 20U;
constexpr std::uint64_t kBytesPerByte = 8;

// A view on its way.
struct Job {
  std::uint32_t index = 0;  ///< of the buffer view
  model::MeshoptView view;
  container::Bytes stream;
  std::optional<container::Bytes> plain;  ///< the copy for readers without the extension
  bool affordable = false;                ///< within what may be decoded, all views together
  // What decoding gives.
  Fault fault = Fault::none;
  meshopt::Misfits misfits{};
  bool differs = false;
  container::Bytes elements{};
};

std::string_view mode_text(meshopt::Mode mode) {
  constexpr std::string_view kTexts[] = {"attributes", "triangles", "indices"};
  return kTexts[static_cast<std::size_t>(mode)];
}

std::string_view code_of(Fault fault) {
  switch (fault) {
    case Fault::header:
    case Fault::version:
      return "MESHOPT_INVALID_HEADER";
    case Fault::trailing:
      return "MESHOPT_TRAILING_BYTES";
    default:
      return "MESHOPT_DECODE_FAILED";
  }
}

std::string sentence(const Job& job, Fault fault) {
  const meshopt::Layout& layout = job.view.layout;
  switch (fault) {
    case Fault::header:
      return fmt::format("The stream begins with {:#04x}, which no stream of {} does.",
                         std::to_integer<unsigned>(job.stream.view().front()),
                         mode_text(layout.mode));
    case Fault::version:
      return fmt::format("The stream begins with {:#04x}: {} does not have that version of {}.",
                         std::to_integer<unsigned>(job.stream.view().front()), job.view.extension,
                         mode_text(layout.mode));
    case Fault::too_short:
      return fmt::format("{} bytes cannot hold {} elements of {} bytes.", job.stream.size(),
                         layout.count, layout.stride);
    case Fault::channel:
      return "The last bytes of the stream name a way to store differences that there is not.";
    case Fault::table:
      return "The table in the last 16 bytes of the stream is malformed.";
    case Fault::unwritten:
      return "A triangle refers to an edge or a vertex before the first one.";
    case Fault::number:
      return "A number of the stream has more than five bytes.";
    case Fault::trailing:
      return fmt::format("Bytes of the stream are left over behind its {} elements.", layout.count);
    default:
      return fmt::format("The stream ends before all of its {} elements are there.", layout.count);
  }
}

// Only numbers as they were; triangles may begin with another of their corners.
bool is_exact(const meshopt::Layout& layout) {
  return layout.filter == meshopt::Filter::none && layout.mode != meshopt::Mode::triangles;
}

void decode(Job& job) {
  const meshopt::Layout& layout = job.view.layout;
  const auto size = static_cast<std::size_t>(*layout.decoded_size());
  const auto memory = std::make_shared_for_overwrite<std::byte[]>(size);
  const std::span<std::byte> elements(memory.get(), size);
  job.fault = meshopt::decode(job.stream.view(), layout, elements);
  if (job.fault != Fault::none) return;
  job.misfits = meshopt::find_misfits(layout, elements);
  if (job.misfits.count != 0) return;
  meshopt::apply_filter(layout, elements);
  if (!job.plain) {
    job.elements = container::Bytes(elements, memory);
  } else if (is_exact(layout) && job.plain->size() == size) {
    job.differs = std::memcmp(job.plain->view().data(), elements.data(), size) != 0;
  }
}

class Decoding {
 public:
  Decoding(const Context& context, model::ResourceData& resources, Sink& sink)
      : context_(context), resources_(resources), sink_(sink) {}

  void run() {
    collect();
    parallel_ordered(
        jobs_.size(), context_.options.jobs,
        [&](std::size_t i) {
          if (jobs_[i].fault == Fault::none && jobs_[i].affordable) decode(jobs_[i]);
        },
        [&](std::size_t i) { finish(jobs_[i]); });
  }

 private:
  // What memory there may be is settled here, view by view, whatever the number of threads.
  void collect() {
    const auto& views = context_.views.buffer_views;
    std::uint64_t left = kFreeBytes;
    for (const auto& buffer : resources_.buffers) {
      if (buffer) left += buffer->size() * kBytesPerByte;
    }
    for (std::uint32_t i = 0; i < views.size(); ++i) {
      auto view = model::read_meshopt_view(context_.asset, views[i].node);
      if (!view) continue;
      auto stream = model::stream_bytes(*view, resources_);
      if (!stream) continue;
      Job job{i, *view, *std::move(stream), plain_bytes(views[i])};
      job.fault = meshopt::check_size(job.stream.view(), view->layout);
      const auto size = view->layout.decoded_size();
      job.affordable = size && *size <= left;
      if (job.affordable && job.fault == Fault::none) left -= *size;
      jobs_.push_back(std::move(job));
    }
  }

  std::optional<container::Bytes> plain_bytes(const model::BufferView& view) const {
    if (!view.byte_length) return std::nullopt;
    return resources_.part(context_.document, view, 0, *view.byte_length);
  }

  void report(const Job& job, std::string_view code, std::string message) const {
    const Path root;
    const Path views(root, "bufferViews");
    const Path view(views, std::uint64_t{job.index});
    const Path extensions(view, "extensions");
    sink_.report(Path(extensions, job.view.extension),
                 finding_on(context_, job.view.object, code, std::move(message)));
  }

  void finish(Job& job) {
    const meshopt::Layout& layout = job.view.layout;
    if (job.fault != Fault::none) return report(job, code_of(job.fault), sentence(job, job.fault));
    if (!job.affordable) {
      return report(job, "MESHOPT_NOT_DECODED",
                    fmt::format("{} bytes of stream hold {} elements of {} bytes, too many to "
                                "decode; they were not looked at.",
                                job.stream.size(), layout.count, layout.stride));
    }
    if (job.misfits.count != 0) {
      return report(job, "MESHOPT_FILTER_INPUT_INVALID",
                    fmt::format("{} of {} elements are nothing that the filter can take; the "
                                "first is element {}.",
                                job.misfits.count, layout.count, job.misfits.first));
    }
    if (job.differs) {
      report(job, "MESHOPT_FALLBACK_DIFFERS", "The plain copy has other bytes than the stream.");
    }
    if (job.plain) return;
    const bool rounded = layout.filter != meshopt::Filter::none;
    resources_.decoded_views.emplace(context_.views.buffer_views[job.index].node,
                                     model::DecodedView{std::move(job.elements), rounded});
  }

  const Context& context_;
  model::ResourceData& resources_;
  Sink& sink_;
  std::vector<Job> jobs_;
};

}  // namespace

void decode_views(const Context& context, model::ResourceData& resources, Sink& sink) {
  if (!context.khronos()) Decoding(context, resources, sink).run();
}

}  // namespace gltfx::validate
