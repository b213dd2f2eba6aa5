// SPDX-License-Identifier: Apache-2.0
// Runs in the build, not in the studio: writes the source file behind facts.h. Arguments: the
// source tree, the file to write (left alone when nothing has changed), the commit.
#include <fstream>
#include <iostream>
#include <sstream>

#include "controller/daemon/study/tags.h"

namespace {

std::string facts(const std::string& root, const std::string& commit) {
  std::ostringstream out;
  out << "// Made by the build.\n#include \"controller/daemon/study/facts.h\"\n"
         "#include \"controller/daemon/study/write.h\"\n"
         "namespace chiaro::daemon::study {\nnamespace {\nconstexpr TagFact kTags[] = {\n";
  for (const auto& tag : chiaro::daemon::study::tags_below(root))
    out << "    {" << tag.item << ", \"" << tag.file << "\", \"" << tag.test << "\"},\n";
  out << "};\n}  // namespace\nstd::span<const TagFact> tag_facts() { return kTags; }\n"
      << "std::string commit() { return \"" << commit
      << "\"; }\n}  // namespace chiaro::daemon::study\n";
  return out.str();
}

std::string content(const char* file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::cerr << "study-facts SOURCE_TREE FILE COMMIT\n";
    return 2;
  }
  const std::string wanted = facts(arguments[1], arguments[3]);
  if (content(arguments[2]) == wanted) return 0;
  std::ofstream out(arguments[2]);
  out << wanted;
  return out.flush() ? 0 : 1;
}
