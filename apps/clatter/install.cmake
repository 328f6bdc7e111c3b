# Everything that users run or read goes to the usual places under the prefix; nothing in there knows the prefix.
include(GNUInstallDirs)
set(share ${CMAKE_INSTALL_DATADIR}/clatter)
install(TARGETS clatter RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET clatter-verify)
  install(TARGETS clatter-verify RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

file(GLOB configs CONFIGURE_DEPENDS configs/*.toml configs/*.ini configs/*.csv)
install(FILES ${configs} DESTINATION ${share}/configs)

install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_DATADIR})
if(TARGET manual_of_verifier)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/manual_of_verifier/ DESTINATION ${CMAKE_INSTALL_DATADIR})
endif()

# Scripts for users, and the Python package, which they find beside them. The others need the sources, and stay there.
set(entries scripts/plot.py scripts/report.py)
install(PROGRAMS ${entries} DESTINATION ${share}/scripts)
install(DIRECTORY scripts/clatter DESTINATION ${share}/scripts
  FILES_MATCHING PATTERN "*.py" PATTERN "*.css" PATTERN "*.js" PATTERN __pycache__ EXCLUDE)
install(PROGRAMS scripts/slurm/submit.sh scripts/slurm/sweep.sbatch DESTINATION ${share}/scripts/slurm)

# clatter-plot and clatter-report: links that hold wherever the prefix is moved.
file(RELATIVE_PATH to_scripts ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/clatter/scripts)
foreach(entry ${entries})
  cmake_path(GET entry STEM name)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links)
  file(CREATE_LINK ${to_scripts}/${name}.py ${PROJECT_BINARY_DIR}/links/clatter-${name} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/links/clatter-${name} DESTINATION ${CMAKE_INSTALL_BINDIR})
endforeach()

# The guides and their pictures, laid out as in the sources: they link to each other.
file(GLOB_RECURSE guides CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  apps/README.md configs/README.md configs/*.svg scripts/README.md src/README.md tests/README.md)
foreach(guide README.md ${guides})
  cmake_path(GET guide PARENT_PATH room)
  install(FILES ${guide} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${room})
endforeach()

# The licence in Debian's format, with LICENSE's own words, and the changelog without a time of its own.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS LICENSE CHANGELOG.md)
file(READ LICENSE licence)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)" notice "${licence}")
set(holders "${CMAKE_MATCH_1}")
string(REGEX REPLACE "^.*${holders}\n+" "" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
configure_file(apps/clatter/copyright.in ${PROJECT_BINARY_DIR}/copyright @ONLY)
find_program(GZIP gzip REQUIRED)
execute_process(COMMAND ${GZIP} -9 --no-name --stdout ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${PROJECT_BINARY_DIR}/copyright ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
