# SPDX-License-Identifier: Apache-2.0
# Debian packages by `cmake --build BUILD --target package`; the preset "deb" has the flags for them.

# Requirements of Debian's policy: only in packages, not with `cmake --install`.
if(GLTFX_GZIP)
  set(changelog ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
  add_custom_command(OUTPUT ${changelog}
    COMMAND sh -c "\"$0\" -9nc changelog > \"$1\"" ${GLTFX_GZIP} ${changelog}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} DEPENDS changelog VERBATIM)
  add_custom_target(gltfx_changelog ALL DEPENDS ${changelog})
endif()
set(packages program:gltfx library:libgltfx-dev)
if(TARGET gltfx_codec_openimageio)
  list(APPEND packages openimageio:gltfx-openimageio)
endif()
foreach(component_package ${packages})
  string(REPLACE ":" ";" component_package ${component_package})
  list(GET component_package 0 component)
  list(GET component_package 1 package)
  install(FILES copyright ${changelog} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gltfx)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${GLTFX_PACKAGE_MAINTAINER})
set(CPACK_PACKAGE_VENDOR "gltfx developers")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET gltfx_codec_openimageio)
  list(APPEND CPACK_COMPONENTS_ALL openimageio)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# The default of CMake, which alone does not come before the summaries below.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "gltfx built using CMake")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gltfx)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "git, gltfx-openimageio")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
  "validates, upgrades and draws glTF 2.0 assets
gltfx opens glTF 2.0 assets from any source and says what is wrong with them
and where, brings extensions of former drafts to those of today without
touching anything else, and draws pictures of assets on the CPU.
.
Assets are not trusted: images and compressed geometry are decoded by
separate programs with limits on memory and time.")

set(CPACK_DEBIAN_OPENIMAGEIO_PACKAGE_NAME gltfx-openimageio)
set(CPACK_DEBIAN_OPENIMAGEIO_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_OPENIMAGEIO_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_OPENIMAGEIO_PACKAGE_DEPENDS "gltfx (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_OPENIMAGEIO_DESCRIPTION
  "decoder of foreign images for gltfx
With it gltfx decodes images that glTF 2.0 does not allow though assets have
them: BMP, TGA, GIF, TIFF, PSD, DDS, JPEG 2000 and PNM.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libgltfx-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
# Users' programs start the decoders of the other package.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "gltfx (= ${PROJECT_VERSION}), libembree-dev, \
libfmt-dev, libmeshoptimizer-dev, libsimdjson-dev, libsodium-dev, libtbb-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS libtinygltf-dev)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION
  "library to validate, upgrade and draw glTF 2.0 assets
Headers and archives of the C++20 library behind the program gltfx, for CMake
(gltfx::gltfx, and gltfx::tinygltf for models of tinygltf) and pkg-config.")
include(CPack)
