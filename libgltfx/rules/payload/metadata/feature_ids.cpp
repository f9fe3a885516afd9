// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_features and EXT_instance_features.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/data_texture.hpp"
#include "rules/payload/metadata/instance.hpp"
#include "rules/payload/metadata/values.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kFeatureAttribute = "_FEATURE_ID_";
constexpr std::string_view kMeshFeatures = "EXT_mesh_features";
constexpr std::string_view kInstanceFeatures = "EXT_instance_features";
constexpr std::string_view kInstancing = "EXT_mesh_gpu_instancing";

// Statistics of the ids of a set.
class IdCount {
 public:
  // Counts at most `most` different ids.
  IdCount(std::optional<std::uint64_t> null_id, std::uint64_t most)
      : null_id_(null_id), most_(most) {}

  void add(std::uint32_t id) {
    if (null_id_ && id == *null_id_) return;
    any_ = true;
    greatest_ = std::max(greatest_, id);
    if (id >= kSmall) return add_large(id);
    if (id >= seen_.size()) seen_.resize(std::max<std::size_t>(id + 1, seen_.size() * 2));
    small_ += seen_[id] ? 0U : 1U;
    seen_[id] = true;
  }
  void add_number(double id) {
    if (id >= 0 && id <= kMost && id == std::floor(id)) return add(static_cast<std::uint32_t>(id));
    if (invalid_++ == 0) first_invalid_ = id;
  }
  void add_float(float id) {
    if (id > kExact && inexact_++ == 0) first_inexact_ = id;
    add_number(static_cast<double>(id));
  }
  // Call it after the last id.
  void finish() { sort_large(); }

  bool any() const { return any_; }
  std::uint64_t greatest() const { return greatest_; }
  std::uint64_t distinct() const { return small_ + large_.size(); }
  std::uint64_t invalid() const { return invalid_; }
  double first_invalid() const { return first_invalid_; }
  /// Number of float ids so large that not all integers are floats.
  std::uint64_t inexact() const { return inexact_; }
  double first_inexact() const { return first_inexact_; }

 private:
  static constexpr std::uint32_t kSmall = 1U << 26U;
  static constexpr double kMost = 4294967295.0;
  static constexpr float kExact = 16777216.0F;

  void add_large(std::uint32_t id) {
    if (small_ + sorted_ > most_) return;
    large_.push_back(id);
    if (large_.size() >= 2 * sorted_ + (std::size_t{1} << 16U)) sort_large();
  }
  void sort_large() {
    std::sort(large_.begin(), large_.end());
    large_.erase(std::unique(large_.begin(), large_.end()), large_.end());
    sorted_ = large_.size();
  }

  std::optional<std::uint64_t> null_id_;
  std::uint64_t most_;
  bool any_ = false;
  std::uint32_t greatest_ = 0;
  std::uint64_t small_ = 0, invalid_ = 0, inexact_ = 0;
  double first_invalid_ = 0, first_inexact_ = 0;
  std::vector<bool> seen_;            // ids below kSmall
  std::vector<std::uint32_t> large_;  // other ids; no repeats among the first `sorted_`
  std::size_t sorted_ = 0;
};

// An object with sets of feature IDs: a primitive or an instanced node.
struct FeatureHost {
  bool instances = false;
  json::NodeId attributes = json::kNoNode;
  std::map<std::string_view, const model::Attribute*> by_name;
  std::vector<model::Attribute> list;
  std::vector<std::uint64_t> texcoords;  // sorted
  std::optional<std::uint64_t> count;    // number of vertices or instances
};

// A set of feature IDs.
struct FeatureSet {
  json::NodeId object = json::kNoNode;
  // `rows`: number of rows of the property table.
  std::optional<std::uint64_t> feature_count, null_id, rows;
};

class FeatureCheck {
 public:
  explicit FeatureCheck(MetadataPhase& phase)
      : phase_(phase),
        context_(phase.context()),
        document_(phase.document()),
        tables_(object_list(document_, phase.root, "propertyTables")) {}

  void run() {
    for_each_primitive_extension(
        context_, kMeshFeatures,
        [&](const ExtensionPlace& place, const Path& path) { check_object(place, path, false); });
    for_each_extension(
        context_, model::RootArray::nodes, kInstanceFeatures,
        [&](const ExtensionPlace& place, const Path& path) { check_object(place, path, true); });
    read_texels(phase_, std::move(requests_));
  }

 private:
  FeatureHost host_of(json::NodeId object, bool instances) const {
    FeatureHost host;
    host.instances = instances;
    const json::NodeId owner =
        instances ? model::extension_object(document_, object, kInstancing) : object;
    host.attributes = model::object_member(document_, owner, "attributes");
    if (host.attributes == json::kNoNode) return host;
    host.list = model::read_attributes(context_.asset, host.attributes);
    for (const model::Attribute& each : host.list) {
      host.by_name[each.name] = &each;
      if (each.accessor && (instances || each.semantic.kind == model::SemanticKind::position)) {
        host.count = context_.views.accessors[*each.accessor].count;
      }
    }
    if (!instances) host.texcoords = texcoord_sets(context_, object);
    return host;
  }

