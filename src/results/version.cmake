# Writes version.cpp at every build; configure_file leaves the file alone when nothing has changed, so nothing is
# compiled again.
# git archive puts the commit here (.gitattributes), as those do who offer archives for download.
set(ARCHIVED "$Format:%H$")
execute_process(
  COMMAND git describe --always --dirty --abbrev=40 --exclude=*
  WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE GIT_COMMIT
  OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET
  RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${SOURCE_DIR}/.git)
  string(REGEX MATCH "^[0-9a-f]+$" GIT_COMMIT "${ARCHIVED}")
endif()
if(NOT GIT_COMMIT)
  set(GIT_COMMIT unknown)
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
