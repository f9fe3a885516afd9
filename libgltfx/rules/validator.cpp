// SPDX-License-Identifier: Apache-2.0
#include "rules/validator.hpp"

#include <optional>
#include <utility>

#include "base/codes.hpp"
#include "base/fork.hpp"
#include "base/parallel.hpp"
#include "base/work_count.hpp"
#include "measure/source.hpp"
#include "model/info.hpp"
#include "rules/collector.hpp"
#include "rules/context.hpp"
#include "rules/extensions/interactivity_draft.hpp"
#include "rules/external_assets.hpp"
#include "rules/own/own_measures.hpp"
#include "rules/own/own_rules.hpp"
#include "rules/payload/phases.hpp"
#include "rules/phases.hpp"
#include "rules/rules_of_types.hpp"
#include "rules/shared_reports.hpp"
#include "schema/compile.hpp"

namespace gltfx::validate {
namespace {

// Object rules by type, so that the walk looks them up once per object.
using ObjectRules = RulesByName<std::vector<ObjectRuleEntry>>;

ObjectRules make_object_rules(bool reading_order) {
  const Runs never = reading_order ? Runs::otherwise : Runs::in_reading_order;
  ObjectRules rules;
  for (const RuleGroup& group : rule_groups()) {
    for (const ObjectRuleEntry& entry : group.object_rules) {
      const bool on_the_way = reading_order && !entry.behind.empty();
      if (entry.runs != never && !on_the_way) rules.to(entry.type).push_back(entry);
    }
  }
  return rules;
}

// The rules that run after all members of an object.
const ObjectRules& object_rules(bool reading_order) {
  static constinit MadeOnce<ObjectRules> tables[2];
  return tables[reading_order ? 1 : 0].get([=] { return make_object_rules(reading_order); });
}

// Bytes of JSON above which a second thread pays off.
constexpr std::size_t kLargeText = std::size_t{1} << 20U;

unsigned jobs_for(const Context& context) {
  return context.document.text().size() < kLargeText ? 1 : context.options.jobs;
}

// The bytes of an asset, and what rules about them share.
struct CheckedBytes {
  Resources resources;
  std::optional<const measure::Source> source;
  std::optional<DataPhase> phase;
  std::optional<Measurements> measured;  // for own rules
  std::vector<Shortfall>* shortfalls = nullptr;
};

// Phases 5 to 7: bytes of buffers and images, and checks that depend on them. The Khronos validator
// does not run them for a GLB that ends too early or an asset with an unknown version.
void check_bytes(const Context& context, Sink& sink, FileReport& report, CheckedBytes& checked) {
  const container::Container& container = context.container;
  const bool is_short = container.cut_short || container.ends_in_empty_chunk;
  if (context.deviations.data_of_short_files_is_skipped && is_short) return;
  Resources& resources = checked.resources;
  resources = load_resources(context, sink, report);
  decode_views(context, resources.data, sink);
  const measure::Source& source = checked.source.emplace(
      measure::Opened{report.path, container, context.files, context.asset, context.views,
                      resources.data, context.schemas, context.options.jobs});
  DataPhase& phase =
      checked.phase.emplace(DataPhase{context, resources.data, source, sink, report});
  for (const DataRule& rule : data_rules()) {
    if (!rule.additional || !context.deviations.no_additional_rules) rule.check(phase);
  }
  report.info = model::asset_info(context.asset, context.views);
  report.info->resources = std::move(resources.listed);
}

// What engines and users require beside the specification.
void check_requirements(const Context& context, Sink& sink, FileReport& report,
                        CheckedBytes& checked) {
  if (!checked.source) return;
  check_targets(context, checked.resources.data, sink, checked.shortfalls);
  check_limits(context, *checked.source, report, sink);
  checked.measured = take_own_measures(context, *checked.source);
}

bool wants_shown_rules(const ValidateOptions& options) {
  if (options.select.empty() && options.ignore.empty()) return true;
  const auto all = rules();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].group == "shows" && is_enabled(options, static_cast<Code>(i))) return true;
  }
  return false;
}

