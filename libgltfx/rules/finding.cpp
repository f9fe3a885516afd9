// SPDX-License-Identifier: Apache-2.0
#include "rules/finding.hpp"

#include <charconv>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"

namespace gltfx::validate {
namespace {

// "meshes": "mesh".
std::string_view singular(std::string_view array) {
  return array.substr(0, array.size() - (array == "meshes" ? 2 : 1));
}

std::optional<std::size_t> index_from(std::string_view text) {
  std::size_t index = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, index);
  return read.ec == std::errc() && read.ptr == end ? std::optional(index) : std::nullopt;
}

}  // namespace

std::string object_label(const Context& context, model::RootArray array, std::size_t index) {
  const std::string name = context.asset.name(context.asset.elements(array)[index]);
  std::string label = fmt::format("{} {}", singular(model::root_array_name(array)), index);
  return name.empty() ? label : fmt::format("{} ({})", label, gltfx::quoted(name));
}

std::string member_label(const Context& context, std::string_view pointer) {
  const auto names = split_pointer(pointer);
  if (!names || names->size() < 3) return printable(pointer);
  const auto index = index_from((*names)[1]);
  for (std::size_t i = 0; index && i < model::kRootArrayCount; ++i) {
    const auto array = static_cast<model::RootArray>(i);
    if (model::root_array_name(array) != names->front()) continue;
    if (*index >= context.asset.count(array)) break;
    return fmt::format("{} of {}", printable(names->back()), object_label(context, array, *index));
  }
  return printable(pointer);
}

Finding finding_on(const Context& context, json::NodeId value, Code code, std::string message,
                   std::string help) {
  const json::Document& document = context.document;
  Finding finding(code);
  finding.message = std::move(message);
  finding.help = std::move(help);
  if (value != json::kNoNode) {
    const bool compound = document.is_object(value) || document.is_array(value);
    finding.span = compound ? first_character(document, value) : document.span(value);
  }
  return finding;
}

void report_member(Sink& sink, const Context& context, const Path& path, json::NodeId object,
                   std::string_view member, Code code, std::string message, std::string help,
                   std::optional<Severity> severity) {
  const json::NodeId value = context.document.find(object, member);
  Finding finding = finding_on(context, value != json::kNoNode ? value : object, code,
                               std::move(message), std::move(help));
  finding.severity = severity;
  sink.report(Path(path, member), std::move(finding));
}

void report_link(const Context& context, const Path& path, json::NodeId place, Code code,
                 std::string message, std::string help) {
  context.link_sink.report(path,
                           finding_on(context, place, code, std::move(message), std::move(help)));
}

void report_link(const Context& context, const Path& path, Span span, Code code,
                 std::string message) {
  Finding finding = finding_on(context, json::kNoNode, code, std::move(message));
  finding.span = span;
  context.link_sink.report(path, std::move(finding));
}

void report_element(Sink& sink, const Context& context, model::RootArray array, std::size_t index,
                    Code code, std::string message, std::optional<Severity> severity) {
  const Path root;
  const Path list(root, model::root_array_name(array));
  Finding finding =
      finding_on(context, context.asset.elements(array)[index], code, std::move(message));
  finding.severity = severity;
  sink.report(Path(list, std::uint64_t{index}), std::move(finding));
}

void report_references(const Context& context, json::NodeId value) {
  if (value != json::kNoNode) report_references(context, context.document.span(value));
}

void report_references(const Context& context, Span place) {
  if (context.order != nullptr) context.order->release(place);
}

void report_at(Sink& sink, std::string_view pointer, Finding finding) {
  const auto names = split_pointer(pointer);
  if (!names) return;
  std::vector<Path> steps(1);
  steps.reserve(names->size() + 1);  // a step points to the one before it
  for (const std::string& name : *names) {
    if (const auto index = index_from(name)) {
      steps.emplace_back(steps.back(), std::uint64_t{*index});
    } else {
      steps.emplace_back(steps.back(), std::string_view(name));
    }
  }
  sink.report(steps.back(), std::move(finding));
}

bool check_root_extension(const Context& context, std::string_view extension, json::NodeId object,
                          const Path& path) {
  const json::Document& document = context.document;
  if (model::extension_object(document, document.root(), extension) != json::kNoNode) return true;
  report_link(context, path, object, Code::UNSATISFIED_DEPENDENCY,
              fmt::format("The root object has no {}.", extension));
  return false;
}

}  // namespace gltfx::validate
