// SPDX-License-Identifier: Apache-2.0
/// A rule is a page of schema/rules/ and one file that raises it.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::IsEmpty;

// Codes with several files, and why.
const std::map<std::string, std::string, std::less<>> kSeveral{
    {"ACCESSOR_DATA_NOT_CHECKED", "columns of property tables share bytes as accessors do"},
    {"ACCESSOR_VECTOR3_NON_UNIT", "normals of edges are checked with their edges"},
    {"ARRAY_LENGTH_NOT_IN_LIST", "the length of min and max depends on the type of the accessor"},
    {"ARRAY_TYPE_MISMATCH", "min and max of integers depend on the component type"},
    {"BLEND_SHOWS_OPAQUE", "the phase asks whether anybody wants it"},
    {"BUDGET_NOT_MEASURED", "limits, and own rules"},
    {"BUFFER_VIEW_INVALID_BYTE_STRIDE", "found by the use of a view and by its target"},
    {"CONDITION_MISMATCH", "the walk over schemas is one class in several files"},
    {"DUPLICATE_ELEMENTS", "the walk over schemas knows nothing of edits"},
    {"EMISSION_HIDES_COLOR", "the phase asks whether anybody wants it"},
    {"EMPTY_ENTITY", "the walk over schemas is one class in several files"},
    {"EXTENSION_ACCESSOR_INVALID_FORMAT", "what changes over time has formats of its own"},
    {"GIT_LFS_POINTER", "the asset or a resource; an option sets the severity"},
    {"GLB_CHUNK_LENGTH_UNALIGNED", "the rewriter corrects it"},
    {"GLB_CHUNK_TOO_BIG", "the rewriter corrects it"},
    {"GLB_CHUNK_TYPE_NUMBER", "the rewriter corrects it"},
    {"GLB_DUPLICATE_CHUNK", "the rewriter keeps it"},
    {"GLB_EMPTY_BIN_CHUNK", "the rewriter keeps it"},
    {"GLB_EXTRA_DATA", "the rewriter keeps it"},
    {"GLB_INVALID_MAGIC", "the phase asks whether the file is a GLB at all"},
    {"GLB_LENGTH_MISMATCH", "the rewriter corrects it"},
    {"GLB_LENGTH_TOO_SMALL", "the rewriter corrects it"},
    {"GLB_UNEXPECTED_BIN_CHUNK", "the rewriter keeps it"},
    {"GLB_UNEXPECTED_END_OF_HEADER", "the phase asks whether the file is a GLB at all"},
    {"GLB_UNKNOWN_CHUNK_TYPE", "the rewriter keeps it"},
    {"IMAGE_UNEXPECTED_EOS", "KTX2 files are read by a reader of their own"},
    {"INVALID_EXTENSION_NAME_FORMAT", "declared, or only used"},
    {"INVALID_INDEX", "the walk over schemas is one class in several files"},
    {"INVALID_JSON", "no text, or a text that is not JSON"},
    {"INVALID_URI", "the form of a reference, or the data of a data URI"},
    {"IO_ERROR", "the asset or a resource"},
    {"KTX2_HEADER_INVALID", "the reader of KTX2 is several files"},
    {"KTX2_INDEX_INVALID", "the reader of KTX2 is several files"},
    {"MASK_ALPHA_GRADIENT", "the phase asks whether anybody wants it"},
    {"MATERIAL_ALPHA_MISSING", "the phase asks whether anybody wants it"},
    {"NON_RELATIVE_URI", "a fix that names the same file is judged by that alone"},
    {"NON_REQUIRED_EXTENSION", "by schema, by declaration, by data without a fallback"},
    {"NORMAL_MAP_AS_COLOR", "the phase asks whether anybody wants it"},
    {"NORMAL_MAP_DIRECTX", "the phase asks whether anybody wants it"},
    {"NORMAL_MAP_FLAT", "the phase asks whether anybody wants it"},
    {"NORMAL_MAP_INWARD", "the phase asks whether anybody wants it"},
    {"NORMAL_MAP_NOT_UNIT", "the phase asks whether anybody wants it"},
    {"OCCLUSION_BLACK", "the phase asks whether anybody wants it"},
    {"PROPERTY_RENAMED", "the walk over schemas knows nothing of edits"},
    {"UNUSED_EXTENSION_REQUIRED", "the walk over schemas knows nothing of edits"},
    {"UNEXPECTED_PROPERTY", "the walk over schemas knows nothing of edits"},
    {"PATTERN_MISMATCH", "the walk over schemas is one class in several files"},
    {"STRING_LENGTH_NOT_IN_RANGE", "the walk over schemas is one class in several files"},
    {"TEXTURE_ALPHA_CONSTANT", "the phase asks whether anybody wants it"},
    {"TEXTURE_ALPHA_OPAQUE", "the phase asks whether anybody wants it"},
    {"TEXTURE_CHANNELS_EQUAL", "the phase asks whether anybody wants it"},
    {"TEXTURE_COLOR_SPACE_CONFLICT", "the phase asks whether anybody wants it"},
    {"TEXTURE_CONSTANT", "the phase asks whether anybody wants it"},
    {"TYPE_MISMATCH", "the walk over schemas is one class in several files"},
    {"UNDECLARED_EXTENSION", "graphs of an earlier draft keep this finding alone"},
    {"UNDEFINED_PROPERTY", "the walk, and the object that a camera's type names"},
    {"UNRESOLVED_REFERENCE", "the walk over schemas knows nothing of edits"},
    {"UNSATISFIED_DEPENDENCY", "the walk, accessors, and extensions that need a root object"},
    {"UNSUPPORTED_EXTENSION", "declared, or only used"},
    {"UNUSED_OBJECT", "animations and vertex data have uses of their own"},
    {"GLB_CHUNK_ENCODING_UNKNOWN", "the writer of GLBs keeps chunks with it"},
    {"GLB_CHUNK_GAP", "the writer of GLBs keeps chunks with it"},
    {"GLB_CHUNK_ORDER", "the writer of GLBs keeps chunks with it"},
    {"URI_OUTSIDE_ROOT", "found in the text, or when the file is opened"},
    {"VALUE_MULTIPLE_OF", "the walk, and strides that depend on the target"},
    {"VALUE_NOT_IN_RANGE", "the walk over schemas is one class in several files"},
};

