# SPDX-License-Identifier: Apache-2.0
# Hardening as in distributions: stack protection, checked copies, control-flow protection, relocations that are
# read-only at run time. Include it before the targets are made.
include(CheckCXXCompilerFlag)
if(NOT GLTFX_STATIC)  # which has its own flags
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
