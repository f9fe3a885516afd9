// SPDX-License-Identifier: Apache-2.0
// The C++ table of words and the vocabulary's own schema agree.
#include "schema/vocabulary.hpp"

#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gltfx::schema {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

const Json& meta() {
  static const Json json = [] {
    std::ifstream file(std::string(GLTFX_SOURCE_DIR) + "/schema/meta/vocabulary.schema.json");
    return Json::parse(file);
  }();
  return json;
}

Names keys(const Json& object) {
  Names names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

Names table(Context context) {
  Names names;
  for (const Word& word : words(context)) names.insert(std::string(word.name));
  return names;
}

Names required(Context context) {
  Names names;
  for (const Word& word : words(context)) {
    if (word.required) names.insert(std::string(word.name));
  }
  return names;
}

Names names_of(const Json& list) { return list.get<Names>(); }

TEST(Vocabulary, KeywordsOfSchemasAgree) {
  Names keywords = keys(meta()["$defs"]["keywords"]["properties"]);
  keywords.insert("x-gltfx");
  EXPECT_EQ(table(Context::schema), keywords);
}

TEST(Vocabulary, KeywordsOfFilesAgree) {
  Names keywords = keys(meta()["$defs"]["keywords"]["properties"]);
  for (const std::string& name : keys(meta()["properties"])) keywords.insert(name);
  EXPECT_EQ(table(Context::file), keywords);
  EXPECT_EQ(required(Context::file), names_of(meta()["required"]));
}

struct Pair {
  Context context;
  Json definition;
};

class VocabularyContext : public testing::TestWithParam<Pair> {};

TEST_P(VocabularyContext, WordsAndRequiredWordsAgree) {
  const auto& [context, definition] = GetParam();
  EXPECT_EQ(table(context), keys(definition["properties"]));
  EXPECT_EQ(required(context), names_of(definition.value("required", Json::array())));
}

INSTANTIATE_TEST_SUITE_P(
    Vocabulary, VocabularyContext,
    testing::Values(Pair{Context::word, meta()["$defs"]["word"]},
                    Pair{Context::extension, meta()["$defs"]["extension"]},
                    Pair{Context::version, meta()["$defs"]["versionText"]},
                    Pair{Context::advice, meta()["$defs"]["advice"]},
                    Pair{Context::slot, meta()["$defs"]["slot"]},
                    Pair{Context::attribute, meta()["$defs"]["attribute"]},
                    Pair{Context::generation,
                         meta()["$defs"]["extension"]["properties"]["generations"]["items"]},
                    Pair{Context::relation, meta()["$defs"]["others"]["items"]},
                    Pair{Context::upgrade, meta()["$defs"]["upgrade"]},
                    Pair{Context::upgrade_step, meta()["$defs"]["upgradeStep"]},
                    Pair{Context::upgrade_loss, meta()["$defs"]["upgradeLoss"]},
                    Pair{Context::upgrade_stay, meta()["$defs"]["upgradeStay"]},
                    Pair{Context::companion, meta()["$defs"]["companions"]["items"]}));

class VocabularyList : public testing::TestWithParam<std::pair<Form, Json>> {};

TEST_P(VocabularyList, ListedValuesAgree) {
  const auto known = listed_values(GetParam().first);
  EXPECT_EQ(Names(known.begin(), known.end()), names_of(GetParam().second));
}

INSTANTIATE_TEST_SUITE_P(
    Vocabulary, VocabularyList,
    testing::Values(
        std::pair{Form::type, meta()["$defs"]["typeName"]["enum"]},
        std::pair{Form::status, meta()["$defs"]["extension"]["properties"]["status"]["enum"]},
        std::pair{Form::requirement,
                  meta()["$defs"]["extension"]["properties"]["mustBeRequired"]["enum"]},
        std::pair{Form::mutable_type, meta()["$defs"]["word"]["properties"]["mutable"]["enum"]},
        std::pair{Form::step_kind, meta()["$defs"]["upgradeStep"]["properties"]["step"]["enum"]},
        std::pair{Form::conversion, meta()["$defs"]["upgrade"]["properties"]["convert"]["enum"]},
        std::pair{Form::accepted_form,
                  meta()["$defs"]["upgradeStep"]["properties"]["accept"]["enum"]},
        std::pair{Form::color_space, meta()["$defs"]["slot"]["properties"]["colorSpace"]["enum"]},
        std::pair{Form::element_types,
                  meta()["$defs"]["attribute"]["properties"]["types"]["items"]["enum"]},
        std::pair{Form::component_types,
                  meta()["$defs"]["attribute"]["properties"]["components"]["items"]["enum"]}));

TEST(Vocabulary, EveryKeywordOfTheTableIsOneForTheCompiler) {
  for (const Word& word : words(Context::file))
    EXPECT_NE(keyword_of(word.name), Keyword::none) << word.name;
  EXPECT_EQ(keyword_of("patterns"), Keyword::none);
}

}  // namespace
}  // namespace gltfx::schema