std::map<std::string, std::set<std::string>> files_by_code() {
  constexpr std::string_view kPrefix = "Code::";
  std::map<std::string, std::set<std::string>> files;
  for (const Source& source : cpp_below({"libgltfx"})) {
    if (source.path.find("/compiler/") != std::string::npos) continue;
    const std::string& code = lex(source.text).code;
    for (std::size_t at = code.find(kPrefix); at != std::string::npos;
         at = code.find(kPrefix, at + 1)) {
      const auto begin = code.begin() + static_cast<std::ptrdiff_t>(at + kPrefix.size());
      const auto end = std::find_if_not(begin, code.end(), is_part_of_name);
      files[std::string(begin, end)].insert(source.path);
    }
  }
  return files;
}

TEST(Rules, EachPageHasOneFileThatRaisesIt) {
  const auto files = files_by_code();
  Problems problems;
  for (const Source& page : files_below({"schema/rules"})) {
    const std::size_t slash = page.path.rfind('/');
    const std::string code = page.path.substr(slash + 1, page.path.rfind('.') - slash - 1);
    const auto found = files.find(code);
    const std::size_t count = found != files.end() ? found->second.size() : 0;
    if (count == 0) problems.push_back(page.path + ": no file raises " + code);
    const bool several = kSeveral.count(code) > 0;
    if (count > 1 && !several) problems.push_back(code + " is in several files");
    if (count == 1 && several) problems.push_back(code + " is in one file: not for the list");
  }
  EXPECT_THAT(problems, IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
