// SPDX-License-Identifier: Apache-2.0
/// toml++, as this program uses it.
#pragma once

// Errors are returned as values, and nothing is printed.
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
// Some assertions of toml++ fail on mistakes that it reports itself afterwards. In a release build
// they are assumptions of the compiler, so the behaviour would be undefined.
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>
