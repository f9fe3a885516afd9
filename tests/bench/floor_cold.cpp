// SPDX-License-Identifier: Apache-2.0
// Floor of a cold start: the libraries such a program needs, its command line, one JSON file.
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <simdjson.h>

int main(int argc, char** argv) {
  CLI::App app{"Reads one JSON file."};
  std::string path;
  app.add_option("file", path)->required();
  CLI11_PARSE(app, argc, argv);
  simdjson::dom::parser parser;
  simdjson::dom::element root;
  if (parser.load(path).get(root) != simdjson::SUCCESS) return 1;
  std::printf("%d\n", static_cast<int>(root.type()));
  return 0;
}
