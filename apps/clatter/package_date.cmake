# cpack reads this first: SOURCE_DATE_EPOCH is the date of the commit, unless it is set already.
# git archive puts the date here (.gitattributes).
set(archived "$Format:%ct$")
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH apps)
  cmake_path(GET apps PARENT_PATH sources)
  if(archived MATCHES "^[0-9]+$")
    set(date ${archived})
  elseif(EXISTS ${sources}/.git)
    execute_process(COMMAND git log -1 --format=%ct WORKING_DIRECTORY ${sources} OUTPUT_VARIABLE date
      OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
  if(date)
    set(ENV{SOURCE_DATE_EPOCH} ${date})
  else()
    message(WARNING "The date of the commit is unknown, so every build makes other bytes; set SOURCE_DATE_EPOCH.")
  endif()
endif()
