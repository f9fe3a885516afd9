// SPDX-License-Identifier: Apache-2.0
#include "measure/take.hpp"

#include <algorithm>
#include <cmath>

namespace gltfx {
namespace {

// The value of a set of elements; nothing of none.
class Fold {
 public:
  explicit Fold(MeasureTotal total) : total_(total) {}

  void add(const MeasureValue& value) {
    if (const auto* missing = std::get_if<NotMeasured>(&value)) {
      if (missing_.reason == 0) missing_ = *missing;
      return;
    }
    double number = 0;
    if (const auto* plain = std::get_if<double>(&value)) number = *plain;
    if (const auto* flag = std::get_if<bool>(&value)) number = *flag ? 1 : 0;
    if (!any_) {
      value_ = number;
    } else if (total_ == MeasureTotal::sum) {
      value_ += number;
    } else {
      const bool greatest = total_ == MeasureTotal::max;
      value_ = greatest ? std::max(value_, number) : std::min(value_, number);
    }
    any_ = true;
  }
  // A total with a missing part would be wrong.
  MeasureValue value(const std::vector<MeasureReason>& reasons) const {
    if (!any_ || reasons[missing_.reason].fault) return missing_;
    return total_ == MeasureTotal::all ? MeasureValue(value_ != 0) : MeasureValue(value_);
  }

 private:
  MeasureTotal total_;
  bool any_ = false;
  double value_ = 0;
  NotMeasured missing_;  // the first one with a reason
};

}  // namespace

namespace measure {

void Column::miss(std::size_t element, std::string_view why, bool fault) {
  const auto same = std::find_if(
      to_.reasons.begin() + 1, to_.reasons.end(),
      [&](const MeasureReason& reason) { return reason.fault == fault && reason.text == why; });
  const auto at = static_cast<std::uint32_t>(same - to_.reasons.begin());
  if (same == to_.reasons.end()) to_.reasons.push_back({std::string(why), fault});
  values_[element] = NotMeasured{at};
}

Taking::Taking(const Source& source, const Request& request) : source_(source), request_(request) {
  taken_.reasons.push_back({"The measure does not apply.", false});
  count_elements();
  wanted_.resize(measures().size());
  if (request.wanted) {
    for (const Wanted& wanted : *request.wanted) want(wanted.on, wanted.measure);
  } else {
    for (std::size_t i = 0; i < measures().size(); ++i) {
      const MeasureDescription& measure = measures()[i];
      wanted_[i] = static_cast<std::uint16_t>(measure.on | (measure.is_of_asset() ? 1U : 0U));
    }
  }
  make_columns();
}

// The value of the asset needs those that it is made of.
void Taking::want(MeasureScope on, Name measure) {
  const auto at = static_cast<std::size_t>(measure);
  const MeasureDescription& description = measures()[at];
  const auto add = [&](MeasureScope scope) {
    wanted_[at] = static_cast<std::uint16_t>(wanted_[at] | 1U << static_cast<unsigned>(scope));
  };
  add(on);
  if (on == MeasureScope::asset && !description.is_on(on)) add(description.first);
}

void Taking::count_elements() {
  using model::RootArray;
  const model::Asset& asset = source_.asset();
  const auto count = [&](MeasureScope scope) -> std::size_t& {
    return counts_[static_cast<std::size_t>(scope)];
  };
  count(MeasureScope::asset) = 1;
  count(MeasureScope::scene) = asset.count(RootArray::scenes);
  count(MeasureScope::node) = asset.count(RootArray::nodes);
  count(MeasureScope::mesh) = asset.count(RootArray::meshes);
  count(MeasureScope::material) = asset.count(RootArray::materials);
  count(MeasureScope::image) = asset.count(RootArray::images);
  count(MeasureScope::skin) = asset.count(RootArray::skins);
  count(MeasureScope::animation) = asset.count(RootArray::animations);
  for (std::uint32_t mesh = 0; mesh < source_.views().meshes.size(); ++mesh) {
    first_primitives_.push_back(taken_.primitives.size());
    const auto& primitives = source_.views().meshes[mesh].primitives;
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
      taken_.primitives.push_back({mesh, i});
      if (!primitives[i].material) taken_.has_plain_primitives = true;
    }
  }
  count(MeasureScope::primitive) = taken_.primitives.size();
  if (taken_.has_plain_primitives) ++count(MeasureScope::material);
}

void Taking::make_columns() {
  for (std::size_t scope = 0; scope < kMeasureScopeCount; ++scope) {
    auto& columns = taken_.columns[scope];
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if ((wanted_[i] >> scope & 1U) == 0) continue;
      columns.push_back({&measures()[i], std::vector<MeasureValue>(counts_[scope])});
    }
    for (MeasureColumn& column : columns) columns_[scope].emplace_back(taken_, column.values);
  }
}

