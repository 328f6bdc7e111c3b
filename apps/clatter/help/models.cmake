# Writes models.cpp: the shipped configurations, first those of the table "Which model is mine" in the guide, with its
# sentences. Run by a build whenever one of them has changed.
file(READ ${CONFIGS}/README.md guide)
string(REGEX MATCHALL "\n\\| [^|\n]+ \\| \\[`[a-z0-9_]+\\.toml`\\]" rows "${guide}")
if(NOT rows)
  message(FATAL_ERROR "configs/README.md: no table of models, rows such as | my machine | [`drill.toml`](#drill) |")
endif()
file(GLOB others RELATIVE ${CONFIGS} ${CONFIGS}/*.toml)
list(SORT others)

set(entries)
function(add_model file machine)
  if(NOT EXISTS ${CONFIGS}/${file})
    message(FATAL_ERROR "configs/README.md names ${file}, and there is no such configuration")
  endif()
  file(READ ${CONFIGS}/${file} text)
  if(text MATCHES "force_table = \"([a-z0-9_]+\\.csv)\"")  # a model is one file, which has the rows in it
    set(table ${CMAKE_MATCH_1})
    file(READ ${CONFIGS}/${table} rows)
    string(REPLACE "\"${table}\"" "'''\n${rows}'''" text "${text}")
  endif()
  cmake_path(GET file STEM name)
  string(APPEND entries "    {\"${name}\", R\"text(${machine})text\", R\"text(${text})text\"},\n")
  set(entries "${entries}" PARENT_SCOPE)
endfunction()

foreach(row IN LISTS rows)
  string(REGEX REPLACE "^\n\\| ([^|\n]+) \\| \\[`([a-z0-9_]+\\.toml)`\\]$" "\\1" machine "${row}")
  string(REGEX REPLACE "^\n\\| ([^|\n]+) \\| \\[`([a-z0-9_]+\\.toml)`\\]$" "\\2" file "${row}")
  add_model(${file} "${machine}")
  list(REMOVE_ITEM others ${file})
endforeach()
foreach(file IN LISTS others)
  add_model(${file} "")
endforeach()

file(WRITE ${OUTPUT} "// Made by models.cmake from configs.
#include \"help/models.hpp\"

namespace clatter::app {
namespace {

constexpr Model all[] = {
${entries}};

}  // namespace

std::span<const Model> models() { return all; }

}  // namespace clatter::app
")
