// SPDX-License-Identifier: Apache-2.0
/// The options of each verb: their rows, and functions that read their words into a request.
#pragma once

#include "option_rows.hpp"
#include "reading.hpp"

namespace gltfx::tool {

// The rows of each verb.
void declare_validate(Options& options, ValidateRequest& request);
void declare_fix(Options& options, FixRequest& request);
void declare_upgrade(Options& options, UpgradeRequest& request);
void declare_edit(Options& options, DeleteRequest& request);
void declare_convert(Options& options, ConvertRequest& request);
void declare_compare(Options& options, CompareRequest& request);
void declare_bake(Options& options, BakeRequest& request);
void declare_report(Options& options, PageRequest& request);
void declare_inspect(Options& options, InspectRequest& request);
void declare_merge(Options& options, MergeRequest& request);
void declare_explain(Options& options, ExplainRequest& request);
void declare_rules(Options& options, RulesRequest& request);
void declare_targets(Options& options, TargetsRequest& request);
void declare_schema(Options& options, SchemaRequest& request);
void declare_measures(Options& options, MeasuresRequest& request);
void declare_presets(Options& options, PresetsRequest& request);
void declare_config(Options& options, ConfigRequest& request);

// Read the words of each verb: checks before and after Reading::read().
void read_validate(Reading& reading, ValidateRequest& request);
void read_fix(Reading& reading, FixRequest& request);
void read_upgrade(Reading& reading, UpgradeRequest& request);
void read_edit(Reading& reading, DeleteRequest& request);
void read_convert(Reading& reading, ConvertRequest& request);
void read_compare(Reading& reading, CompareRequest& request);
void read_bake(Reading& reading, BakeRequest& request);
void read_report(Reading& reading, PageRequest& request);
void read_inspect(Reading& reading, InspectRequest& request);
void read_merge(Reading& reading, MergeRequest& request);
void read_explain(Reading& reading, ExplainRequest& request);
void read_rules(Reading& reading, RulesRequest& request);
void read_targets(Reading& reading, TargetsRequest& request);
void read_schema(Reading& reading, SchemaRequest& request);
void read_measures(Reading& reading, MeasuresRequest& request);
void read_presets(Reading& reading, PresetsRequest& request);
void read_config(Reading& reading, ConfigRequest& request);

}  // namespace gltfx::tool
