// SPDX-License-Identifier: Apache-2.0
/// Which files the .gitignore files of a repository name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx::tool {

/// The .gitignore files along a walk through folders, read as gitignore(5) describes them. The
/// user's own lists (core.excludesFile, .git/info/exclude) are not read, and git is not run: the
/// settings of a repository that nobody vouches for could make it start programs.
class IgnoreFiles {
 public:
  /// The walk begins in `folder`. Files above it count as far as the top of its repository; outside
  /// of repositories there are none.
  void begin(const std::string& folder);
  /// The walk goes into a folder, or back out of it; `folder` ends in '/'.
  void enter(const std::string& folder);
  void leave();
  /// `path` lies directly in the folder that was entered last.
  bool ignores(std::string_view path, bool is_folder) const;

 private:
  struct Pattern {
    std::string text;
    bool keep = false;          ///< begins with '!'
    bool folders_only = false;  ///< ends in '/'
    bool anchored = false;      ///< fits paths from the folder of its file only
  };
  struct File {
    std::string before;    ///< what paths of the walk lack: from the file's folder to its start
    std::size_t skip = 0;  ///< bytes of a walked path that lie above the file's folder
    std::vector<Pattern> patterns;
  };

  void read(const std::string& folder, std::string before, std::size_t skip);
  static std::vector<Pattern> parse(std::string_view text);

  std::vector<File> files_;  ///< from the top of the repository to the folder entered last
  bool in_repository_ = false;
};

}  // namespace gltfx::tool
