# Run by cpack between installing and packing: what Debian's policy wants and others do not.
set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX})
set(documents ${root}/share/doc/arris)
file(RENAME ${documents}/LICENSE ${documents}/copyright)
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)  # or SOURCE_DATE_EPOCH
file(WRITE ${documents}/changelog.Debian
"arris (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Built from its own sources by CPack.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${today}
")
file(GLOB pages ${root}/share/man/man1/*.1)
execute_process(COMMAND gzip -9 -n -f ${pages} ${documents}/changelog.Debian
                COMMAND_ERROR_IS_FATAL ANY)
