# cpack runs this before it packs the files: what only Debian asks for, and one date for all, that of the commit.
set(documents ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc/clatter)

# The licences of libraries whose code gets into the program: they ask to go along with it. Boost's doesn't, nor does
# that of the compiler's library.
foreach(library libhdf5 libtomlplusplus libxsimd nlohmann-json3)
  file(READ /usr/share/doc/${library}-dev/copyright licence)
  file(WRITE ${documents}/libraries/${library} "${licence}")
endforeach()

# A changelog in Debian's form, that says the version, and then the project's own.
set(seconds $ENV{SOURCE_DATE_EPOCH})
if(NOT seconds)
  string(TIMESTAMP seconds %s UTC)
endif()
execute_process(COMMAND date --utc --rfc-email --date=@${seconds} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip --decompress --stdout ${documents}/changelog.gz OUTPUT_VARIABLE changes
  COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${documents}/changelog "clatter (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Version ${CPACK_PACKAGE_VERSION}. Its changes are listed below.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}

Old Changelog:
${changes}")
execute_process(COMMAND gzip -9 --no-name --force ${documents}/changelog COMMAND_ERROR_IS_FATAL ANY)

# Debian's zsh looks for the completions of packages elsewhere, and pages of the manual are compressed there.
file(RENAME ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/zsh/site-functions
  ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/zsh/vendor-completions)
file(GLOB pages ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/man/man*/*.[1-8])
execute_process(COMMAND gzip -9 --no-name ${pages} COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND find ${CPACK_TEMPORARY_INSTALL_DIRECTORY} -exec touch --no-dereference --date=@${seconds} {} +
  COMMAND_ERROR_IS_FATAL ANY)
