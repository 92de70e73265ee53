// SPDX-License-Identifier: MIT
// Emscripten's -msse2 stands for the vectors of SSE2, not for its registers: CGAL's assembler is left out.
#pragma push_macro("__SSE2__")
#undef __SSE2__
#include_next <CGAL/FPU.h>
#pragma pop_macro("__SSE2__")
