# cpack in a build folder makes the Debian package; scripts/tarball.sh makes the one of the sources.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clatter)
set(CPACK_PACKAGE_CONTACT "The clatter authors <clatter@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact sweeps of vibro-impact oscillators")
set(CPACK_PACKAGE_DESCRIPTION
"clatter computes how an elastic oscillator moves between rigid stops: damped,
forced, with restitution, as in vibration drives, impact dampers and gears
with play. It follows the motion from impact to impact in closed form, sweeps
any parameters on all cores, finds the steady motion at each point, and
writes one HDF5 file that is netCDF-4 too.
.
clatter-plot draws these files, clatter-report makes a page of them; both need
the recommended packages.")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-h5py, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-xarray, python3-h5netcdf | python3-netcdf4")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/apps/clatter/debian/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# The same bytes from every build of a commit: its date instead of the time of the build.
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/apps/clatter/package_date.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/apps/clatter/package_files.cmake)
include(CPack)
