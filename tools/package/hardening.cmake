# SPDX-License-Identifier: Apache-2.0
# What makes programs harder to take over, as distributions build theirs: a stack that notices when it
# is written over, checked copies, jumps that only land where they may, tables of addresses that are
# read-only once the program runs. To be included before the targets are made.
include(CheckCXXCompilerFlag)
if(NOT GLTFX_STATIC)  # which has its own kind
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
endif()
add_compile_options(-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
check_cxx_compiler_flag(-fcf-protection GLTFX_HAS_CF_PROTECTION)  # x86
check_cxx_compiler_flag(-mbranch-protection=standard GLTFX_HAS_BRANCH_PROTECTION)  # Arm
if(GLTFX_HAS_CF_PROTECTION)
  add_compile_options(-fcf-protection)
elseif(GLTFX_HAS_BRANCH_PROTECTION)
  add_compile_options(-mbranch-protection=standard)
endif()
add_link_options(-Wl,-z,relro -Wl,-z,now)