// What an asset shows is only worth a word where nothing is wrong with it.
void check_what_is_shown(const Context& context, const Collector& collector,
                         CheckedBytes& checked) {
  if (!checked.phase || context.deviations.no_additional_rules || collector.has_errors()) return;
  if (!wants_shown_rules(context.options)) return;
  for (const DataRule& rule : shown_rules()) rule.check(*checked.phase);
}

// Phase 3: the schema walk with the object rules. `own` is the document of a profile that hides
// broken members.
schema::CheckResult check_objects(Context& context, json::Document& own) {
  const ObjectRules& rules = object_rules(context.deviations.reading_order);
  TypeCache<const std::vector<ObjectRuleEntry>*> known;
  const auto rules_of = [&](const schema::ObjectType& type) { return &rules.of(type.name); };
  const auto visit = [&](const schema::ObjectType& type, json::NodeId object, const Path& path) {
    for (const ObjectRuleEntry& entry : *known.of(type, rules_of)) {
      entry.rule(context, object, path);
    }
  };
  if (context.order != nullptr) return check_as_khronos(context, own, *context.order, visit);
  return schema::check(context.document, context.schemas, {}, context.schema_sink,
                       context.link_sink, visit);
}

// Phase 4.
void check_links(const Context& context) {
  for (const RuleGroup& group : rule_groups()) {
    if (group.additional && context.deviations.no_additional_rules) continue;
    for (const LinkRule rule : group.link_rules) rule(context);
  }
}

// Phases 3 to 7. Each phase reports to a separate sink, so that two of them can run at once: shared
// data is only read, unless phase 3 hides broken members of the document. Returns whether all of
// them could run.
bool check_document(Context& context, json::Document& own, Collector& collector, FileReport& report,
                    CheckedBytes& bytes) {
  const unsigned jobs = jobs_for(context);
  schema::CheckResult checked;
  model::Views views;
  model::SceneGraph graph;
  run_both(
      context.deviations.broken_values_are_absent ? 1 : jobs,
      [&] { checked = check_objects(context, own); },
      [&] {
        views = model::Views(context.asset);
        graph = model::SceneGraph(context.asset, views.nodes);
      });
  if (checked.stopped_at_asset || !context.document.is_object(context.document.root())) {
    return false;
  }
  context.checked = std::move(checked);
  context.views = std::move(views);
  context.graph = std::move(graph);
  run_both(
      jobs, [&] { check_links(context); },
      [&] { check_bytes(context, collector.sink(Phase::resources), report, bytes); });
  check_what_is_shown(context, collector, bytes);
  check_requirements(context, collector.sink(Phase::resources), report, bytes);
  check_truncated(context, bytes.resources.data, collector.sink(Phase::resources));
  check_encodings(context, collector);
  return true;
}

/// What a validation has and gives beside its options and its report.
struct Extras {
  Sites* sites = nullptr;
  std::vector<Shortfall>* shortfalls = nullptr;
  std::optional<model::Views>* views = nullptr;
  SharedReports* shared = nullptr;
  const ExternalLinks* links = nullptr;  ///< of an external asset; null: they are not known yet
};

FileReport check_asset(const model::OpenedAsset& opened, const ValidateOptions& options,
                       const Extras& extras);

// The options for an external asset: it is checked as the asset that the user named.
ValidateOptions options_of_external(const ValidateOptions& options, const std::string& path) {
  ValidateOptions own = options;
  own.changed_lines = options.changed_lines_of ? options.changed_lines_of(path) : std::nullopt;
  return own;
}

void check_external_assets(const Context& context, const model::OpenedAsset& opened,
                           const Extras& extras, Sink& sink, FileReport& report) {
  if (context.version <= schema::kVersion2) return;
  if (extras.links != nullptr) return report_external_assets(context, *extras.links, sink);
  if (!context.document.holds(context.document.root(), "externalAssets")) return;
  ExternalTree tree(opened, [&](const model::AssetInTree& asset, const ExternalLinks& links) {
    const model::OpenedAsset& child = asset.asset();
    const ValidateOptions options = options_of_external(context.options, child.name());
    const auto check = [&] { return check_asset(child, options, {.links = &links}); };
    return extras.shared == nullptr ? check()
                                    : extras.shared->get(options, {opened, asset, links}, check);
  });
  report_external_assets(context, tree.links(), sink);
  report.external_assets = tree.take_reports();
}

