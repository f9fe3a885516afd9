// SPDX-License-Identifier: Apache-2.0
#include "rules/fix.hpp"

#include <set>
#include <utility>

#include "base/fork.hpp"
#include "change/deletion.hpp"
#include "change/place.hpp"
#include "json/parse.hpp"
#include "rules/context.hpp"
#include "rules/files_read.hpp"

namespace gltfx::validate {
namespace {

std::vector<const FixEntry*> table_of_fixes() {
  std::vector<const FixEntry*> table(rules().size());
  for (const RuleGroup& group : rule_groups()) {
    for (const FixEntry& entry : group.fixes) table[static_cast<std::size_t>(entry.code)] = &entry;
  }
  return table;
}

}  // namespace

const FixEntry* find_fix(Code code) {
  static constinit MadeOnce<std::vector<const FixEntry*>> table;
  const auto position = static_cast<std::size_t>(code);
  return position < rules().size() ? table.get(table_of_fixes)[position] : nullptr;
}

namespace {

// Without a document, fixes of the text use only the text.
const json::Document& document_of(const model::OpenedAsset& opened) {
  static constinit MadeOnce<json::Parsed> nothing;
  const json::Document& document = opened.document();
  const bool usable = !document.empty() && document.is_object(document.root());
  return usable ? document : nothing.get([] { return json::parse(share_text("{}")); }).document;
}

}  // namespace

Fixing::Fixing(const model::OpenedAsset& opened, const schema::Set& schemas,
               std::uint64_t content_bytes)
    : opened_(opened),
      document_(document_of(opened)),
      schemas_(schemas),
      elements_(document_),
      editor_(document_),
      names_{{document_, "extensionsUsed"}, {document_, "extensionsRequired"}},
      contents_{{}, content_bytes} {}

namespace {

struct Loaded {
  explicit Loaded(const Fixing& fixing) {
    container::OpenedFiles files(fixing.opened().resolver());
    data = model::load_resources(fixing.opened().container(), files, fixing.elements(),
                                 fixing.views(), 1)
               .data;
  }
  model::ResourceData data;
};

}  // namespace

const model::ResourceData& Fixing::resources() { return table<Loaded>().data; }

std::string* Fixing::content(std::uint32_t buffer) {
  const auto known = contents_.changed.find(buffer);
  if (known != contents_.changed.end()) return &known->second;
  const auto& buffers = resources().buffers;
  if (buffer >= buffers.size() || !buffers[buffer]) return nullptr;
  if (buffers[buffer]->size() > contents_.bytes_left) return nullptr;
  contents_.bytes_left -= buffers[buffer]->size();
  return &contents_.changed.emplace(buffer, std::string(buffers[buffer]->text())).first->second;
}

// Nodes are in the order of the text, and no two of them begin at one byte.
json::NodeId node_around(const json::Document& document, Span place) {
  if (place.end == 0) return json::kNoNode;
  json::NodeId first = 0;
  auto last = static_cast<json::NodeId>(document.node_count());
  while (first < last) {
    const json::NodeId middle = first + (last - first) / 2;
    if (document.node(middle).begin <= place.begin) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  const bool found = first > 0 && document.node(first - 1).end > place.begin;
  return found ? first - 1 : json::kNoNode;
}

json::NodeId node_at(const json::Document& document, Span place) {
  const json::NodeId node = node_around(document, place);
  const bool found = node != json::kNoNode && document.node(node).begin == place.begin;
  return found ? node : json::kNoNode;
}

namespace {

struct Referring {
  explicit Referring(const Fixing& fixing) : graph(fixing.document(), fixing.schemas()) {}
  const graph::Graph graph;
};

}  // namespace

const graph::Graph& Fixing::graph() { return table<Referring>().graph; }

namespace {

struct Parents {
  explicit Parents(const Fixing& fixing) : tree(fixing.document()) {}
  const graph::Tree tree;
};

}  // namespace

const graph::Tree& Fixing::tree() { return table<Parents>().tree; }

std::optional<Subject> Fixing::subject_at(Span place) {
  const json::NodeId node = node_around(document_, place);
  if (node == json::kNoNode) return std::nullopt;
  Subject subject;
  subject.begin = place.begin;
  if (document_.node(node).begin != place.begin) {
    if (document_.kind(node) != json::Kind::number_array) return std::nullopt;
    subject.owner = node;
    return subject;
  }
  subject.is_name = document_.kind(node) == json::Kind::key;
  subject.value = subject.is_name ? node + 1 : node;
  subject.owner = parent(subject.value);
  subject.name = member_name(subject.value);
  return subject;
}

bool Fixing::fix(const Site& site, bool unsafe) {
  const FixEntry& entry = *find_fix(site.code);
  const bool of_document = entry.stage > FixStage::syntax;
  const auto subject = of_document ? subject_at(site.span) : Subject();
  if (!subject) return false;
  return entry.fix(*this, *subject) ||
         (unsafe && entry.unsafe != nullptr && entry.unsafe(*this, *subject));
}

std::optional<std::uint32_t> Fixing::index(model::RootArray array, json::NodeId value) {
  if (value == json::kNoNode) return std::nullopt;
  if (document_.is_number(value)) return elements_.index(document_.number(value).value, array);
  const std::uint32_t position = tree().position(value);
  const auto& objects = elements_.elements(array);
  const bool found = position < objects.size() && objects[position] == value;
  return found ? std::optional(position) : std::nullopt;
}

bool Fixing::is_claimed(json::NodeId node) {
  const bool claimed = node < claimed_.nodes.size() && claimed_.nodes[node];
  claimed_.was_met = claimed_.was_met || claimed;
  return claimed;
}

bool Fixing::claim(json::NodeId node) {
  if (is_claimed(node)) return false;
  claimed_.nodes.resize(document_.node_count());
  claimed_.nodes[node] = true;
  return true;
}

bool Fixing::remove_member(json::NodeId value) {
  const json::NodeId object = value == json::kNoNode ? json::kNoNode : parent(value);
  if (object == json::kNoNode || !document_.is_object(object) || !claim(value)) return false;
  editor_.remove(object, value - 1);
  return true;
}

bool Fixing::replace_scalar(json::NodeId value, std::string json) {
  if (!claim(value)) return false;
  editor_.replace_scalar(value, std::move(json));
  return true;
}

bool Fixing::replace(json::NodeId value, std::string_view json) {
  const json::NodeId container = parent(value);
  if (container == json::kNoNode || !claim(value)) return false;
  editor_.replace(container, value, json);
  return true;
}

bool Fixing::append_member(json::NodeId object, std::string_view name, std::string_view json) {
  if (!document_.is_object(object)) return false;
  editor_.append_member(object, name, json);
  return true;
}

bool remove_marked(Fixing& fixing, const Subject& subject) {
  return fixing.remove_member(subject.value);
}

std::string without_repeats(const json::Document& document, json::NodeId numbers) {
  std::set<double> seen;
  std::string text = "[";
  for (json::NumberCursor at(document, numbers); at.valid(); at.advance()) {
    if (!seen.insert(at.number().value).second) continue;
    if (text.size() > 1) text += ", ";
    text += at.number().span.in(document.text());
  }
  return text + "]";
}

Result<change::Change> Fixing::take_deletion() {
  const std::vector<std::string> pointers(deleted_.begin(), deleted_.end());
  auto deletion =
      change::plan_deletion(document_, schemas_, pointers, {true, &opened_.container()});
  if (!deletion) return deletion.error();
  return std::move(deletion->change);
}

Result<change::Change> Fixing::take() {
  if (!deleted_.empty()) return take_deletion();
  std::erase_if(contents_.changed, [&](const auto& content) {
    return content.second == resources().buffers[content.first]->text();
  });
  if (auto error = unite_buffers(*this, contents_.changed)) return *std::move(error);
  names_.used.apply(editor_);
  names_.required.apply(editor_);
  change::Change change;
  change.edits = editor_.take();
  change.sound_chunks = rewrites_container_;
  change.contents = std::move(contents_.changed);
  auto placed = change::place(std::move(change), opened_, nullptr);
  if (placed && !placed->replaced.empty()) add_other_names(*this, placed->replaced);
  return placed;
}

}  // namespace gltfx::validate