  void check_object(const ExtensionPlace& place, const Path& path, bool instances) {
    const FeatureHost host = host_of(place.host, instances);
    const Path list(path, "featureIds");
    const auto sets = object_list(document_, place.object, "featureIds");
    if (host.attributes != json::kNoNode) check_names(host, place.object, path);
    json::KeyTable labels;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (sets[i] == json::kNoNode) continue;
      const Path at(list, i);
      check_label(sets[i], at, labels);
      check_set(host, sets[i], at);
    }
  }

  // _FEATURE_ID_n: n from 0 without gaps.
  void check_names(const FeatureHost& host, json::NodeId object, const Path& path) {
    std::uint64_t count = 0;
    for (const model::Attribute& each : host.list)
      count += each.name.starts_with(kFeatureAttribute);
    for (std::uint64_t n = 0; n < count; ++n) {
      if (host.by_name.count(fmt::format("{}{}", kFeatureAttribute, n)) != 0) continue;
      phase_.sink().report(
          path, finding_on(context_, object, Code::FEATURE_ID_ATTRIBUTE_GAP,
                           fmt::format("There are {} attributes {}n, but no {}{}.", count,
                                       kFeatureAttribute, kFeatureAttribute, n)));
      return;
    }
  }

  void check_label(json::NodeId set, const Path& path, json::KeyTable& labels) {
    const json::NodeId label = document_.find(set, "label");
    if (label == json::kNoNode || !document_.is_string(label)) return;
    if (document_.insert_string(label, labels)) return;
    report_member(
        phase_.sink(), context_, path, set, "label", Code::FEATURE_ID_LABEL_REPEATED,
        fmt::format("Another set has the label {}.", gltfx::quoted(document_.string(label))));
  }

  FeatureSet read_set(json::NodeId object) const {
    FeatureSet set;
    set.object = object;
    set.feature_count = model::unsigned_member(document_, object, "featureCount");
    set.null_id = model::unsigned_member(document_, object, "nullFeatureId");
    const auto table = model::unsigned_member(document_, object, "propertyTable");
    if (table && *table < tables_.size()) {
      set.rows =
          model::unsigned_member(document_, tables_[static_cast<std::size_t>(*table)], "count");
    }
    return set;
  }

  void check_set(const FeatureHost& host, json::NodeId object, const Path& path) {
    const FeatureSet set = read_set(object);
    const json::NodeId attribute = document_.find(object, "attribute");
    const json::NodeId texture = host.instances ? json::kNoNode : document_.find(object, "texture");
    if (attribute != json::kNoNode) {
      const auto number = document_.unsigned_integer(attribute);
      if (number) check_attribute(host, set, *number, path);
    }
    if (texture != json::kNoNode && document_.is_object(texture)) {
      check_texture(host, set, texture, path);
    }
    if (attribute == json::kNoNode && texture == json::kNoNode) check_implicit(host, set, path);
  }

  void report(const FeatureSet& set, const Path& path, std::string_view member, Code code,
              std::string message) {
    report_member(phase_.sink(), context_, path, set.object, member, code, std::move(message));
  }

  void check_attribute(const FeatureHost& host, const FeatureSet& set, std::uint64_t number,
                       const Path& path) {
    const std::string name = fmt::format("{}{}", kFeatureAttribute, number);
    const auto found = host.by_name.find(name);
    if (found == host.by_name.end()) {
      return report(set, path, "attribute", Code::FEATURE_ID_ATTRIBUTE_MISSING,
                    host.instances ? fmt::format("{} of the node has no {}.", kInstancing, name)
                                   : fmt::format("The primitive has no {}.", name));
    }
    if (!found->second->accessor) return;
    const std::uint32_t accessor = *found->second->accessor;
    const model::Format& format = context_.views.accessors[accessor].format;
    if (!format.known()) return;
    if (format.type != model::ElementType::scalar || format.normalized) {
      return report(set, path, "attribute", Code::FEATURE_ID_ATTRIBUTE_INVALID_FORMAT,
                    fmt::format("{} is {}; it must be SCALAR and not normalized.", name,
                                format_text(format)));
    }
    if (!model::is_core_component(format.component)) return;
    const auto data = phase_.data.open(accessor);
    if (!data || !phase_.data.budget.take(data->count(), 1)) return;
    IdCount ids(set.null_id, set.feature_count.value_or(UINT64_MAX));
    model::with_component_type(format.component, [&](auto zero) {
      using T = decltype(zero);
      data->visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
        for (std::size_t i = 0; i < elements; ++i) {
          if constexpr (std::is_unsigned_v<T>) {
            ids.add(values[i]);
          } else if constexpr (std::is_floating_point_v<T>) {
            ids.add_float(static_cast<float>(values[i]));
          } else {
            ids.add_number(static_cast<double>(values[i]));
          }
        }
      });
    });
    check_ids(set, ids, path, "attribute");
  }

  void check_texture(const FeatureHost& host, const FeatureSet& set, json::NodeId object,
                     const Path& path) {
    const Path at(path, "texture");
    const DataTexture texture = check_data_texture(phase_, object, at, true);
    const auto coordinates = texcoord_set(document_, object);
    if (coordinates &&
        !std::binary_search(host.texcoords.begin(), host.texcoords.end(), *coordinates)) {
      report_missing_texcoord(phase_, *coordinates, object, at);
    }
    if (!texture.image || texture.channels.empty() || texture.channels.size() > 4) return;
    requests_.push_back(
        {*texture.image,
         [this, set, channels = texture.channels, pointer = path.pointer()](
             const codec::Image& image) { scan_texture(set, channels, pointer, image); },
         object, at.pointer()});
  }

  void scan_texture(const FeatureSet& set, const std::vector<unsigned>& channels,
                    const std::string& pointer, const codec::Image& image) {
    IdCount ids(set.null_id, set.feature_count.value_or(UINT64_MAX));
    for_each_texel_block(
        image, channels, [&](std::span<const std::byte> bytes, std::size_t texels) {
          for (std::size_t i = 0; i < texels; ++i) {
            std::uint32_t id = 0;
            for (std::size_t k = 0; k < channels.size(); ++k) {
              id |= std::to_integer<std::uint32_t>(bytes[i * channels.size() + k]) << (k * 8);
            }
            ids.add(id);
          }
        });
    with_pointer(pointer, [&](const Path& path) { check_ids(set, ids, path, "texture"); });
  }

  template <typename Use>
  static void with_pointer(const std::string& pointer, Use use) {
    const auto steps = split_pointer(pointer).value_or(std::vector<std::string>());
    std::vector<Path> path(steps.size() + 1);
    for (std::size_t i = 0; i < steps.size(); ++i) path[i + 1] = Path(path[i], steps[i]);
    use(path.back());
  }

  void check_implicit(const FeatureHost& host, const FeatureSet& set, const Path& path) {
    if (!host.count || *host.count == 0) return;
    const std::string_view what = host.instances ? "instances" : "vertices";
    if (set.feature_count && *set.feature_count != *host.count) {
      report(set, path, "featureCount", Code::FEATURE_ID_COUNT_MISMATCH,
             fmt::format("featureCount is {}, but the number of {} is {}.", *set.feature_count,
                         what, *host.count));
    }
    if (set.rows && *host.count > *set.rows) {
      report(set, path, "propertyTable", Code::FEATURE_ID_OOB,
             fmt::format("The number of {} is {}, but the property table has only {} rows.", what,
                         *host.count, *set.rows));
    }
  }

  void check_ids(const FeatureSet& set, IdCount& ids, const Path& path, std::string_view member) {
    ids.finish();
    if (ids.invalid() != 0) {
      report(set, path, member, Code::FEATURE_ID_NOT_INTEGER,
             fmt::format("The feature ID {} is not a non-negative integer.",
                         number_text(ids.first_invalid())));
    } else if (ids.inexact() != 0) {
      Finding finding = finding_on(
          context_, document_.find(set.object, member), Code::FEATURE_ID_NOT_INTEGER,
          fmt::format("The feature ID {} is above 2^24, where FLOAT does not hold every integer.",
                      number_text(ids.first_inexact())));
      finding.severity = Severity::warning;
      phase_.sink().report(Path(path, member), std::move(finding));
    }
    if (set.feature_count && ids.distinct() > *set.feature_count) {
      report(set, path, "featureCount", Code::FEATURE_ID_COUNT_MISMATCH,
             fmt::format("featureCount is {}, but there are more different feature IDs.",
                         *set.feature_count));
    }
    if (set.rows && ids.any() && ids.greatest() >= *set.rows) {
      report(set, path, "propertyTable", Code::FEATURE_ID_OOB,
             fmt::format("The greatest feature ID is {}, but the property table has only {} rows.",
                         ids.greatest(), *set.rows));
    }
  }

  MetadataPhase& phase_;
  const Context& context_;
  const json::Document& document_;
  std::vector<json::NodeId> tables_;
  std::vector<TexelRequest> requests_;
};

}  // namespace

void check_feature_ids(MetadataPhase& phase) { FeatureCheck(phase).run(); }

void check_metadata(DataPhase& data) {
  MetadataPhase phase{data, data.report, root_extension(data.context, kMetadataExtension)};
  MetadataSource source;
  if (phase.root != json::kNoNode) {
    source.load(phase);
    check_property_tables(phase);
    check_property_textures(phase);
    check_property_attributes(phase);
    check_metadata_of_objects(phase);
  }
  check_feature_ids(phase);
}

}  // namespace gltfx::validate