FileReport check_asset(const model::OpenedAsset& opened, const ValidateOptions& options,
                       const Extras& extras) {
  ++work_count.validated;
  const Deviations& deviations = deviations_of(options.profile);
  const bool literal = deviations.mistakes_of_glbs_are_not_named;
  const container::Container container =
      literal ? container::literal_reading(opened.container()) : opened.container();
  const bool hides = deviations.broken_values_are_absent;
  FileReport report;
  report.path = opened.name();
  Collector collector(options);
  const bool has_text = check_container(container, opened.name(), report, collector);
  // Members that are hidden here are visible to other users of the document.
  json::Document own;
  if (has_text && hides) own = opened.document();
  const json::Document& document = has_text && !hides ? opened.document() : own;
  const bool readable = has_text && check_text(container.json, opened.parsed(), options, collector);
  if (readable) {
    const auto set = options.schemas ? options.schemas : schema::builtin_set();
    Sink& forms = collector.sink(Phase::schema);
    Sink& links = collector.sink(Phase::reference);
    const bool additions = !deviations.no_additional_rules;
    const model::Asset asset(document, !additions);  // an additional rule limits the objects
    const bool earlier = additions && !earlier_interactivity(document).empty();
    OutsideInteractivity outside_forms(forms);
    OutsideInteractivity outside_links(links);
    Sink& reported_links = earlier ? static_cast<Sink&>(outside_links) : links;
    std::optional<LinkOrder> order;
    if (deviations.reading_order) order.emplace(links);
    container::OpenedFiles files(opened.resolver());
    Context context{container,
                    files,
                    document,
                    *set,
                    asset,
                    options,
                    {},
                    earlier ? static_cast<Sink&>(outside_forms) : forms,
                    order ? static_cast<Sink&>(*order) : reported_links};
    if (order) context.order = &*order;
    collector.judge_by(context.version);
    DataUris data_uris(context.uri_reading());
    context.data_uris = &data_uris;
    context.opened = &opened;
    Suppressions suppressions;
    if (options.inline_suppressions && additions) {
      suppressions = Suppressions(document, options.own_rules.get());
    }
    if (!suppressions.empty()) collector.suppress(&suppressions);
    BrokenPlaces broken;
    if (options.own_rules && additions) collector.note_broken(&broken);
    CheckedBytes bytes;
    bytes.shortfalls = extras.shortfalls;
    if (check_identity(context, collector) &&
        check_document(context, own, collector, report, bytes)) {
      check_external_assets(context, opened, extras, collector.sink(Phase::resources), report);
      if (options.own_rules && additions) {
        broken.finish();
        check_own_rules(context, broken, report.path, bytes.measured ? &*bytes.measured : nullptr,
                        collector);
      }
      suppressions.report(options, links);
      if (!hides && extras.views != nullptr) extras.views->emplace(std::move(context.views));
    }
    report.left_out = suppressions.total();
  }
  report.mime_type = mime_type(container, readable && document.is_object(document.root()));
  if (extras.sites != nullptr) *extras.sites = collector.take_sites();
  collector.finish(report, document, container.json_offset);
  return report;
}

}  // namespace

FileReport validate(model::OpenedAsset& opened, const ValidateOptions& options, Sites* sites,
                    std::vector<Shortfall>* shortfalls, SharedReports* shared) {
  std::optional<model::Views> views;
  FileReport report =
      check_asset(opened, options,
                  {.sites = sites, .shortfalls = shortfalls, .views = &views, .shared = shared});
  if (views) opened.keep_views(*std::move(views));
  return report;
}

FileReport unreadable(const std::string& name, const std::string& reason,
                      const ValidateOptions& options) {
  FileReport report;
  report.path = name;
  report.readable = false;
  Collector collector(options);
  Finding finding(Code::IO_ERROR);
  finding.message = reason;
  collector.report_file(Phase::container, std::move(finding));
  collector.finish(report, json::Document(), 0);
  return report;
}

}  // namespace gltfx::validate