bool Taking::wants(Name measure) const { return wanted_[static_cast<std::size_t>(measure)] != 0; }

Column* Taking::column(MeasureScope on, Name measure) {
  const auto scope = static_cast<std::size_t>(on);
  const MeasureDescription* wanted = &measures()[static_cast<std::size_t>(measure)];
  const auto& columns = taken_.columns[scope];
  const auto at = std::lower_bound(columns.begin(), columns.end(), wanted,
                                   [](const MeasureColumn& column, const MeasureDescription* to) {
                                     return column.measure->name < to->name;
                                   });
  if (at == columns.end() || at->measure != wanted) return nullptr;
  return &columns_[scope][static_cast<std::size_t>(at - columns.begin())];
}

Measurements Taking::finish() {
  const auto scene = source_.default_scene();
  for (MeasureColumn& of_asset : taken_.columns[static_cast<std::size_t>(MeasureScope::asset)]) {
    const MeasureDescription& measure = *of_asset.measure;
    if (measure.is_on(MeasureScope::asset)) continue;
    const MeasureScope scope = measure.first;
    const MeasureColumn* elements = taken_.find(scope, measure.name);
    Column to(taken_, of_asset.values);
    if (scope == MeasureScope::scene) {
      if (scene && *scene < elements->values.size()) {
        of_asset.values[0] = elements->values[*scene];
      } else {
        to.does_not_apply(0, "The asset has no scene.");
      }
    } else if (!elements->values.empty()) {
      Fold fold(measure.total);
      for (const MeasureValue& value : elements->values) fold.add(value);
      of_asset.values[0] = fold.value(taken_.reasons);
    } else if (measure.total == MeasureTotal::sum) {
      of_asset.values[0] = 0.0;
    } else {
      to.does_not_apply(0, "The asset has no such element.");
    }
  }
  return std::move(taken_);
}

Measurements take(const Source& source, const Request& request) {
  Taking taking(source, request);
  for (const TakeEntry& entry : take_entries()) {
    const bool wanted = std::any_of(entry.measures.begin(), entry.measures.end(),
                                    [&](Name measure) { return taking.wants(measure); });
    if (wanted) entry.take(taking);
  }
  return taking.finish();
}

}  // namespace measure

const MeasureDescription* find_measure(std::string_view name) {
  const auto all = measures();
  const auto at = std::lower_bound(all.begin(), all.end(), name,
                                   [](const MeasureDescription& measure, std::string_view wanted) {
                                     return measure.name < wanted;
                                   });
  return at != all.end() && at->name == name ? &*at : nullptr;
}

const MeasureDescription* find_measure(MeasureScope scope, std::string_view name) {
  const auto all = measures();
  const MeasureDescription* at = find_measure(name);
  for (; at != nullptr && at != all.data() + all.size() && at->name == name; ++at) {
    const bool of_asset = scope == MeasureScope::asset && at->is_of_asset();
    if (of_asset || at->is_on(scope)) return at;
  }
  return nullptr;
}

}  // namespace gltfx
