// SPDX-License-Identifier: Apache-2.0
// Limits that the user sets for an asset. No findings without limits.
#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_slots.hpp"
#include "rules/phases.hpp"

namespace gltfx::validate {
namespace {

class BudgetCheck {
 public:
  BudgetCheck(const Context& context, const model::ResourceData& resources, Sink& sink)
      : context_(context), resources_(resources), sink_(sink) {}

  void check_images() const {
    const Budgets& budgets = context_.options.budgets;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < resources_.images.size(); ++i) {
      const auto& header = resources_.images[i].header;
      if (!header) continue;
      total = saturating_add(total, std::uint64_t{header->width} * header->height);
      if (within(std::max(header->width, header->height), budgets.texture_size)) continue;
      const auto index = static_cast<std::uint32_t>(i);
      report_element(sink_, context_, model::RootArray::images, i, Code::BUDGET_TEXTURE_SIZE,
                     fmt::format("The size of {} is {}x{}; the budget is {} per side.",
                                 image_label(context_, index), header->width, header->height,
                                 budgets.texture_size));
    }
    check_sum("images", total, budgets.total_pixels, Code::BUDGET_TOTAL_PIXELS, "pixels");
  }

  // A sum over a root array.
  void check_sum(std::string_view array, std::uint64_t sum, std::uint64_t limit, Code code,
                 std::string_view what) const {
    if (within(sum, limit)) return;
    const json::Document& document = context_.document;
    const Path root;
    sink_.report(
        Path(root, array),
        finding_on(context_, document.find(document.root(), array), code,
                   fmt::format("The asset has {} {}; the budget is {}.", sum, what, limit)));
  }

  void check_files(const std::vector<ResourceInfo>& listed) const {
    const std::uint64_t limit = context_.options.budgets.file_size;
    std::uint64_t bytes = context_.container.bytes.size();
    std::set<std::string_view> seen;
    for (const ResourceInfo& resource : listed) {
      if (resource.storage != "external" || !seen.insert(resource.uri).second) continue;
      bytes = saturating_add(bytes, size_of(resource.pointer));
    }
    if (within(bytes, limit)) return;
    const Path root;
    sink_.report(root,
                 finding_on(context_, context_.document.root(), Code::BUDGET_FILE_SIZE,
                            fmt::format("The asset takes {} bytes in {} file{}; the budget "
                                        "is {}.",
                                        bytes, seen.size() + 1, seen.empty() ? "" : "s", limit)));
  }

 private:
  static bool within(std::uint64_t value, std::uint64_t limit) {
    return limit == 0 || value <= limit;
  }

  // Number of bytes that were read for "/images/3" or "/buffers/0".
  std::uint64_t size_of(std::string_view pointer) const {
    const std::string_view digits = pointer.substr(pointer.rfind('/') + 1);
    std::size_t index = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const bool image = pointer.starts_with("/images/");
    const auto& bytes = image ? resources_.images[index].bytes : resources_.buffers[index];
    return bytes ? bytes->size() : 0;
  }

  const Context& context_;
  const model::ResourceData& resources_;
  Sink& sink_;
};

}  // namespace

void check_budgets(const Context& context, const model::ResourceData& resources,
                   const AssetInfo& info, const std::vector<ResourceInfo>& listed, Sink& sink) {
  const Budgets& budgets = context.options.budgets;
  const BudgetCheck check(context, resources, sink);
  check.check_images();
  check.check_sum("meshes", info.total_triangle_count, budgets.triangles, Code::BUDGET_TRIANGLES,
                  "triangles");
  check.check_sum("meshes", info.draw_call_count, budgets.draw_calls, Code::BUDGET_DRAW_CALLS,
                  "primitives");
  check.check_files(listed);
}

}  // namespace gltfx::validate
