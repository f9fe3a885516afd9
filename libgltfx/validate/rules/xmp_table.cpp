// SPDX-License-Identifier: Apache-2.0
// Examples of an extension name it, as those of any extension do.
#include "validate/rules/xmp_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
  "@id": "", "dc:format": "model/gltf+json"}]}}})";

constexpr RuleDescription kRules[] = {
    {"XMP_ARRAY_BARE", Severity::error, "An array of metadata does not say whether it is ordered",
     "Readers of JSON-LD lose the order of a bare array; others keep one that means nothing.",
     "Put the array under @list where order matters, otherwise under @set.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
  "@id": "", "dc:creator": ["A. Botanist"]}]}}})",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
  "@id": "", "dc:creator": {"@list": ["A. Botanist"]}}]}}})",
     Fix::none, false},
    {"XMP_ID_MISSING", Severity::hint, "A metadata packet has no @id",
     "Tools that turn packets into XMP files expect one; it may be empty.",
     "Write \"@id\": \"\" into the packet.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
  "dc:format": "model/gltf+json"}]}}})",
     kGood, Fix::none, false},
    {"XMP_LANGUAGE_INVALID", Severity::error, "Text in several languages has an entry that is none",
     "Each entry is rdf:_1, rdf:_2 and so on, with a language and a text; readers skip others.",
     "Write { \"@language\": \"en\", \"@value\": \"text\" } under rdf:_N.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/", "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#"},
  "@id": "", "dc:title": {"@type": "rdf:Alt", "rdf:_1": {"@value": "Fern"}}}]}}})",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/", "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#"},
  "@id": "", "dc:title": {"@type": "rdf:Alt", "rdf:_1": {"@language": "en", "@value": "Fern"}}}]}}})",
     Fix::none, false},
    {"XMP_NAME_WITHOUT_PREFIX", Severity::error, "A property of metadata has no prefix",
     "The prefix says whose property it is; without one it means nothing.",
     "Write prefix:name, and the namespace of the prefix into @context.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
  "@id": "", "format": "model/gltf+json"}]}}})",
     kGood, Fix::none, false},
    {"XMP_NAMESPACE_REPEATED", Severity::error, "Two prefixes stand for one namespace",
     "Readers that go by prefixes see two different vocabularies.", "Keep one of the prefixes.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/", "dublin": "http://purl.org/dc/elements/1.1/"},
  "@id": "", "dc:format": "model/gltf+json"}]}}})",
     kGood, Fix::none, false},
    {"XMP_PREFIX_UNKNOWN", Severity::error, "A prefix of metadata is not in @context",
     "Nobody can tell which namespace is meant.", "Add the prefix to @context, or correct it.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}}, "extensionsUsed": ["KHR_xmp_json_ld"],
 "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
  "@id": "", "xmp:Rating": 5}]}}})",
     kGood, Fix::none, false},
};

}  // namespace

std::span<const RuleDescription> xmp_rules() { return kRules; }

}  // namespace gltfx::validate
