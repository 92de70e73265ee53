// SPDX-License-Identifier: MIT
// Eigen includes this header of MMX without using it; clang's own refuses all machines but x86.
