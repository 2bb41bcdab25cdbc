# cmake -DFILES=a;b -DOUT=file.cpp -P embed_files.cmake: writes a source file with the unchanged files for page_files().
set(entries "")
foreach(file IN LISTS FILES)
  file(READ ${file} text)
  string(FIND "${text}" ")embedded\"" ending)
  if(NOT ending EQUAL -1)
    message(FATAL_ERROR "${file}: holds what ends a literal here")
  endif()
  cmake_path(GET file FILENAME name)
  string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
list(LENGTH FILES count)
file(WRITE ${OUT} "// Made by embed_files.cmake.
#include <array>

#include \"tools/page/html_page.hpp\"

namespace azimuth {

std::span<const PageFile> page_files() {
  static constexpr std::array<PageFile, ${count}> kFiles{{
${entries}  }};
  return kFiles;
}

}  // namespace azimuth
")
